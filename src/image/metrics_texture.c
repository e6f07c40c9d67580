/* SPDX-License-Identifier: MIT */
/* Sums of rows, gathered by band; see metrics_texture.h. */
#include "image/metrics_texture.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* References stand by their mean R = (A + B)/2 and by A′B′. */
typedef struct band_sums {
    double picture, reference;                                        /* Σ P, Σ R */
    double picture_power, reference_power, product;                   /* Σ P′², Σ A′B′, Σ P′R′ */
    double noise;                                                     /* Σ d², d = (A′ − B′)/2 */
    double noisy_picture_power, noisy_reference_power, noisy_product; /* Σ d²P′², Σ d²R′², Σ d²P′R′ */
} band_sums;

struct texture {
    uint32_t width, height, bands;
    band_sums sums[];
};

file_status texture_create(texture **result, uint32_t width, uint32_t height, file_error *error)
{
    const uint32_t bands = height / TEXTURE_ROWS + (height % TEXTURE_ROWS >= TEXTURE_ROWS_LEAST);
    texture *t = *result = calloc(1, sizeof *t + bands * sizeof t->sums[0]);
    if (!t)
        return file_error_set(error, FILE_MEMORY, "out of memory for metrics");
    t->width = width;
    t->height = height;
    t->bands = bands;
    return FILE_OK;
}

void texture_free(texture *t) { free(t); }

static bool counts(const texture_input *input, size_t pixel) { return !input->counted || input->counted[pixel]; }

/* Deviations are taken from the row's first pixel before its mean, so that a row of one value deviates by exactly 0. */
static void add_row(band_sums *sums, const texture_input *input, size_t first, size_t end)
{
    const float *const p = input->picture, *const a = input->references[0], *const b = input->references[1];
    while (first < end && !counts(input, first))
        first++;
    if (first == end)
        return;
    const double p0 = p[first], a0 = a[first], b0 = b[first];
    double p_mean = 0, a_mean = 0, b_mean = 0;
    uint32_t count = 0;
    for (size_t i = first; i < end; i++) {
        if (!counts(input, i))
            continue;
        count++;
        p_mean += p[i] - p0;
        a_mean += a[i] - a0;
        b_mean += b[i] - b0;
    }
    p_mean /= count;
    a_mean /= count;
    b_mean /= count;
    double p_power = 0, ab_power = 0, product = 0, noise = 0, noisy_p = 0, noisy_r = 0, noisy_product = 0;
    for (size_t i = first; i < end; i++) {
        if (!counts(input, i))
            continue;
        const double dp = p[i] - p0 - p_mean, da = a[i] - a0 - a_mean, db = b[i] - b0 - b_mean, dr = (da + db) / 2;
        const double square = (da - db) * (da - db) / 4;
        p_power += dp * dp;
        ab_power += da * db;
        product += dp * dr;
        noise += square;
        noisy_p += square * dp * dp;
        noisy_r += square * dr * dr;
        noisy_product += square * dp * dr;
    }
    sums->picture += count * (p0 + p_mean);
    sums->reference += count * (a0 + a_mean + b0 + b_mean) / 2;
    sums->picture_power += p_power;
    sums->reference_power += ab_power;
    sums->product += product;
    sums->noise += noise;
    sums->noisy_picture_power += noisy_p;
    sums->noisy_reference_power += noisy_r;
    sums->noisy_product += noisy_product;
}

void texture_add(texture *t, const texture_input *input)
{
    for (uint32_t y = 0; y < t->height && y / TEXTURE_ROWS < t->bands; y++)
        add_row(&t->sums[y / TEXTURE_ROWS], input, (size_t)y * t->width, (size_t)(y + 1) * t->width);
}

uint32_t texture_bands(const texture *t) { return t->bands; }

static double correlation_noise(const band_sums *s, double correlation)
{
    const double p = 1 / sqrt(s->reference_power * s->picture_power), r = correlation / s->reference_power;
    return sqrt(fmax(0, p * p * s->noisy_picture_power - 2 * p * r * s->noisy_product + r * r * s->noisy_reference_power));
}

texture_band texture_band_at(const texture *t, uint32_t index)
{
    const band_sums *s = &t->sums[index];
    const uint32_t row = index * TEXTURE_ROWS, left = t->height - row;
    texture_band band = {row, left < TEXTURE_ROWS ? left : TEXTURE_ROWS, NAN, NAN, NAN, NAN, NAN, NAN};
    if (s->reference_power > 0) {
        band.contrast = sqrt(s->picture_power / s->reference_power);
        band.contrast_noise = band.contrast * sqrt(s->noisy_reference_power) / s->reference_power;
    }
    if (s->reference_power > 0 && s->picture_power > 0) {
        band.correlation = s->product / sqrt(s->picture_power * s->reference_power);
        band.correlation_noise = correlation_noise(s, band.correlation);
    }
    if (s->reference != 0) {
        band.mean = s->picture / s->reference;
        band.mean_noise = fabs(band.mean) * sqrt(s->noise) / fabs(s->reference);
    }
    return band;
}

/* The figure that a summary takes of the bands, and its noise. */
typedef struct extreme {
    double value, noise;
} extreme;

static extreme lesser(extreme a, double value, double noise) { return !(value >= a.value) && !isnan(value) ? (extreme){value, noise} : a; }

static extreme greater(extreme a, double value, double noise) { return !(value <= a.value) && !isnan(value) ? (extreme){value, noise} : a; }

static void summarize(const texture *t, texture_summary *values, texture_summary *noise)
{
    extreme correlation = {NAN, NAN}, contrast[2] = {correlation, correlation}, mean[2] = {correlation, correlation};
    double sum = 0, variance = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < t->bands; i++) {
        const texture_band band = texture_band_at(t, i);
        if (!isnan(band.correlation)) {
            sum += band.correlation;
            variance += band.correlation_noise * band.correlation_noise;
            count++;
        }
        correlation = lesser(correlation, band.correlation, band.correlation_noise);
        contrast[0] = lesser(contrast[0], band.contrast, band.contrast_noise);
        contrast[1] = greater(contrast[1], band.contrast, band.contrast_noise);
        mean[0] = lesser(mean[0], band.mean, band.mean_noise);
        mean[1] = greater(mean[1], band.mean, band.mean_noise);
    }
    *values = (texture_summary){count ? sum / count : NAN, correlation.value, contrast[0].value, contrast[1].value, mean[0].value, mean[1].value};
    *noise = (texture_summary){count ? sqrt(variance) / count : NAN, correlation.noise, contrast[0].noise, contrast[1].noise, mean[0].noise, mean[1].noise};
}

texture_summary texture_summarize(const texture *t)
{
    texture_summary values, noise;
    summarize(t, &values, &noise);
    return values;
}

texture_summary texture_summarize_noise(const texture *t)
{
    texture_summary values, noise;
    summarize(t, &values, &noise);
    return noise;
}
