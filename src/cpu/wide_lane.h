/* SPDX-License-Identifier: MIT
 *
 * Vectors of doubles, two of which have as many elements as there are lanes, and phases of waves at points. Points may be many wavelengths from the origin, so
 * phases are summed and reduced in double precision. For files that are compiled once per lane width, after the kernel prelude and math.k.
 */
#ifndef MANGATA_CPU_WIDE_LANE_H
#define MANGATA_CPU_WIDE_LANE_H

#include "frame/water_terms.h"

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

/* Phase of a wave at points, turns in [−1/2, 1/2]. */
static inline wide turns_at(const water_terms *w, int i, wide x, wide z)
{
    const double rounder = 0x1.8p52; /* adding it rounds to whole numbers */
    const wide p = wide_fma(wide_of(w->of[i].along_x), x, wide_fma(wide_of(w->of[i].along_z), z, wide_of(w->of[i].start)));
    return p - ((p + rounder) - rounder);
}

/* Coordinates of as many points as there are lanes. */
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

/* Phases of a wave at these points, turns. They are rounded to single precision after the reduction. */
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

/* sin(y)/y by its Taylor series in y², for |y| ≤ π/2. The error is below 1e-15. */
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

/* cos(y) by its Taylor series in y², for |y| ≤ π/2. The error is below 1e-15. */
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
    const wide s = y * sine_over(squared); /* sine of half the phase */
    return (wide_sine){2 * s * cosine(squared), 1 - 2 * s * s};
}

#endif
