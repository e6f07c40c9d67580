/* SPDX-License-Identifier: MIT
 *
 * Method `msaa32`.
 */
#include "lattice_data.glsl"
#include "msaa.k"
#define point_pixel msaa_pixel
#include "points.glsl"
