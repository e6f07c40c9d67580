/* SPDX-License-Identifier: MIT */
/* How much of the truth's texture a picture keeps, from the horizon down: contrast, correlation and mean of bands of rows. Private to src/image,
 * cli and their tests.
 * P: the picture; A, B: two references of one truth with independent noise; x′: x minus the mean of its row. All are linear luminances.
 *   contrast    √ mean P′² / √ mean A′B′                          1 is best; below 1: too smooth
 *   correlation mean P′(A′ + B′)/2 / (√ mean P′² · √ mean A′B′)   1 is best; 0: the texture lies elsewhere
 *   mean        mean P / mean (A + B)/2                           1 is best
 * The noise of A is not that of B, so mean A′B′ is the variance of the truth alone. Means run over the rows of a band and over all frames.
 * Their own noise, a standard deviation, is what is left of the references' noise; the noise of their mean R is taken from d = (A − B)/2, pixel by pixel
 * (errors of R: independent from pixel to pixel, to first order, S = Σ A′B′):
 *   contrast    contrast · √ Σ d′²R′² / S
 *   correlation √ Σ d′² (P′/√(S Σ P′²) − correlation · R′/S)²
 *   mean        mean · √ Σ d′² / Σ R
 * NaN: contrast and correlation where mean A′B′ ≤ 0 (no texture, or less than the noise hides), correlation where P′ is 0, mean where both
 * references are black. */
#ifndef MANGATA_IMAGE_METRICS_TEXTURE_H
#define MANGATA_IMAGE_METRICS_TEXTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"

/* Bands begin at the top row; the last one may be shorter, down to TEXTURE_ROWS_LEAST rows. */
enum { TEXTURE_ROWS = 10, TEXTURE_ROWS_LEAST = 5 };

/* Sums of each band. */
typedef struct texture texture;

/* Width and height from 1. FILE_MEMORY; on failure *result is NULL. */
file_status texture_create(texture **result, uint32_t width, uint32_t height, file_error *error);
void texture_free(texture *t);

/* Linear luminances, finite, width · height, top row first. */
typedef struct texture_input {
    const float *picture, *references[2];
    const bool *counted; /* false leaves a pixel out of its row; NULL: all count */
} texture_input;

/* Adds a frame. */
void texture_add(texture *t, const texture_input *input);

typedef struct texture_band {
    uint32_t row, rows; /* first row from the top, and how many */
    double contrast, correlation, mean;
    double contrast_noise, correlation_noise, mean_noise; /* standard deviations */
} texture_band;

/* How many bands there are; 0 where the picture has fewer than TEXTURE_ROWS_LEAST rows. */
uint32_t texture_bands(const texture *t);
/* Band `index` < texture_bands(), over the frames added so far. */
texture_band texture_band_at(const texture *t, uint32_t index);

/* Over all bands that have the score; NaN where none has it. */
typedef struct texture_summary {
    double correlation_mean, correlation_least;
    double contrast_least, contrast_greatest;
    double mean_least, mean_greatest;
} texture_summary;

texture_summary texture_summarize(const texture *t);
/* The standard deviation of each: of a mean over bands that mean's, of the least and the greatest that of their band. */
texture_summary texture_summarize_noise(const texture *t);

#endif
