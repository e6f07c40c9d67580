/* SPDX-License-Identifier: MIT */
/* Errors against a truth that is known by two pictures with independent noise, B and B2. Private to src/image and its tests.
 * With A independent of both, mean (A − B)(A − B2) is the mean squared distance of A from the truth: the noise of B and that of B2 are not
 * correlated and cancel, where mean (A − B)² holds the noise of B. */
#ifndef MANGATA_IMAGE_METRICS_NOISE_H
#define MANGATA_IMAGE_METRICS_NOISE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/picture.h"

/* Running sums in double; start from all zero. */
typedef struct noise_sums {
    uint64_t values;           /* finite in all three: what the sums hold */
    double product;            /* Σ (A − B)(A − B2) */
    double difference_squared; /* Σ (B − B2)² */
} noise_sums;

/* Adds a frame: A, B, B2, values as given. `counted`: width · height, false leaves a pixel out; NULL: all count. Sizes and channels must agree
 * (FILE_ARGUMENT, nothing added). */
file_status noise_sums_add(noise_sums *sums, const float_image images[3], const bool *counted, file_error *error);

/* √ max(0, mean (A − B)(A − B2)); 0 without values. */
double noise_sums_rmse(const noise_sums *sums);
/* Half of √ mean (B − B2)²: how far the mean of B and B2 still is from the truth; 0 without values. */
double noise_sums_floor(const noise_sums *sums);

/* The mean of two references, of B's size; the caller frees it. FILE_ARGUMENT where their sizes or channels differ, FILE_MEMORY. */
file_status noise_mean(float_image *mean, const float_image *b, const float_image *b2, file_error *error);

#endif
