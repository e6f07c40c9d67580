/* SPDX-License-Identifier: MIT
 *
 * What kernels of the sky read, at one lane, from cx->frame and cx->sky. Include it before these kernels.
 */
#ifndef MANGATA_TESTS_SKY_LANE_H
#define MANGATA_TESTS_SKY_LANE_H

#include "cpu/kernel_context.h"
#include "frame/kernel_data.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* the dialect hands cx to every function */
#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#define FRAME(cx) (*(cx)->frame)
#define SKY_TEXEL(cx, column, row) sky_texel(cx, column, row)

KERNEL vec3 sky_texel(CTX cx, real column, real row)
{
    const float *t = cx->sky + ((size_t)row * SKY_COLUMNS + (size_t)column) * 3;
    return vec3(t[0], t[1], t[2]);
}

#endif
