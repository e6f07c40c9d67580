/* SPDX-License-Identifier: MIT */
/* Separable filters over planes of floats; beyond the border the nearest pixel goes on. Private to src/image. */
#ifndef MANGATA_IMAGE_METRICS_FILTER_H
#define MANGATA_IMAGE_METRICS_FILTER_H

#include <stdint.h>

enum { FILTER_RADIUS_MAX = 63 };

/* weights[radius + d] belongs to the neighbour at distance d to the right or below: a correlation, not a convolution. */
typedef struct filter_kernel {
    int radius; /* 0 … FILTER_RADIUS_MAX */
    float weights[2 * FILTER_RADIUS_MAX + 1];
} filter_kernel;

/* Samples of exp(−d²/2σ²), summing to 1. σ > 0, in pixels. */
filter_kernel filter_gaussian(double sigma, int radius);

/* out = in filtered along rows; the two must not overlap. */
void filter_rows(float *out, const float *in, uint32_t width, uint32_t height, const filter_kernel *kernel);

/* out = (or += where `add`) in filtered along columns; the two must not overlap. */
void filter_columns(float *out, const float *in, uint32_t width, uint32_t height, const filter_kernel *kernel, int add);

#endif
