/* SPDX-License-Identifier: MIT
 * podee_mixture.k in one lane. */
#include "cpu/kernel_context.h"
#include "cpu/mixture_lane.h"

#include <math.h>
#include <string.h>

#include "cpu/lanes.h"
#include "frame/atmosphere.h"

/* The prelude redefines names of <math.h>, so these come first. */
static double log_of(double x) { return log(x); }

static double exp_of(double x) { return exp(x); }

static double reach_of(double e) { return sqrt(fmax(e * e - 1, 0)); }

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "cpu/lane_access.h"

KERNEL real SWEEP_TEXEL(CTX cx, real v, real u, real slice) { return cx->podee->sweep[((size_t)slice * PODEE_ROWS + (size_t)u) * PODEE_COLUMNS + (size_t)v]; }

KERNEL real FRACTION_TEXEL(CTX cx, real r, real slice) { return cx->podee->share[(size_t)slice * PODEE_COLUMNS + (size_t)r]; }

#include "kernels/glitter/glitter.k"
#include "kernels/baselines/podee_mixture.k"

mixture mixture_fitted(int kernels, double e)
{
    const struct kernel_context cx = {.frame = NULL};
    mixture m = {.count = 0};
    for (int i = 0; i < (kernels + 1) / 2; i++) {
        const MixtureMember member = mixture_member(&cx, kernels, i, (float)log_of(e));
        const mixture_part one = {(double)member.weight, exp_of((double)member.log_deviation), (double)member.distance * reach_of(e)};
        m.members[m.count++] = one;
        if (i > 0)
            m.members[m.count++] = (mixture_part){one.weight, one.deviation, -one.place};
    }
    return m;
}

double mixture_path_fraction(const podee_tables *tables, mgt_mixture kernels, const double from[2], const double to[2], const double covariance[3])
{
    const FrameData data = {.podee_kernels = (int)kernels, .podee_elongation = 1e6f};
    const struct kernel_context cx = {.frame = &data, .podee = tables};
    const Symmetric on_light = {(float)covariance[0], (float)covariance[1], (float)covariance[2]};
    return (double)mixture_disk_path(&cx, vec2((float)from[0], (float)from[1]), vec2((float)to[0], (float)to[1]), on_light, 1);
}
