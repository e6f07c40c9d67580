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
uint64_t diff_prepare_mask(float_image *images, size_t count, const float_image *mask);

/* The pictures of a frame, of one size: A, B and, where there is one, the second reference. Start from all zero. */
typedef struct diff_frame {
    float_image images[3];
    size_t count;      /* 2 or 3 */
    bool *counted;     /* one a pixel, owned; NULL: all count */
    uint64_t left_out; /* pixels that do not count */
} diff_frame;

/* Prepares the pictures of frame number `frame`: what does not count is black. An exit code, after a line on stderr where it is not 0. */
int diff_prepare_frame(const diff_prepare *prepare, uint32_t frame, diff_frame *pictures);

/* Frees what the frame still holds, and clears it. */
void diff_frame_free(diff_frame *pictures);

#endif
