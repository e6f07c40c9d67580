/* SPDX-License-Identifier: MIT
 * Refraction by a flat surface in double precision: the oracle of kernels/refraction/refract_point.k. */
#include "reference/refraction.h"

#include <math.h>
#include <stdbool.h>

/* Derivative of the optical length by the place of the crossing, which is `x` metres from the point in air and `rest` metres from the point in water. */
static double growth(double above, double below, double x, double rest, double index) { return x / hypot(above, x) - index * rest / hypot(below, rest); }

/* Horizontal distance of the path's crossing of the surface from the point in air, metres. */
static double crossing(double above, double below, double across, double index)
{
    /* Bisection measures from the end that the crossing is nearer to, so that both distances keep their precision. */
    const bool early = growth(above, below, 0.5 * across, 0.5 * across, index) > 0;
    double low = 0, high = 0.5 * across;
    for (int i = 0; i < 64; i++) {
        const double middle = 0.5 * (low + high);
        const bool past = early ? growth(above, below, middle, across - middle, index) > 0 : growth(above, below, across - middle, middle, index) < 0;
        if (past)
            high = middle;
        else
            low = middle;
    }
    return early ? low : across - low;
}

double reference_air_angle(double above, double below, double across, double index) { return atan2(crossing(above, below, across, index), above); }
