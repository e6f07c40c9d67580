/* SPDX-License-Identifier: MIT */
/* Specks: single pixels whose value the truth does not have nearby. Private to src/image and its tests. */
#ifndef MANGATA_IMAGE_METRICS_SPECKS_H
#define MANGATA_IMAGE_METRICS_SPECKS_H

#include <stdbool.h>
#include <stdint.h>

/* Least distance of a speck's displayed value from the range of its neighbourhood in the truth. */
#define SPECKS_DISTANCE 0.1f

/* Pictures of one value per pixel, top row first: sRGB-encoded luminance, 0 … 1. */
typedef struct specks_input {
    const float *picture, *truth;
    const bool *counted; /* false: the pixel is left out, also as a neighbour; NULL: no pixel is left out */
    uint32_t width, height;
} specks_input;

/* Number of pixels that lie more than SPECKS_DISTANCE below the least or above the greatest of the truth's 3 × 3 pixels around them. Pixels beyond the edges
 * are left out. */
uint64_t specks_count(const specks_input *input);

#endif
