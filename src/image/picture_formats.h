/* SPDX-License-Identifier: MIT */
/* What the files of single formats share with one another: opening an input and checking a size. Private to src/image. */
#ifndef MANGATA_IMAGE_PICTURE_FORMATS_H
#define MANGATA_IMAGE_PICTURE_FORMATS_H

#include <stdbool.h>
#include <stdio.h>

#include "image/picture.h"

/* How a file of sums begins. */
#define SUMS_MAGIC "mangata sums 1\n"

enum { PICTURE_SIDE_MAX = 32768 };

/* A regular file open for reading, at its start. */
typedef struct input_file {
    FILE *stream;
    const char *path; /* borrowed */
    uint64_t size;
} input_file;

/* FILE_MISSING where it cannot be opened, or is no regular file (a pipe would hang, a directory cannot be read). */
file_status input_file_open(input_file *input, const char *path, file_error *error);
void input_file_close(input_file *input);

/* Kind by the first bytes (PNG, EXR, PFM, sums or unknown); leaves the stream at its start. */
picture_format input_file_format(const input_file *input);

/* FILE_ARGUMENT unless 1 ≤ sides ≤ PICTURE_SIDE_MAX; for writers. */
file_status picture_check_size(const char *path, uint32_t width, uint32_t height, file_error *error);

/* FILE_BAD where a picture has more pixels than pixel_budget(); for readers, before they decode. */
file_status picture_check_budget(const char *path, uint64_t width, uint64_t height, file_error *error);

/* Allocates image->pixels for its size and channels, overflow-checked; for readers. */
file_status float_image_allocate(float_image *image, const char *path, file_error *error);

/* Row `y` of caller's pixels, with the stride rules of picture.h. */
const void *picture_row(const void *pixels, size_t packed_row_bytes, ptrdiff_t row_stride, uint32_t y);

file_status png_read(float_image *image, const input_file *input, file_error *error);
file_status exr_read(float_image *image, const input_file *input, const char *layer, file_error *error);
file_status pfm_read(float_image *image, const input_file *input, file_error *error);

file_status png_metadata_read(const input_file *input, const char *key, char **value, file_error *error);
file_status exr_metadata_read(const input_file *input, const char *key, char **value, file_error *error);

#endif
