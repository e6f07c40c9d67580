/* SPDX-License-Identifier: MIT */
/* Telling picture formats apart, opening inputs, and reading any of them. */
#define _POSIX_C_SOURCE 200809L

#include "image/picture.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/pixel_budget.h"
#include "base/regular_file.h"
#include "image/picture_formats.h"

picture_format picture_format_of(const char *path)
{
    static const struct {
        const char *extension;
        picture_format format;
    } known[] = {{".png", PICTURE_PNG}, {".exr", PICTURE_EXR}, {".pfm", PICTURE_PFM},  {".mp4", PICTURE_MP4},
                 {".mov", PICTURE_MOV}, {".y4m", PICTURE_Y4M}, {".sums", PICTURE_SUMS}};
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    if (!dot)
        return PICTURE_UNKNOWN;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcasecmp(dot, known[i].extension) == 0)
            return known[i].format;
    return PICTURE_UNKNOWN;
}

file_status input_file_open(input_file *input, const char *path, file_error *error)
{
    *input = (input_file){.path = path};
    regular_file file;
    if (!regular_file_open(&file, path))
        return file.fault == REGULAR_FILE_MISSING  ? file_error_errno(error, FILE_MISSING, path, "cannot read", errno)
               : file.fault == REGULAR_FILE_MEMORY ? file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM)
                                                   : file_error_set(error, FILE_MISSING, "%s: %s", path, file.what);
    input->size = file.size;
    input->stream = file.stream;
    return FILE_OK;
}

void input_file_close(input_file *input)
{
    if (input->stream)
        fclose(input->stream);
    *input = (input_file){0};
}

picture_format input_file_format(const input_file *input)
{
    static const unsigned char png[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const unsigned char exr[4] = {0x76, 0x2f, 0x31, 0x01};
    unsigned char start[sizeof SUMS_MAGIC - 1] = {0};
    size_t length = fread(start, 1, sizeof start, input->stream);
    rewind(input->stream);
    if (length >= sizeof png && memcmp(start, png, sizeof png) == 0)
        return PICTURE_PNG;
    if (length >= sizeof exr && memcmp(start, exr, sizeof exr) == 0)
        return PICTURE_EXR;
    if (length >= 2 && start[0] == 'P' && (start[1] == 'F' || start[1] == 'f'))
        return PICTURE_PFM;
    if (length >= sizeof SUMS_MAGIC - 1 && memcmp(start, SUMS_MAGIC, sizeof SUMS_MAGIC - 1) == 0)
        return PICTURE_SUMS;
    return PICTURE_UNKNOWN;
}

file_status picture_check_size(const char *path, uint32_t width, uint32_t height, file_error *error)
{
    if (width < 1 || height < 1 || width > PICTURE_SIDE_MAX || height > PICTURE_SIDE_MAX)
        return file_error_set(error, FILE_ARGUMENT, "%s: size %ux%u is not within 1x1 and %dx%d", path, width, height, (int)PICTURE_SIDE_MAX,
                              (int)PICTURE_SIDE_MAX);
    return FILE_OK;
}

file_status picture_check_budget(const char *path, uint64_t width, uint64_t height, file_error *error)
{
    if (width * height <= pixel_budget())
        return FILE_OK;
    return file_error_set(error, FILE_BAD, "%s: it has %llu pixels; %s", path, (unsigned long long)(width * height), pixel_budget_allowed(width * height).text);
}

file_status float_image_allocate(float_image *image, const char *path, file_error *error)
{
    if (image->width < 1 || image->height < 1 || image->width > PICTURE_SIDE_MAX || image->height > PICTURE_SIDE_MAX)
        return file_error_set(error, FILE_BAD, "%s: size %ux%u is not within 1x1 and %dx%d", path, image->width, image->height, (int)PICTURE_SIDE_MAX,
                              (int)PICTURE_SIDE_MAX);
    const file_status status = picture_check_budget(path, image->width, image->height, error);
    if (status != FILE_OK)
        return status;
    size_t pixels = (size_t)image->width * image->height;
    if (pixels > SIZE_MAX / sizeof(float) / image->channels)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    image->pixels = malloc(pixels * image->channels * sizeof(float));
    if (!image->pixels)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    return FILE_OK;
}

const void *picture_row(const void *pixels, size_t packed_row_bytes, ptrdiff_t row_stride, uint32_t y)
{
    ptrdiff_t stride = row_stride != 0 ? row_stride : (ptrdiff_t)packed_row_bytes;
    return (const char *)pixels + (ptrdiff_t)y * stride;
}

file_status picture_read(float_image *image, const char *path, const char *layer, file_error *error)
{
    *image = (float_image){0};
    input_file input = {0};
    file_status status = input_file_open(&input, path, error);
    if (status != FILE_OK)
        return status;
    switch (input_file_format(&input)) {
    case PICTURE_PNG:
        status = png_read(image, &input, error);
        break;
    case PICTURE_EXR:
        status = exr_read(image, &input, layer, error);
        break;
    case PICTURE_PFM:
        status = pfm_read(image, &input, error);
        break;
    case PICTURE_SUMS:
        status = file_error_set(error, FILE_BAD, "%s: holds sums of samples; mangata merge makes a picture of them", path);
        break;
    default:
        status = file_error_set(error, FILE_BAD, "%s: is not a PNG, EXR or PFM picture", path);
    }
    input_file_close(&input);
    if (status != FILE_OK)
        float_image_free(image);
    return status;
}

bool picture_origin(const char *path, int32_t origin[2])
{
    input_file input = {0};
    bool found = input_file_open(&input, path, &(file_error){0}) == FILE_OK;
    origin[0] = origin[1] = 0;
    if (found && input_file_format(&input) == PICTURE_EXR)
        found = exr_origin_read(&input, origin);
    input_file_close(&input);
    return found;
}

void float_image_free(float_image *image)
{
    free(image->pixels);
    *image = (float_image){0};
}
