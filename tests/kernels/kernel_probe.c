/* SPDX-License-Identifier: MIT */
/* Functions of the kernels on arrays of floats. Compiled once per lane width. */
#include "kernel_probe.h"

#if MGT_LANES == 1
static long evaluations;
#define TALLY(live) (evaluations += (live) ? 1 : 0)
#endif

#include "kernels/common/prelude_c.h"
#include "kernels/common/math.k"
#include "kernels/common/disk_path.k"
#include "kernel_probe.k"

#define NAME_(n) kernel_probe_##n
#define NAME(n) NAME_(n)

static real load(const float *p)
{
    real r;
    __builtin_memcpy(&r, p, sizeof r);
    return r;
}

static void store(float *p, real r) { __builtin_memcpy(p, &r, sizeof r); }

static void run(enum probe_function function, const float *const *in, float *const *out, size_t count)
{
    for (size_t i = 0; i < count; i += MGT_LANES) {
        ProbeInput x;
        for (int k = 0; k < PROBE_INPUTS; k++)
            x.value[k] = in[k] ? load(in[k] + i) : real(0.0f);
        vec3 y = probe(NULL, (int)function, x);
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

#define TEXT_(n) #n
#define TEXT(n) TEXT_(n)
static const char lanes_name[] = TEXT(MGT_LANES) " lanes";

struct kernel_probe NAME(MGT_LANES)(void);
struct kernel_probe NAME(MGT_LANES)(void)
{
    const int fused = MGT_LANES != 4; /* plain SSE2 has no fused multiply-add */
    return (struct kernel_probe){lanes_name, MGT_LANES, fused, fused, run, count_evaluations};
}
