/* SPDX-License-Identifier: MIT */
/* Flicker of a clip A against the reference's, B, which flickers too. Private to src/image and its tests.
 * Steps: frame minus the frame before. Power of a pixel: mean over steps and channels of the step squared.
 * Glints: pixels brighter than a threshold, joined with their eight neighbours; sizes fall into classes of 1, 2–3, 4–7, 8–15 … pixels.
 * Distance of counts: the histogram of a count over frames against the reference's by the earth mover's distance (with one count a frame,
 * the mean difference of the sorted counts), relative to the reference's mean count. It is 0 only for equal histograms, and does not mind when
 * glints flash, only how many at a time. Distance of sizes: Σ |glints of A in a class − those of B| over B's glints. Both are 1 where A
 * shows none of B's glints. Where B has none, 1 stands in for what is divided by. */
#ifndef MANGATA_IMAGE_METRICS_FLICKER_H
#define MANGATA_IMAGE_METRICS_FLICKER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"

typedef struct flicker flicker;

/* FILE_MEMORY; on failure *result is NULL. */
file_status flicker_create(flicker **result, uint32_t width, uint32_t height, uint32_t channels, file_error *error);
void flicker_free(flicker *f);

typedef struct flicker_input {
    const float *values[2];    /* of A, of B: interleaved channels, finite */
    const float *luminance[2]; /* one a pixel, for glints; NULL: none are counted */
    float threshold;
} flicker_input;

typedef struct flicker_step {
    double error, power, ratio;    /* as flicker_scores, of this step; NaN in the first frame */
    uint32_t bright[2], glints[2]; /* counts of this frame */
} flicker_step;

/* Adds a frame. `map`: √ mean over channels of the step's squared error, or NULL. FILE_MEMORY: nothing was added. */
file_status flicker_add(flicker *f, const flicker_input *input, float *map, flicker_step *step, file_error *error);

typedef struct flicker_scores {
    double error;               /* √ mean (step of A − step of B)² */
    double power;               /* mean |power of A − power of B| */
    double ratio;               /* mean power of A / mean power of B; 1 where both are 0 */
    double bright, glints;      /* distances of counts */
    double sizes;               /* distance of sizes */
    bool has_steps, has_glints; /* false: error, power and ratio (bright, glints and sizes) are NaN, for there is nothing to tell */
} flicker_scores;

file_status flicker_measure(const flicker *f, flicker_scores *scores, file_error *error);

/* How many groups of pixels above `threshold`, eight neighbours joined; adds each to sizes[floor(log2(its pixels))]. `labels`: a scratch
 * of 2 · width · height. */
uint32_t flicker_count_glints(const float *luminance, uint32_t width, uint32_t height, float threshold, uint32_t *labels, uint64_t sizes[32]);

#endif
