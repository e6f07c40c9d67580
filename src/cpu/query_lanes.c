/* SPDX-License-Identifier: MIT
 *
 * Heights, normals and velocities of the water at points. Phases are summed in double, for points may be many waves from the origin, and reduced there; the
 * sums over waves are single or double.
 */
#include <math.h>
#include <stddef.h>

#include "cpu/query_lanes.h"

#include "kernels/common/prelude_c.h"

#include "kernels/common/math.k"

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

/* ---- half as many doubles in a vector ---- */

#if MGT_LANES == 1

enum { HALVES = 1, WIDE = 1 };
typedef double wide;

static inline wide wide_of(double u) { return u; }
static inline wide wide_load(const double *from) { return *from; }
static inline void wide_store(double *to, wide value) { *to = value; }
static inline wide wide_fma(wide a, wide b, wide c) { return __builtin_fma(a, b, c); }
static inline real real_of_wides(const wide halves[HALVES]) { return (real)halves[0]; }

#else

enum { HALVES = 2, WIDE = MGT_LANES / 2 };
typedef double wide __attribute__((vector_size(8 * WIDE)));

static inline wide wide_of(double u) { return u - (wide){0}; }
static inline wide wide_load(const double *from)
{
    wide value;
    __builtin_memcpy(&value, from, sizeof value);
    return value;
}
static inline void wide_store(double *to, wide value) { __builtin_memcpy(to, &value, sizeof value); }

#if MGT_LANES == 16
static inline wide wide_fma(wide a, wide b, wide c) { return (wide)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c); }
static inline real real_of_wides(const wide halves[HALVES])
{
    return (real)_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps((__m512d)halves[0])), _mm512_cvtpd_ps((__m512d)halves[1]), 1);
}
#elif MGT_LANES == 8
static inline wide wide_fma(wide a, wide b, wide c) { return (wide)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c); }
static inline real real_of_wides(const wide halves[HALVES])
{
    return (real)_mm256_set_m128(_mm256_cvtpd_ps((__m256d)halves[1]), _mm256_cvtpd_ps((__m256d)halves[0]));
}
#elif defined(__aarch64__)
static inline wide wide_fma(wide a, wide b, wide c) { return (wide)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b); }
static inline real real_of_wides(const wide halves[HALVES])
{
    return (real)vcombine_f32(vcvt_f32_f64((float64x2_t)halves[0]), vcvt_f32_f64((float64x2_t)halves[1]));
}
#else
static inline wide wide_fma(wide a, wide b, wide c) { return a * b + c; }
static inline real real_of_wides(const wide halves[HALVES]) { return (real)_mm_movelh_ps(_mm_cvtpd_ps((__m128d)halves[0]), _mm_cvtpd_ps((__m128d)halves[1])); }
#endif
#endif

/* ---- a group of points ---- */

/* As many points as lanes. */
typedef struct query_group {
    double x[MGT_LANES], z[MGT_LANES];
    double height[MGT_LANES], slope_x[MGT_LANES], slope_z[MGT_LANES], rise[MGT_LANES];
} query_group;

/* Turns of a wave at the points of a half, in [−1/2, 1/2]. */
static inline wide turns_at(const water_terms *w, int i, wide x, wide z)
{
    const double rounder = 0x1.8p52; /* in p + rounder nothing is left below one */
    const wide p = wide_fma(wide_of(w->along_x[i]), x, wide_fma(wide_of(w->along_z[i]), z, wide_of(w->start[i])));
    return p - ((p + rounder) - rounder);
}

/* The places of a group. */
typedef struct wide_places {
    wide x[HALVES], z[HALVES];
} wide_places;

static inline wide_places load_places(const double *x, const double *z)
{
    wide_places p;
    for (int half = 0; half < HALVES; half++) {
        p.x[half] = wide_load(x + half * WIDE);
        p.z[half] = wide_load(z + half * WIDE);
    }
    return p;
}

/* Turns of a wave there, rounded to single precision last. */
static inline real turns_of(const water_terms *w, int i, const wide_places *p)
{
    wide turns[HALVES];
    for (int half = 0; half < HALVES; half++)
        turns[half] = turns_at(w, i, p->x[half], p->z[half]);
    return real_of_wides(turns);
}

static inline void store_sum(double to[MGT_LANES], real sum)
{
    float single[MGT_LANES];
    __builtin_memcpy(single, &sum, sizeof single);
    for (int lane = 0; lane < MGT_LANES; lane++)
        to[lane] = (double)single[lane];
}

/* In single precision; `moving`: with the velocity. */
static inline __attribute__((always_inline)) void sum_single(const water_terms *w, query_group *g, bool moving)
{
    real height = real_broadcast(0), slope_x = height, slope_z = height, rise = height;
    const wide_places places = load_places(g->x, g->z);
    for (int i = 0; i < w->count; i++) {
        const SinCos t = sincos_turns(NULL, turns_of(w, i, &places));
        height = real_fma(t.s, real_broadcast(w->single[i].up), height);
        slope_x = real_fma(t.c, real_broadcast(w->single[i].lean_x), slope_x);
        slope_z = real_fma(t.c, real_broadcast(w->single[i].lean_z), slope_z);
        if (moving)
            rise = real_fma(t.c, real_broadcast(w->single[i].rise), rise);
    }
    store_sum(g->height, height);
    store_sum(g->slope_x, slope_x);
    store_sum(g->slope_z, slope_z);
    store_sum(g->rise, rise);
}

/* Taylor's series of sin(y)/y and cos(y) in y² for |y| ≤ π/2, with what y is off by below 1e-15. */
static inline wide sine_over(wide squared)
{
    wide sum = wide_of(1 / 51090942171709440000.0);
    sum = wide_fma(sum, squared, wide_of(-1 / 121645100408832000.0));
    sum = wide_fma(sum, squared, wide_of(1 / 355687428096000.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 1307674368000.0));
    sum = wide_fma(sum, squared, wide_of(1 / 6227020800.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 39916800.0));
    sum = wide_fma(sum, squared, wide_of(1 / 362880.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 5040.0));
    sum = wide_fma(sum, squared, wide_of(1 / 120.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 6.0));
    return wide_fma(sum, squared, wide_of(1));
}

static inline wide cosine(wide squared)
{
    wide sum = wide_of(1 / 2432902008176640000.0);
    sum = wide_fma(sum, squared, wide_of(-1 / 6402373705728000.0));
    sum = wide_fma(sum, squared, wide_of(1 / 20922789888000.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 87178291200.0));
    sum = wide_fma(sum, squared, wide_of(1 / 479001600.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 3628800.0));
    sum = wide_fma(sum, squared, wide_of(1 / 40320.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 720.0));
    sum = wide_fma(sum, squared, wide_of(1 / 24.0));
    sum = wide_fma(sum, squared, wide_of(-1 / 2.0));
    return wide_fma(sum, squared, wide_of(1));
}

typedef struct wide_sine {
    wide sine, cosine;
} wide_sine;

static inline wide_sine sine_of_turns(wide turns)
{
    const wide y = turns * 3.14159265358979323846, squared = y * y;
    const wide s = y * sine_over(squared); /* of half the phase */
    return (wide_sine){2 * s * cosine(squared), 1 - 2 * s * s};
}

static inline void sum_double(const water_terms *w, query_group *g)
{
    for (int half = 0; half < HALVES; half++) {
        const wide x = wide_load(g->x + half * WIDE), z = wide_load(g->z + half * WIDE);
        wide height = wide_of(0), slope_x = height, slope_z = height, rise = height;
        for (int i = 0; i < w->count; i++) {
            const wide_sine t = sine_of_turns(turns_at(w, i, x, z));
            height = wide_fma(t.sine, wide_of(w->up[i]), height);
            slope_x = wide_fma(t.cosine, wide_of(w->lean_x[i]), slope_x);
            slope_z = wide_fma(t.cosine, wide_of(w->lean_z[i]), slope_z);
            rise = wide_fma(t.cosine, wide_of(w->rise[i]), rise);
        }
        wide_store(g->height + half * WIDE, height);
        wide_store(g->slope_x + half * WIDE, slope_x);
        wide_store(g->slope_z + half * WIDE, slope_z);
        wide_store(g->rise + half * WIDE, rise);
    }
}

/* ---- choppy water ---- */

/* Sums at places of rest, as many as lanes. */
typedef struct rest_group {
    double x[MGT_LANES], z[MGT_LANES]; /* the places */
    double height[MGT_LANES], slope_x[MGT_LANES], slope_z[MGT_LANES], rise[MGT_LANES];
    double shift_x[MGT_LANES], shift_z[MGT_LANES], drift_x[MGT_LANES], drift_z[MGT_LANES];
    double xx[MGT_LANES], xz[MGT_LANES], zz[MGT_LANES];                    /* −∂shift/∂place */
    double bend_xx[MGT_LANES], bend_xz[MGT_LANES], bend_zz[MGT_LANES];     /* −∂slope/∂place */
    double xxx[MGT_LANES], xxz[MGT_LANES], xzz[MGT_LANES], zzz[MGT_LANES]; /* −∂²shift/∂place² */
} rest_group;

/* Turns of the waves at the places where a search begins. */
typedef struct start_turns {
    float of[MGT_MAX_WAVES][MGT_LANES];
} start_turns;

static void place_turns(const water_terms *w, const rest_group *g, start_turns *to)
{
    const wide_places places = load_places(g->x, g->z);
    for (int i = 0; i < w->count; i++) {
        const real single = turns_of(w, i, &places);
        __builtin_memcpy(to->of[i], &single, sizeof single);
    }
}

/* Shift, and minus its derivative. */
typedef struct shift_sums {
    real x, z, xx, xz, zz;
} shift_sums;

/* As far as a search needs them, away_x and away_z from where it began. */
static inline shift_sums shift_away(const water_terms *w, int count, const start_turns *turns, real away_x, real away_z)
{
    const real zero = real_broadcast(0);
    shift_sums d = {zero, zero, zero, zero, zero};
    for (int i = 0; i < count; i++) {
        real at;
        __builtin_memcpy(&at, turns->of[i], sizeof at);
        at = real_fma(away_x, real_broadcast(w->single[i].along_x), real_fma(away_z, real_broadcast(w->single[i].along_z), at));
        const SinCos t = sincos_wave(NULL, at);
        d.x = real_fma(t.c, real_broadcast(w->single[i].shift_x), d.x);
        d.z = real_fma(t.c, real_broadcast(w->single[i].shift_z), d.z);
        d.xx = real_fma(t.s, real_broadcast(w->single[i].press_xx), d.xx);
        d.xz = real_fma(t.s, real_broadcast(w->single[i].press_xz), d.xz);
        d.zz = real_fma(t.s, real_broadcast(w->single[i].press_zz), d.zz);
    }
    return d;
}

static inline void rest_single(const water_terms *w, rest_group *g)
{
    const real zero = real_broadcast(0);
    real height = zero, slope_x = zero, slope_z = zero, rise = zero, shift_x = zero, shift_z = zero, drift_x = zero, drift_z = zero;
    real xx = zero, xz = zero, zz = zero, bend_xx = zero, bend_xz = zero, bend_zz = zero, xxx = zero, xxz = zero, xzz = zero, zzz = zero;
    const wide_places places = load_places(g->x, g->z);
    for (int i = 0; i < w->count; i++) {
        const SinCos t = sincos_turns(NULL, turns_of(w, i, &places));
        height = real_fma(t.s, real_broadcast(w->single[i].up), height);
        slope_x = real_fma(t.c, real_broadcast(w->single[i].lean_x), slope_x);
        slope_z = real_fma(t.c, real_broadcast(w->single[i].lean_z), slope_z);
        rise = real_fma(t.c, real_broadcast(w->single[i].rise), rise);
        shift_x = real_fma(t.c, real_broadcast(w->single[i].shift_x), shift_x);
        shift_z = real_fma(t.c, real_broadcast(w->single[i].shift_z), shift_z);
        drift_x = real_fma(t.s, real_broadcast(w->single[i].drift_x), drift_x);
        drift_z = real_fma(t.s, real_broadcast(w->single[i].drift_z), drift_z);
        xx = real_fma(t.s, real_broadcast(w->single[i].press_xx), xx);
        xz = real_fma(t.s, real_broadcast(w->single[i].press_xz), xz);
        zz = real_fma(t.s, real_broadcast(w->single[i].press_zz), zz);
        const real along_x = t.c * w->single[i].radians_x, along_z = t.c * w->single[i].radians_z, high_x = t.s * w->single[i].radians_x,
                   high_z = t.s * w->single[i].radians_z;
        bend_xx = real_fma(high_x, real_broadcast(w->single[i].lean_x), bend_xx);
        bend_xz = real_fma(high_x, real_broadcast(w->single[i].lean_z), bend_xz);
        bend_zz = real_fma(high_z, real_broadcast(w->single[i].lean_z), bend_zz);
        xxx = real_fma(along_x, real_broadcast(w->single[i].press_xx), xxx);
        xxz = real_fma(along_z, real_broadcast(w->single[i].press_xx), xxz);
        xzz = real_fma(along_x, real_broadcast(w->single[i].press_zz), xzz);
        zzz = real_fma(along_z, real_broadcast(w->single[i].press_zz), zzz);
    }
    store_sum(g->bend_xx, bend_xx);
    store_sum(g->bend_xz, bend_xz);
    store_sum(g->bend_zz, bend_zz);
    store_sum(g->xxx, xxx);
    store_sum(g->xxz, xxz);
    store_sum(g->xzz, xzz);
    store_sum(g->zzz, zzz);
    store_sum(g->height, height);
    store_sum(g->slope_x, slope_x);
    store_sum(g->slope_z, slope_z);
    store_sum(g->rise, rise);
    store_sum(g->shift_x, shift_x);
    store_sum(g->shift_z, shift_z);
    store_sum(g->drift_x, drift_x);
    store_sum(g->drift_z, drift_z);
    store_sum(g->xx, xx);
    store_sum(g->xz, xz);
    store_sum(g->zz, zz);
}

/* Without the second derivatives: a search in double ends where they do not matter. */
static inline void rest_double(const water_terms *w, rest_group *g)
{
    __builtin_memset(g->bend_xx, 0, sizeof *g - offsetof(rest_group, bend_xx));
    for (int half = 0; half < HALVES; half++) {
        const wide x = wide_load(g->x + half * WIDE), z = wide_load(g->z + half * WIDE), zero = wide_of(0);
        wide height = zero, slope_x = zero, slope_z = zero, rise = zero, shift_x = zero, shift_z = zero, drift_x = zero, drift_z = zero;
        wide xx = zero, xz = zero, zz = zero;
        for (int i = 0; i < w->count; i++) {
            const wide_sine t = sine_of_turns(turns_at(w, i, x, z));
            height = wide_fma(t.sine, wide_of(w->up[i]), height);
            slope_x = wide_fma(t.cosine, wide_of(w->lean_x[i]), slope_x);
            slope_z = wide_fma(t.cosine, wide_of(w->lean_z[i]), slope_z);
            rise = wide_fma(t.cosine, wide_of(w->rise[i]), rise);
            shift_x = wide_fma(t.cosine, wide_of(w->shift_x[i]), shift_x);
            shift_z = wide_fma(t.cosine, wide_of(w->shift_z[i]), shift_z);
            drift_x = wide_fma(t.sine, wide_of(w->drift_x[i]), drift_x);
            drift_z = wide_fma(t.sine, wide_of(w->drift_z[i]), drift_z);
            xx = wide_fma(t.sine, wide_of(w->press_xx[i]), xx);
            xz = wide_fma(t.sine, wide_of(w->press_xz[i]), xz);
            zz = wide_fma(t.sine, wide_of(w->press_zz[i]), zz);
        }
        wide_store(g->height + half * WIDE, height);
        wide_store(g->slope_x + half * WIDE, slope_x);
        wide_store(g->slope_z + half * WIDE, slope_z);
        wide_store(g->rise + half * WIDE, rise);
        wide_store(g->shift_x + half * WIDE, shift_x);
        wide_store(g->shift_z + half * WIDE, shift_z);
        wide_store(g->drift_x + half * WIDE, drift_x);
        wide_store(g->drift_z + half * WIDE, drift_z);
        wide_store(g->xx + half * WIDE, xx);
        wide_store(g->xz + half * WIDE, xz);
        wide_store(g->zz + half * WIDE, zz);
    }
}

/* What is told of a point of choppy water. */
typedef struct settled_point {
    double height, slope[2], velocity[3], jacobian;
    double least;    /* eigenvalue of B */
    double worst[2]; /* unit, its direction */
    double rest[2];  /* the place */
    bool settled;
} settled_point;

/* Eigenvalues of B = 1 − [xx, xz; xz, zz], the greater first, and the lesser one's direction. */
static void stretch_of(double xx, double xz, double zz, double value[2], double direction[2])
{
    const double middle = 1 - 0.5 * (xx + zz), half = 0.5 * (zz - xx), radius = __builtin_sqrt(half * half + xz * xz);
    value[0] = middle + radius;
    value[1] = middle - radius;
    /* B − middle is [half, −xz; −xz, −half]; the eigenvector of −radius. */
    const double a = half <= 0 ? radius - half : xz, b = half <= 0 ? xz : radius + half, length = __builtin_sqrt(a * a + b * b);
    direction[0] = length > 0 ? a / length : 1;
    direction[1] = length > 0 ? b / length : 0;
}

/* B⁻¹ v. */
static void to_rest_by(double most, double least, const double direction[2], const double v[2], double out[2])
{
    const double along = v[0] * direction[0] + v[1] * direction[1], across = v[1] * direction[0] - v[0] * direction[1];
    out[0] = along / least * direction[0] - across / most * direction[1];
    out[1] = along / least * direction[1] + across / most * direction[0];
}

/* The same with eigenvalues of at least 0.1. */
static void to_rest(const double value[2], const double direction[2], const double v[2], double out[2])
{
    to_rest_by(value[0] > 0.1 ? value[0] : 0.1, value[1] > 0.1 ? value[1] : 0.1, direction, v, out);
}

/* Newton's step, also to a place where the water is folded over. */
static void newton_step(const double value[2], const double direction[2], const double v[2], double out[2])
{
    const double least = value[1] < 0 ? (value[1] < -0.05 ? value[1] : -0.05) : value[1] > 0.05 ? value[1] : 0.05;
    to_rest_by(value[0] > 0.1 ? value[0] : 0.1, least, direction, v, out);
}

/* The answer at the point `left` beyond the one that the sums' place is shifted to. */
static void keep_point(const rest_group *g, int lane, const double left[2], settled_point *p)
{
    double value[2], step[2];
    stretch_of(g->xx[lane], g->xz[lane], g->zz[lane], value, p->worst);
    newton_step(value, p->worst, left, step);
    const double turn[2] = {g->bend_xx[lane] * step[0] + g->bend_xz[lane] * step[1], g->bend_xz[lane] * step[0] + g->bend_zz[lane] * step[1]};
    const double press[3] = {g->xxx[lane] * step[0] + g->xxz[lane] * step[1], g->xxz[lane] * step[0] + g->xzz[lane] * step[1],
                             g->xzz[lane] * step[0] + g->zzz[lane] * step[1]};
    stretch_of(g->xx[lane] + press[0], g->xz[lane] + press[1], g->zz[lane] + press[2], value, p->worst);
    const double slope[2] = {g->slope_x[lane] - turn[0], g->slope_z[lane] - turn[1]};
    to_rest(value, p->worst, slope, p->slope);
    p->height = g->height[lane] + (g->slope_x[lane] - 0.5 * turn[0]) * step[0] + (g->slope_z[lane] - 0.5 * turn[1]) * step[1];
    p->velocity[0] = g->drift_x[lane];
    p->velocity[1] = g->rise[lane];
    p->velocity[2] = g->drift_z[lane];
    p->jacobian = value[0] * value[1];
    p->least = value[1];
    p->rest[0] = g->x[lane] + step[0];
    p->rest[1] = g->z[lane] + step[1];
}

/* A step towards the place of rest: one that always comes nearer, and Newton's where the waves are straight. */
static void rest_step(const water_terms *w, const rest_group *g, int lane, const double left[2], double step[2])
{
    step[0] = left[0];
    step[1] = left[1];
    if (left[0] * left[0] + left[1] * left[1] < w->straight * w->straight) {
        double value[2], direction[2];
        stretch_of(g->xx[lane], g->xz[lane], g->zz[lane], value, direction);
        newton_step(value, direction, left, step);
    }
}

/* rest_step() by lanes. */
static inline vec2 rest_steps(const water_terms *w, shift_sums d, vec2 left)
{
    const real half_sum = 1 - 0.5f * (d.xx + d.zz), half = 0.5f * (d.zz - d.xx);
    const real radius = sqrt(half * half + d.xz * d.xz), inverse_radius = 1 / max(radius, real(1e-20f));
    const real most = max(half_sum + radius, real(0.1f)), value = half_sum - radius;
    const real least = SELECT(value < 0, min(value, real(-0.05f)), max(value, real(0.05f)));
    /* B⁻¹ = middle + part · (B − half_sum)/radius */
    const real middle = 0.5f * (1 / most + 1 / least), part = 0.5f * (1 / most - 1 / least) * inverse_radius;
    const vec2 newton = vec2(middle * left.x + part * (half * left.x - d.xz * left.y), middle * left.y - part * (d.xz * left.x + half * left.y));
    const real straight = real((float)(w->straight * w->straight));
    return SELECT2(left.x * left.x + left.y * left.y < straight, newton, left);
}

/* Moves places from where they are to near those of rest. The largest waves alone serve for the first steps. */
static void settle_roughly(const water_terms *w, const double at[][2], rest_group *g)
{
    enum { LOOKS = 24, FIRST = 3 };
    start_turns turns;
    float off_x[MGT_LANES], off_z[MGT_LANES];
    for (int lane = 0; lane < MGT_LANES; lane++) {
        off_x[lane] = (float)(at[lane][0] - g->x[lane]);
        off_z[lane] = (float)(at[lane][1] - g->z[lane]);
    }
    place_turns(w, g, &turns);
    const float enough = (float)(0.05 * w->straight + 3e-5 * w->sum);
    real away_x = real(0.0f), away_z = real(0.0f), open = real(1.0f), x, z;
    __builtin_memcpy(&x, off_x, sizeof x);
    __builtin_memcpy(&z, off_z, sizeof z);
    for (int look = 0; look < LOOKS && any_lane(open > 0); look++) {
        const int count = look < FIRST && w->count > 16 ? w->count / 4 : w->count;
        const shift_sums d = shift_away(w, count, &turns, away_x, away_z);
        const vec2 left = vec2(x - away_x - d.x, z - away_z - d.z), step = rest_steps(w, d, left);
        away_x = away_x + open * step.x;
        away_z = away_z + open * step.y;
        if (count == w->count)
            open = SELECT(left.x * left.x + left.y * left.y > real(enough * enough), open, real(0.0f));
    }
    double moved_x[MGT_LANES], moved_z[MGT_LANES];
    store_sum(moved_x, away_x);
    store_sum(moved_z, away_z);
    for (int lane = 0; lane < MGT_LANES; lane++) {
        g->x[lane] += moved_x[lane];
        g->z[lane] += moved_z[lane];
    }
}

/* Finds the places of rest of as many points as lanes, from those in g. */
static void settle(const water_terms *w, bool exact, const double at[][2], rest_group *g, settled_point *points)
{
    enum { LOOKS = 12 };
    const double near = exact ? 1e-11 * (1 + w->sum) : 2e-3 * w->straight + 1e-5 * w->sum;
    int open = MGT_LANES;
    for (int lane = 0; lane < MGT_LANES; lane++) {
        points[lane].settled = !(0 * (at[lane][0] + at[lane][1]) == 0); /* where there is no place to find */
        open -= points[lane].settled;
    }
    settle_roughly(w, at, g);
    for (int look = 0; look < LOOKS && open > 0; look++) {
        if (exact)
            rest_double(w, g);
        else
            rest_single(w, g);
        for (int lane = 0; lane < MGT_LANES; lane++) {
            if (points[lane].settled)
                continue;
            const double left[2] = {at[lane][0] - g->x[lane] - g->shift_x[lane], at[lane][1] - g->z[lane] - g->shift_z[lane]};
            points[lane].settled = left[0] * left[0] + left[1] * left[1] <= near * near;
            if (points[lane].settled || look + 1 == LOOKS) {
                keep_point(g, lane, left, &points[lane]);
                open -= points[lane].settled;
                continue;
            }
            double step[2];
            rest_step(w, g, lane, left, step);
            g->x[lane] += step[0];
            g->z[lane] += step[1];
        }
    }
}

/* Where the water may fold, other places may be shifted here too: the highest of those found from around. */
static void settle_folded(const water_terms *w, bool exact, const double at[2], settled_point *p)
{
    enum { STARTS = 32 };
    static const double eighths[8][2] = {{1, 0},  {M_SQRT1_2, M_SQRT1_2},   {0, 1},  {-M_SQRT1_2, M_SQRT1_2},
                                         {-1, 0}, {-M_SQRT1_2, -M_SQRT1_2}, {0, -1}, {M_SQRT1_2, -M_SQRT1_2}};
    settled_point best = *p;
    for (int first = 0; first < STARTS; first += MGT_LANES) {
        rest_group g;
        double ats[MGT_LANES][2];
        settled_point found[MGT_LANES];
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const int k = first + lane < STARTS ? first + lane : STARTS - 1;
            /* Around the place found, at four distances; the first of eight directions is that in which the water is pressed most. */
            const double away = 1.5 * w->straight * (1 + k / 8), c = p->worst[0], s = p->worst[1];
            const double *turn = eighths[k % 8];
            g.x[lane] = p->rest[0] + away * (c * turn[0] - s * turn[1]);
            g.z[lane] = p->rest[1] + away * (s * turn[0] + c * turn[1]);
            ats[lane][0] = at[0];
            ats[lane][1] = at[1];
        }
        settle(w, exact, ats, &g, found);
        for (int lane = 0; lane < MGT_LANES && first + lane < STARTS; lane++)
            if (found[lane].settled && (!best.settled || found[lane].height > best.height))
                best = found[lane];
    }
    *p = best;
}

static void write_choppy(const double at[2], const settled_point *p, double level, size_t i, mgt_water_answers *answers)
{
    const double here = 0 * (at[0] + at[1]);
    if (answers->height)
        answers->height[i] = here == 0 ? level + p->height : here;
    if (answers->normal) {
        const double x = -p->slope[0], z = -p->slope[1], inverse = 1 / __builtin_sqrt(x * x + 1 + z * z);
        answers->normal[3 * i] = here == 0 ? (float)(x * inverse) : (float)here;
        answers->normal[3 * i + 1] = here == 0 ? (float)inverse : (float)here;
        answers->normal[3 * i + 2] = here == 0 ? (float)(z * inverse) : (float)here;
    }
    if (answers->velocity)
        for (int c = 0; c < 3; c++)
            answers->velocity[3 * i + (size_t)c] = here == 0 ? (float)p->velocity[c] : (float)here;
    if (answers->jacobian)
        answers->jacobian[i] = here == 0 ? (float)p->jacobian : (float)here;
    answers->unsettled += !p->settled;
}

static void query_choppy(const water_terms *terms, double level, const double *points, size_t count, mgt_water_answers *answers, double *rest)
{
    for (size_t first = 0; first < count; first += MGT_LANES) {
        rest_group g;
        double at[MGT_LANES][2];
        settled_point found[MGT_LANES];
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const size_t i = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            at[lane][0] = g.x[lane] = points[2 * i];
            at[lane][1] = g.z[lane] = points[2 * i + 1];
            if (0 * (at[lane][0] + at[lane][1]) != 0)
                g.x[lane] = g.z[lane] = 0;
        }
        settle(terms, answers->exact, at, &g, found);
        for (int lane = 0; lane < MGT_LANES && first + (size_t)lane < count; lane++) {
            const bool finite = 0 * (at[lane][0] + at[lane][1]) == 0;
            if (finite && (terms->folds || !found[lane].settled || found[lane].least < 0.2))
                settle_folded(terms, answers->exact, at[lane], &found[lane]);
            write_choppy(at[lane], &found[lane], level, first + (size_t)lane, answers);
            for (size_t c = 0; c < 2 && rest; c++)
                rest[2 * (first + (size_t)lane) + c] = finite ? found[lane].rest[c] : at[lane][c];
        }
    }
}

static void write_point(const query_group *g, int lane, double level, size_t i, const mgt_water_answers *answers)
{
    const double here = 0 * (g->x[lane] + g->z[lane]); /* 0, or NaN where the point is not finite */
    if (answers->height)
        answers->height[i] = level + g->height[lane] + here;
    if (answers->normal) {
        const double x = here - g->slope_x[lane], z = here - g->slope_z[lane], inverse = 1 / __builtin_sqrt(x * x + 1 + z * z);
        answers->normal[3 * i] = (float)(x * inverse);
        answers->normal[3 * i + 1] = (float)inverse;
        answers->normal[3 * i + 2] = (float)(z * inverse);
    }
    if (answers->jacobian)
        answers->jacobian[i] = (float)(1 + here);
    if (answers->velocity) {
        answers->velocity[3 * i] = answers->velocity[3 * i + 2] = (float)here;
        answers->velocity[3 * i + 1] = (float)(g->rise[lane] + here);
    }
}

void JOIN(query_lanes_, MGT_LANES)(const water_terms *terms, double level, const double *points, size_t count, mgt_water_answers *answers, double *rest)
{
    answers->unsettled = 0;
    if (terms->choppy) {
        query_choppy(terms, level, points, count, answers, rest);
        return;
    }
    for (size_t first = 0; first < count; first += MGT_LANES) {
        query_group g;
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const size_t i = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            g.x[lane] = points[2 * i];
            g.z[lane] = points[2 * i + 1];
        }
        if (answers->exact)
            sum_double(terms, &g);
        else if (answers->velocity)
            sum_single(terms, &g, true);
        else
            sum_single(terms, &g, false);
        for (int lane = 0; lane < MGT_LANES && first + (size_t)lane < count; lane++)
            write_point(&g, lane, level, first + (size_t)lane, answers);
    }
}

/* ---- rays ---- */

/* A ray on its way to the surface. All that bounds the surface along it is in metres per unit of `along`. */
typedef struct traced_ray {
    double origin[3], direction[3]; /* the origin's height is over the mean surface */
    double side;                    /* 1 from above, −1 from below, 0 before the first look */
    double closing, bend;           /* most that the gap shrinks by, and that this rate grows by */
    double along, speed;            /* metres a unit of `along` */
    double shift[2];                /* about that of choppy water at `along` */
    int tries;                      /* looks at it there */
    bool arrived;
} traced_ray;

/* Starts where the ray enters the slab that holds the surface. */
static traced_ray ray_start(const water_terms *w, double level, const double *ray, double crest, double reach)
{
    traced_ray r = {.origin = {ray[0], ray[1] - level, ray[2]}, .direction = {ray[3], ray[4], ray[5]}, .bend = 1e-12};
    double length = 0, finite = 0;
    for (int c = 0; c < 3; c++) {
        length += r.direction[c] * r.direction[c];
        finite += 0 * (r.origin[c] + r.direction[c]);
    }
    if (!(length > 0) || finite != 0 || !(length < 1e300)) {
        r.along = __builtin_nan("");
        r.arrived = true;
        return r;
    }
    r.speed = __builtin_sqrt(length);
    double slope = 0;
    for (int i = 0; i < w->count; i++) {
        const double turns = w->along_x[i] * r.direction[0] + w->along_z[i] * r.direction[2], radians = 6.28318530717958647692 * turns;
        slope += __builtin_fabs(w->up[i] * radians);
        r.bend += w->up[i] * radians * radians;
    }
    if (w->choppy) { /* a surface that leans by S at most, and is pressed by as much, leans by S/√(1 − S²) */
        const double pressed = w->pressed < 0.9 ? w->pressed : 0.9, steeper = 1 / __builtin_sqrt(1 - pressed * pressed);
        slope *= steeper;
        r.bend *= steeper * steeper;
    }
    r.closing = slope + __builtin_fabs(r.direction[1]) + 1e-12 * r.speed;
    const double above = __builtin_fabs(r.origin[1]) - crest;
    if (above > 0) {
        const double toward = r.origin[1] > 0 ? -r.direction[1] : r.direction[1];
        r.along = toward > 0 ? above / toward : __builtin_inf();
        r.arrived = !(r.along <= reach);
        if (r.arrived)
            r.along = __builtin_inf();
    }
    return r;
}

/* A step that jumps over no crest; near the surface it becomes Newton's. As search_step() in search_step.k. */
static double ray_step(const traced_ray *r, double gap, double closing)
{
    const double root = __builtin_sqrt(closing * closing + 2 * r->bend * gap), spare = r->closing - closing;
    if (root > r->closing)
        return gap / r->closing + spare * spare / (2 * r->closing * r->bend);
    return closing > 0 ? 2 * gap / (root + closing) : (root - closing) / r->bend;
}

static void ray_advance(traced_ray *r, double height, double slope_x, double slope_z, double crest, double reach)
{
    double gap = r->origin[1] + r->direction[1] * r->along - height;
    if (r->side == 0)
        r->side = gap >= 0 ? 1 : -1;
    gap = gap * r->side > 0 ? gap * r->side : 0;
    const double closing = r->side * (slope_x * r->direction[0] + slope_z * r->direction[2] - r->direction[1]);
    const double step = ray_step(r, gap, closing), out = r->side * (r->origin[1] + r->direction[1] * r->along);
    if (gap <= 1e-9 || step <= 1e-9 * (r->along + 1 / r->speed)) {
        r->arrived = true;
        r->along += closing > 0 ? gap / closing < step ? gap / closing : step : 0;
        return;
    }
    r->along += step;
    const bool leaves = out > crest && r->side * r->direction[1] >= 0;
    if (r->along > reach || leaves) {
        r->along = __builtin_inf();
        r->arrived = true;
    }
}

/* Looks at the water at the rays' points; `ready`: lanes whose place of rest has been found. */
static void look_at_points(const water_terms *w, traced_ray *r, query_group *g, bool *ready)
{
    if (!w->choppy) {
        sum_double(w, g);
        for (int lane = 0; lane < MGT_LANES; lane++)
            ready[lane] = true;
        return;
    }
    enum { MOST_TRIES = 40 };
    rest_group rest;
    for (int lane = 0; lane < MGT_LANES; lane++) {
        rest.x[lane] = g->x[lane] - r[lane].shift[0];
        rest.z[lane] = g->z[lane] - r[lane].shift[1];
    }
    rest_double(w, &rest);
    for (int lane = 0; lane < MGT_LANES; lane++) {
        const double left[2] = {r[lane].shift[0] - rest.shift_x[lane], r[lane].shift[1] - rest.shift_z[lane]};
        const double squared = left[0] * left[0] + left[1] * left[1], straight = w->straight * w->straight;
        double value[2], direction[2], step[2] = {left[0], left[1]}, slope[2];
        stretch_of(rest.xx[lane], rest.xz[lane], rest.zz[lane], value, direction);
        if (squared < straight)
            to_rest(value, direction, left, step);
        to_rest(value, direction, (const double[]){rest.slope_x[lane], rest.slope_z[lane]}, slope);
        r[lane].shift[0] -= step[0];
        r[lane].shift[1] -= step[1];
        g->height[lane] = rest.height[lane] + slope[0] * left[0] + slope[1] * left[1];
        g->slope_x[lane] = slope[0];
        g->slope_z[lane] = slope[1];
        ready[lane] = squared < 1e-8 * straight || ++r[lane].tries >= MOST_TRIES;
        if (ready[lane])
            r[lane].tries = 0;
    }
}

void JOIN(trace_lanes_, MGT_LANES)(const water_terms *terms, double level, const double *rays, size_t count, double reach, double *distance)
{
    enum { MOST_LOOKS = 100000 };
    double crest = 1e-9;
    for (int i = 0; i < terms->count; i++)
        crest += terms->up[i];
    for (size_t first = 0; first < count; first += MGT_LANES) {
        traced_ray r[MGT_LANES];
        query_group g;
        int travelling = 0;
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const size_t i = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            r[lane] = ray_start(terms, level, rays + 6 * i, crest, reach);
            travelling += !r[lane].arrived;
        }
        for (int look = 0; look < MOST_LOOKS && travelling > 0; look++) {
            for (int lane = 0; lane < MGT_LANES; lane++) {
                const double along = r[lane].arrived ? 0 : r[lane].along;
                g.x[lane] = r[lane].origin[0] + r[lane].direction[0] * along;
                g.z[lane] = r[lane].origin[2] + r[lane].direction[2] * along;
            }
            bool ready[MGT_LANES];
            look_at_points(terms, r, &g, ready);
            travelling = 0;
            for (int lane = 0; lane < MGT_LANES; lane++) {
                if (!r[lane].arrived && ready[lane])
                    ray_advance(&r[lane], g.height[lane], g.slope_x[lane], g.slope_z[lane], crest, reach);
                travelling += !r[lane].arrived;
            }
        }
        for (int lane = 0; lane < MGT_LANES && first + (size_t)lane < count; lane++)
            distance[first + (size_t)lane] = r[lane].arrived ? r[lane].along : __builtin_nan("");
    }
}
