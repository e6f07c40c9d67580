/* SPDX-License-Identifier: MIT */
/* What `mangata diff` makes of pictures before it compares them: displayed values, and a part of the pixels. */
#ifndef MANGATA_CLI_DIFF_DIFF_PREPARE_H
#define MANGATA_CLI_DIFF_DIFF_PREPARE_H

#include <stdbool.h>

#include "cli/common/frames.h"
#include "image/image_metrics.h"
#include "image/picture.h"

/* Start from all zero. */
typedef struct diff_prepare {
    bool displayed; /* linear light · 2^exposure, clamped to 0 … 1 and sRGB-encoded */
    double exposure;
    const char *mask;     /* picture of one channel whose whole pixels (0.999 or more) count, or numbered name of such; NULL: all count */
    frame_path mask_name; /* of `mask` */
} diff_prepare;

/* The same in parts: displayed values of linear light, and black where `mask` (of the same size, 1 channel) is below 0.999; returns how many that are. */
void diff_prepare_display(float_image *image, double exposure);
uint64_t diff_prepare_mask(float_image pair[2], const float_image *mask);

/* Prepares both pictures of a frame: what does not count is black. Puts the number of pixels left out into *left_out. An exit code, after a line on
 * stderr where it is not 0. */
int diff_prepare_pair(const diff_prepare *prepare, uint32_t frame, float_image pair[2], uint64_t *left_out);

#endif
