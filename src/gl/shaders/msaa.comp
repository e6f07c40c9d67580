/* SPDX-License-Identifier: MIT
 *
 * Method `msaa32`.
 */
#define EXACT_FMA
#include "lattice_data.glsl"
#include "msaa.k"
#define point_pixel msaa_pixel
#include "points.glsl"
