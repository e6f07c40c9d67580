/* SPDX-License-Identifier: MIT */
/* Sums over two noisy references; see metrics_noise.h. */
#include "image/metrics_noise.h"

#include <math.h>

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

file_status noise_sums_add(noise_sums *sums, const float_image images[3], const bool *counted, file_error *error)
{
    for (int i = 1; i < 3; i++)
        if (images[i].width != images[0].width || images[i].height != images[0].height || images[i].channels != images[0].channels)
            return file_error_set(error, FILE_ARGUMENT, "pictures of %ux%u pixels of %u channels and %ux%u of %u cannot be compared", images[0].width,
                                  images[0].height, images[0].channels, images[i].width, images[i].height, images[i].channels);
    for (uint32_t y = 0; y < images[0].height; y++)
        add_row(sums, images, counted, y);
    return FILE_OK;
}

double noise_sums_rmse(const noise_sums *sums) { return sums->values ? sqrt(fmax(0, sums->product / (double)sums->values)) : 0; }

double noise_sums_floor(const noise_sums *sums) { return sums->values ? sqrt(sums->difference_squared / (double)sums->values) / 2 : 0; }
