/* SPDX-License-Identifier: MIT */
/*
 * The kernel dialect as C in double precision, one value at a time, in place of prelude_c.h: for kernels that shaders evaluate in floats where C, at few
 * places, takes doubles. The rules are those of prelude_c.h, but that dot() and cross() are not fused, and that a kernel which looks at the bits of a float is
 * none for it.
 */
#ifndef MANGATA_KERNELS_COMMON_PRELUDE_DOUBLE_H
#define MANGATA_KERNELS_COMMON_PRELUDE_DOUBLE_H

#ifdef MANGATA_KERNELS_COMMON_PRELUDE_C_H
#error "a file has one prelude"
#endif

#include <stdbool.h>

#include "kernels/common/constants.h"

#define KERNEL static inline __attribute__((always_inline, unused))
#define CTX __attribute__((unused)) const struct kernel_context *
#define STRUCT(name)          \
    typedef struct name name; \
    struct name

struct kernel_context;

typedef double real;
typedef int mask;

#define AND(a, b) ((a) & (b))
#define OR(a, b) ((a) | (b))
#define NOT(a) (!(a))
#define SELECT(m, a, b) ((m) ? (a) : (b))

#define real(u) ((double)(u))
#define min(a, b) real_min(a, b)
#define max(a, b) real_max(a, b)
#define clamp(x, low, high) real_min(real_max(x, low), high)
#define abs(x) __builtin_fabs(x)
#define sqrt(x) __builtin_sqrt(x)
#define floor(x) __builtin_floor(x)
#define fma(a, b, c) __builtin_fma(a, b, c)
#define INFINITE __builtin_inf()
#define PRECISE
#define DOUBLE(x) ((double)(x))
#define floor_of_double(x) __builtin_floor(x)

KERNEL real real_min(real a, real b) { return a < b ? a : b; }
KERNEL real real_max(real a, real b) { return a > b ? a : b; }
/* In place of that of math.k. */
KERNEL real exp_real(CTX cx, real x) { return __builtin_exp(x); }
KERNEL bool any_lane(mask m) { return m != 0; }

/* ---- Vectors ---- */

typedef struct {
    real x, y;
} vec2;
typedef struct {
    real x, y, z;
} vec3;

#define vec2(x, y) ((vec2){x, y})
#define vec3(x, y, z) ((vec3){x, y, z})
#define add(a, b) vec3_add(a, b)
#define sub(a, b) vec3_sub(a, b)
#define scale(v, s) vec3_scale(v, s)
#define dot(a, b) vec3_dot(a, b)
#define cross(a, b) vec3_cross(a, b)

KERNEL vec3 vec3_add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
KERNEL vec3 vec3_sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
KERNEL vec3 vec3_scale(vec3 v, real s) { return (vec3){v.x * s, v.y * s, v.z * s}; }
KERNEL real vec3_dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
KERNEL vec3 vec3_cross(vec3 a, vec3 b) { return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

#endif
