/* SPDX-License-Identifier: MIT */
/* Errors against the truth behind two references B and B2 with independent noise. Private to src/image and its tests.
 * With A independent of both, mean (A − B)(A − B2) is the mean squared distance of A from the truth: the noise of B and that of B2 are not
 * correlated and cancel, where mean (A − B)² holds the noise of B. */
#ifndef MANGATA_IMAGE_METRICS_NOISE_H
#define MANGATA_IMAGE_METRICS_NOISE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/picture.h"

/* Running sums in double precision, which start zeroed. */
typedef struct noise_sums {
    uint64_t values;           /* number of values that are finite in all three pictures; only these are in the sums */
    double product;            /* Σ (A − B)(A − B2) */
    double difference_squared; /* Σ (B − B2)² */
} noise_sums;

/* Adds a frame: A, B and B2. `counted`: width · height elements, false: the pixel is left out; NULL: no pixel is left out. FILE_ARGUMENT: sizes or channels
 * differ, and nothing was added. */
file_status noise_sums_add(noise_sums *sums, const float_image images[3], const bool *counted, file_error *error);

/* √ max(0, mean (A − B)(A − B2)); 0: there are no values. */
double noise_sums_rmse(const noise_sums *sums);
/* ½ √ mean (B − B2)²: the RMSE of the mean of B and B2 against the truth; 0: there are no values. */
double noise_sums_floor(const noise_sums *sums);

/* The mean of two references. The caller frees it. Returns FILE_OK, FILE_ARGUMENT if their sizes or channels differ, or FILE_MEMORY. */
file_status noise_mean(float_image *mean, const float_image *b, const float_image *b2, file_error *error);

#endif
