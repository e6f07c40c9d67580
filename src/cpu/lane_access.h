/* SPDX-License-Identifier: MIT
 * The kernels' accessors on the CPU, and loads and stores of vectors. Include it after the kernel prelude. */
#ifndef MANGATA_CPU_LANE_ACCESS_H
#define MANGATA_CPU_LANE_ACCESS_H

#define FRAME(cx) (*(cx)->frame)
#define VIEW(cx) (*(cx)->view)
#define TILE(cx) (*(cx)->tile)
#define CHOPPY(cx) (TILE(cx).pressed > 0.0f ? 1 : 0)
#define WAVE(cx, i) ((cx)->waves[i])
#define SEARCH_WAVE(cx, i) ((cx)->search[i])
#define FOAMY(cx) ((cx)->foam != NULL)
#define FOAM(cx) (*(cx)->foam)
#define FOAM_WAVE(cx, i) ((cx)->foam_waves[i])
#define FOAM_SINE(cx, i) ((cx)->foam_sines[i])
#define PARTS(cx) TILE(cx).parts

/* One element per lane, for 4 lanes, which have no gather instruction. */
#define FOUR_OF(table, at)                                                     \
    {                                                                          \
        (table)[(at)[0]], (table)[(at)[1]], (table)[(at)[2]], (table)[(at)[3]] \
    }

/* ---- loads and stores ---- */

static inline real load(const float *p)
{
#if MGT_LANES == 1
    return *p;
#else
    real r;
    __builtin_memcpy(&r, p, sizeof r);
    return r;
#endif
}

static inline void store(float *p, real r) { __builtin_memcpy(p, &r, sizeof r); }

/* Bit i is set if lane i is. */
static inline unsigned lane_bits(mask m)
{
#if MGT_LANES == 16
    return _mm512_movepi32_mask((__m512i)m);
#else
    int lanes[MGT_LANES];
    unsigned bits = 0;
    __builtin_memcpy(lanes, &m, sizeof lanes);
    for (int i = 0; i < MGT_LANES; i++)
        bits |= (unsigned)(lanes[i] != 0) << i;
    return bits;
#endif
}

/* Whole numbers in a real as integers. */
static inline mask whole(real x)
{
#if MGT_LANES == 1
    return (mask)x;
#else
    return __builtin_convertvector(x, mask);
#endif
}

static inline mask whole_select(mask m, mask a, mask b) { return real_bits(real_select(m, real_from_bits(a), real_from_bits(b))); }

/* One element of a table per lane. */
static inline real gather_floats(const float *table, mask at)
{
#if MGT_LANES == 1
    return table[at];
#elif MGT_LANES == 16
    return (real)_mm512_i32gather_ps((__m512i)at, table, 4);
#elif MGT_LANES == 8
    return (real)_mm256_i32gather_ps(table, (__m256i)at, 4);
#else
    return (real)FOUR_OF(table, at);
#endif
}

static inline mask gather_ints(const int *table, mask at)
{
#if MGT_LANES == 1
    return table[at];
#elif MGT_LANES == 16
    return (mask)_mm512_i32gather_epi32((__m512i)at, table, 4);
#elif MGT_LANES == 8
    return (mask)_mm256_i32gather_epi32(table, (__m256i)at, 4);
#else
    return (mask)FOUR_OF(table, at);
#endif
}

/* Four consecutive elements of a table per lane. */
typedef struct four_reals {
    real x, y, z, w;
} four_reals;

static inline four_reals gather_fours(const float *table, mask first)
{
#if MGT_LANES == 16
    int at[16];
    __builtin_memcpy(at, &first, sizeof at);
    __m512 q[4]; /* q[i]: elements of the lanes i, i + 4, i + 8 and i + 12 */
    for (int i = 0; i < 4; i++) {
        q[i] = _mm512_castps128_ps512(_mm_loadu_ps(table + at[i]));
        q[i] = _mm512_insertf32x4(q[i], _mm_loadu_ps(table + at[i + 4]), 1);
        q[i] = _mm512_insertf32x4(q[i], _mm_loadu_ps(table + at[i + 8]), 2);
        q[i] = _mm512_insertf32x4(q[i], _mm_loadu_ps(table + at[i + 12]), 3);
    }
    const __m512d low = _mm512_castps_pd(_mm512_unpacklo_ps(q[0], q[1])), low_2 = _mm512_castps_pd(_mm512_unpacklo_ps(q[2], q[3]));
    const __m512d high = _mm512_castps_pd(_mm512_unpackhi_ps(q[0], q[1])), high_2 = _mm512_castps_pd(_mm512_unpackhi_ps(q[2], q[3]));
    return (four_reals){(real)_mm512_unpacklo_pd(low, low_2), (real)_mm512_unpackhi_pd(low, low_2), (real)_mm512_unpacklo_pd(high, high_2),
                        (real)_mm512_unpackhi_pd(high, high_2)};
#elif MGT_LANES == 8
    int at[8];
    __builtin_memcpy(at, &first, sizeof at);
    __m256 q[4]; /* q[i]: elements of the lanes i and i + 4 */
    for (int i = 0; i < 4; i++)
        q[i] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(table + at[i])), _mm_loadu_ps(table + at[i + 4]), 1);
    const __m256d low = _mm256_castps_pd(_mm256_unpacklo_ps(q[0], q[1])), low_2 = _mm256_castps_pd(_mm256_unpacklo_ps(q[2], q[3]));
    const __m256d high = _mm256_castps_pd(_mm256_unpackhi_ps(q[0], q[1])), high_2 = _mm256_castps_pd(_mm256_unpackhi_ps(q[2], q[3]));
    return (four_reals){(real)_mm256_unpacklo_pd(low, low_2), (real)_mm256_unpackhi_pd(low, low_2), (real)_mm256_unpacklo_pd(high, high_2),
                        (real)_mm256_unpackhi_pd(high, high_2)};
#else
    return (four_reals){gather_floats(table, first), gather_floats(table + 1, first), gather_floats(table + 2, first), gather_floats(table + 3, first)};
#endif
}

#if MGT_LANES == 16
/* Six consecutive elements of a table per lane. The two elements behind them are read, too. */
typedef struct six_reals {
    real x, y, z, w, u, v;
} six_reals;

static inline six_reals gather_sixes(const float *table, mask first)
{
    int at[16];
    __builtin_memcpy(at, &first, sizeof at);
    __m512d low[4], high[4]; /* elements 0, 1, 4 and 5, and elements 2, 3, 6 and 7, of two lanes and of the two lanes that are four further on */
    for (int i = 0; i < 4; i++) {
        const int lane = i / 2 * 8 + i % 2 * 2;
        __m512 q[2];
        for (int k = 0; k < 2; k++)
            q[k] = _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(table + at[lane + k])), _mm256_loadu_ps(table + at[lane + k + 4]), 1);
        low[i] = _mm512_castps_pd(_mm512_unpacklo_ps(q[0], q[1]));
        high[i] = _mm512_castps_pd(_mm512_unpackhi_ps(q[0], q[1]));
    }
    __m512 n[2][4]; /* n[h][k]: elements k and k + 4 of the lanes 8 h to 8 h + 7 */
    for (int h = 0; h < 2; h++) {
        n[h][0] = _mm512_castpd_ps(_mm512_unpacklo_pd(low[2 * h], low[2 * h + 1]));
        n[h][1] = _mm512_castpd_ps(_mm512_unpackhi_pd(low[2 * h], low[2 * h + 1]));
        n[h][2] = _mm512_castpd_ps(_mm512_unpacklo_pd(high[2 * h], high[2 * h + 1]));
        n[h][3] = _mm512_castpd_ps(_mm512_unpackhi_pd(high[2 * h], high[2 * h + 1]));
    }
    enum { FIRST = 2 << 2 | 2 << 6, SECOND = 1 | 3 << 2 | 1 << 4 | 3 << 6 };
    return (six_reals){(real)_mm512_shuffle_f32x4(n[0][0], n[1][0], FIRST),  (real)_mm512_shuffle_f32x4(n[0][1], n[1][1], FIRST),
                       (real)_mm512_shuffle_f32x4(n[0][2], n[1][2], FIRST),  (real)_mm512_shuffle_f32x4(n[0][3], n[1][3], FIRST),
                       (real)_mm512_shuffle_f32x4(n[0][0], n[1][0], SECOND), (real)_mm512_shuffle_f32x4(n[0][1], n[1][1], SECOND)};
}
#endif

/* One row of a table with four columns per lane. */
static inline four_reals gather_rows(const float *table, mask row) { return gather_fours(table, 4 * row); }

/* One byte of a table per lane. Up to three bytes behind the table may be read. */
static inline mask gather_bytes(const uint8_t *table, mask at)
{
#if MGT_LANES == 1
    return table[at];
#elif MGT_LANES == 16
    return (mask)_mm512_i32gather_epi32((__m512i)at, table, 1) & 255;
#elif MGT_LANES == 8
    return (mask)_mm256_i32gather_epi32((const int *)(const void *)table, (__m256i)at, 1) & 255;
#else
    return (mask)FOUR_OF(table, at);
#endif
}

/* ---- the sky ---- */

KERNEL vec3 SKY_TEXEL(CTX cx, real column, real row)
{
    const four_reals texel = gather_fours(cx->sky, whole(real_fma(row, real_broadcast(SKY_COLUMNS), column)) * 3);
    return (vec3){texel.x, texel.y, texel.z};
}

#if MGT_LANES == 16
#define SKY_PAIRS
#include "kernels/sky/sky_pair.k"

KERNEL SkyPair SKY_PAIR(CTX cx, real column, real row)
{
    const six_reals six = gather_sixes(cx->sky, whole(real_fma(row, real_broadcast(SKY_COLUMNS), column)) * 3);
    return (SkyPair){{six.x, six.y, six.z}, {six.w, six.u, six.v}};
}
#endif

/* The lanes' numbers: 0, 1, 2, … */
static inline real lane_numbers(void)
{
    static const float numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return load(numbers);
}

KERNEL vec2 SKYLINE(CTX cx, real entry)
{
    const mask at = 2 * whole(entry);
    return (vec2){gather_floats(cx->skyline, at), gather_floats(cx->skyline + 1, at)};
}

/* ---- light of objects ---- */

/* A plane of the tile_light at the pixels of this vector. */
static inline real light_plane(CTX cx, size_t plane) { return load(cx->light + plane * TILE_PIXELS); }

KERNEL vec3 UPWELLING(CTX cx)
{
    if (!cx->light)
        return (vec3){real_broadcast(FRAME(cx).body_r), real_broadcast(FRAME(cx).body_g), real_broadcast(FRAME(cx).body_b)};
    return (vec3){light_plane(cx, 0), light_plane(cx, 1), light_plane(cx, 2)};
}

#define MIRRORS_OBJECTS(cx) ((cx)->light != NULL)

KERNEL vec3 OBJECTS_COLOR(CTX cx) { return (vec3){light_plane(cx, 3), light_plane(cx, 4), light_plane(cx, 5)}; }
KERNEL real OBJECTS_COVERAGE(CTX cx) { return light_plane(cx, 6); }
KERNEL vec3 CLEAR_TO_LIGHT(CTX cx) { return (vec3){light_plane(cx, 7), light_plane(cx, 8), light_plane(cx, 9)}; }
KERNEL vec3 DEEP_WATER(CTX cx) { return (vec3){light_plane(cx, 10), light_plane(cx, 11), light_plane(cx, 12)}; }
KERNEL real FRONT_COVERAGE(CTX cx) { return light_plane(cx, 13); }

#endif
