/* SPDX-License-Identifier: MIT */
/* Functions of the kernels on arrays of floats, the same list at every lane width. */
#ifndef MGT_TESTS_KERNEL_PROBE_H
#define MGT_TESTS_KERNEL_PROBE_H

#include <stddef.h>

enum { PROBE_INPUTS = 8, PROBE_OUTPUTS = 3, PROBE_BATCH = 16 };

/* What kernel_probe.k evaluates. */
#define PROBE_FUNCTIONS(X)                                                                                      \
    X(PROBE_SINCOS_TURNS)                                                                                       \
    X(PROBE_SINCOS_WAVE)                                                                                        \
    X(PROBE_SINCOS_COARSE)                                                                                      \
    X(PROBE_SINCOS_REDUCED)                                                                                     \
    X(PROBE_EXP2)                                                                                               \
    X(PROBE_EXP)                                                                                                \
    X(PROBE_LOG)                                                                                                \
    X(PROBE_NORMAL_PDF)                                                                                         \
    X(PROBE_NORMAL_CDF)                                                                                         \
    X(PROBE_NORMAL_EXCESS)                                                                                      \
    X(PROBE_CDF_ANTIDERIVATIVE)                                                                                 \
    X(PROBE_DISK_PATH)     /* p0.x p0.y p1.x p1.y sxx sxy syy radius */                                         \
    X(PROBE_ARC_SHARE)     /* p0.x p0.y p1.x p1.y radius */                                                     \
    X(PROBE_ROUNDING)      /* round_even, floor, abs */                                                         \
    X(PROBE_MINMAX)        /* min, max, clamp to [-1, 1] */                                                     \
    X(PROBE_EXPONENT)      /* pow2i(round_even(b)), exponent_of(a), mantissa_of(a) */                           \
    X(PROBE_SELECT)        /* a < b ? a : b; a < b and not a < 0 or b > 1; bit 0: any lane a < b, bit 1: all */ \
    X(PROBE_PRODUCT_ERROR) /* a b, and what rounding took from it */                                            \
    X(PROBE_CROSS)         /* of (a b c) and (d e f) */                                                         \
    X(PROBE_NORMALIZE)     /* of (a b c) */                                                                     \
    X(PROBE_VECTOR)        /* dot of (a b c) and (d e f); length_squared of (a b) + 2 (c d); the same by sub */ \
    X(PROBE_COUNT)

enum probe_function {
#define PROBE_MEMBER(name) name,
    PROBE_FUNCTIONS(PROBE_MEMBER)
#undef PROBE_MEMBER
};

struct kernel_probe {
    const char *name;
    int lanes;
    int fused; /* whether fma() rounds once */
    int exact; /* whether every operation gives the bits that IEEE 754 asks for, so that all such probes agree */
    /* count is a multiple of PROBE_BATCH; unused arrays may be NULL. */
    void (*run)(enum probe_function function, const float *const *in, float *const *out, size_t count);
    /* Evaluations of the disk-path integrand since the start; counted by one lane only. */
    long (*evaluations)(void);
};

struct kernel_probe kernel_probe_1(void);
struct kernel_probe kernel_probe_4(void);
struct kernel_probe kernel_probe_8(void);
struct kernel_probe kernel_probe_16(void);

/* In a compute shader. Returns whether OpenGL is there; where a shader fails, says so and ends the process. */
int kernel_probe_gl(struct kernel_probe *probe);

enum { MOST_PROBES = 5 };

/* The widths that were built and that this processor can run, narrowest first; returns how many. */
int kernel_lane_probes(struct kernel_probe *probes);

/* The same, then OpenGL where it is there. */
int kernel_probes(struct kernel_probe *probes);

#endif
