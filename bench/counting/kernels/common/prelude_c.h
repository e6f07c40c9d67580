/* SPDX-License-Identifier: MIT
 *
 * The kernel dialect at one lane with every operation on a pixel's value counted. It stands before src/ in the include path and so
 * takes the place of src/kernels/common/prelude_c.h, with the same words and the same results.
 *
 * This is C++ because C cannot count a bare `a + b`: kernels write + - * / on reals, and only a class can give these a meaning of
 * ours. Uniform floats are not counted: they cost one operation for a whole tile or vector.
 */
#ifndef MANGATA_BENCH_COUNTING_KERNELS_COMMON_PRELUDE_C_H
#define MANGATA_BENCH_COUNTING_KERNELS_COMMON_PRELUDE_C_H

#include <string.h>

#include "kernels/common/constants.h"
#include "operation_count.h"

#if MGT_LANES != 1
#error "operations are counted at one lane"
#endif

#define KERNEL static inline __attribute__((unused))
#define KERNEL_CALLED static __attribute__((unused))
#define CTX __attribute__((unused)) const struct kernel_context *
#define STRUCT(name)          \
    typedef struct name name; \
    struct name
#define STD140 __attribute__((aligned(16)))
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) float name;

struct kernel_context;

#define UNROLLED 1
#define LOOPS_APART 1
#define TALLY(live) ((void)(operations_done.integrands += (live) != 0))

typedef int mask;

struct real {
    float v;
    real() = default;
    real(float value) : v(value) {}
    explicit operator int() const { return (int)v; }
    explicit operator float() const { return v; }
};

#define MGT_COUNTED(what, value) (operations_done.what++, (value))
#define MGT_LIFT(x) real(x)

static inline real operator+(real a, real b) { return MGT_COUNTED(add, a.v + b.v); }
static inline real operator-(real a, real b) { return MGT_COUNTED(add, a.v - b.v); }
static inline real operator*(real a, real b) { return MGT_COUNTED(multiply, a.v * b.v); }
static inline real operator/(real a, real b) { return MGT_COUNTED(divide, a.v / b.v); }
static inline real operator-(real a) { return MGT_COUNTED(other, -a.v); }
static inline mask operator<(real a, real b) { return MGT_COUNTED(other, a.v < b.v); }
static inline mask operator>(real a, real b) { return MGT_COUNTED(other, a.v > b.v); }
static inline mask operator<=(real a, real b) { return MGT_COUNTED(other, a.v <= b.v); }
static inline mask operator>=(real a, real b) { return MGT_COUNTED(other, a.v >= b.v); }
static inline mask operator==(real a, real b) { return MGT_COUNTED(other, a.v == b.v); }
static inline mask operator!=(real a, real b) { return MGT_COUNTED(other, a.v != b.v); }

KERNEL mask bits_of(real x)
{
    mask b;
    memcpy(&b, &x.v, sizeof b);
    return b;
}
KERNEL real from_bits(mask b)
{
    float x;
    memcpy(&x, &b, sizeof x);
    return x;
}

KERNEL real real_broadcast(float u) { return u; }
KERNEL mask real_bits(real x) { return bits_of(x); }
KERNEL real real_from_bits(mask b) { return from_bits(b); }
KERNEL real real_from_int(mask i) { return MGT_COUNTED(other, (float)i); }
KERNEL real real_select(mask m, real a, real b) { return MGT_COUNTED(other, m ? a : b); }
KERNEL mask mask_not(mask m) { return !m; }
KERNEL mask mask_shift_left(mask b, int places) { return MGT_COUNTED(other, (mask)((unsigned)b << places)); }
KERNEL bool any_lane(mask m) { return m != 0; }
KERNEL bool all_lanes(mask m) { return m != 0; }
KERNEL real real_min(real a, real b) { return MGT_COUNTED(other, a.v < b.v ? a : b); }
KERNEL real real_max(real a, real b) { return MGT_COUNTED(other, a.v > b.v ? a : b); }
KERNEL real real_sqrt(real x) { return MGT_COUNTED(square_root, __builtin_sqrtf(x.v)); }
KERNEL real real_fma(real a, real b, real c) { return MGT_COUNTED(fused, __builtin_fmaf(a.v, b.v, c.v)); }
KERNEL real real_abs(real x) { return MGT_COUNTED(other, __builtin_fabsf(x.v)); }
KERNEL real real_copy_sign(real magnitude, real sign) { return MGT_COUNTED(other, __builtin_copysignf(magnitude.v, sign.v)); }
KERNEL real real_round_even(real x) { return MGT_COUNTED(other, __builtin_rintf(x.v)); }
KERNEL real real_floor(real x) { return MGT_COUNTED(other, __builtin_floorf(x.v)); }

#define AND(a, b) ((a) & (b))
#define OR(a, b) ((a) | (b))
#define NOT(a) mask_not(a)
#define SELECT(m, a, b) real_select(m, real(a), real(b))

#define min(a, b) real_min(real(a), real(b))
#define max(a, b) real_max(real(a), real(b))
#define clamp(x, low, high) real_min(real_max(real(x), real(low)), real(high))
#define sqrt(x) real_sqrt(real(x))
#define fma(a, b, c) real_fma(real(a), real(b), real(c))
#define product_error(a, b) real_fma(real(a), real(b), -(real(a) * real(b)))
#define abs(x) real_abs(real(x))
#define copy_sign(magnitude, sign) real_copy_sign(real(magnitude), real(sign))
#define round_even(x) real_round_even(real(x))
#define floor(x) real_floor(real(x))

KERNEL float uniform_min(float a, float b) { return a < b ? a : b; }
KERNEL float uniform_max(float a, float b) { return a > b ? a : b; }
#define uniform_sqrt(x) __builtin_sqrtf(x)
#define uniform_float(x) ((float)(x))
#define INFINITE real(__builtin_inff())

#define MGT_ROUNDER 12582912.0f

KERNEL real pow2i(real n) { return real_from_bits(mask_shift_left(real_bits(n + (MGT_ROUNDER + 127.0f)), 23)); }
KERNEL real exponent_of(real x) { return real_from_int((real_bits(x) >> 23) - 127); }
KERNEL real mantissa_of(real x) { return MGT_COUNTED(other, real_from_bits((real_bits(x) & 0x007fffff) | 0x3f800000)); }

STRUCT(Nearest) { real integer, parity; };

KERNEL Nearest real_nearest(real x, float factor, float rounder)
{
    Nearest n;
    real shifted = real_fma(x, real(factor), real(rounder));
    n.parity = real_from_bits(mask_shift_left(real_bits(shifted), 31));
    n.integer = shifted - rounder;
    return n;
}

KERNEL Nearest nearest(real x, float factor) { return real_nearest(x, factor, MGT_ROUNDER); }
KERNEL Nearest nearest_even(real x, float factor) { return real_nearest(x, factor, 2.0f * MGT_ROUNDER); }
KERNEL real flip_by_parity(real value, real parity) { return MGT_COUNTED(other, real_from_bits(real_bits(value) ^ real_bits(parity))); }

struct vec2 {
    real x, y;
};
struct vec3 {
    real x, y, z;
};

#define vec2(x, y) (vec2{real(x), real(y)})
#define vec3(x, y, z) (vec3{real(x), real(y), real(z)})

KERNEL vec2 add(vec2 a, vec2 b) { return vec2(a.x + b.x, a.y + b.y); }
KERNEL vec3 add(vec3 a, vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
KERNEL vec2 sub(vec2 a, vec2 b) { return vec2(a.x - b.x, a.y - b.y); }
KERNEL vec3 sub(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
KERNEL vec2 scale(vec2 v, real s) { return vec2(v.x * s, v.y * s); }
KERNEL vec3 scale(vec3 v, real s) { return vec3(v.x * s, v.y * s, v.z * s); }
KERNEL real dot(vec2 a, vec2 b) { return fma(a.x, b.x, a.y * b.y); }
KERNEL real dot(vec3 a, vec3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
KERNEL real length_squared(vec2 v) { return dot(v, v); }
KERNEL real length_squared(vec3 v) { return dot(v, v); }
KERNEL vec3 cross(vec3 a, vec3 b) { return vec3(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))); }
KERNEL vec3 normalize(vec3 v) { return scale(v, real(1.0f) / sqrt(dot(v, v))); }
KERNEL vec2 SELECT2(mask m, vec2 a, vec2 b) { return vec2(real_select(m, a.x, b.x), real_select(m, a.y, b.y)); }
KERNEL vec3 SELECT3(mask m, vec3 a, vec3 b) { return vec3(real_select(m, a.x, b.x), real_select(m, a.y, b.y), real_select(m, a.z, b.z)); }

#endif
