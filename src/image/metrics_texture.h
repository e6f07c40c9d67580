/* SPDX-License-Identifier: MIT */
/* The truth's texture in a picture, by bands of rows from the top down: contrast, correlation and mean. Private to src/image, cli and their tests.
 *
 * P is the picture. A and B are two references of one truth with independent noise. x′ is x minus the mean of its row. All are linear luminances.
 *   contrast    √ mean P′² / √ mean A′B′                          1 is best; below 1: too smooth
 *   correlation mean P′(A′ + B′)/2 / (√ mean P′² · √ mean A′B′)   1 is best; 0: the texture lies elsewhere
 *   mean        mean P / mean (A + B)/2                           1 is best
 * The noise of A is not that of B, so mean A′B′ is the variance of the truth alone. Means run over the rows of a band and over all frames.
 *
 * The noise of a score is its standard deviation by the references' noise. The error of their mean R in a pixel is taken to be d = (A − B)/2. Errors are
 * independent from pixel to pixel and enter to first order. With S = Σ A′B′ the noise of each score is
 *   contrast    contrast · √ Σ d′²R′² / S
 *   correlation √ Σ d′² (P′/√(S Σ P′²) − correlation · R′/S)²
 *   mean        mean · √ Σ d′² / Σ R
 *
 * Scores are NaN in these cases: contrast and correlation if mean A′B′ ≤ 0, because there is no texture or the noise hides it; correlation if P′ is 0; mean if
 * both references are black. */
#ifndef MANGATA_IMAGE_METRICS_TEXTURE_H
#define MANGATA_IMAGE_METRICS_TEXTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"

/* Number of rows of a band. The last band may have fewer, but at least TEXTURE_ROWS_LEAST. */
enum { TEXTURE_ROWS = 10, TEXTURE_ROWS_LEAST = 5 };

/* Sums over each band. */
typedef struct texture texture;

/* Width and height are at least 1. Returns FILE_OK, or FILE_MEMORY and *result NULL. */
file_status texture_create(texture **result, uint32_t width, uint32_t height, file_error *error);
void texture_free(texture *t);

/* Pictures of width · height finite linear luminances, top row first. */
typedef struct texture_input {
    const float *picture, *references[2];
    const bool *counted; /* false: the pixel is left out of its row; NULL: no pixel is left out */
} texture_input;

/* Adds a frame. */
void texture_add(texture *t, const texture_input *input);

typedef struct texture_band {
    uint32_t row, rows; /* first row, counted from the top, and number of rows */
    double contrast, correlation, mean;
    double contrast_noise, correlation_noise, mean_noise; /* standard deviations */
} texture_band;

/* Number of bands; 0: the picture has fewer than TEXTURE_ROWS_LEAST rows. */
uint32_t texture_bands(const texture *t);
/* Scores of band `index` < texture_bands() over the frames added so far. */
texture_band texture_band_at(const texture *t, uint32_t index);

/* Scores over all bands that have them; NaN: none has. */
typedef struct texture_summary {
    double correlation_mean, correlation_least;
    double contrast_least, contrast_greatest;
    double mean_least, mean_greatest;
} texture_summary;

texture_summary texture_summarize(const texture *t);
/* Standard deviations of these scores. That of a least or greatest score is the one of its band. */
texture_summary texture_summarize_noise(const texture *t);

#endif
