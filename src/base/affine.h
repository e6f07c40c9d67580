/* SPDX-License-Identifier: MIT
 * Affine transforms of places: three rows of four. */
#ifndef MANGATA_BASE_AFFINE_H
#define MANGATA_BASE_AFFINE_H

#include <math.h>
#include <stdbool.h>

/* The factor by which volumes grow, negative where it mirrors. */
static inline double affine_volume(const double t[3][4])
{
    return t[0][0] * (t[1][1] * t[2][2] - t[1][2] * t[2][1]) - t[0][1] * (t[1][0] * t[2][2] - t[1][2] * t[2][0]) +
           t[0][2] * (t[1][0] * t[2][1] - t[1][1] * t[2][0]);
}

/* Whether a mesh is left with a volume, so that its normals can be turned. */
static inline bool affine_keeps_volume(double volume) { return fabs(volume) > 1e-24; }

#endif
