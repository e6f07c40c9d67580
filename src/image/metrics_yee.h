/* SPDX-License-Identifier: MIT */
/* Yee's perceptual test ("A Perceptual Metric for Production Testing", 2004) by OpenImageIO's `idiff -p`: at 100 cd/m² and a field of view of 45 degrees.
 * Private to src/image and its tests. Its limit: OpenImageIO 2.4 answers to colour alone. Grey of 0.9 against grey of 0.2 fails in no pixel; trust FLIP. */
#ifndef MANGATA_IMAGE_METRICS_YEE_H
#define MANGATA_IMAGE_METRICS_YEE_H

#include <stdint.h>

#include "image/file_error.h"

/* Fraction of the pixels that fail. Pixels are linear light with 3 channels, in which a screen shows 0 … 1. Writes two pictures into a new folder in $TMPDIR or
 * /tmp and runs `idiff` without a shell; NULL: the one on the PATH. The number is taken from its text, because its exit code does not tell it. Returns FILE_OK,
 * FILE_UNAVAILABLE if idiff is missing or fails, FILE_WRITE or FILE_MEMORY. */
file_status yee_failures(double *share, const float *a, const float *b, uint32_t width, uint32_t height, const char *idiff, file_error *error);

/* Reads the number of failing pixels from idiff's text. Identical pictures have 0, although idiff does not count them. False: the text is no such report. */
int yee_parse(const char *text, uint64_t *failures);

#endif
