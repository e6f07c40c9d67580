/* SPDX-License-Identifier: MIT
 *
 * Samples a spectrum by sines.
 */
#include "sea/spectrum_sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/hash.h"
#include "sea/spectrum_math.h"
#include "params/waves.h"

/* Waves within one cell of the grid have the same length, so seas of more than CELL_WAVES waves use a finer grid. */
enum { CELLS = 4096, CELL_WAVES = 512, FINE_CELLS = 8 * CELLS, DIRECTIONS = 720, HARMONIC_STEP = 64 };

static const double HEIGHT_SHARE = 0.25, TAIL_BEGINS = 3 /* times the peak frequency */;

/* A difference of two variances that is a smaller fraction of them has lost too many digits by cancellation. */
static const double CANCELLED = 1e-10;

/* ---- quadrature over frequency ------------------------------------------------------------------------------ */

/* Variances of height and slope below each node of a grid with equal steps in the logarithm of frequency. */
typedef struct frequency_grid {
    double low, step; /* logarithm of the first node's frequency, and step of the logarithm */
    int cells;
    double *slope, *rest; /* arrays of the same length behind `height`; `rest`: variance of the height above each node */
    double height[];
} frequency_grid;

static double node_frequency(const frequency_grid *grid, double node) { return portable_exp(grid->low + grid->step * node); }

/* Integrates by Simpson's rule in each cell. NULL: out of memory. */
static frequency_grid *make_grid(const wave_spectrum *spectrum, int cells)
{
    frequency_grid *grid = malloc(sizeof *grid + 3 * ((size_t)cells + 1) * sizeof *grid->height);
    if (grid == NULL)
        return NULL;
    grid->cells = cells;
    grid->slope = grid->height + cells + 1;
    grid->rest = grid->slope + cells + 1;
    grid->rest[cells] = 0;
    grid->low = portable_log(spectrum->low);
    grid->step = (portable_log(spectrum->high) - grid->low) / cells;
    grid->height[0] = grid->slope[0] = 0;
    double height_before = 0, slope_before = 0;
    for (int i = 0; i <= 2 * cells; i++) {
        /* The ends are exact, because rounding must not move them out of the spectrum. */
        const double f = i == 0 ? spectrum->low : i == 2 * cells ? spectrum->high : node_frequency(grid, i / 2.0);
        const double k = dispersion_wave_number(f, spectrum->depth);
        const double height = grid->step / 6 * f * wave_spectrum_density(spectrum, f), slope = k * k * height;
        const int node = (i + 1) / 2;
        if (i == 0) {
            height_before = height;
            slope_before = slope;
        } else if (i % 2 != 0) {
            grid->height[node] = grid->height[node - 1] + height_before + 4 * height;
            grid->slope[node] = grid->slope[node - 1] + slope_before + 4 * slope;
            grid->rest[node - 1] = height_before + 4 * height;
        } else {
            grid->height[node] += height;
            grid->slope[node] += slope;
            grid->rest[node - 1] += height;
            height_before = height;
            slope_before = slope;
        }
    }
    for (int i = cells - 1; i >= 0; i--)
        grid->rest[i] += grid->rest[i + 1];
    return grid;
}

/* ---- quadrature over direction ------------------------------------------------------------------------------ */

/* Fraction of a frequency's density below each of DIRECTIONS + 1 azimuths, which start upwind and go around to upwind. */
static void cumulate_directions(const wave_spectrum *spectrum, double frequency, double share[DIRECTIONS + 1])
{
    const double width = 2 * SPECTRUM_PI / DIRECTIONS;
    double before = wave_spectrum_spreading(spectrum, frequency, spectrum->downwind - SPECTRUM_PI);
    share[0] = 0;
    for (int i = 1; i <= DIRECTIONS; i++) {
        const double density = wave_spectrum_spreading(spectrum, frequency, spectrum->downwind - SPECTRUM_PI + width * i);
        share[i] = share[i - 1] + (before + density) / 2;
        before = density;
    }
    /* A table may have frequencies without waves, whose direction does not matter. */
    const double total = share[DIRECTIONS];
    for (int i = 1; i <= DIRECTIONS; i++)
        share[i] = total > 0 ? share[i] / total : (double)i / DIRECTIONS;
}

/* The azimuth below which the fraction u in [0, 1) of the density lies. */
static double direction_quantile(const wave_spectrum *spectrum, double frequency, double u)
{
    double share[DIRECTIONS + 1];
    cumulate_directions(spectrum, frequency, share);
    int low = 0, high = DIRECTIONS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (share[middle] <= u)
            low = middle;
        else
            high = middle;
    }
    const double part = share[high] > share[low] ? (u - share[low]) / (share[high] - share[low]) : 0.5;
    return spectrum->downwind - SPECTRUM_PI + 2 * SPECTRUM_PI / DIRECTIONS * (low + part);
}

/* Mean of cos 2θ, with θ from downwind. It is (upwind - crosswind) / (upwind + crosswind) for the mean-square slopes of one frequency. */
static double second_harmonic(const wave_spectrum *spectrum, double frequency)
{
    const double width = 2 * SPECTRUM_PI / DIRECTIONS;
    double sum = 0, weighted = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        const double density = wave_spectrum_spreading(spectrum, frequency, spectrum->downwind + width * i);
        sum += density;
        weighted += density * portable_cos(2 * width * i);
    }
    return sum > 0 ? weighted / sum : 0;
}

/* Upwind minus crosswind mean-square slope of the waves between two nodes. */
static double slope_difference(const wave_spectrum *spectrum, const frequency_grid *grid, int from, int to)
{
    double sum = 0;
    for (int i = from; i < to; i += HARMONIC_STEP) {
        const int end = i + HARMONIC_STEP < to ? i + HARMONIC_STEP : to;
        sum += (grid->slope[end] - grid->slope[i]) * second_harmonic(spectrum, node_frequency(grid, (i + end) / 2.0));
    }
    return sum;
}

/* ---- the tail ----------------------------------------------------------------------------------------------- */

/* Mean-square slope of the waves beyond a node if their density is multiplied by (ω/ω_node)^power. */
static double bent_slope(const frequency_grid *grid, int node, double power)
{
    double sum = 0;
    for (int i = node; i < grid->cells; i++)
        sum += (grid->slope[i + 1] - grid->slope[i]) * portable_exp(power * grid->step * (i + 0.5 - node));
    return sum;
}

/* The s of cos^2s whose mean of cos 2θ, s (s - 1) / ((s + 1) (s + 2)), is `harmonic`. The least value of this form is -0.0718, so lower ones are clamped. */
static double spread_of_harmonic(double harmonic)
{
    const double r = fmin(fmax(harmonic, -0.0717), 0.95), b = 1 + 3 * r;
    return (b + sqrt(b * b + 8 * r * (1 - r))) / (2 * (1 - r));
}

bool spectrum_bend_tail(wave_spectrum *spectrum, cox_munk slopes, spectrum_fault *fault)
{
    const double least = -30, most = 30, halfway = sqrt(spectrum->peak * spectrum->high);
    const double from = spectrum->kind == SPECTRUM_BUOY ? spectrum->tail_from : fmin(TAIL_BEGINS * spectrum->peak, halfway);
    fault->key = NULL;
    spectrum->bend_from = INFINITY;
    frequency_grid *grid = make_grid(spectrum, CELLS);
    if (grid == NULL)
        return false;
    fault->key = "slope";
    int node = (int)ceil((portable_log(from) - grid->low) / grid->step);
    node = node < 0 ? 0 : node > CELLS - 1 ? CELLS - 1 : node;
    const double rest = slopes.total - grid->slope[node];
    const bool reachable = bent_slope(grid, node, least) < rest && rest < bent_slope(grid, node, most);
    if (!reachable) {
        snprintf(fault->text, sizeof fault->text,
                 "cannot be cox-munk: the clean sea's mean-square slope is %.3g, that of the waves longer than %.3g m alone %.3g; "
                 "allowed: spectrum, or another wind, fetch or shortest wave",
                 slopes.total, 2 * SPECTRUM_PI / dispersion_wave_number(from, spectrum->depth), grid->slope[node]);
        free(grid);
        return false;
    }
    double low = least, high = most;
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        if (bent_slope(grid, node, middle) < rest)
            low = middle;
        else
            high = middle;
    }
    const double difference = slopes.total * (slopes.upwind - slopes.crosswind) / (slopes.upwind + slopes.crosswind);
    spectrum->bend_spread = spread_of_harmonic((difference - slope_difference(spectrum, grid, 0, node)) / rest);
    spectrum->bend_power = low;
    spectrum->bend_from = node_frequency(grid, node);
    free(grid);
    return true;
}

/* ---- waves -------------------------------------------------------------------------------------------------- */

/* A uniform random number in [0, 1) for a seed and a counter, by two passes of the finaliser of SplitMix64. */
static double uniform(uint32_t seed, uint64_t counter) { return hash_fraction(hash_mixed(hash_of((uint64_t)seed << 32 | counter))); }

static mgt_wave make_wave(const wave_spectrum *spectrum, double height_variance, double slope_variance, double direction_share, double phase)
{
    const double k = sqrt(slope_variance / height_variance), frequency = dispersion_frequency(k, spectrum->depth);
    const double azimuth = direction_quantile(spectrum, frequency, direction_share);
    return wave_from(seven_digits(sqrt(2 * height_variance)), seven_digits(k * portable_sin(azimuth)), seven_digits(-k * portable_cos(azimuth)),
                     seven_digits(-frequency), seven_digits(phase));
}

/* The share of a wave's directions below its own. A sea of few waves runs with the wind: the first, the longest, right along it, the others in the middles of
 * equal shares. Of more waves neighbours run apart, by the golden ratio from a start. */
static double direction_share(double start, size_t index, size_t count)
{
    enum { FEW_WAVES = 4 };
    const double golden = 0.61803398874989484820;
    if (count <= FEW_WAVES)
        return index == 0 ? 0.5 : ((double)index - 0.5) / ((double)count - 1);
    const double turns = start + golden * (double)index;
    return turns - floor(turns);
}

bool spectrum_sample(const wave_spectrum *spectrum, uint32_t seed, size_t count, mgt_wave *waves)
{
    frequency_grid *grid = make_grid(spectrum, count > CELL_WAVES ? FINE_CELLS : CELLS);
    if (grid == NULL)
        return false;
    const double height_scale = HEIGHT_SHARE / grid->height[grid->cells], slope_scale = (1 - HEIGHT_SHARE) / grid->slope[grid->cells];
    const double start = uniform(seed, 0);
    double height_before = 0, slope_before = 0, rest_before = grid->rest[0];
    int cell = 0;
    for (size_t i = 0; i < count; i++) {
        const double share = (double)(i + 1) / (double)count;
        while (cell < grid->cells - 1 && height_scale * grid->height[cell + 1] + slope_scale * grid->slope[cell + 1] < share)
            cell++;
        const double height_step = grid->height[cell + 1] - grid->height[cell], slope_step = grid->slope[cell + 1] - grid->slope[cell];
        const double low = height_scale * grid->height[cell] + slope_scale * grid->slope[cell];
        const double part = i + 1 == count ? 1 : (share - low) / (height_scale * height_step + slope_scale * slope_step);
        const double height = grid->height[cell] + part * height_step, slope = grid->slope[cell] + part * slope_step;
        const double rest = grid->rest[cell] - part * (grid->rest[cell] - grid->rest[cell + 1]);
        const double variance = height - height_before < CANCELLED * height ? rest_before - rest : height - height_before;
        waves[i] = make_wave(spectrum, variance, slope - slope_before, direction_share(start, i, count), 2 * SPECTRUM_PI * uniform(seed, i + 1));
        height_before = height;
        slope_before = slope;
        rest_before = rest;
    }
    free(grid);
    return true;
}

/* ---- statistics --------------------------------------------------------------------------------------------- */

bool spectrum_statistics(const wave_spectrum *spectrum, sea_statistics *out)
{
    frequency_grid *grid = make_grid(spectrum, CELLS);
    if (grid == NULL)
        return false;
    const double slope = grid->slope[CELLS], difference = slope_difference(spectrum, grid, 0, CELLS);
    *out = (sea_statistics){.height = 4 * sqrt(grid->height[CELLS]), .slope = slope, .upwind = (slope + difference) / 2, .crosswind = (slope - difference) / 2};
    free(grid);
    return true;
}

sea_statistics waves_statistics(const mgt_wave *waves, size_t count, double azimuth)
{
    const double x = portable_sin(azimuth), z = -portable_cos(azimuth);
    const wave_variances v = waves_variances(waves, count, x, z);
    return (sea_statistics){.height = 4 * sqrt(v.height), .slope = v.along + v.across, .upwind = v.along, .crosswind = v.across};
}
