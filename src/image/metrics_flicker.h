/* SPDX-License-Identifier: MIT */
/* Flicker of a clip A against the reference's clip B, which flickers, too. Private to src/image and its tests.
 *
 * A step is a frame minus the previous frame. The power of a pixel is the mean over steps and channels of the squared step.
 *
 * A glint is a group of pixels that are brighter than a threshold. Pixels are joined with their eight neighbours. Classes of sizes are 1, 2–3, 4–7, 8–15 …
 * pixels.
 *
 * The distance of counts is the earth mover's distance between the histograms over frames of a count in A and B, divided by the mean count in B. With one count
 * per frame that is the mean difference of the sorted counts. It is 0 only for equal histograms. It depends on the number of glints at a time, but not on the
 * time at which they flash. The distance of sizes is the sum over classes of |glints of A − glints of B|, divided by the number of B's glints. Both distances
 * are 1 if A has no glints. If B has none, the divisor is 1. */
#ifndef MANGATA_IMAGE_METRICS_FLICKER_H
#define MANGATA_IMAGE_METRICS_FLICKER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"

typedef struct flicker flicker;

/* Returns FILE_OK, or FILE_MEMORY and *result NULL. */
file_status flicker_create(flicker **result, uint32_t width, uint32_t height, uint32_t channels, file_error *error);
void flicker_free(flicker *f);

typedef struct flicker_input {
    const float *values[2];    /* A and B: finite values, interleaved channels */
    const float *luminance[2]; /* luminance of each pixel of A and B, for glints; NULL: glints are not counted */
    float threshold;
} flicker_input;

typedef struct flicker_step {
    double error, power, ratio;    /* those of flicker_scores for this step; NaN in the first frame */
    uint32_t bright[2], glints[2]; /* numbers of bright pixels and glints in this frame of A and B */
} flicker_step;

/* Adds a frame. `map` receives √ mean over channels of the step's squared error; NULL: not wanted. FILE_MEMORY: nothing was added. */
file_status flicker_add(flicker *f, const flicker_input *input, float *map, flicker_step *step, file_error *error);

typedef struct flicker_scores {
    double error;          /* √ mean (step of A − step of B)² */
    double power;          /* mean |power of A − power of B| */
    double ratio;          /* mean power of A / mean power of B; 1: both are 0 */
    double bright, glints; /* distances of the counts of bright pixels and of glints */
    double sizes;          /* distance of sizes */
    bool has_steps;        /* false: error, power and ratio are NaN, because there is one frame */
    bool has_glints;       /* false: bright, glints and sizes are NaN, because glints were not counted */
} flicker_scores;

file_status flicker_measure(const flicker *f, flicker_scores *scores, file_error *error);

/* Counts groups of pixels above `threshold`. Pixels are joined with their eight neighbours. Adds each group to sizes[floor(log2(number of its pixels))].
 * `labels`: scratch memory of 2 · width · height elements. */
uint32_t flicker_count_glints(const float *luminance, uint32_t width, uint32_t height, float threshold, uint32_t *labels, uint64_t sizes[32]);

#endif
