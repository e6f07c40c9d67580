/* SPDX-License-Identifier: MIT */
/* Specks: single pixels that stand out of a picture where the truth shows nothing like them nearby. Private to src/image and its tests. */
#ifndef MANGATA_IMAGE_METRICS_SPECKS_H
#define MANGATA_IMAGE_METRICS_SPECKS_H

#include <stdbool.h>
#include <stdint.h>

/* How far beyond its neighbourhood in the truth a displayed value must lie. */
#define SPECKS_DISTANCE 0.1f

/* One value a pixel, top row first: sRGB-encoded luminance, 0 … 1. */
typedef struct specks_input {
    const float *picture, *truth;
    const bool *counted; /* false leaves a pixel out, as a neighbour too; NULL: all count */
    uint32_t width, height;
} specks_input;

/* How many pixels lie more than SPECKS_DISTANCE below the least or above the greatest of the truth's 3 × 3 pixels around them; at the edges those
 * that the picture has. */
uint64_t specks_count(const specks_input *input);

#endif
