/* SPDX-License-Identifier: MIT
 * Refraction by a flat surface in double precision: the oracle of kernels/refraction/refract_point.k. */
#include "reference/refraction.h"

#include <math.h>
#include <stdbool.h>

/* How the optical length grows with the place of the crossing, at `x` from the point in air and `rest` from the one in water. */
static double growth(double above, double below, double x, double rest, double index) { return x / hypot(above, x) - index * rest / hypot(below, rest); }

double reference_crossing(double above, double below, double across, double index)
{
    /* Halved from the end that it is nearer to, so that both distances keep their digits. */
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

double reference_air_angle(double above, double below, double across, double index) { return atan2(reference_crossing(above, below, across, index), above); }
