/* SPDX-License-Identifier: MIT
 *
 * Heights, normals and velocities of the water at points. Phases are summed in double, for points may be many waves from the origin, and reduced there; the
 * sums over waves are single or double.
 */
#include <math.h>

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
    wide x[HALVES], z[HALVES];
    for (int half = 0; half < HALVES; half++) {
        x[half] = wide_load(g->x + half * WIDE);
        z[half] = wide_load(g->z + half * WIDE);
    }
    for (int i = 0; i < w->count; i++) {
        wide turns[HALVES];
        for (int half = 0; half < HALVES; half++)
            turns[half] = turns_at(w, i, x[half], z[half]);
        const SinCos t = sincos_turns(NULL, real_of_wides(turns));
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

static inline void sum_double(const water_terms *w, query_group *g)
{
    const double pi = 3.14159265358979323846;
    for (int half = 0; half < HALVES; half++) {
        const wide x = wide_load(g->x + half * WIDE), z = wide_load(g->z + half * WIDE);
        wide height = wide_of(0), slope_x = height, slope_z = height, rise = height;
        for (int i = 0; i < w->count; i++) {
            const wide y = turns_at(w, i, x, z) * pi, squared = y * y;
            const wide s = y * sine_over(squared); /* of half the phase */
            const wide sine = 2 * s * cosine(squared), flat = 1 - 2 * s * s;
            height = wide_fma(sine, wide_of(w->up[i]), height);
            slope_x = wide_fma(flat, wide_of(w->lean_x[i]), slope_x);
            slope_z = wide_fma(flat, wide_of(w->lean_z[i]), slope_z);
            rise = wide_fma(flat, wide_of(w->rise[i]), rise);
        }
        wide_store(g->height + half * WIDE, height);
        wide_store(g->slope_x + half * WIDE, slope_x);
        wide_store(g->slope_z + half * WIDE, slope_z);
        wide_store(g->rise + half * WIDE, rise);
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
    if (answers->velocity) {
        answers->velocity[3 * i] = answers->velocity[3 * i + 2] = (float)here;
        answers->velocity[3 * i + 1] = (float)(g->rise[lane] + here);
    }
}

void JOIN(query_lanes_, MGT_LANES)(const water_terms *terms, double level, const double *points, size_t count, const mgt_water_answers *answers)
{
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
            sum_double(terms, &g);
            travelling = 0;
            for (int lane = 0; lane < MGT_LANES; lane++) {
                if (!r[lane].arrived)
                    ray_advance(&r[lane], g.height[lane], g.slope_x[lane], g.slope_z[lane], crest, reach);
                travelling += !r[lane].arrived;
            }
        }
        for (int lane = 0; lane < MGT_LANES && first + (size_t)lane < count; lane++)
            distance[first + (size_t)lane] = r[lane].arrived ? r[lane].along : __builtin_nan("");
    }
}
