/* SPDX-License-Identifier: MIT */
/* Functions that files of single formats share: opening inputs and checking sizes. Private to src/image. */
#ifndef MANGATA_IMAGE_PICTURE_FORMATS_H
#define MANGATA_IMAGE_PICTURE_FORMATS_H

#include <stdbool.h>
#include <stdio.h>

#include "image/picture.h"

/* The beginning of a file of sums. */
#define SUMS_MAGIC "mangata sums 1\n"

enum { PICTURE_SIDE_MAX = 32768 };

/* A regular file that is open for reading, at its start. */
typedef struct input_file {
    FILE *stream;
    const char *path; /* borrowed */
    uint64_t size;
} input_file;

/* Opens a file. FILE_MISSING: it cannot be opened, or is no regular file. A pipe could block, and a directory cannot be read. */
file_status input_file_open(input_file *input, const char *path, file_error *error);
void input_file_close(input_file *input);

/* The format by the first bytes: PNG, EXR, PFM, sums or unknown. The stream stays at its start. */
picture_format input_file_format(const input_file *input);

/* Checks a size for writers. FILE_ARGUMENT: a side is below 1 or above PICTURE_SIDE_MAX. */
file_status picture_check_size(const char *path, uint32_t width, uint32_t height, file_error *error);

/* Checks a size for readers, before they decode. FILE_BAD: the picture has more pixels than pixel_budget(). */
file_status picture_check_budget(const char *path, uint64_t width, uint64_t height, file_error *error);

/* Allocates image->pixels for its size and channels, with a check for overflow. For readers. */
file_status float_image_allocate(float_image *image, const char *path, file_error *error);

/* Row `y` of the caller's pixels, with picture_layer.row_stride. */
const void *picture_row(const void *pixels, size_t packed_row_bytes, ptrdiff_t row_stride, uint32_t y);

file_status png_read(float_image *image, const input_file *input, file_error *error);
file_status exr_read(float_image *image, const input_file *input, const char *layer, file_error *error);
/* The corner of the data window of the first part. False: there is none. */
bool exr_origin_read(const input_file *input, int32_t origin[2]);
file_status pfm_read(float_image *image, const input_file *input, file_error *error);

file_status png_metadata_read(const input_file *input, const char *key, char **value, file_error *error);
file_status exr_metadata_read(const input_file *input, const char *key, char **value, file_error *error);

#endif
