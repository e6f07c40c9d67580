/* SPDX-License-Identifier: MIT
 * The tables of Podee et al. 2021, §3.5 and §4: a circular Gaussian convolved with the light disk, and its integral along straight lines. */
#include "frame/podee_tables.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;
static const double least_deviation = 0.02, deviation_range = 400;

/* Number of finer radii at which F is computed for the integrals S. */
enum { RADII = 2048, MAX_CHORDS = 512 };

double podee_slice_deviation(int slice) { return least_deviation * pow(deviation_range, (double)slice / (PODEE_SLICES - 1)); }

double podee_slice_reach(int slice) { return 1 + 4 * podee_slice_deviation(slice); }

/* ---- F ---- */

/* F at `count` radii: 0, spacing, 2·spacing, … The Gaussian lies at distance r along v. The disk is summed over its chords at v = sin θ for equispaced θ:
 *   F(r) = ∫ N(v; r, σ²) · [2Φ(cos θ/σ) − 1] · cos θ dθ.
 * The sum converges exponentially. From one radius to the next a chord's density N is multiplied by a factor, and this factor by a constant. The recurrence
 * runs both ways from the radius nearest to the chord. */
static void convolve(double deviation, double spacing, int count, float *out)
{
    double sum[RADII];
    for (int i = 0; i < count; i++)
        sum[i] = 0;
    const int wanted = (int)(pi / (0.6 * deviation)), chords = wanted < 32 ? 32 : wanted < MAX_CHORDS ? wanted : MAX_CHORDS;
    const double per_deviation = spacing / deviation, change = exp(-per_deviation * per_deviation);
    for (int k = 0; k < chords; k++) {
        const double angle = pi * ((k + 0.5) / chords - 0.5), v = sin(angle), h = cos(angle);
        const double weight = erf(h / (deviation * sqrt(2))) * h * (pi / chords) / (deviation * sqrt(2 * pi));
        const int nearest = v > 0 ? (int)(v / spacing) : 0;
        const double off = nearest * per_deviation - v / deviation;
        double density = weight * exp(-off * off / 2), factor = exp(-per_deviation * (off + per_deviation / 2));
        for (int i = nearest; i < count && density > 1e-12; i++, factor *= change) {
            sum[i] += density;
            density *= factor;
        }
        density = weight * exp(-off * off / 2), factor = exp(per_deviation * (off - per_deviation / 2));
        for (int i = nearest - 1; i >= 0 && density > 1e-12; i--, factor *= change) {
            density *= factor;
            sum[i] += density;
        }
    }
    for (int i = 0; i < count; i++)
        out[i] = (float)sum[i];
}

/* ---- S ---- */

/* F along the row u of a slice, by interpolation. */
static void fill_row(const float *fine, float per_fine, float u, float spacing, float *row)
{
    const float furthest = (RADII - 2) / per_fine, within = furthest * furthest - u * u;
    const float end = within > 0 ? sqrtf(within) / spacing : 0;
    const int columns = end < PODEE_COLUMNS ? (int)end : PODEE_COLUMNS;
    for (int c = columns; c < PODEE_COLUMNS; c++)
        row[c] = 0;
    for (int c = 0; c < columns; c++) {
        const float v = spacing * (float)c, at = sqrtf(u * u + v * v) * per_fine;
        const int i = at < RADII - 2 ? (int)at : RADII - 2;
        const float t = at - (float)i, f = fine[i] + (fine[i + 1] - fine[i]) * t;
        row[c] = f > 0 ? f : 0;
    }
}

/* ∫ F du from row to row by the cubic through four rows: h/24 · (−f₋₁ + 13 f₀ + 13 f₁ − f₂). F is even in u. */
static void integrate_rows(const float *fine, float per_fine, float spacing, float *slice)
{
    float rows[4][PODEE_COLUMNS], *f[4] = {rows[0], rows[1], rows[2], rows[3]};
    fill_row(fine, per_fine, spacing, spacing, f[0]);
    fill_row(fine, per_fine, 0, spacing, f[1]);
    fill_row(fine, per_fine, spacing, spacing, f[2]);
    fill_row(fine, per_fine, 2 * spacing, spacing, f[3]);
    for (int c = 0; c < PODEE_COLUMNS; c++)
        slice[c] = 0;
    const float share = spacing / 24;
    for (int r = 1; r < PODEE_ROWS; r++) {
        const float *before = slice + (size_t)(r - 1) * PODEE_COLUMNS;
        float *row = slice + (size_t)r * PODEE_COLUMNS;
        for (int c = 0; c < PODEE_COLUMNS; c++)
            row[c] = before[c] + share * (13 * (f[1][c] + f[2][c]) - f[0][c] - f[3][c]);
        float *oldest = f[0];
        f[0] = f[1], f[1] = f[2], f[2] = f[3], f[3] = oldest;
        fill_row(fine, per_fine, spacing * (float)(r + 2), spacing, f[3]);
    }
}

static void build_slice(void *argument, size_t index)
{
    const podee_tables *tables = argument;
    const int s = (int)index;
    const double deviation = podee_slice_deviation(s), reach = podee_slice_reach(s);
    /* Farther than five deviations from the disk F is negligible. */
    const double furthest = 1 + 5 * deviation, fine_spacing = furthest / (RADII - 2);
    float fine[RADII];
    convolve(deviation, fine_spacing, RADII, fine);
    fine[RADII - 2] = fine[RADII - 1] = 0;
    convolve(deviation, reach / (PODEE_COLUMNS - 1), PODEE_COLUMNS, tables->share + index * PODEE_COLUMNS);
    integrate_rows(fine, (float)(1 / fine_spacing), (float)(reach / (PODEE_ROWS - 1)), tables->sweep + index * PODEE_ROWS * PODEE_COLUMNS);
}

bool podee_tables_build(podee_tables *tables, podee_loop *loop, void *user)
{
    tables->sweep = malloc(sizeof *tables->sweep * PODEE_SLICES * PODEE_ROWS * PODEE_COLUMNS);
    tables->share = malloc(sizeof *tables->share * PODEE_SLICES * PODEE_COLUMNS);
    if (!tables->sweep || !tables->share) {
        podee_tables_free(tables);
        return false;
    }
    loop(user, PODEE_SLICES, build_slice, tables);
    return true;
}

void podee_tables_free(podee_tables *tables)
{
    free(tables->sweep);
    free(tables->share);
    *tables = (podee_tables){NULL, NULL};
}
