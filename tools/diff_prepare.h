/* SPDX-License-Identifier: MIT */
/* What `mangata diff` makes of pictures before it compares them: displayed values, and a part of the pixels. */
#ifndef MANGATA_TOOLS_DIFF_PREPARE_H
#define MANGATA_TOOLS_DIFF_PREPARE_H

#include <stdbool.h>

#include "frames.h"
#include "image/image_metrics.h"
#include "image/picture.h"

/* Start from all zero. */
typedef struct diff_prepare {
    bool displayed;       /* linear light · 2^exposure, clamped to 0 … 1 and sRGB-encoded */
    double exposure;
    const char *mask;     /* picture of one channel whose whole pixels (0.999 or more) count, or numbered name of such; NULL: all count */
    frame_path mask_name; /* of `mask` */
} diff_prepare;

/* Prepares both pictures of a frame: what does not count is black. Puts the number of pixels left out into *left_out. An exit code, after a line on
 * stderr where it is not 0. */
int diff_prepare_pair(const diff_prepare *prepare, uint32_t frame, float_image pair[2], uint64_t *left_out);

#endif
