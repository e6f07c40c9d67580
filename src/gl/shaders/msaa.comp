/* SPDX-License-Identifier: MIT
 *
 * Method `msaa32`.
 */
#define EXACT_FMA
#include "lattice_data.glsl"
#include "kernels/baselines/msaa.k"
#define point_pixel msaa_pixel
#include "points.glsl"
