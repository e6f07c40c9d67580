/* SPDX-License-Identifier: MIT
 *
 * Fresnel's reflectance in double precision, for the light that enters the water through a flat surface. Pixels take that of kernels/common/mirror.k.
 */
#ifndef MANGATA_FRAME_FRESNEL_H
#define MANGATA_FRAME_FRESNEL_H

#include <math.h>

/* Reflectance into a medium of relative index n for unpolarised light. `cosine`: of the angle of incidence, 0 to 1. */
static inline double fresnel_reflectance(double cosine, double n)
{
    const double squared = n * n - 1 + cosine * cosine;
    if (squared <= 0)
        return 1;
    const double g = sqrt(squared), a = (g - cosine) / (g + cosine), b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
    return 0.5 * a * a * (1 + b * b);
}

/* The same for diffuse light, which comes from all sides alike. */
static inline double fresnel_diffuse(double n)
{
    enum { STEPS = 64 };
    double mirrored = 0;
    for (int i = 0; i < STEPS; i++) {
        const double cosine = (i + 0.5) / STEPS;
        mirrored += fresnel_reflectance(cosine, n) * 2 * cosine / STEPS;
    }
    return mirrored;
}

#endif
