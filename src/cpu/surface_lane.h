/* SPDX-License-Identifier: MIT
 * The kernels of rays against the triangles of surfaces, for C: a ray at a time, in double precision. Include it after all other headers. */
#ifndef MANGATA_CPU_SURFACE_LANE_H
#define MANGATA_CPU_SURFACE_LANE_H

#include "cpu/refraction_state.h"

#include "kernels/common/prelude_double.h"

/* What the kernels can reach through their accessors. */
struct kernel_context {
    const surface_triangle *surface;
};

KERNEL vec3 vec3_of(const float v[3]) { return vec3((double)v[0], (double)v[1], (double)v[2]); }

KERNEL vec3 SURFACE_CORNER(CTX cx, int triangle, int i) { return vec3_of(cx->surface[triangle].corners[i]); }
KERNEL vec3 SURFACE_NORMAL(CTX cx, int triangle) { return vec3_of(cx->surface[triangle].normal); }
KERNEL int SURFACE_NEIGHBOUR(CTX cx, int triangle, int i) { return cx->surface[triangle].neighbours[i]; }

#include "kernels/refraction/surfaces.k"

#endif
