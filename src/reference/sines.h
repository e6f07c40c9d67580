/* SPDX-License-Identifier: MIT
 *
 * Sine waves of the reference renderer, and their sums.
 */
#ifndef MANGATA_REFERENCE_SINES_H
#define MANGATA_REFERENCE_SINES_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* A wave. Phases are in half turns (π radians), so that an exact subtraction reduces them. */
typedef struct reference_wave {
    double amplitude;
    double amplitude_a, amplitude_b; /* amplitude × wave vector in radians per metre */
    double a, b;                     /* wave vector, radians per metre */
    double half_turns_a, half_turns_b, half_turns_c;
    double phase; /* half turns at camera.position (x, z) and scene.time, in [−1, 1] */
} reference_wave;

enum {
    REFERENCE_LEVELS = 8,
    REFERENCE_BLOCK = 16,      /* waves of a block; all levels except the last have whole blocks */
    REFERENCE_MOST_WAVES = 512 /* most waves of any level except the last */
};

/* The longest waves of a sea, and a bound of the others' height. */
typedef struct reference_level {
    uint32_t waves;    /* number of the longest waves */
    double rest;       /* bound of the other waves' height, metres; 0 on the last level */
    bool random;       /* `rest` is a number of standard deviations, not the sum of amplitudes */
    double amplitudes; /* sum of the longest waves' amplitudes, metres */
} reference_level;

/* The members of the first waves as arrays, padded with waves of amplitude 0 to a whole block. */
typedef struct reference_columns {
    _Alignas(64) double half_turns_a[REFERENCE_MOST_WAVES], half_turns_b[REFERENCE_MOST_WAVES], half_turns_c[REFERENCE_MOST_WAVES];
    double phase[REFERENCE_MOST_WAVES], amplitude_a[REFERENCE_MOST_WAVES], amplitude_b[REFERENCE_MOST_WAVES];
    float amplitude[REFERENCE_MOST_WAVES];
    /* For choppy water: height; factor of the cosine in the shift; factor of the sine in −∂shift/∂place. */
    _Alignas(64) double height[REFERENCE_MOST_WAVES], shift_a[REFERENCE_MOST_WAVES], shift_b[REFERENCE_MOST_WAVES];
    double press_aa[REFERENCE_MOST_WAVES], press_ab[REFERENCE_MOST_WAVES], press_bb[REFERENCE_MOST_WAVES];
} reference_columns;

/* Sums of choppy water at a place at rest. */
typedef struct choppy_sums {
    double height, slope[2], shift[2];
    double stretch[3]; /* xx, xz, zz of 1 + ∂shift/∂place */
} choppy_sums;

/* Bounds of choppy water along a curve of places at rest, for the longest waves. */
typedef struct choppy_level {
    uint32_t waves;
    double shift;            /* shift by all waves along a direction, metres */
    double rest, rest_shift; /* height of the other waves, and the height by which their shift moves these waves along their slope, metres */
    double slope, bend;      /* first and second derivative of the height along the curve */
    double most_stretch;     /* metres of shifted water per metre of the curve */
    double shift_bend;       /* second derivative of the shift along the curve, 1/metre */
} choppy_level;

/* Fills `out` with the scene's waves. If levels are used, the longest wave comes first. */
void reference_waves_of(const mgt_scene *scene, reference_wave *out);

/* Bound of the sum of these waves: the sum of amplitudes or `deviations` standard deviations, whichever is less. */
double reference_waves_bound(const reference_wave *waves, size_t count, double deviations);

void reference_columns_of(const reference_wave *waves, uint32_t count, reference_columns *columns);

/* Fills the columns' members for choppy water. `choppiness` < 0: the water is turned upside down. */
void reference_columns_shift(const reference_wave *waves, uint32_t count, double choppiness, reference_columns *columns);

/* Bounds of choppy water with the waves of these levels. */
void choppy_levels_of(const reference_wave *waves, double choppiness, double deviations, const reference_level *levels, uint32_t level_count,
                      choppy_level *out);

/* Fills `levels`, of which the last one has all waves. Returns their number. */
uint32_t reference_levels_of(const reference_wave *waves, uint32_t count, double deviations, reference_level levels[REFERENCE_LEVELS]);

/* Bounds within a parallelogram. Along direction i of slope space, the slope differs from its first-order expansion at the middle by at most first[i] + both[i]
 * + second[i]. For a parallelogram with the fractions x and y of the sides, the bound is x² first[i] + x y both[i] + y² second[i]. */
typedef struct reference_bend {
    double first[2], both[2], second[2];
    double height; /* bound of the difference in height from the middle, within whole[i] parallelograms along each side i, metres */
} reference_bend;

/* Bounds for parallelograms whose side i is any mean of the four vectors sides[i]. */
reference_bend reference_waves_bend(const reference_wave *waves, uint32_t count, const double sides[2][4][2], const double whole[2], const double axes[2][2]);

/* Distance within which the slope differs from its first-order expansion by at most `share` of its standard deviation, metres. +inf: there are no waves. */
double reference_waves_straight(const reference_wave *waves, uint32_t count, double share);

/* Fills `bend` with ∇²h − Σ slope_i ∇²D_i (xx, xz, zz), and the stretch of `sums`. `place`: x and z at rest, and time offset. */
void choppy_bend_at_rest(const reference_wave *waves, uint32_t count, double choppiness, const double place[3], const double slope[2], double bend[3],
                         choppy_sums *sums);

/* Turns the surface upside down. */
void reference_waves_mirror(reference_wave *waves, size_t count);

/* Height and slope along a direction if the crests of all waves were aligned. */
void water_worst_case(const mgt_water *water, const double direction[3], double *height, double *slope);

#ifdef MANGATA_REFERENCE_DOUBLE_LANES_H /* only for files that are compiled in lanes */
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

/* waves_at() and waves_hessian() together, with one sine and cosine for each wave. */
static inline lane_surface waves_at_with_hessian(const reference_wave *waves, uint32_t count, reals x, reals z, reals time_offset, lane_hessian *bend)
{
    lane_surface sum = {splat(0), splat(0), splat(0)};
    *bend = (lane_hessian){splat(0), splat(0), splat(0)};
    for (const reference_wave *wave = waves; wave < waves + count; wave++) {
        const sine_cosine sc = wave_sine_cosine(wave, x, z, time_offset);
        sum.height = fused(sc.sine, splat(wave->amplitude), sum.height);
        sum.slope_x = fused(sc.cosine, splat(wave->amplitude_a), sum.slope_x);
        sum.slope_z = fused(sc.cosine, splat(wave->amplitude_b), sum.slope_z);
        bend->xx = fused(sc.sine, splat(-wave->amplitude_a * wave->a), bend->xx);
        bend->xz = fused(sc.sine, splat(-wave->amplitude_a * wave->b), bend->xz);
        bend->zz = fused(sc.sine, splat(-wave->amplitude_b * wave->b), bend->zz);
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

/* ---- choppy water: eight partial sums at every number of lanes ---- */

enum { CHOPPY_PARTS = 8 / REFERENCE_LANES, CHOPPY_SUMS = 8 };

static inline double add_parts(const reals part[CHOPPY_PARTS])
{
    _Alignas(64) double sum[8];
    for (int i = 0; i < CHOPPY_PARTS; i++)
        store(&sum[i * REFERENCE_LANES], part[i]);
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

static inline choppy_sums choppy_sums_at(const reference_columns *c, uint32_t count, double x, double z, double time_offset)
{
    reals sum[CHOPPY_SUMS][CHOPPY_PARTS] = {0};
    for (uint32_t at = 0; at < count; at += 8)
        for (int part = 0; part < CHOPPY_PARTS; part++) {
            const uint32_t i = at + (uint32_t)part * REFERENCE_LANES;
            reals phase = fused(splat(time_offset), load(&c->half_turns_c[i]), load(&c->phase[i]));
            phase = fused(splat(z), load(&c->half_turns_b[i]), phase);
            phase = fused(splat(x), load(&c->half_turns_a[i]), phase);
            const sine_cosine sc = sine_cosine_half_turns(phase);
            sum[0][part] = fused(sc.sine, load(&c->height[i]), sum[0][part]);
            sum[1][part] = fused(sc.cosine, load(&c->amplitude_a[i]), sum[1][part]);
            sum[2][part] = fused(sc.cosine, load(&c->amplitude_b[i]), sum[2][part]);
            sum[3][part] = fused(sc.cosine, load(&c->shift_a[i]), sum[3][part]);
            sum[4][part] = fused(sc.cosine, load(&c->shift_b[i]), sum[4][part]);
            sum[5][part] = fused(sc.sine, load(&c->press_aa[i]), sum[5][part]);
            sum[6][part] = fused(sc.sine, load(&c->press_ab[i]), sum[6][part]);
            sum[7][part] = fused(sc.sine, load(&c->press_bb[i]), sum[7][part]);
        }
    return (choppy_sums){.height = add_parts(sum[0]),
                         .slope = {add_parts(sum[1]), add_parts(sum[2])},
                         .shift = {add_parts(sum[3]), add_parts(sum[4])},
                         .stretch = {1 - add_parts(sum[5]), -add_parts(sum[6]), 1 - add_parts(sum[7])}};
}

/* ---- sums in single precision ---- */

/* Blocks of 16 waves are added to 16 partial sums at every number of lanes, so that the bits are the same. */
#define FLOAT_LANES (REFERENCE_LANES == 1 ? 1 : 2 * REFERENCE_LANES)
enum { PARTS = REFERENCE_BLOCK / FLOAT_LANES };

typedef float floats __attribute__((vector_size(4 * FLOAT_LANES)));
typedef int32_t float_bits __attribute__((vector_size(4 * FLOAT_LANES)));
typedef floats floats_memory __attribute__((may_alias));
typedef float few_floats __attribute__((vector_size(4 * REFERENCE_LANES)));
typedef few_floats few_floats_memory __attribute__((may_alias));

static inline floats load_floats(const float *from) { return *(const floats_memory *)from; }

static inline floats splat_float(float value) { return value - (floats){0}; }

static inline floats fused_floats(floats a, floats b, floats c)
{
#if FLOAT_LANES == 16 && defined(__AVX512F__)
    return (floats)_mm512_fmadd_ps((__m512)a, (__m512)b, (__m512)c);
#elif FLOAT_LANES == 8 && defined(__FMA__)
    return (floats)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
#else
    floats result;
    for (int lane = 0; lane < FLOAT_LANES; lane++)
        result[lane] = fmaf(a[lane], b[lane], c[lane]);
    return result;
#endif
}

/* The waves along one ray. A wave's phase is phase + turns · (distance from the anchor), half turns. */
typedef struct ray_waves {
    _Alignas(64) float phase[REFERENCE_MOST_WAVES], turns[REFERENCE_MOST_WAVES], slope[REFERENCE_MOST_WAVES];
} ray_waves;

typedef struct partial_sums {
    floats height[PARTS], slope[PARTS]; /* `slope`: derivative of the height along the ray */
} partial_sums;

static inline void place_waves(const reference_columns *from, uint32_t first, uint32_t end, const double place[3], const double direction[2], ray_waves *to)
{
    const double round_magic = 0x1.8p53; /* adding it rounds to an even integer */
    for (uint32_t i = first; i < end; i += REFERENCE_LANES) {
        const reals a = load(&from->half_turns_a[i]), b = load(&from->half_turns_b[i]);
        reals phase = fused(splat(place[2]), load(&from->half_turns_c[i]), load(&from->phase[i]));
        phase = fused(splat(place[1]), b, phase);
        phase = fused(splat(place[0]), a, phase);
        phase = phase - ((phase + round_magic) - round_magic);
        const reals turns = fused(a, splat(direction[0]), b * direction[1]);
        const reals slope = fused(load(&from->amplitude_a[i]), splat(direction[0]), load(&from->amplitude_b[i]) * direction[1]);
        *(few_floats_memory *)&to->phase[i] = __builtin_convertvector(phase, few_floats);
        *(few_floats_memory *)&to->turns[i] = __builtin_convertvector(turns, few_floats);
        *(few_floats_memory *)&to->slope[i] = __builtin_convertvector(slope, few_floats);
    }
}

/* Adds blocks of waves. sin(πp) and cos(πp) are Chebyshev fits in r² over [0, ¼], for p = n + r. Their errors are below 2e-7, besides those of p. */
static inline void add_waves(const ray_waves *ray, const reference_columns *columns, uint32_t from, uint32_t to, float distance, partial_sums *sums)
{
    const float round_magic = 0x1.8p23f;
    for (uint32_t at = from; at < to; at += REFERENCE_BLOCK)
        for (int part = 0; part < PARTS; part++) {
            const uint32_t i = at + (uint32_t)part * FLOAT_LANES;
            const floats p = fused_floats(load_floats(&ray->turns[i]), splat_float(distance), load_floats(&ray->phase[i]));
            const floats shifted = p + round_magic;
            const floats r = p - (shifted - round_magic);
            const float_bits sign = (float_bits)shifted << 31;
            const floats u = r * r;
            floats s = splat_float(0.07765591227685842f);
            s = fused_floats(s, u, splat_float(-0.5982904112836939f));
            s = fused_floats(s, u, splat_float(2.5500773865289372f));
            s = fused_floats(s, u, splat_float(-5.167710076668316f));
            s = fused_floats(s, u, splat_float(3.141592640077203f));
            floats c = splat_float(0.21968242357666407f);
            c = fused_floats(c, u, splat_float(-1.3318729727880956f));
            c = fused_floats(c, u, splat_float(4.058410790762683f));
            c = fused_floats(c, u, splat_float(-4.934792802489462f));
            c = fused_floats(c, u, splat_float(0.9999999530275124f));
            sums->height[part] = fused_floats((floats)((float_bits)(s * r) ^ sign), load_floats(&columns->amplitude[i]), sums->height[part]);
            sums->slope[part] = fused_floats((floats)((float_bits)c ^ sign), load_floats(&ray->slope[i]), sums->slope[part]);
        }
}

/* The sum of 16 partial sums. Halves are added to halves. */
static inline double add_up(const floats part[PARTS])
{
    typedef float eight __attribute__((vector_size(32), may_alias));
    typedef float four __attribute__((vector_size(16), may_alias));
    _Alignas(64) float sum[REFERENCE_BLOCK];
    for (int i = 0; i < PARTS; i++)
        *(floats_memory *)&sum[i * FLOAT_LANES] = part[i];
    *(eight *)sum = *(const eight *)sum + *(const eight *)(sum + 8);
    *(four *)sum = *(const four *)sum + *(const four *)(sum + 4);
    return (double)((sum[0] + sum[2]) + (sum[1] + sum[3]));
}
#endif

#endif
