/* SPDX-License-Identifier: MIT
 *
 * What kernels of objects read, at one lane, from data of the test's own. Include it before these kernels, and unit/kernel_words_off.h after them.
 */
#ifndef MANGATA_TESTS_OBJECTS_LANE_H
#define MANGATA_TESTS_OBJECTS_LANE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/kernel_context.h"
#include "cpu/gbuffer.h"
#include "cpu/narrow_lanes.h"
#include "frame/refraction_data.h"
#include "unit/random_numbers.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* the dialect hands cx to every function */
#pragma GCC diagnostic ignored "-Wshadow"

static const double pi = 3.14159265358979323846;

static random_state numbers;

static inline double range(double low, double high) { return random_range(&numbers, low, high); }

static inline double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static inline void unit3(double v[3])
{
    const double length = sqrt(dot3(v, v));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

/* Snell's law: false where nothing gets through. `ratio`: index before over index behind. */
static inline bool refract3(const double ray[3], const double normal[3], double ratio, double out[3])
{
    const double cosine = -dot3(ray, normal), squared = 1 - ratio * ratio * (1 - cosine * cosine);
    if (squared < 0)
        return false;
    for (int k = 0; k < 3; k++)
        out[k] = ratio * ray[k] + (ratio * cosine - sqrt(squared)) * normal[k];
    return true;
}

/* The data of one case. */
static FrameData frame_data;
static SearchWave waves[4];

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#define FRAME(cx) frame_data
#define SEARCH_WAVE(cx, i) (waves[i])

KERNEL vec3 SKY_TEXEL(CTX cx, real column, real row) { return vec3(0.0f, 0.0f, 0.0f); }

#endif
