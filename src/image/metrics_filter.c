/* SPDX-License-Identifier: MIT */
/* Filtering rows and columns, a tap at a time over a whole run of pixels: the loops that the compiler makes vectors of. */
#include "image/metrics_filter.h"

#include <math.h>
#include <stddef.h>

enum { RUN = 256 };

filter_kernel filter_gaussian(double sigma, int radius)
{
    filter_kernel kernel = {.radius = radius};
    double sum = 0;
    for (int d = -radius; d <= radius; d++)
        sum += exp(-d * d / (2 * sigma * sigma));
    for (int d = -radius; d <= radius; d++)
        kernel.weights[radius + d] = (float)(exp(-d * d / (2 * sigma * sigma)) / sum);
    return kernel;
}

static ptrdiff_t clamp_index(ptrdiff_t index, uint32_t count) { return index < 0 ? 0 : index >= (ptrdiff_t)count ? (ptrdiff_t)count - 1 : index; }

/* `padded` holds a run and a radius more on both sides. */
static void filter_run(float *restrict out, const float *restrict padded, uint32_t count, const filter_kernel *kernel)
{
    for (uint32_t x = 0; x < count; x++)
        out[x] = kernel->weights[0] * padded[x];
    for (int tap = 1; tap <= 2 * kernel->radius; tap++) {
        const float weight = kernel->weights[tap];
        const float *restrict from = padded + tap;
        for (uint32_t x = 0; x < count; x++)
            out[x] += weight * from[x];
    }
}

void filter_rows(float *out, const float *in, uint32_t width, uint32_t height, const filter_kernel *kernel)
{
    for (uint32_t y = 0; y < height; y++, in += width, out += width)
        for (uint32_t start = 0; start < width; start += RUN) {
            float padded[RUN + 2 * FILTER_RADIUS_MAX];
            const uint32_t count = width - start < RUN ? width - start : RUN;
            for (ptrdiff_t i = 0; i < (ptrdiff_t)count + 2 * kernel->radius; i++)
                padded[i] = in[clamp_index((ptrdiff_t)start + i - kernel->radius, width)];
            filter_run(out + start, padded, count, kernel);
        }
}

static void add_row(float *restrict out, const float *restrict in, float weight, uint32_t width)
{
    for (uint32_t x = 0; x < width; x++)
        out[x] += weight * in[x];
}

void filter_columns(float *out, const float *in, uint32_t width, uint32_t height, const filter_kernel *kernel, int add)
{
    for (uint32_t y = 0; y < height; y++) {
        float *to = out + (size_t)y * width;
        if (!add)
            for (uint32_t x = 0; x < width; x++)
                to[x] = 0.0f;
        for (int tap = 0; tap <= 2 * kernel->radius; tap++)
            add_row(to, in + (size_t)clamp_index((ptrdiff_t)y + tap - kernel->radius, height) * width, kernel->weights[tap], width);
    }
}
