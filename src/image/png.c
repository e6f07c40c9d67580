/* SPDX-License-Identifier: MIT */
/* PNG through libspng: rows streamed into the atomic file; 8 and 16 bit reading. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <spng.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture_formats.h"

/* Below the usual 6: frames are written as fast as they are rendered only with a quicker deflate, and hardly grow. */
enum { COMPRESSION_LEVEL = 4 };

typedef struct png_sink {
    output_file *file;
    file_error *error;
    file_status status;
} png_sink;

static int sink_write(spng_ctx *context, void *user, void *bytes, size_t size)
{
    (void)context;
    png_sink *sink = user;
    sink->status = output_file_write(sink->file, bytes, size, sink->error);
    return sink->status == FILE_OK ? 0 : SPNG_IO_ERROR;
}

static bool is_ascii(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text >= 0x80)
            return false;
    return true;
}

/* The texts borrow the list's strings; the array is allocated. NULL: out of memory. The library takes no empty text, so an empty
 * value is left out. */
static struct spng_text *texts_of(const metadata_list *metadata, uint32_t *count)
{
    static char empty[1] = "";
    struct spng_text *texts = calloc(metadata->count, sizeof *texts);
    *count = 0;
    for (size_t i = 0; texts && i < metadata->count; i++) {
        const metadata_entry *entry = &metadata->entries[i];
        if (entry->value[0] == '\0')
            continue;
        struct spng_text *text = &texts[(*count)++];
        memcpy(text->keyword, entry->key, strlen(entry->key) + 1); /* metadata_check: at most 79 */
        text->text = (char *)entry->value;                         /* the encoder only reads it */
        text->length = strlen(entry->value);
        text->type = is_ascii(entry->value) ? SPNG_TEXT : SPNG_ITXT;
        text->language_tag = text->translated_keyword = empty;
    }
    return texts;
}

static file_status write_png(const char *path, uint32_t width, uint32_t height, const uint8_t *rgba, ptrdiff_t row_stride, bool alpha,
                             const metadata_list *metadata, const output_options *options, file_error *error)
{
    file_status status = picture_check_size(path, width, height, error);
    if (status == FILE_OK)
        status = metadata_check(metadata, error);
    if (status != FILE_OK)
        return status;

    size_t row_bytes = (size_t)width * (alpha ? 4 : 3);
    png_sink sink = {.error = error};
    spng_ctx *context = NULL;
    struct spng_text *texts = NULL;
    uint8_t *row = malloc(row_bytes);
    status = output_file_open(&sink.file, path, options, error);
    if (status != FILE_OK)
        goto fail;
    status = FILE_MEMORY;
    context = spng_ctx_new(SPNG_CTX_ENCODER);
    if (!row || !context)
        goto fail;

    struct spng_ihdr header = {.width = width,
                               .height = height,
                               .bit_depth = 8,
                               .color_type = alpha ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR};
    int code = spng_set_png_stream(context, sink_write, &sink);
    if (!code)
        code = spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, COMPRESSION_LEVEL);
    if (!code)
        code = spng_set_option(context, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_ALL);
    if (!code)
        code = spng_set_ihdr(context, &header);
    if (!code)
        code = spng_set_srgb(context, 0); /* perceptual intent */
    if (!code && metadata && metadata->count > 0) {
        uint32_t count;
        texts = texts_of(metadata, &count);
        if (!texts)
            goto fail;
        if (count > 0)
            code = spng_set_text(context, texts, count);
    }
    if (!code)
        code = spng_encode_image(context, NULL, 0, SPNG_FMT_PNG, SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE);
    for (uint32_t y = 0; y < height && !code; y++) {
        const uint8_t *from = picture_row(rgba, (size_t)width * 4, row_stride, y);
        if (alpha)
            memcpy(row, from, row_bytes);
        else
            for (uint32_t x = 0; x < width; x++)
                memcpy(row + 3 * (size_t)x, from + 4 * (size_t)x, 3);
        code = spng_encode_row(context, row, row_bytes);
    }
    if (code != SPNG_EOI && code != 0) {
        status = sink.status != FILE_OK ? sink.status : file_error_set(error, FILE_WRITE, "%s: cannot encode: %s", path, spng_strerror(code));
        goto done;
    }
    status = output_file_finish(sink.file, error);
    sink.file = NULL;

fail:
    if (status == FILE_MEMORY)
        file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
done:
    spng_ctx_free(context);
    output_file_abort(sink.file);
    free(texts);
    free(row);
    return status;
}

file_status picture_write_png(const char *path, uint32_t width, uint32_t height, const uint8_t *rgba, ptrdiff_t row_stride, const metadata_list *metadata,
                              const output_options *options, file_error *error)
{
    return write_png(path, width, height, rgba, row_stride, false, metadata, options, error);
}

file_status picture_write_png_alpha(const char *path, uint32_t width, uint32_t height, const uint8_t *rgba, ptrdiff_t row_stride, const metadata_list *metadata,
                                    const output_options *options, file_error *error)
{
    return write_png(path, width, height, rgba, row_stride, true, metadata, options, error);
}

/* ---- reading ---- */

static spng_ctx *decoder(const input_file *input)
{
    spng_ctx *context = spng_ctx_new(0);
    if (!context)
        return NULL;
    if (spng_set_image_limits(context, PICTURE_SIDE_MAX, PICTURE_SIDE_MAX) != 0 || spng_set_chunk_limits(context, (size_t)16 << 20, (size_t)64 << 20) != 0 ||
        spng_set_png_file(context, input->stream) != 0) {
        spng_ctx_free(context);
        return NULL;
    }
    return context;
}

static file_status bad_png(const input_file *input, int code, file_error *error)
{
    if (code == SPNG_EMEM)
        return file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
    return file_error_set(error, FILE_BAD, "%s: is not a sound PNG: %s", input->path, code == SPNG_IO_EOF ? "it ends too early" : spng_strerror(code));
}

static uint32_t sample(const void *rgba, bool deep, size_t i) { return deep ? ((const uint16_t *)rgba)[i] : ((const uint8_t *)rgba)[i]; }

static bool is_opaque(const void *rgba, bool deep, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++)
        if (sample(rgba, deep, 4 * i + 3) != (deep ? 65535u : 255u))
            return false;
    return true;
}

/* From four stored channels to those that mean something: grey, grey + alpha, colour, colour + alpha. */
static void convert(float_image *image, const void *rgba, bool deep)
{
    size_t pixels = (size_t)image->width * image->height;
    uint32_t colors = image->channels >= 3 ? 3 : 1;
    bool alpha = image->channels % 2 == 0;
    float scale = deep ? 65535.0f : 255.0f;
    float *to = image->pixels;
    for (size_t i = 0; i < pixels; i++) {
        for (uint32_t c = 0; c < colors; c++)
            *to++ = (float)sample(rgba, deep, 4 * i + c) / scale;
        if (alpha)
            *to++ = (float)sample(rgba, deep, 4 * i + 3) / scale;
    }
}

file_status png_read(float_image *image, const input_file *input, file_error *error)
{
    file_status status = FILE_OK;
    void *rgba = NULL;
    spng_ctx *context = decoder(input);
    if (!context)
        return file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);

    struct spng_ihdr header;
    size_t size = 0;
    int code = spng_get_ihdr(context, &header);
    bool deep = !code && header.bit_depth == 16;
    int format = deep ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
    if (!code)
        code = spng_decoded_image_size(context, format, &size);
    if (code) {
        status = bad_png(input, code, error);
        goto fail;
    }
    status = picture_check_budget(input->path, header.width, header.height, error);
    if (status != FILE_OK)
        goto fail;
    rgba = malloc(size);
    if (!rgba) {
        status = file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
        goto fail;
    }
    code = spng_decode_image(context, rgba, size, format, SPNG_DECODE_TRNS);
    if (!code)
        code = spng_decode_chunks(context); /* up to the end mark, so that a cut file is found out */
    if (code) {
        status = bad_png(input, code, error);
        goto fail;
    }
    bool grey = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE || header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
    image->width = header.width;
    image->height = header.height;
    image->channels = (grey ? 1 : 3) + (is_opaque(rgba, deep, (size_t)header.width * header.height) ? 0 : 1);
    status = float_image_allocate(image, input->path, error);
    if (status == FILE_OK)
        convert(image, rgba, deep);

fail:
    free(rgba);
    spng_ctx_free(context);
    return status;
}

file_status png_metadata_read(const input_file *input, const char *key, char **value, file_error *error)
{
    file_status status = FILE_OK;
    struct spng_text *texts = NULL;
    uint32_t count = 0;
    spng_ctx *context = decoder(input);
    if (!context)
        return file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
    int code = spng_get_text(context, NULL, &count);
    if (code == SPNG_ECHUNKAVAIL || (code == 0 && count == 0))
        goto done;
    if (code == 0) {
        texts = calloc(count, sizeof *texts);
        if (!texts)
            code = SPNG_EMEM;
        else
            code = spng_get_text(context, texts, &count);
    }
    if (code) {
        status = bad_png(input, code, error);
        goto done;
    }
    for (uint32_t i = 0; i < count && !*value; i++)
        if (strcmp(texts[i].keyword, key) == 0 && !(*value = strndup(texts[i].text, texts[i].length)))
            status = file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
done:
    free(texts);
    spng_ctx_free(context);
    return status;
}
