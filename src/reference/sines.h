/* SPDX-License-Identifier: MIT
 *
 * Sine waves as the reference renderer keeps and sums them.
 */
#ifndef MANGATA_REFERENCE_SINES_H
#define MANGATA_REFERENCE_SINES_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* Phases are kept in half turns (π radians): reducing them is then one exact subtraction. */
typedef struct reference_wave {
    double amplitude;
    double amplitude_a, amplitude_b; /* amplitude × wave vector in radians per metre */
    double a, b;                     /* wave vector, radians per metre */
    double half_turns_a, half_turns_b, half_turns_c;
    double phase; /* half turns at camera.position (x, z) and scene.time, in [−1, 1] */
} reference_wave;

enum {
    REFERENCE_LEVELS = 8,
    REFERENCE_BLOCK = 16,      /* waves; but for the last level, levels are whole blocks */
    REFERENCE_MOST_WAVES = 512 /* on any level but the last */
};

/* The longest waves of a sea, and what the others add to their height. */
typedef struct reference_level {
    uint32_t waves;    /* how many, from the first */
    double rest;       /* metres: the bound of the others' height; 0 on the last level */
    bool random;       /* that bound is so many deviations, not the sum */
    double amplitudes; /* metres: the sum of theirs */
} reference_level;

/* The first waves once more, with waves of no height up to a whole block. */
typedef struct reference_columns {
    _Alignas(64) double half_turns_a[REFERENCE_MOST_WAVES], half_turns_b[REFERENCE_MOST_WAVES], half_turns_c[REFERENCE_MOST_WAVES];
    double phase[REFERENCE_MOST_WAVES], amplitude_a[REFERENCE_MOST_WAVES], amplitude_b[REFERENCE_MOST_WAVES];
    float amplitude[REFERENCE_MOST_WAVES];
} reference_columns;

/* Fills a wave for each of the scene's, the longest first where levels want it. */
void reference_waves_of(const mgt_scene *scene, reference_wave *out);

/* What a sum of these waves never rises above: the sum of amplitudes or so many deviations, whichever is less. */
double reference_waves_bound(const reference_wave *waves, size_t count, double deviations);

void reference_columns_of(const reference_wave *waves, uint32_t count, reference_columns *columns);

/* Fills levels, the last one being all waves, and returns how many. */
uint32_t reference_levels_of(const reference_wave *waves, uint32_t count, double deviations, reference_level levels[REFERENCE_LEVELS]);

/* Turns the surface over. */
void reference_waves_mirror(reference_wave *waves, size_t count);

/* Of all waves aligned: their height, and their slope along a direction. */
void water_worst_case(const mgt_water *water, const double direction[3], double *height, double *slope);

#ifdef MANGATA_REFERENCE_DOUBLE_LANES_H /* for what is compiled in lanes */
typedef struct lane_surface {
    reals height, slope_x, slope_z;
} lane_surface;

typedef struct lane_hessian {
    reals xx, xz, zz;
} lane_hessian;

/* Adds to `total`, over the waves, the absolute slopes and second derivatives along a direction, and their squares. */
typedef struct lane_bounds {
    reals slope, slope_square, curvature, curvature_square;
} lane_bounds;

static inline sine_cosine wave_sine_cosine(const reference_wave *wave, reals x, reals z, reals time_offset)
{
    reals phase = fused(time_offset, splat(wave->half_turns_c), splat(wave->phase));
    phase = fused(z, splat(wave->half_turns_b), phase);
    phase = fused(x, splat(wave->half_turns_a), phase);
    return sine_cosine_half_turns(phase);
}

static inline lane_surface waves_at(const reference_wave *waves, uint32_t count, reals x, reals z, reals time_offset)
{
    lane_surface sum = {splat(0), splat(0), splat(0)};
    for (const reference_wave *wave = waves; wave < waves + count; wave++) {
        const sine_cosine sc = wave_sine_cosine(wave, x, z, time_offset);
        sum.height = fused(sc.sine, splat(wave->amplitude), sum.height);
        sum.slope_x = fused(sc.cosine, splat(wave->amplitude_a), sum.slope_x);
        sum.slope_z = fused(sc.cosine, splat(wave->amplitude_b), sum.slope_z);
    }
    return sum;
}

static inline lane_hessian waves_hessian(const reference_wave *waves, uint32_t count, reals x, reals z, reals time_offset)
{
    lane_hessian sum = {splat(0), splat(0), splat(0)};
    for (const reference_wave *wave = waves; wave < waves + count; wave++) {
        const reals sine = wave_sine_cosine(wave, x, z, time_offset).sine;
        sum.xx = fused(sine, splat(-wave->amplitude_a * wave->a), sum.xx);
        sum.xz = fused(sine, splat(-wave->amplitude_a * wave->b), sum.xz);
        sum.zz = fused(sine, splat(-wave->amplitude_b * wave->b), sum.zz);
    }
    return sum;
}

static inline void waves_bounds(const reference_wave *waves, uint32_t count, reals dx, reals dz, lane_bounds *total)
{
    lane_bounds sum = *total;
    for (const reference_wave *wave = waves; wave < waves + count; wave++) {
        const reals frequency = absolute(fused(dx, splat(wave->a), dz * wave->b));
        const reals slope = frequency * wave->amplitude;
        const reals curvature = slope * frequency;
        sum.slope += slope;
        sum.slope_square = fused(slope, slope, sum.slope_square);
        sum.curvature += curvature;
        sum.curvature_square = fused(curvature, curvature, sum.curvature_square);
    }
    *total = sum;
}
#endif

#endif
