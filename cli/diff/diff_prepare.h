/* SPDX-License-Identifier: MIT */
/* Preparation of pictures before `mangata diff` compares them: displayed values, and a mask. */
#ifndef MANGATA_CLI_DIFF_DIFF_PREPARE_H
#define MANGATA_CLI_DIFF_DIFF_PREPARE_H

#include <stdbool.h>

#include "cli/common/frames.h"
#include "image/image_metrics.h"
#include "image/picture.h"

/* The options of the preparation. All zero: none. */
typedef struct diff_prepare {
    bool displayed;       /* pictures are compared as displayed values: linear light · 2^exposure, clamped to [0, 1], sRGB-encoded */
    double exposure;      /* stops */
    const char *mask;     /* path or pattern of paths of a picture of one channel. Pixels of at least 0.999 count. NULL: all count */
    frame_path mask_name; /* `mask` as a pattern of paths */
} diff_prepare;

/* The two steps of the preparation, in place. diff_prepare_display() converts linear light to displayed values; NaN stays. diff_prepare_mask() sets pixels black where
 * `mask`, which has one channel and the images' size, is below 0.999. It returns their number. */
void diff_prepare_display(float_image *image, double exposure);
uint64_t diff_prepare_mask(float_image *images, size_t count, const float_image *mask);

/* The pictures of a frame, all of one size: A, B and maybe the second reference. It must be all zero at first. */
typedef struct diff_frame {
    float_image images[3]; /* owned */
    size_t count;          /* 2 or 3 */
    bool *counted;         /* for each pixel whether it counts, owned; NULL: all count */
    uint64_t left_out;     /* number of pixels that do not count */
} diff_frame;

/* Prepares the pictures of frame number `frame`. Pixels that do not count become black. Returns an exit code; errors are printed. */
int diff_prepare_frame(const diff_prepare *prepare, uint32_t frame, diff_frame *pictures);

/* Frees what the frame holds and clears it. */
void diff_frame_free(diff_frame *pictures);

#endif
