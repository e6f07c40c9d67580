/* SPDX-License-Identifier: MIT */
/* SSIM from five filtered planes. */
#include "image/metrics_ssim.h"

#include "image/metrics_filter.h"

#define MIDDLE 0.5f

typedef struct planes {
    float *mean_a, *mean_b, *square_a, *square_b, *product, *scratch[2];
} planes;

/* Values are taken from the middle of their range: variances do not change, and lose less to rounding. */
static void filter_product(const planes *p, const float *a, const float *b, uint32_t width, uint32_t height, float *out)
{
    const filter_kernel window = filter_gaussian(1.5, SSIM_RADIUS);
    for (size_t i = 0; i < (size_t)width * height; i++)
        p->scratch[0][i] = b ? (a[i] - MIDDLE) * (b[i] - MIDDLE) : a[i] - MIDDLE;
    filter_rows(p->scratch[1], p->scratch[0], width, height, &window);
    filter_columns(out, p->scratch[1], width, height, &window, 0);
}

/* Equation 13. */
static float similarity(const planes *p, size_t i)
{
    const float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;
    const float shifted_a = p->mean_a[i], shifted_b = p->mean_b[i], a = shifted_a + MIDDLE, b = shifted_b + MIDDLE;
    const float variance_a = p->square_a[i] - shifted_a * shifted_a, variance_b = p->square_b[i] - shifted_b * shifted_b;
    const float covariance = p->product[i] - shifted_a * shifted_b;
    return (2 * (a * b) + c1) * (2 * covariance + c2) / ((a * a + b * b + c1) * (variance_a + variance_b + c2));
}

double ssim_mean(const float *a, const float *b, uint32_t width, uint32_t height, float *map, float *buffers)
{
    const size_t count = (size_t)width * height;
    const planes p = {buffers, buffers + count, buffers + 2 * count, buffers + 3 * count, buffers + 4 * count, {buffers + 5 * count, buffers + 6 * count}};
    filter_product(&p, a, NULL, width, height, p.mean_a);
    filter_product(&p, b, NULL, width, height, p.mean_b);
    filter_product(&p, a, a, width, height, p.square_a);
    filter_product(&p, b, b, width, height, p.square_b);
    filter_product(&p, a, b, width, height, p.product);
    const uint32_t border = width > 2 * SSIM_RADIUS && height > 2 * SSIM_RADIUS ? SSIM_RADIUS : 0;
    double sum = 0;
    for (uint32_t y = 0; y < height; y++) {
        double row = 0;
        for (uint32_t x = 0; x < width; x++) {
            const size_t i = (size_t)y * width + x;
            const float value = similarity(&p, i);
            if (map)
                map[i] = value;
            if (y >= border && y < height - border && x >= border && x < width - border)
                row += value;
        }
        sum += row;
    }
    return sum / ((double)(width - 2 * border) * (height - 2 * border));
}
