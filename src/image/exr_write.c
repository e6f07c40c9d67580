/* SPDX-License-Identifier: MIT */
/* Multi-layer scanline EXR through OpenEXRCore, written into the atomic file. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <math.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/exr_names.h"
#include "image/file_whole.h"
#include "image/frame_rate.h"
#include "image/picture_formats.h"

enum {
    ZIP_LEVEL = 4, /* stated, so that another version's default does not change our bytes */
    CHANNELS_MAX = 64,
    PARTS_MAX = CHANNELS_MAX
};

typedef struct exr_sink {
    output_file *file;
    file_error *error;
    file_status status;
} exr_sink;

/* One channel of the file and where its values come from. */
typedef struct exr_source {
    char name[EXR_CHANNEL_NAME_SIZE];
    const picture_layer *layer;
    uint32_t component;
    int part;
} exr_source;

typedef struct exr_parts {
    int count;
    const char *names[PARTS_MAX];
} exr_parts;

static int64_t sink_write(exr_const_context_t context, void *user, const void *bytes, uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t report)
{
    (void)context;
    (void)report;
    exr_sink *sink = user;
    if (sink->status == FILE_OK)
        sink->status = output_file_write_at(sink->file, offset, bytes, (size_t)size, sink->error);
    return sink->status == FILE_OK ? (int64_t)size : -1;
}

/* Without a handler of ours the library prints to stderr. */
static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

/* The part of a layer, which may be a new one. */
static int take_part(exr_parts *parts, const picture_layer *layer, bool several)
{
    const char *name = !several ? "mangata" : layer->part ? layer->part : layer->name;
    int i = 0;
    while (i < parts->count && strcmp(parts->names[i], name) != 0)
        i++;
    if (i == parts->count)
        parts->names[parts->count++] = name;
    return i;
}

/* Lists the channels of all layers and their parts; 0 with an error set where a layer cannot be written. */
static int list_sources(exr_source *sources, exr_parts *parts, bool several, const char *path, const picture_layer *layers, size_t count, file_error *error)
{
    int used = 0;
    for (size_t i = 0; i < count; i++) {
        const picture_layer *layer = &layers[i];
        if ((layer->channels != 1 && layer->channels != 3) || !exr_layer_name_is_valid(layer->name))
            return file_error_set(error, FILE_ARGUMENT, "%s: an EXR layer has a name of letters, digits and _, and 1 or 3 channels", path), 0;
        for (uint32_t c = 0; c < layer->channels; c++) {
            if (used == CHANNELS_MAX)
                return file_error_set(error, FILE_ARGUMENT, "%s: more than %d channels", path, (int)CHANNELS_MAX), 0;
            exr_source *source = &sources[used];
            if (layer->channel)
                snprintf(source->name, sizeof source->name, "%s", layer->channel);
            else
                exr_channel_name(source->name, layer->name, layer->channels, c);
            source->layer = layer;
            source->component = c;
            source->part = take_part(parts, layer, several);
            for (int other = 0; other < used; other++)
                if (strcmp(sources[other].name, source->name) == 0)
                    return file_error_set(error, FILE_ARGUMENT, "%s: channel %s is given twice", path, source->name), 0;
            used++;
        }
    }
    if (used == 0)
        file_error_set(error, FILE_ARGUMENT, "%s: an EXR needs a layer", path);
    return used;
}

/* ---- the header ---- */

static bool is_half(const exr_desc *desc, const exr_source *source) { return desc->half && !source->layer->exact; }

static exr_compression_t compression_of(const exr_desc *desc)
{
    return desc->packing == EXR_PACKING_PIZ ? EXR_COMPRESSION_PIZ : desc->packing == EXR_PACKING_NONE ? EXR_COMPRESSION_NONE : EXR_COMPRESSION_ZIP;
}

static exr_result_t write_windows(exr_context_t context, int part, uint32_t width, uint32_t height, const exr_desc *desc)
{
    const uint32_t display_width = desc->display_width ? desc->display_width : width, display_height = desc->display_height ? desc->display_height : height;
    const exr_attr_box2i_t display = {{{{0, 0}}}, {{{(int32_t)display_width - 1, (int32_t)display_height - 1}}}};
    const exr_attr_box2i_t data = {{{{(int32_t)desc->x, (int32_t)desc->y}}}, {{{(int32_t)(desc->x + width) - 1, (int32_t)(desc->y + height) - 1}}}};
    const exr_attr_v2f_t center = {{{0, 0}}};
    return exr_initialize_required_attr(context, part, &display, &data, 1.0f, &center, desc->described ? (float)desc->screen_width : 1.0f,
                                        EXR_LINEORDER_INCREASING_Y, compression_of(desc));
}

static exr_result_t write_matrix(exr_context_t context, int part, const char *name, const double from[4][4])
{
    exr_attr_m44f_t matrix;
    for (int i = 0; i < 16; i++)
        matrix.m[i] = (float)from[i / 4][i % 4];
    return exr_attr_set_m44f(context, part, name, &matrix);
}

static exr_result_t write_rate(exr_context_t context, int part, double rate)
{
    const frame_rate exact = frame_rate_of(rate);
    const exr_attr_rational_t rational = {.num = (int32_t)exact.numerator, .denom = exact.denominator};
    return exr_attr_set_rational(context, part, "framesPerSecond", &rational);
}

static exr_result_t write_description(exr_context_t context, int part, const exr_desc *desc)
{
    static const exr_attr_chromaticities_t srgb =
        {.red_x = 0.64f, .red_y = 0.33f, .green_x = 0.3f, .green_y = 0.6f, .blue_x = 0.15f, .blue_y = 0.06f, .white_x = 0.3127f, .white_y = 0.329f};
    static const exr_attr_chromaticities_t ap1 =
        {.red_x = 0.713f, .red_y = 0.293f, .green_x = 0.165f, .green_y = 0.83f, .blue_x = 0.128f, .blue_y = 0.044f, .white_x = 0.32168f, .white_y = 0.33767f};
    exr_result_t code = exr_attr_set_chromaticities(context, part, "chromaticities", desc->acescg ? &ap1 : &srgb);
    if (!code)
        code = exr_attr_set_float(context, part, "whiteLuminance", (float)desc->nits);
    if (!code && desc->frames_per_second > 0)
        code = write_rate(context, part, desc->frames_per_second);
    if (!code && desc->exposure > 0)
        code = exr_attr_set_float(context, part, "expTime", (float)desc->exposure);
    if (!code)
        code = write_matrix(context, part, "worldToCamera", desc->world_to_camera);
    return code ? code : write_matrix(context, part, "worldToNDC", desc->world_to_ndc);
}

static exr_result_t write_strings(exr_context_t context, int part, const metadata_entry *entries, size_t count)
{
    exr_result_t code = EXR_ERR_SUCCESS;
    for (size_t i = 0; i < count && !code; i++)
        code = exr_attr_set_string(context, part, entries[i].key, entries[i].value);
    return code;
}

static exr_result_t write_metadata(exr_context_t context, const metadata_list *metadata)
{
    char name[EXR_ATTRIBUTE_NAME_SIZE];
    exr_result_t code = EXR_ERR_SUCCESS;
    for (size_t i = 0; i < metadata->count && !code; i++) {
        exr_attribute_name(name, metadata->entries[i].key);
        code = exr_attr_set_string(context, 0, name, metadata->entries[i].value);
    }
    exr_attribute_name(name, FILE_CHECK_KEY);
    return code ? code : exr_attr_set_string(context, 0, name, FILE_CHECK_NONE);
}

static exr_result_t add_part(exr_context_t context, const char *name, uint32_t width, uint32_t height, const exr_desc *desc, int *part)
{
    exr_result_t code = exr_add_part(context, name, EXR_STORAGE_SCANLINE, part);
    if (!code)
        code = write_windows(context, *part, width, height, desc);
    if (!code && desc->described)
        code = write_description(context, *part, desc);
    return code ? code : exr_set_zip_compression_level(context, *part, ZIP_LEVEL);
}

static exr_result_t write_header(exr_context_t context, uint32_t width, uint32_t height, const exr_source *sources, int count, const exr_parts *parts,
                                 const exr_desc *desc, const metadata_list *metadata)
{
    exr_result_t code = exr_set_longname_support(context, 1);
    for (int p = 0; p < parts->count && !code; p++) {
        int part = 0;
        code = add_part(context, parts->names[p], width, height, desc, &part);
        for (int i = 0; i < count && !code; i++)
            if (sources[i].part == part)
                code = exr_add_channel(context, part, sources[i].name, is_half(desc, &sources[i]) ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                                       EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    }
    if (metadata && !code)
        code = write_metadata(context, metadata);
    if (!code)
        code = write_strings(context, sources[count - 1].part, desc->attributes, desc->attribute_count);
    return code ? code : exr_write_header(context);
}

static const exr_source *find_source(const exr_source *sources, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(sources[i].name, name) == 0)
            return &sources[i];
    return NULL;
}

/* Within what a half float holds; infinities stay. */
static float within_half(float value)
{
    enum { HALF_MAX = 65504 };
    if (!isfinite(value))
        return value;
    return value > HALF_MAX ? HALF_MAX : value < -HALF_MAX ? -HALF_MAX : value;
}

/* Gathers a chunk's rows of every channel into the planar `band` and points the encoder there. */
static exr_result_t gather_band(exr_encode_pipeline_t *encoder, float *band, uint32_t width, uint32_t y, int32_t rows, const exr_source *sources, int count,
                                const exr_desc *desc)
{
    for (int c = 0; c < encoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &encoder->channels[c];
        const exr_source *source = find_source(sources, count, channel->channel_name);
        if (!source)
            return EXR_ERR_INVALID_ARGUMENT;
        const picture_layer *layer = source->layer;
        const bool half = is_half(desc, source);
        size_t step = layer->pixel_floats ? layer->pixel_floats : layer->channels;
        channel->encode_from_ptr = (const uint8_t *)band;
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_pixel_stride = (int32_t)sizeof(float);
        channel->user_line_stride = (int32_t)(width * sizeof(float));
        for (int32_t row = 0; row < rows; row++) {
            const float *from = picture_row(layer->pixels, width * step * sizeof(float), layer->row_stride, y + (uint32_t)row);
            for (uint32_t x = 0; x < width; x++) {
                memcpy(band, from + x * step + source->component, sizeof(float));
                if (half)
                    *band = within_half(*band);
                band++;
            }
        }
    }
    return EXR_ERR_SUCCESS;
}

/* Chunks that do not shrink are stored as they are, which readers tell by their size. OpenEXR 3.1 does so only for those that grow: one that is as long
 * compressed as it was is then read as if it were not compressed. */
static exr_result_t compress_or_store(exr_encode_pipeline_t *encoder)
{
    exr_result_t (*const *compress)(exr_encode_pipeline_t *) = encoder->encoding_user_data;
    const exr_result_t code = (*compress)(encoder);
    if (!code && encoder->compressed_bytes == encoder->packed_bytes)
        memcpy(encoder->compressed_buffer, encoder->packed_buffer, encoder->packed_bytes);
    return code;
}

static exr_result_t write_pixels(exr_context_t context, int part, float *band, uint32_t width, uint32_t height, const exr_source *sources, int count,
                                 const exr_desc *desc)
{
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t (*compress)(exr_encode_pipeline_t *) = NULL;
    exr_chunk_info_t chunk;
    int32_t rows = 0;
    exr_result_t code = exr_get_scanlines_per_chunk(context, part, &rows);
    for (uint32_t y = 0; y < height && !code; y += (uint32_t)rows) {
        code = exr_write_scanline_chunk_info(context, part, (int)(desc->y + y), &chunk);
        if (!code && y == 0)
            code = exr_encoding_initialize(context, part, &chunk, &encoder);
        else if (!code)
            code = exr_encoding_update(context, part, &chunk, &encoder);
        if (!code)
            code = gather_band(&encoder, band, width, y, chunk.height, sources, count, desc);
        if (!code && y == 0)
            code = exr_encoding_choose_default_routines(context, part, &encoder);
        if (!code && y == 0 && encoder.compress_fn) {
            compress = encoder.compress_fn;
            encoder.encoding_user_data = &compress;
            encoder.compress_fn = compress_or_store;
        }
        if (!code)
            code = exr_encoding_run(context, part, &encoder);
    }
    exr_encoding_destroy(context, &encoder);
    return code;
}

file_status picture_write_exr(const char *path, uint32_t width, uint32_t height, const picture_layer *layers, size_t layer_count, const metadata_list *metadata,
                              const output_options *options, file_error *error)
{
    const exr_desc plain = {0};
    return picture_write_exr_described(path, width, height, layers, layer_count, &plain, metadata, options, error);
}

file_status picture_write_exr_described(const char *path, uint32_t width, uint32_t height, const picture_layer *layers, size_t layer_count,
                                        const exr_desc *desc, const metadata_list *metadata, const output_options *options, file_error *error)
{
    enum { CHUNK_ROWS_MAX = 32 }; /* of PIZ */
    exr_source sources[CHANNELS_MAX];
    exr_parts parts = {0};
    file_status status = picture_check_size(path, width, height, error);
    if (status == FILE_OK)
        status = metadata_check(metadata, error);
    if (status != FILE_OK)
        return status;
    int count = list_sources(sources, &parts, desc->parts, path, layers, layer_count, error);
    if (count == 0)
        return FILE_ARGUMENT;

    exr_sink sink = {.error = error};
    exr_context_t context = NULL;
    float *band = malloc((size_t)width * CHUNK_ROWS_MAX * (size_t)count * sizeof *band);
    if (!band)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    status = output_file_open(&sink.file, path, options, error);
    if (status != FILE_OK)
        goto fail;

    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = ignore_message;
    initializer.user_data = &sink;
    initializer.write_fn = sink_write;
    exr_result_t code = exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &initializer);
    if (!code)
        code = write_header(context, width, height, sources, count, &parts, desc, metadata);
    for (int part = 0; part < parts.count && !code; part++)
        code = write_pixels(context, part, band, width, height, sources, count, desc);
    /* Writes the table of chunks, too. */
    exr_result_t finish_code = context ? exr_finish(&context) : EXR_ERR_SUCCESS;
    if (!code)
        code = finish_code;
    if (code || sink.status != FILE_OK) {
        status = sink.status != FILE_OK          ? sink.status
                 : code == EXR_ERR_OUT_OF_MEMORY ? file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM)
                                                 : file_error_set(error, FILE_WRITE, "%s: cannot encode: %s", path, exr_get_default_error_message(code));
        goto fail;
    }
    status = metadata ? file_check_seal_exr(sink.file, path, error) : FILE_OK;
    if (status != FILE_OK)
        goto fail;
    status = output_file_finish(sink.file, error);
    sink.file = NULL;

fail:
    output_file_abort(sink.file);
    free(band);
    return status;
}
