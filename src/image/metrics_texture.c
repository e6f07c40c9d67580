/* SPDX-License-Identifier: MIT */
/* Sums of rows, gathered by band; see metrics_texture.h. */
#include "image/metrics_texture.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* References stand by their mean R = (A + B)/2 and by A′B′. */
typedef struct band_sums {
    double picture, reference;                      /* Σ P, Σ R */
    double picture_power, reference_power, product; /* Σ P′², Σ A′B′, Σ P′R′ */
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
    double p_power = 0, ab_power = 0, product = 0;
    for (size_t i = first; i < end; i++) {
        if (!counts(input, i))
            continue;
        const double dp = p[i] - p0 - p_mean, da = a[i] - a0 - a_mean, db = b[i] - b0 - b_mean;
        p_power += dp * dp;
        ab_power += da * db;
        product += dp * (da + db) / 2;
    }
    sums->picture += count * (p0 + p_mean);
    sums->reference += count * (a0 + a_mean + b0 + b_mean) / 2;
    sums->picture_power += p_power;
    sums->reference_power += ab_power;
    sums->product += product;
}

void texture_add(texture *t, const texture_input *input)
{
    for (uint32_t y = 0; y < t->height && y / TEXTURE_ROWS < t->bands; y++)
        add_row(&t->sums[y / TEXTURE_ROWS], input, (size_t)y * t->width, (size_t)(y + 1) * t->width);
}

uint32_t texture_bands(const texture *t) { return t->bands; }

texture_band texture_band_at(const texture *t, uint32_t index)
{
    const band_sums *s = &t->sums[index];
    const uint32_t row = index * TEXTURE_ROWS, left = t->height - row;
    texture_band band = {row, left < TEXTURE_ROWS ? left : TEXTURE_ROWS, NAN, NAN, NAN};
    if (s->reference_power > 0)
        band.contrast = sqrt(s->picture_power / s->reference_power);
    if (s->reference_power > 0 && s->picture_power > 0)
        band.correlation = s->product / sqrt(s->picture_power * s->reference_power);
    if (s->reference != 0)
        band.mean = s->picture / s->reference;
    return band;
}

texture_summary texture_summarize(const texture *t)
{
    texture_summary summary = {NAN, NAN, NAN, NAN, NAN, NAN};
    double sum = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < t->bands; i++) {
        const texture_band band = texture_band_at(t, i);
        if (!isnan(band.correlation)) {
            sum += band.correlation;
            count++;
        }
        /* fmin and fmax leave NaN out. */
        summary.correlation_least = fmin(summary.correlation_least, band.correlation);
        summary.contrast_least = fmin(summary.contrast_least, band.contrast);
        summary.contrast_greatest = fmax(summary.contrast_greatest, band.contrast);
        summary.mean_least = fmin(summary.mean_least, band.mean);
        summary.mean_greatest = fmax(summary.mean_greatest, band.mean);
    }
    if (count)
        summary.correlation_mean = sum / count;
    return summary;
}
