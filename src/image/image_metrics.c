/* SPDX-License-Identifier: MIT */
/* Error sums between pictures; see image_metrics.h. */
#include "image/image_metrics.h"

#include <math.h>

typedef struct row_sums {
    double a, b, b_squared, difference_squared;
} row_sums;

const char image_mismatch_text[] = "not a number, or infinite in one picture only";

bool image_values_comparable(float a, float b) { return (isfinite(a) && isfinite(b)) || a == b; }

static void note_difference(image_metrics *metrics, double difference, uint32_t x, uint32_t y, uint32_t channel)
{
    if (!(difference > metrics->max_difference))
        return;
    metrics->max_difference = difference;
    metrics->max_frame = metrics->frames;
    metrics->max_x = x;
    metrics->max_y = y;
    metrics->max_channel = channel;
}

/* Sums row by row, so that the rounding of millions of additions stays small. */
static row_sums add_row(image_metrics *metrics, const float *a, const float *b, uint32_t width, uint32_t channels, uint32_t y)
{
    row_sums sums = {0};
    for (uint32_t x = 0; x < width; x++)
        for (uint32_t c = 0; c < channels; c++, a++, b++) {
            metrics->non_finite_a += !isfinite(*a);
            metrics->non_finite_b += !isfinite(*b);
            if (!isfinite(*a) || !isfinite(*b)) {
                if (image_values_comparable(*a, *b))
                    metrics->equal_infinities++;
                else
                    metrics->mismatches++;
                continue;
            }
            double difference = (double)*a - (double)*b;
            sums.a += *a;
            sums.b += *b;
            sums.b_squared += (double)*b * *b;
            sums.difference_squared += difference * difference;
            metrics->values++;
            note_difference(metrics, fabs(difference), x, y, c);
        }
    return sums;
}

file_status image_metrics_add(image_metrics *metrics, const float_image *a, const float_image *b, file_error *error)
{
    if (a->width != b->width || a->height != b->height)
        return file_error_set(error, FILE_ARGUMENT, "pictures of %ux%u and %ux%u pixels cannot be compared", a->width, a->height, b->width, b->height);
    if (a->channels != b->channels)
        return file_error_set(error, FILE_ARGUMENT, "pictures of %u and %u channels cannot be compared", a->channels, b->channels);
    size_t row_values = (size_t)a->width * a->channels;
    for (uint32_t y = 0; y < a->height; y++) {
        row_sums sums = add_row(metrics, a->pixels + y * row_values, b->pixels + y * row_values, a->width, a->channels, y);
        metrics->sum_a += sums.a;
        metrics->sum_b += sums.b;
        metrics->sum_b_squared += sums.b_squared;
        metrics->sum_difference_squared += sums.difference_squared;
    }
    metrics->frames++;
    return FILE_OK;
}

double image_metrics_rmse(const image_metrics *metrics) { return metrics->values ? sqrt(metrics->sum_difference_squared / (double)metrics->values) : 0.0; }

double image_metrics_relative_rmse(const image_metrics *metrics)
{
    if (metrics->sum_b_squared == 0.0)
        return metrics->sum_difference_squared == 0.0 ? 0.0 : INFINITY;
    return sqrt(metrics->sum_difference_squared / metrics->sum_b_squared);
}

double image_metrics_mean_ratio(const image_metrics *metrics)
{
    if (metrics->sum_b == 0.0)
        return metrics->sum_a == 0.0 ? 1.0 : copysign(INFINITY, metrics->sum_a);
    return metrics->sum_a / metrics->sum_b;
}
