/* SPDX-License-Identifier: MIT
 *
 * Lanes of doubles: GNU vectors of REFERENCE_LANES elements. Operations act per lane and give the same bits at every width. fma() is always fused.
 */
#ifndef MANGATA_REFERENCE_DOUBLE_LANES_H
#define MANGATA_REFERENCE_DOUBLE_LANES_H

#include <math.h>
#include <stdint.h>

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

#ifndef REFERENCE_LANES
#define REFERENCE_LANES 1
#endif

typedef double reals __attribute__((vector_size(8 * REFERENCE_LANES)));
typedef int64_t masks __attribute__((vector_size(8 * REFERENCE_LANES))); /* 0 or −1 in each lane */

/* These types in memory, where they alias arrays of numbers. */
typedef reals reals_memory __attribute__((may_alias));
typedef masks masks_memory __attribute__((may_alias));

static inline reals splat(double value) { return value - (reals){0}; /* x − 0 keeps the sign of zero */ }

static inline reals load(const double *from) { return *(const reals_memory *)from; }

static inline void store(double *to, reals value) { *(reals_memory *)to = value; }

static inline masks load_mask(const int64_t *from) { return *(const masks_memory *)from; }

static inline void store_mask(int64_t *to, masks value) { *(masks_memory *)to = value; }

static inline reals select_lanes(masks which, reals yes, reals no) { return (reals)((which & (masks)yes) | (~which & (masks)no)); }

static inline reals fused(reals a, reals b, reals c)
{
#if REFERENCE_LANES == 8 && defined(__AVX512F__)
    return (reals)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#elif REFERENCE_LANES == 4 && defined(__FMA__)
    return (reals)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
#else
    reals result;
    for (int lane = 0; lane < REFERENCE_LANES; lane++)
        result[lane] = fma(a[lane], b[lane], c[lane]);
    return result;
#endif
}

static inline reals square_root(reals a)
{
#if REFERENCE_LANES == 8 && defined(__AVX512F__)
    return (reals)_mm512_sqrt_pd((__m512d)a);
#elif REFERENCE_LANES == 4 && defined(__AVX2__)
    return (reals)_mm256_sqrt_pd((__m256d)a);
#else
    reals result;
    for (int lane = 0; lane < REFERENCE_LANES; lane++)
        result[lane] = sqrt(a[lane]);
    return result;
#endif
}

static inline reals absolute(reals a) { return (reals)((masks)a & INT64_MAX); }

static inline reals lesser(reals a, reals b) { return select_lanes((masks)(a < b), a, b); }

static inline reals greater(reals a, reals b) { return select_lanes((masks)(a > b), a, b); }

/* Bit i is set if lane i of the mask is. */
static inline uint32_t lane_bits(masks which)
{
#if REFERENCE_LANES == 8 && defined(__AVX512DQ__)
    return (uint32_t)_mm512_movepi64_mask((__m512i)which);
#elif REFERENCE_LANES == 4 && defined(__AVX2__)
    return (uint32_t)_mm256_movemask_pd((__m256d)which);
#else
    uint32_t bits = 0;
    for (int lane = 0; lane < REFERENCE_LANES; lane++)
        bits |= (uint32_t)(which[lane] & 1) << lane;
    return bits;
#endif
}

typedef struct sine_cosine {
    reals sine, cosine;
} sine_cosine;

/* sin(πp) and cos(πp) for |p| < 2⁵⁰. p = n + r with the nearest integer n, so the reduction is exact. sin(πr)/r and cos(πr) are Chebyshev fits in r² over [0,
 * ¼], with errors below 5e-14 and 8e-13. */
static inline sine_cosine sine_cosine_half_turns(reals p)
{
    const double round_magic = 0x1.8p52; /* adding it rounds to an integer and leaves its parity in the lowest bit */
    const reals shifted = p + round_magic;
    const reals r = p - (shifted - round_magic);
    const masks sign = (masks)shifted << 63;
    const reals u = r * r;
    reals s = splat(0.00044749208490771010666);
    s = fused(s, u, splat(-0.0073640054721157225265));
    s = fused(s, u, splat(0.082144794670648549212));
    s = fused(s, u, splat(-0.59926443393572864576));
    s = fused(s, u, splat(2.550164035906744668));
    s = fused(s, u, splat(-5.1677127799879590018));
    s = fused(s, u, splat(3.1415926535896350618));
    reals c = splat(0.0018399894372694041644);
    c = fused(c, u, splat(-0.025776316427315859077));
    c = fused(c, u, splat(0.23532543658771120306));
    c = fused(c, u, splat(-1.3352623152615699533));
    c = fused(c, u, splat(4.0587121075374376222));
    c = fused(c, u, splat(-4.9348022002498495203));
    c = fused(c, u, splat(0.9999999999992479627));
    const sine_cosine result = {(reals)((masks)(s * r) ^ sign), (reals)((masks)c ^ sign)};
    return result;
}

#endif
