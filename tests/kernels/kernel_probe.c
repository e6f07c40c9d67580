/* SPDX-License-Identifier: MIT */
/* Functions of the kernels on arrays of floats. Compiled once per lane width. */
#include "kernel_probe.h"

#if MGT_LANES == 1
static long evaluations;
#define TALLY(live) (evaluations += (live) ? 1 : 0)
#endif

#include "kernels/prelude_c.h"
#include "kernels/math.k"
#include "kernels/disk_path.k"

#define NAME_(n) kernel_probe_##n
#define NAME(n) NAME_(n)

static real load(const float *p)
{
    real r;
    __builtin_memcpy(&r, p, sizeof r);
    return r;
}

static void store(float *p, real r) { __builtin_memcpy(p, &r, sizeof r); }

static SinCos lanes_any_all(real a, real b)
{
    SinCos counts;
    mask less = a < b;
    counts.s = real(any_lane(less) ? 1.0f : 0.0f);
    counts.c = real(all_lanes(less) ? 1.0f : 0.0f);
    return counts;
}

static vec3 evaluate(enum probe_function function, const real *x)
{
    CTX cx = NULL;
    real zero = real(0.0f);
    SinCos pair;
    vec3 a = vec3(x[0], x[1], x[2]);
    vec3 b = vec3(x[3], x[4], x[5]);
    switch (function) {
    case PROBE_SINCOS_TURNS:
        pair = sincos_turns(cx, x[0]);
        return vec3(pair.s, pair.c, zero);
    case PROBE_SINCOS_WAVE:
        pair = sincos_wave(cx, x[0]);
        return vec3(pair.s, pair.c, zero);
    case PROBE_SINCOS_REDUCED:
        pair = sincos_reduced(cx, x[0]);
        return vec3(pair.s, pair.c, zero);
    case PROBE_EXP2:
        return vec3(exp2_real(cx, x[0]), zero, zero);
    case PROBE_EXP:
        return vec3(exp_real(cx, x[0]), zero, zero);
    case PROBE_LOG:
        return vec3(log_real(cx, x[0]), zero, zero);
    case PROBE_NORMAL_PDF:
        return vec3(normal_pdf(cx, x[0]), zero, zero);
    case PROBE_NORMAL_CDF:
        return vec3(normal_cdf(cx, x[0]), zero, zero);
    case PROBE_NORMAL_EXCESS:
        return vec3(normal_excess(cx, x[0]), zero, zero);
    case PROBE_CDF_ANTIDERIVATIVE:
        return vec3(cdf_antiderivative(cx, x[0], x[1]), zero, zero);
    case PROBE_DISK_PATH:
        return vec3(gaussian_disk_path(cx, vec2(x[0], x[1]), vec2(x[2], x[3]), x[4], x[5], x[6], x[7]), zero, zero);
    case PROBE_ARC_SHARE:
        return vec3(light_arc_share(cx, vec2(x[0], x[1]), vec2(x[2], x[3]), x[4]), zero, zero);
    case PROBE_ROUNDING:
        return vec3(round_even(x[0]), floor(x[0]), abs(x[0]));
    case PROBE_MINMAX:
        return vec3(min(x[0], x[1]), max(x[0], x[1]), clamp(x[0], -1.0f, 1.0f));
    case PROBE_EXPONENT:
        return vec3(pow2i(round_even(x[1])), exponent_of(x[0]), mantissa_of(x[0]));
    case PROBE_SELECT:
        pair = lanes_any_all(x[0], x[1]);
        return vec3(SELECT(x[0] < x[1], x[0], x[1]),
                    SELECT(OR(AND(x[0] < x[1], NOT(x[0] < 0.0f)), x[1] > 1.0f), 1.0f, 0.0f), fma(pair.c, 2.0f, pair.s));
    case PROBE_CROSS:
        return cross(a, b);
    case PROBE_NORMALIZE:
        return normalize(a);
    case PROBE_VECTOR:
        return vec3(dot(a, b), length_squared(add(vec2(x[0], x[1]), scale(vec2(x[2], x[3]), 2.0f))),
                    length_squared(sub(vec2(x[0], x[1]), scale(vec2(x[2], x[3]), -2.0f))));
    case PROBE_COUNT:
        break;
    }
    return vec3(zero, zero, zero);
}

static void run(enum probe_function function, const float *const *in, float *const *out, size_t count)
{
    for (size_t i = 0; i < count; i += MGT_LANES) {
        real x[PROBE_INPUTS];
        for (int k = 0; k < PROBE_INPUTS; k++)
            x[k] = in[k] ? load(in[k] + i) : real(0.0f);
        vec3 y = evaluate(function, x);
        store(out[0] + i, y.x);
        if (out[1])
            store(out[1] + i, y.y);
        if (out[2])
            store(out[2] + i, y.z);
    }
}

static long count_evaluations(void)
{
#if MGT_LANES == 1
    return evaluations;
#else
    return 0;
#endif
}

struct kernel_probe NAME(MGT_LANES)(void);
struct kernel_probe NAME(MGT_LANES)(void)
{
    return (struct kernel_probe){MGT_LANES, run, count_evaluations};
}
