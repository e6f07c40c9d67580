// SPDX-License-Identifier: MIT
// src/kernels/refraction/refract_point.k over reals that count what is done with them: see counting/kernels/common/prelude_c.h.
#define MGT_LANES 1
#define _Static_assert static_assert

#include <stddef.h>

#include "cpu/kernel_context.h"
#include "operation_count.h"

extern "C" {
#include "frame/kernel_data.h"
}

#include "kernels/common/prelude_c.h"

#define REFRACT(cx) (*(cx)->refract)
#include "kernels/refraction/refract_point.k"

extern "C" void counting_virtual_points(const RefractData *refract, size_t count, const float *const in[3]);

void counting_virtual_points(const RefractData *refract, size_t count, const float *const in[3])
{
    kernel_context cx = {};
    cx.refract = refract;
    for (size_t i = 0; i < count; i++)
        (void)virtual_point(&cx, vec3(real(in[0][i]), real(in[1][i]), real(in[2][i])));
}
