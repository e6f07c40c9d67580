/* SPDX-License-Identifier: MIT
 *
 * Method `tokuyoshi`.
 */
#define EXACT_FMA
#include "lattice_data.glsl"
#include "kernels/baselines/tokuyoshi.k"
#define point_pixel tokuyoshi_pixel
#include "points.glsl"
