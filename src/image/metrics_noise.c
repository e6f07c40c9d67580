/* SPDX-License-Identifier: MIT */
/* Sums over two noisy references; see metrics_noise.h. */
#include "image/metrics_noise.h"

#include <math.h>
#include <stdlib.h>

/* Row by row, so that the rounding of millions of additions stays small. */
static void add_row(noise_sums *sums, const float_image images[3], const bool *counted, uint32_t y)
{
    const uint32_t width = images[0].width, channels = images[0].channels;
    double product = 0, squared = 0;
    for (uint32_t x = 0; x < width; x++) {
        const size_t pixel = (size_t)y * width + x;
        if (counted && !counted[pixel])
            continue;
        for (size_t v = pixel * channels; v < (pixel + 1) * channels; v++) {
            const double a = images[0].pixels[v], b = images[1].pixels[v], b2 = images[2].pixels[v];
            if (!isfinite(a) || !isfinite(b) || !isfinite(b2))
                continue;
            product += (a - b) * (a - b2);
            squared += (b - b2) * (b - b2);
            sums->values++;
        }
    }
    sums->product += product;
    sums->difference_squared += squared;
}

static file_status check_sizes(const float_image *a, const float_image *b, file_error *error)
{
    if (b->width == a->width && b->height == a->height && b->channels == a->channels)
        return FILE_OK;
    return file_error_set(error, FILE_ARGUMENT, "pictures of %ux%u pixels of %u channels and %ux%u of %u cannot be compared", a->width, a->height, a->channels,
                          b->width, b->height, b->channels);
}

file_status noise_sums_add(noise_sums *sums, const float_image images[3], const bool *counted, file_error *error)
{
    for (int i = 1; i < 3; i++)
        if (check_sizes(&images[0], &images[i], error) != FILE_OK)
            return FILE_ARGUMENT;
    for (uint32_t y = 0; y < images[0].height; y++)
        add_row(sums, images, counted, y);
    return FILE_OK;
}

double noise_sums_rmse(const noise_sums *sums) { return sums->values ? sqrt(fmax(0, sums->product / (double)sums->values)) : 0; }

double noise_sums_floor(const noise_sums *sums) { return sums->values ? sqrt(sums->difference_squared / (double)sums->values) / 2 : 0; }

file_status noise_mean(float_image *mean, const float_image *b, const float_image *b2, file_error *error)
{
    const size_t count = (size_t)b->width * b->height * b->channels;
    *mean = (float_image){0};
    if (check_sizes(b, b2, error) != FILE_OK)
        return FILE_ARGUMENT;
    float *pixels = malloc(count * sizeof *pixels);
    if (!pixels)
        return file_error_set(error, FILE_MEMORY, "out of memory for metrics");
    for (size_t i = 0; i < count; i++)
        pixels[i] = 0.5f * b->pixels[i] + 0.5f * b2->pixels[i];
    *mean = (float_image){b->width, b->height, b->channels, pixels};
    return FILE_OK;
}
