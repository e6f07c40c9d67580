/* SPDX-License-Identifier: MIT */
/* PFM, portable float map: "PF" (colour) or "Pf" (grey), size, scale whose sign tells the byte order, rows from the bottom up. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/paired_output.h"
#include "image/picture_formats.h"

static const bool host_is_little_endian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

static void swap_bytes(float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        bits = __builtin_bswap32(bits);
        memcpy(&values[i], &bits, sizeof bits);
    }
}

file_status picture_write_pfm(const char *path, uint32_t width, uint32_t height, const picture_layer *layer, const metadata_list *metadata,
                              const output_options *options, file_error *error)
{
    file_status status = picture_check_size(path, width, height, error);
    if (status != FILE_OK)
        return status;
    uint32_t channels = layer->channels;
    if (channels != 1 && channels != 3)
        return file_error_set(error, FILE_ARGUMENT, "%s: a PFM holds 1 or 3 channels, not %u", path, channels);
    size_t step = layer->pixel_floats ? layer->pixel_floats : channels;
    size_t row_values = (size_t)width * channels;

    paired_output output = {0};
    float *row = malloc(row_values * sizeof *row);
    if (!row)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    status = paired_output_open(&output, path, metadata, options, error);
    if (status != FILE_OK)
        goto fail;

    char header[64];
    int length = snprintf(header, sizeof header, "%s\n%u %u\n-1.0\n", channels == 3 ? "PF" : "Pf", width, height);
    status = output_file_write(output.file, header, (size_t)length, error);
    for (uint32_t y = height; y-- > 0 && status == FILE_OK;) {
        const float *from = picture_row(layer->pixels, width * step * sizeof(float), layer->row_stride, y);
        /* memcpy, not assignment: the payload of a NaN is kept. */
        for (uint32_t x = 0; x < width; x++)
            memcpy(row + (size_t)x * channels, from + x * step, channels * sizeof(float));
        if (!host_is_little_endian)
            swap_bytes(row, row_values);
        status = output_file_write(output.file, row, row_values * sizeof *row, error);
    }
    if (status != FILE_OK)
        goto fail;
    free(row);
    return paired_output_finish(&output, error);

fail:
    paired_output_abort(&output);
    free(row);
    return status;
}

/* ---- reading ---- */

/* The next word, ended by exactly one whitespace character, as the format wants before its data. False: none, or too long. */
static bool read_word(FILE *stream, char *word, size_t capacity)
{
    size_t length = 0;
    int c = getc(stream);
    while (c == ' ' || c == '\t' || c == '\r' || c == '\n')
        c = getc(stream);
    while (c > ' ' && c < 0x7f) {
        if (length + 1 >= capacity)
            return false;
        word[length++] = (char)c;
        c = getc(stream);
    }
    word[length] = '\0';
    return length > 0 && (c == ' ' || c == '\t' || c == '\r' || c == '\n');
}

static bool read_side(FILE *stream, uint32_t *side)
{
    char word[16];
    if (!read_word(stream, word, sizeof word) || strspn(word, "0123456789") != strlen(word) || strlen(word) > 9)
        return false;
    *side = (uint32_t)strtoul(word, NULL, 10);
    return true;
}

static bool read_scale(FILE *stream, bool *little_endian)
{
    char word[32];
    if (!read_word(stream, word, sizeof word))
        return false;
    char *end;
    double scale = strtod(word, &end);
    *little_endian = scale < 0.0;
    return *end == '\0' && isfinite(scale) && scale != 0.0;
}

file_status pfm_read(float_image *image, const input_file *input, file_error *error)
{
    char kind[4];
    bool little_endian = true;
    FILE *stream = input->stream;
    if (!read_word(stream, kind, sizeof kind) || (strcmp(kind, "PF") != 0 && strcmp(kind, "Pf") != 0) || !read_side(stream, &image->width) ||
        !read_side(stream, &image->height) || !read_scale(stream, &little_endian))
        return file_error_set(error, FILE_BAD, "%s: is not a sound PFM: its header must be PF or Pf, width, height, scale, without comments", input->path);
    image->channels = kind[1] == 'F' ? 3 : 1;

    /* Before anything is allocated: the file must really hold what its header says. */
    long start = ftell(stream);
    uint64_t row_values = (uint64_t)image->width * image->channels;
    if (image->width > PICTURE_SIDE_MAX || image->height > PICTURE_SIDE_MAX || start < 0 ||
        input->size - (uint64_t)start != row_values * image->height * sizeof(float))
        return file_error_set(
            error, FILE_BAD,
            "%s: is not a sound PFM: %ux%u pixels of %u channels do not fit its length; its header ends with one blank or line end, and the pixels follow",
            input->path, image->width, image->height, image->channels);
    file_status status = float_image_allocate(image, input->path, error);
    if (status != FILE_OK)
        return status;
    for (uint32_t y = image->height; y-- > 0;) {
        float *row = image->pixels + y * (size_t)row_values;
        if (fread(row, sizeof(float), (size_t)row_values, stream) != row_values)
            return file_error_set(error, FILE_BAD, "%s: is not a sound PFM: it ends too early", input->path);
        if (little_endian != host_is_little_endian)
            swap_bytes(row, (size_t)row_values);
    }
    return FILE_OK;
}
