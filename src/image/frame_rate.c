/* SPDX-License-Identifier: MIT */
/* Frames per second as a fraction. */
#include "image/frame_rate.h"

#include <math.h>

frame_rate frame_rate_of(double frames_per_second)
{
    double whole = round(frames_per_second);
    if (fabs(frames_per_second - whole) < 1e-6)
        return (frame_rate){(uint32_t)whole, 1};
    /* The television rates 23.976, 29.97, 59.94 are n · 1000/1001. */
    if (fabs(frames_per_second - whole * 1000.0 / 1001.0) < 2e-3 && whole >= 1.0)
        return (frame_rate){(uint32_t)whole * 1000, 1001};
    uint32_t a = (uint32_t)round(frames_per_second * 1000.0), b = 1000;
    for (uint32_t x = a, y = b;;) { /* greatest common divisor */
        if (y == 0)
            return (frame_rate){a / x, b / x};
        uint32_t rest = x % y;
        x = y;
        y = rest;
    }
}
