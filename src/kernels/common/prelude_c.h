/* SPDX-License-Identifier: MIT */
/*
 * The kernel dialect as C: one pixel per lane of a GNU vector.
 *
 * A kernel file (*.k) is compiled twice: as C after this prelude and as GLSL after prelude_glsl.k. Define MGT_LANES
 * (1, 4, 8 or 16) before including this file, and include it after every system header, for it takes names such as
 * sqrt, abs and min for itself. It is the only C file of the kernels that knows the processor.
 *
 * Rules of the dialect
 *  1. `float` and `int` are uniform: one value for all pixels. `real` and `mask` vary per pixel. real(u) broadcasts.
 *     + - * / mix real and float; comparisons of reals give a mask. Every built-in function below that takes a real also
 *     takes a float in its place and returns a real.
 *  2. `vec2` and `vec3` are structs of reals: vec2(x, y) constructs, add sub scale dot cross normalize length_squared
 *     compute, .x .y .z select. No operators on them, no swizzles.
 *  3. Branch and loop on uniforms only. Else SELECT(mask, a, b), which evaluates both sides: guard sqrt and division
 *     before it. `if (any_lane(m))` may skip work, but a lane's value must never depend on its neighbours: an early out must
 *     leave every lane as the whole computation would.
 *  4. KERNEL before each function, CTX cx its first parameter; values are returned, several by a STRUCT. No out
 *     parameters, pointers, recursion, statics or globals.
 *  5. Data come from named accessors (WAVE(cx, i), ...) that each backend defines.
 *  6. Literals end in f. No casts, no int times real, no arrays indexed per lane, no name that GLSL reserves (active, common, filter, input,
 *     output, sample, ...), no member called length. Directives: #include, #pragma once, #define of a constant or an accessor, and #ifndef
 *     around a file or around a default of an accessor. A part for shaders alone stands behind one #ifdef at the end of its file and need not
 *     keep these rules.
 *  7. Every operation here is exactly rounded and the kernels are built with -ffp-contract=off, so that every lane width
 *     with fused multiply-add gives the same bits. SSE2 (4 lanes), where fma(a,b,c) is a*b+c, is outside that promise, as is WebAssembly.
 *  8. `double` is uniform and GLSL ES has none: only files that the page does without use it. DOUBLE(x) converts; constants are quotients of whole
 *     numbers, since the languages do not agree how a double is written. PRECISE before a variable: its sums are not reordered.
 */
#ifndef MANGATA_KERNELS_COMMON_PRELUDE_C_H
#define MANGATA_KERNELS_COMMON_PRELUDE_C_H

#include <stdbool.h>

#include "kernels/common/constants.h"

#if !defined(MGT_LANES)
#error "define MGT_LANES before including the kernel prelude"
#elif MGT_LANES == 1
#include <string.h>
#elif defined(__aarch64__) && MGT_LANES == 4
#include <arm_neon.h>
#elif defined(__wasm_simd128__) && MGT_LANES == 4
#include <wasm_simd128.h>
#elif MGT_LANES == 4 || MGT_LANES == 8 || MGT_LANES == 16
#include <immintrin.h>
#else
#error "MGT_LANES must be 1, 4, 8 or 16"
#endif

#define KERNEL static inline __attribute__((always_inline, unused))
/* For a long function that several kernels call: one copy, called. */
#define KERNEL_CALLED static __attribute__((noinline, unused))
#define CTX __attribute__((unused)) const struct kernel_context *
#define STRUCT(name)          \
    typedef struct name name; \
    struct name
/* The end of a struct whose size is a multiple of 16, as std140 rounds it up. */
#define STD140 __attribute__((aligned(16)))
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) float name;

struct kernel_context;

/* Turns of a loop over waves that are taken as one; a lane of C gains nothing from that. */
#define UNROLLED 1
/* 1: loops over waves that a uniform changes are compiled once for each of its values, which saves time. Shaders compile one, which saves theirs. */
#define LOOPS_APART 1

/* Called once for each evaluation of an integrand; instrumented builds define it to count the lanes where `live` holds. */
#ifndef TALLY
#define TALLY(live) ((void)0)
#endif

/* ---- Types, and what depends on the instruction set ---- */

#if MGT_LANES == 1

typedef float real;
typedef int mask;

#define MGT_LIFT(x) (x)

KERNEL real real_broadcast(float u) { return u; }
KERNEL mask real_bits(real x)
{
    mask b;
    memcpy(&b, &x, sizeof b);
    return b;
}
KERNEL real real_from_bits(mask b)
{
    real x;
    memcpy(&x, &b, sizeof x);
    return x;
}
KERNEL real real_from_int(mask i) { return (real)i; }
KERNEL real real_select(mask m, real a, real b) { return m ? a : b; }
KERNEL mask mask_not(mask m) { return !m; }
KERNEL mask mask_shift_left(mask b, int places) { return (mask)((unsigned)b << places); }
KERNEL bool any_lane(mask m) { return m != 0; }
KERNEL bool all_lanes(mask m) { return m != 0; }
KERNEL real real_min(real a, real b) { return a < b ? a : b; }
KERNEL real real_max(real a, real b) { return a > b ? a : b; }
KERNEL real real_sqrt(real x) { return __builtin_sqrtf(x); }
KERNEL real real_fma(real a, real b, real c) { return __builtin_fmaf(a, b, c); }

#else

typedef float real __attribute__((vector_size(4 * MGT_LANES)));
typedef int mask __attribute__((vector_size(4 * MGT_LANES)));

/* Subtracting +0 keeps every value, the sign of zero included, and broadcasts a float. It costs nothing. */
#define MGT_LIFT(x) ((x) - (real){0})

KERNEL real real_broadcast(float u) { return MGT_LIFT(u); }
KERNEL mask real_bits(real x) { return (mask)x; }
KERNEL real real_from_bits(mask b) { return (real)b; }
KERNEL real real_from_int(mask i) { return __builtin_convertvector(i, real); }
KERNEL mask mask_not(mask m) { return ~m; }
KERNEL mask mask_shift_left(mask b, int places) { return b << places; }

/* Comparing a comparison with 0 changes nothing, but lets compilers see the blend instruction (gcc with AVX-512 too). */
KERNEL real real_select(mask m, real a, real b)
{
    mask chosen = m < 0;
    return (real)((chosen & (mask)a) | (~chosen & (mask)b));
}

#if MGT_LANES == 16

KERNEL bool any_lane(mask m) { return _mm512_movepi32_mask((__m512i)m) != 0; }
KERNEL bool all_lanes(mask m) { return _mm512_movepi32_mask((__m512i)m) == 0xffff; }
KERNEL real real_min(real a, real b) { return (real)_mm512_min_ps((__m512)a, (__m512)b); }
KERNEL real real_max(real a, real b) { return (real)_mm512_max_ps((__m512)a, (__m512)b); }
KERNEL real real_sqrt(real x) { return (real)_mm512_sqrt_ps((__m512)x); }
KERNEL real real_fma(real a, real b, real c) { return (real)_mm512_fmadd_ps((__m512)a, (__m512)b, (__m512)c); }
KERNEL real real_round_even(real x) { return (real)_mm512_roundscale_ps((__m512)x, _MM_FROUND_TO_NEAREST_INT); }
KERNEL real real_floor(real x) { return (real)_mm512_roundscale_ps((__m512)x, _MM_FROUND_TO_NEG_INF); }

#elif MGT_LANES == 8

KERNEL bool any_lane(mask m) { return _mm256_movemask_ps((__m256)m) != 0; }
KERNEL bool all_lanes(mask m) { return _mm256_movemask_ps((__m256)m) == 0xff; }
KERNEL real real_min(real a, real b) { return (real)_mm256_min_ps((__m256)a, (__m256)b); }
KERNEL real real_max(real a, real b) { return (real)_mm256_max_ps((__m256)a, (__m256)b); }
KERNEL real real_sqrt(real x) { return (real)_mm256_sqrt_ps((__m256)x); }
KERNEL real real_fma(real a, real b, real c) { return (real)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c); }
KERNEL real real_round_even(real x) { return (real)_mm256_round_ps((__m256)x, _MM_FROUND_TO_NEAREST_INT); }
KERNEL real real_floor(real x) { return (real)_mm256_floor_ps((__m256)x); }

#elif defined(__aarch64__)

KERNEL bool any_lane(mask m) { return vmaxvq_u32((uint32x4_t)m) != 0; }
KERNEL bool all_lanes(mask m) { return vminvq_u32((uint32x4_t)m) != 0; }
KERNEL real real_min(real a, real b) { return (real)vminq_f32((float32x4_t)a, (float32x4_t)b); }
KERNEL real real_max(real a, real b) { return (real)vmaxq_f32((float32x4_t)a, (float32x4_t)b); }
KERNEL real real_sqrt(real x) { return (real)vsqrtq_f32((float32x4_t)x); }
KERNEL real real_fma(real a, real b, real c) { return (real)vfmaq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b); }
KERNEL real real_round_even(real x) { return (real)vrndnq_f32((float32x4_t)x); }
KERNEL real real_floor(real x) { return (real)vrndmq_f32((float32x4_t)x); }

#elif defined(__wasm__)

KERNEL bool any_lane(mask m) { return wasm_v128_any_true((v128_t)m); }
KERNEL bool all_lanes(mask m) { return wasm_i32x4_all_true((v128_t)m); }
KERNEL real real_min(real a, real b) { return (real)wasm_f32x4_pmin((v128_t)b, (v128_t)a); }
KERNEL real real_max(real a, real b) { return (real)wasm_f32x4_pmax((v128_t)b, (v128_t)a); }
KERNEL real real_sqrt(real x) { return (real)wasm_f32x4_sqrt((v128_t)x); }
KERNEL real real_fma(real a, real b, real c) { return a * b + c; }
KERNEL real real_round_even(real x) { return (real)wasm_f32x4_nearest((v128_t)x); }
KERNEL real real_floor(real x) { return (real)wasm_f32x4_floor((v128_t)x); }

#else

KERNEL bool any_lane(mask m) { return _mm_movemask_ps((__m128)m) != 0; }
KERNEL bool all_lanes(mask m) { return _mm_movemask_ps((__m128)m) == 0xf; }
KERNEL real real_min(real a, real b) { return (real)_mm_min_ps((__m128)a, (__m128)b); }
KERNEL real real_max(real a, real b) { return (real)_mm_max_ps((__m128)a, (__m128)b); }
KERNEL real real_sqrt(real x) { return (real)_mm_sqrt_ps((__m128)x); }
KERNEL real real_fma(real a, real b, real c) { return a * b + c; }

#endif
#endif

/* ---- Masks ---- */

#define AND(a, b) ((a) & (b))
#define OR(a, b) ((a) | (b))
#define NOT(a) mask_not(a)
#define SELECT(m, a, b) real_select(m, MGT_LIFT(a), MGT_LIFT(b))

KERNEL mask no_lane(CTX cx) { return (mask){0}; }
KERNEL mask every_lane(CTX cx) { return NOT(no_lane(cx)); }

/* ---- Scalars ---- */

#define real(u) real_broadcast(u)
/* One instruction: min is a < b ? a : b, max is a > b ? a : b. */
#define min(a, b) real_min(MGT_LIFT(a), MGT_LIFT(b))
#define max(a, b) real_max(MGT_LIFT(a), MGT_LIFT(b))
#define clamp(x, low, high) real_min(real_max(MGT_LIFT(x), MGT_LIFT(low)), MGT_LIFT(high))
#define sqrt(x) real_sqrt(MGT_LIFT(x))
#define fma(a, b, c) real_fma(MGT_LIFT(a), MGT_LIFT(b), MGT_LIFT(c))
#define abs(x) real_abs(MGT_LIFT(x))
#define copy_sign(magnitude, sign) real_copy_sign(MGT_LIFT(magnitude), MGT_LIFT(sign))
#define round_even(x) real_round_even(MGT_LIFT(x))
#define floor(x) real_floor(MGT_LIFT(x))
#define uniform_min(a, b) mgt_uniform_min(a, b)
#define uniform_max(a, b) mgt_uniform_max(a, b)
#define uniform_sqrt(x) __builtin_sqrtf(x)
#define uniform_float(x) ((float)(x))
#define PRECISE
#define DOUBLE(x) ((double)(x))
#define sqrt_of_double(x) __builtin_sqrt(x)
#define floor_of_double(x) __builtin_floor(x)
#define INFINITE real_broadcast(__builtin_inff())

KERNEL float mgt_uniform_min(float a, float b) { return a < b ? a : b; }
KERNEL float mgt_uniform_max(float a, float b) { return a > b ? a : b; }

#define MGT_SIGN_BIT (-2147483647 - 1)

KERNEL real real_abs(real x) { return real_from_bits(real_bits(x) & 0x7fffffff); }

KERNEL real real_copy_sign(real magnitude, real sign) { return real_from_bits((real_bits(magnitude) & 0x7fffffff) | (real_bits(sign) & MGT_SIGN_BIT)); }

#if MGT_LANES == 1 || (MGT_LANES == 4 && !defined(__aarch64__) && !defined(__wasm__))
/* Adding 2^23 leaves no bits below one. Neither plain C nor SSE2 has a rounding instruction; the bits are the same. */
KERNEL real real_round_even(real x)
{
    real rounded = real_copy_sign((real_abs(x) + 8388608.0f) - 8388608.0f, x);
    return real_select(real_abs(x) < 8388608.0f, rounded, x);
}

KERNEL real real_floor(real x)
{
    real rounded = real_round_even(x);
    return real_select(rounded > x, rounded - 1.0f, rounded);
}
#endif

/* What rounding took from a * b, to be added to it. Without fused multiply-add: 0. */
KERNEL real real_product_error(real a, real b) { return real_fma(a, b, -(a * b)); }
#define product_error(a, b) real_product_error(MGT_LIFT(a), MGT_LIFT(b))

/* ---- Exponents and parity ---- */

#define MGT_ROUNDER 12582912.0f /* 1.5 * 2^23: in x + MGT_ROUNDER the low bits are the integer nearest x. */

/* 2^n for integral n from -126 to 127. */
KERNEL real pow2i(real n) { return real_from_bits(mask_shift_left(real_bits(n + (MGT_ROUNDER + 127.0f)), 23)); }

/* x = mantissa_of(x) * 2^exponent_of(x), the mantissa in [1, 2), for normal x > 0. */
KERNEL real exponent_of(real x) { return real_from_int((real_bits(x) >> 23) - 127); }
KERNEL real mantissa_of(real x) { return real_from_bits((real_bits(x) & 0x007fffff) | 0x3f800000); }

/* An integer near x * factor, and its parity for flip_by_parity: value * (-1)^integer. |x * factor| < 2^22. */
STRUCT(Nearest) { real integer, parity; };

KERNEL Nearest real_nearest(real x, float factor, float rounder)
{
    real shifted = real_fma(x, real_broadcast(factor), real_broadcast(rounder));
    real parity = real_from_bits(mask_shift_left(real_bits(shifted), 31));
    return (Nearest){shifted - rounder, parity};
}

KERNEL Nearest nearest(real x, float factor) { return real_nearest(x, factor, MGT_ROUNDER); }
/* The nearest even integer; the parity is that of its half. */
KERNEL Nearest nearest_even(real x, float factor) { return real_nearest(x, factor, 2.0f * MGT_ROUNDER); }
KERNEL real flip_by_parity(real value, real parity) { return real_from_bits(real_bits(value) ^ real_bits(parity)); }

/* ---- Vectors ---- */

typedef struct {
    real x, y;
} vec2;
typedef struct {
    real x, y, z;
} vec3;

#define vec2(x, y) ((vec2){MGT_LIFT(x), MGT_LIFT(y)})
#define vec3(x, y, z) ((vec3){MGT_LIFT(x), MGT_LIFT(y), MGT_LIFT(z)})

#define add(a, b) _Generic((a), vec2 : vec2_add, vec3 : vec3_add)(a, b)
#define sub(a, b) _Generic((a), vec2 : vec2_sub, vec3 : vec3_sub)(a, b)
#define scale(v, s) _Generic((v), vec2 : vec2_scale, vec3 : vec3_scale)(v, MGT_LIFT(s))
#define dot(a, b) _Generic((a), vec2 : vec2_dot, vec3 : vec3_dot)(a, b)
#define length_squared(v) _Generic((v), vec2 : vec2_length_squared, vec3 : vec3_length_squared)(v)
#define cross(a, b) vec3_cross(a, b)
#define normalize(v) vec3_normalize(v)
#define SELECT2(m, a, b) vec2_select(m, a, b)
#define SELECT3(m, a, b) vec3_select(m, a, b)

KERNEL vec2 vec2_add(vec2 a, vec2 b) { return (vec2){a.x + b.x, a.y + b.y}; }
KERNEL vec2 vec2_sub(vec2 a, vec2 b) { return (vec2){a.x - b.x, a.y - b.y}; }
KERNEL vec2 vec2_scale(vec2 v, real s) { return (vec2){v.x * s, v.y * s}; }
KERNEL real vec2_dot(vec2 a, vec2 b) { return real_fma(a.x, b.x, a.y * b.y); }
KERNEL real vec2_length_squared(vec2 v) { return vec2_dot(v, v); }
KERNEL vec2 vec2_select(mask m, vec2 a, vec2 b) { return (vec2){real_select(m, a.x, b.x), real_select(m, a.y, b.y)}; }

KERNEL vec3 vec3_add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
KERNEL vec3 vec3_sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
KERNEL vec3 vec3_scale(vec3 v, real s) { return (vec3){v.x * s, v.y * s, v.z * s}; }
KERNEL real vec3_dot(vec3 a, vec3 b) { return real_fma(a.x, b.x, real_fma(a.y, b.y, a.z * b.z)); }
KERNEL real vec3_length_squared(vec3 v) { return vec3_dot(v, v); }
KERNEL vec3 vec3_cross(vec3 a, vec3 b) { return (vec3){real_fma(a.y, b.z, -(a.z * b.y)), real_fma(a.z, b.x, -(a.x * b.z)), real_fma(a.x, b.y, -(a.y * b.x))}; }
KERNEL vec3 vec3_normalize(vec3 v) { return vec3_scale(v, 1.0f / real_sqrt(vec3_dot(v, v))); }
KERNEL vec3 vec3_select(mask m, vec3 a, vec3 b) { return (vec3){real_select(m, a.x, b.x), real_select(m, a.y, b.y), real_select(m, a.z, b.z)}; }

#endif
