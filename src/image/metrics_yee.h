/* SPDX-License-Identifier: MIT */
/* Yee's perceptual test ("A Perceptual Metric for Production Testing", 2004) as OpenImageIO's `idiff -p` computes it: at 100 cd/m² and a
 * field of view of 45 degrees. Private to src/image and its tests.
 * Its limit: OpenImageIO 2.4 answers to colour alone. Grey of 0.9 against grey of 0.2 fails in no pixel; trust FLIP. */
#ifndef MANGATA_IMAGE_METRICS_YEE_H
#define MANGATA_IMAGE_METRICS_YEE_H

#include <stdint.h>

#include "image/file_error.h"

/* Share of the pixels that fail. Pixels: linear light, 3 channels, 0 … 1 is what a screen shows. Writes two pictures into a folder of its
 * own in $TMPDIR (/tmp) and runs `idiff` (NULL: the one on the PATH) without a shell; reads its text, since its exit code does not tell.
 * FILE_UNAVAILABLE: it is missing, or did not do its work; FILE_WRITE, FILE_MEMORY. */
file_status yee_failures(double *share, const float *a, const float *b, uint32_t width, uint32_t height, const char *idiff, file_error *error);

/* Pixels that fail, by what idiff printed; false where the text is no such report. Identical pictures are not counted at all: 0. */
int yee_parse(const char *text, uint64_t *failures);

#endif
