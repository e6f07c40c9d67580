/* SPDX-License-Identifier: MIT */
/* Differences between pictures A and B, over one frame or several frames together. */
#ifndef MANGATA_IMAGE_IMAGE_METRICS_H
#define MANGATA_IMAGE_IMAGE_METRICS_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/picture.h"

/* Running sums in double precision, which start zeroed. A value is one channel of a pixel. Values are added in a fixed order. */
typedef struct image_metrics {
    uint64_t frames;
    uint64_t values;                     /* number of values that are finite in A and B; only these are in the sums */
    uint64_t equal_infinities;           /* number of values with the same infinity in A and B, which count as equal */
    uint64_t non_finite_a, non_finite_b; /* numbers of values that are NaN or infinite in A and in B */
    uint64_t mismatches;                 /* number of values for which image_values_comparable() is false */
    double sum_a, sum_b, sum_b_squared, sum_difference_squared;
    double max_difference;
    uint64_t max_frame;                 /* frame of max_difference */
    uint32_t max_x, max_y, max_channel; /* pixel and channel of max_difference */
} image_metrics;

/* Whether two values have a difference. They have none if one of them is NaN, if only one is finite, or if they are different infinities. */
bool image_values_comparable(float a, float b);
/* The rule of image_values_comparable() in words, for messages. */
extern const char image_mismatch_text[];

/* Adds one frame. FILE_ARGUMENT: sizes or channels differ, and nothing was added. */
file_status image_metrics_add(image_metrics *metrics, const float_image *a, const float_image *b, file_error *error);

/* √ mean (A − B)²; 0: there are no values. Callers must look at `mismatches`, too. */
double image_metrics_rmse(const image_metrics *metrics);
/* RMSE / √ mean B²; 0 if both are 0, +inf if only the divisor is 0. */
double image_metrics_relative_rmse(const image_metrics *metrics);
/* mean A / mean B; 1 if both are 0, ±inf if only the divisor is 0. */
double image_metrics_mean_ratio(const image_metrics *metrics);

#endif
