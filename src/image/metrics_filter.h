/* SPDX-License-Identifier: MIT */
/* Separable filters over planes of floats. Pixels beyond the border have the value of the nearest pixel. Private to src/image. */
#ifndef MANGATA_IMAGE_METRICS_FILTER_H
#define MANGATA_IMAGE_METRICS_FILTER_H

#include <stdint.h>

enum { FILTER_RADIUS_MAX = 63 };

/* A kernel. weights[radius + d] is the weight of the neighbour d pixels to the right or below, so a filter is a correlation, not a convolution. */
typedef struct filter_kernel {
    int radius; /* 0 … FILTER_RADIUS_MAX */
    float weights[2 * FILTER_RADIUS_MAX + 1];
} filter_kernel;

/* The kernel of exp(−d²/2σ²) at whole d, with the sum 1. `sigma` > 0, pixels. */
filter_kernel filter_gaussian(double sigma, int radius);

/* Filters `in` along rows. `out` must not overlap it. */
void filter_rows(float *out, const float *in, uint32_t width, uint32_t height, const filter_kernel *kernel);

/* Filters `in` along columns. If `add` is not 0, the result is added to `out`. They must not overlap. */
void filter_columns(float *out, const float *in, uint32_t width, uint32_t height, const filter_kernel *kernel, int add);

#endif
