/* SPDX-License-Identifier: MIT */
/* Scanline EXR through OpenEXRCore: one layer as floats, or one string attribute. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "image/exr_names.h"
#include "image/exr_primaries.h"
#include "image/picture_formats.h"

enum { LAYER_CHANNELS_MAX = 4 };

/* The channels of one layer, in the order of the pixels: indices into the file's list. */
typedef struct exr_selection {
    int count;
    int channels[LAYER_CHANNELS_MAX];
} exr_selection;

static int64_t source_read(exr_const_context_t context, void *user, void *bytes, uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t report)
{
    (void)context;
    (void)report;
    const input_file *input = user;
    uint64_t done = 0;
    while (done < size) {
        ssize_t got = pread(fileno(input->stream), (char *)bytes + done, (size_t)(size - done), (off_t)(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        done += (uint64_t)got;
    }
    return (int64_t)done;
}

static int64_t source_size(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((const input_file *)user)->size;
}

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static exr_result_t start_read(exr_context_t *context, const input_file *input)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = ignore_message;
    initializer.user_data = (void *)input;
    initializer.read_fn = source_read;
    initializer.size_fn = source_size;
    initializer.max_image_width = PICTURE_SIDE_MAX;
    initializer.max_image_height = PICTURE_SIDE_MAX;
    /* A damaged file is an error, not a puzzle. */
    initializer.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    return exr_start_read(context, input->path, &initializer);
}

static file_status bad_exr(const input_file *input, exr_result_t code, file_error *error)
{
    if (code == EXR_ERR_OUT_OF_MEMORY)
        return file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
    return file_error_set(error, FILE_BAD, "%s: is not a sound EXR: %s", input->path, exr_get_default_error_message(code));
}

/* ---- choosing channels ---- */

/* Length of the layer's part of a channel name: "normal.X" 6, "R" 0. */
static size_t layer_length(const char *channel)
{
    const char *dot = strrchr(channel, '.');
    return dot ? (size_t)(dot - channel) : 0;
}

static bool in_layer(const char *channel, const char *layer, size_t length) { return layer_length(channel) == length && strncmp(channel, layer, length) == 0; }

/* Components in the order people expect, R G B A, X Y Z, in whatever case; anything else after them in the file's order. */
static int component_rank(const char *channel)
{
    static const char *const order[][2] = {{"R", "red"}, {"G", "green"}, {"B", "blue"}, {"A", "alpha"}, {"X", "X"}, {"Y", "Y"}, {"Z", "Z"}};
    enum { RANKS = sizeof order / sizeof order[0] };
    size_t length = layer_length(channel);
    const char *component = channel + length + (length > 0 || channel[0] == '.' ? 1 : 0);
    int rank = 0;
    while (rank < RANKS && strcasecmp(component, order[rank][0]) != 0 && strcasecmp(component, order[rank][1]) != 0)
        rank++;
    return rank;
}

/* Takes the channels of a layer (length 0: the nameless one), at most four; colour goes without alpha. */
static exr_selection select_layer(const exr_attr_chlist_t *list, const char *layer, size_t length)
{
    exr_selection selection = {0};
    for (int rank = 0; rank <= 8; rank++)
        for (int i = 0; i < list->num_channels && selection.count < LAYER_CHANNELS_MAX; i++) {
            const char *name = list->entries[i].name.str;
            if (in_layer(name, layer, length) && component_rank(name) == rank)
                selection.channels[selection.count++] = i;
        }
    if (selection.count == 4 && component_rank(list->entries[selection.channels[3]].name.str) == 3)
        selection.count = 3;
    return selection;
}

static exr_selection select_color(const exr_attr_chlist_t *list)
{
    static const char *const names[] = {"R", "G", "B"};
    exr_selection selection = {0};
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < list->num_channels; i++)
            if (strcmp(list->entries[i].name.str, names[c]) == 0)
                selection.channels[selection.count++] = i;
    if (selection.count == 3)
        return selection;
    selection = select_layer(list, "", 0);
    bool named = selection.count >= 3;
    for (int c = 0; c < 3; c++)
        named = named && component_rank(list->entries[selection.channels[c]].name.str) == c;
    selection.count = named ? 3 : 0;
    if (named)
        return selection;
    for (int i = 0; i < list->num_channels; i++)
        if (strcmp(list->entries[i].name.str, "Y") == 0)
            selection = (exr_selection){1, {i}};
    return selection;
}

/* The layer that all channels share, if they do. */
static exr_selection select_only(const exr_attr_chlist_t *list)
{
    const char *first = list->num_channels > 0 ? list->entries[0].name.str : "";
    size_t length = layer_length(first);
    for (int i = 0; i < list->num_channels; i++)
        if (!in_layer(list->entries[i].name.str, first, length))
            return (exr_selection){0};
    return select_layer(list, first, length);
}

static exr_selection select_channels(const exr_attr_chlist_t *list, const char *layer)
{
    exr_selection selection = {0};
    if (!layer || strcmp(layer, "color") == 0)
        selection = select_color(list);
    if (selection.count == 0 && !layer)
        selection = select_only(list);
    if (selection.count == 0 && layer && *layer)
        selection = select_layer(list, layer, strlen(layer));
    for (int i = 0; selection.count == 0 && layer && i < list->num_channels; i++)
        if (strcmp(list->entries[i].name.str, layer) == 0)
            selection = (exr_selection){1, {i}};
    return selection;
}

/* The channels of one part. */
typedef struct exr_found {
    int part;
    const exr_attr_chlist_t *list;
    exr_selection selection; /* none: there is no such layer */
} exr_found;

/* The nameless channels of the part of this name, as other programs write layers. */
static exr_result_t find_part(exr_context_t context, int parts, const char *name, exr_found *found)
{
    exr_result_t code = EXR_ERR_SUCCESS;
    for (int part = 0; part < parts && found->selection.count == 0 && !code; part++) {
        const char *own = NULL;
        if (exr_get_name(context, part, &own) != EXR_ERR_SUCCESS || !own || strcmp(own, name) != 0)
            continue;
        found->part = part;
        code = exr_get_channels(context, part, &found->list);
        if (!code)
            found->selection = select_channels(found->list, NULL);
    }
    return code;
}

static exr_result_t find_layer(exr_context_t context, const char *layer, exr_found *found)
{
    int parts = 0;
    exr_result_t code = exr_get_count(context, &parts);
    *found = (exr_found){0};
    for (int part = 0; part < parts && found->selection.count == 0 && !code; part++) {
        found->part = part;
        code = exr_get_channels(context, part, &found->list);
        if (!code)
            found->selection = select_channels(found->list, layer || parts == 1 ? layer : "color");
    }
    if (!code && found->selection.count == 0 && layer && parts > 1)
        code = find_part(context, parts, layer, found);
    return code;
}

static file_status no_such_layer(exr_context_t context, const input_file *input, const char *layer, file_error *error)
{
    char names[256] = "";
    size_t used = 0;
    int parts = 0;
    exr_get_count(context, &parts);
    for (int part = 0; part < parts; part++) {
        const exr_attr_chlist_t *list = NULL;
        const bool good = exr_get_channels(context, part, &list) == EXR_ERR_SUCCESS;
        for (int i = 0; good && i < list->num_channels && used < sizeof names; i++) {
            int length = snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", list->entries[i].name.str);
            used += length > 0 ? (size_t)length : 0;
        }
    }
    return file_error_set(error, FILE_ARGUMENT, "%s: has no layer %s; its channels are: %s", input->path, layer ? layer : "color", names);
}

/* ---- pixels ---- */

static exr_result_t read_pixels(exr_context_t context, float_image *image, const exr_found *found, int32_t first_y)
{
    const exr_attr_chlist_t *list = found->list;
    const exr_selection *selection = &found->selection;
    const int part = found->part;
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_chunk_info_t chunk;
    int32_t rows = 0;
    bool initialized = false;
    exr_result_t code = exr_get_scanlines_per_chunk(context, part, &rows);
    if (!code && rows < 1)
        code = EXR_ERR_FILE_BAD_HEADER;
    for (uint32_t y = 0; y < image->height && !code; y += (uint32_t)rows) {
        code = exr_read_scanline_chunk_info(context, part, (int)(first_y + (int64_t)y), &chunk);
        if (code)
            break;
        uint32_t expected = image->height - y < (uint32_t)rows ? image->height - y : (uint32_t)rows;
        if (chunk.start_y != first_y + (int64_t)y || chunk.height != (int32_t)expected || chunk.width != (int32_t)image->width) {
            code = EXR_ERR_BAD_CHUNK_LEADER;
            break;
        }
        code = initialized ? exr_decoding_update(context, part, &chunk, &decoder) : exr_decoding_initialize(context, part, &chunk, &decoder);
        for (int c = 0; c < decoder.channel_count && !code; c++)
            decoder.channels[c].decode_to_ptr = NULL;
        for (int s = 0; s < selection->count && !code; s++) {
            int index = selection->channels[s];
            if (index >= decoder.channel_count || strcmp(decoder.channels[index].channel_name, list->entries[index].name.str) != 0) {
                code = EXR_ERR_INCORRECT_CHUNK;
                break;
            }
            exr_coding_channel_info_t *channel = &decoder.channels[index];
            channel->decode_to_ptr = (uint8_t *)(image->pixels + (size_t)y * image->width * image->channels + s);
            channel->user_data_type = EXR_PIXEL_FLOAT;
            channel->user_bytes_per_element = (int16_t)sizeof(float);
            channel->user_pixel_stride = (int32_t)(image->channels * sizeof(float));
            channel->user_line_stride = (int32_t)(image->width * image->channels * sizeof(float));
        }
        if (!code && !initialized)
            code = exr_decoding_choose_default_routines(context, part, &decoder);
        initialized = true;
        if (!code)
            code = exr_decoding_run(context, part, &decoder);
    }
    exr_decoding_destroy(context, &decoder);
    return code;
}

/* B44 packs half channels alone. Chunks without such channels are as large as their pixels, so that OpenEXRCore takes them for unpacked ones, but are in
 * another order. */
static bool is_b44_misread(exr_compression_t compression, const exr_attr_chlist_t *list)
{
    if (compression != EXR_COMPRESSION_B44 && compression != EXR_COMPRESSION_B44A)
        return false;
    for (int c = 0; c < list->num_channels; c++)
        if (list->entries[c].pixel_type == EXR_PIXEL_HALF)
            return false;
    return true;
}

/* Refuses, with a reason, what this reader does not unpack. */
static file_status check_kind(exr_context_t context, int part, const input_file *input, file_error *error)
{
    static const char allowed[] = "allowed: none, RLE, ZIPS, ZIP, PIZ, PXR24, and B44 of half channels";
    exr_storage_t storage;
    exr_compression_t compression;
    const exr_attr_chlist_t *list = NULL;
    exr_result_t code = exr_get_storage(context, part, &storage);
    if (!code && storage != EXR_STORAGE_SCANLINE)
        return file_error_set(error, FILE_BAD, "%s: tiled and deep EXR are not supported; allowed: scanlines", input->path);
    if (!code)
        code = exr_get_compression(context, part, &compression);
    if (!code)
        code = exr_get_channels(context, part, &list);
    if (!code && (compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB))
        return file_error_set(error, FILE_BAD, "%s: DWA compression is not supported; %s", input->path, allowed);
    if (!code && is_b44_misread(compression, list))
        return file_error_set(error, FILE_BAD, "%s: B44 compression without half channels is not supported; %s", input->path, allowed);
    return code ? bad_exr(input, code, error) : FILE_OK;
}

/* Colours become those of the primaries of sRGB, where the file says that they are others. */
static void convert_color(exr_context_t context, const exr_found *found, float_image *image)
{
    const exr_attribute_t *attribute = NULL;
    bool color = found->selection.count == 3;
    for (int c = 0; c < 3 && color; c++)
        color = component_rank(found->list->entries[found->selection.channels[c]].name.str) == c;
    if (color && exr_get_attribute_by_name(context, found->part, "chromaticities", &attribute) == EXR_ERR_SUCCESS && attribute->type == EXR_ATTR_CHROMATICITIES)
        exr_primaries_to_srgb(image->pixels, (size_t)image->width * image->height, attribute->chromaticities);
}

bool exr_origin_read(const input_file *input, int32_t origin[2])
{
    exr_context_t context = NULL;
    exr_attr_box2i_t window;
    const bool good = start_read(&context, input) == EXR_ERR_SUCCESS && exr_get_data_window(context, 0, &window) == EXR_ERR_SUCCESS;
    if (good) {
        origin[0] = window.min.x;
        origin[1] = window.min.y;
    }
    if (context)
        exr_finish(&context);
    return good;
}

file_status exr_read(float_image *image, const input_file *input, const char *layer, file_error *error)
{
    exr_context_t context = NULL;
    exr_found found;
    exr_attr_box2i_t window;
    file_status status;
    exr_result_t code = start_read(&context, input);
    if (code) {
        status = bad_exr(input, code, error);
        goto fail;
    }
    code = find_layer(context, layer, &found);
    status = code ? bad_exr(input, code, error) : check_kind(context, found.part, input, error);
    if (status != FILE_OK)
        goto fail;
    code = exr_get_data_window(context, found.part, &window);
    if (code) {
        status = bad_exr(input, code, error);
        goto fail;
    }
    if (found.selection.count == 0) {
        status = no_such_layer(context, input, layer, error);
        goto fail;
    }
    for (int s = 0; s < found.selection.count; s++) {
        const exr_attr_chlist_entry_t *entry = &found.list->entries[found.selection.channels[s]];
        if (entry->x_sampling != 1 || entry->y_sampling != 1) {
            status = file_error_set(error, FILE_BAD, "%s: subsampled channels are not supported", input->path);
            goto fail;
        }
    }
    int64_t width = (int64_t)window.max.x - window.min.x + 1;
    int64_t height = (int64_t)window.max.y - window.min.y + 1;
    image->width = width >= 1 && width <= PICTURE_SIDE_MAX ? (uint32_t)width : 0;
    image->height = height >= 1 && height <= PICTURE_SIDE_MAX ? (uint32_t)height : 0;
    image->channels = (uint32_t)found.selection.count;
    status = float_image_allocate(image, input->path, error);
    if (status != FILE_OK)
        goto fail;
    code = read_pixels(context, image, &found, window.min.y);
    if (code)
        status = bad_exr(input, code, error);
    else
        convert_color(context, &found, image);

fail:
    if (context)
        exr_finish(&context);
    return status;
}

file_status exr_metadata_read(const input_file *input, const char *key, char **value, file_error *error)
{
    exr_context_t context = NULL;
    file_status status = FILE_OK;
    char name[EXR_ATTRIBUTE_NAME_SIZE];
    const exr_attribute_t *attribute = NULL;
    exr_attribute_name(name, key);
    exr_result_t code = start_read(&context, input);
    if (code)
        status = bad_exr(input, code, error);
    else if (exr_get_attribute_by_name(context, 0, name, &attribute) == EXR_ERR_SUCCESS && attribute->type == EXR_ATTR_STRING) {
        *value = strndup(attribute->string->str, (size_t)attribute->string->length);
        if (!*value)
            status = file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
    }
    if (context)
        exr_finish(&context);
    return status;
}
