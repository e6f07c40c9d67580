/* SPDX-License-Identifier: MIT */
/* Functions of the kernels on arrays of floats, the same list at every lane width. */
#ifndef MGT_TESTS_KERNEL_PROBE_H
#define MGT_TESTS_KERNEL_PROBE_H

#include <stddef.h>

enum { PROBE_INPUTS = 8, PROBE_OUTPUTS = 3, PROBE_BATCH = 16 };

enum probe_function {
    PROBE_SINCOS_TURNS,
    PROBE_SINCOS_WAVE,
    PROBE_SINCOS_REDUCED,
    PROBE_EXP2,
    PROBE_EXP,
    PROBE_LOG,
    PROBE_NORMAL_PDF,
    PROBE_NORMAL_CDF,
    PROBE_NORMAL_EXCESS,
    PROBE_CDF_ANTIDERIVATIVE,
    PROBE_DISK_PATH, /* p0.x p0.y p1.x p1.y sxx sxy syy radius */
    PROBE_ARC_SHARE, /* p0.x p0.y p1.x p1.y radius */
    PROBE_ROUNDING,  /* round_even, floor, abs */
    PROBE_MINMAX,    /* min, max, clamp to [-1, 1] */
    PROBE_EXPONENT,  /* pow2i(round_even(b)), exponent_of(a), mantissa_of(a) */
    PROBE_SELECT,    /* a < b ? a : b; a < b and not a < 0 or b > 1; bit 0: any lane a < b, bit 1: all lanes */
    PROBE_CROSS,     /* of (a b c) and (d e f) */
    PROBE_NORMALIZE, /* of (a b c) */
    PROBE_VECTOR,    /* dot of (a b c) and (d e f); length_squared of (a b) + 2 (c d); the same by sub */
    PROBE_COUNT
};

struct kernel_probe {
    int lanes;
    /* count is a multiple of PROBE_BATCH; unused arrays may be NULL. */
    void (*run)(enum probe_function function, const float *const *in, float *const *out, size_t count);
    /* Evaluations of the disk-path integrand since the start; counted by one lane only. */
    long (*evaluations)(void);
};

struct kernel_probe kernel_probe_1(void);
struct kernel_probe kernel_probe_4(void);
struct kernel_probe kernel_probe_8(void);
struct kernel_probe kernel_probe_16(void);

/* The widths that were built and that this processor can run, narrowest first; returns how many. */
int kernel_probes(struct kernel_probe *probes);

#endif
