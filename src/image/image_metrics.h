/* SPDX-License-Identifier: MIT */
/* How far pictures A are from pictures B, over one frame or over many scored together. */
#ifndef MANGATA_IMAGE_IMAGE_METRICS_H
#define MANGATA_IMAGE_IMAGE_METRICS_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/picture.h"

/* Running sums in double; start from all zero. Values (one channel of one pixel) are added in a fixed order. */
typedef struct image_metrics {
    uint64_t frames;
    uint64_t values;                     /* finite in both: what the sums hold */
    uint64_t equal_infinities;           /* the same infinity in both: equal, outside the sums */
    uint64_t non_finite_a, non_finite_b; /* NaN or infinite values in A, in B */
    uint64_t mismatches;                 /* values that cannot be compared: never equal */
    double sum_a, sum_b, sum_b_squared, sum_difference_squared;
    double max_difference;
    uint64_t max_frame; /* where max_difference is: number of the frame added, pixel, channel */
    uint32_t max_x, max_y, max_channel;
} image_metrics;

/* False where values are finite in one only, of unlike infinities, or NaN in either: such have no difference. */
bool image_values_comparable(float a, float b);

/* Adds one frame. Sizes and channels must agree (FILE_ARGUMENT, nothing added). */
file_status image_metrics_add(image_metrics *metrics, const float_image *a, const float_image *b, file_error *error);

/* √ mean (A − B)²; 0 without values. A comparison must also look at `mismatches`. */
double image_metrics_rmse(const image_metrics *metrics);
/* RMSE / √ mean B²; 0 where both are 0, +inf where only the divisor is. */
double image_metrics_relative_rmse(const image_metrics *metrics);
/* mean A / mean B; 1 where both are 0, ±inf where only the divisor is. */
double image_metrics_mean_ratio(const image_metrics *metrics);

#endif
