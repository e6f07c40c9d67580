/* SPDX-License-Identifier: MIT
 *
 * Method `tokuyoshi`.
 */
#define EXACT_FMA
#include "lattice_data.glsl"
#include "tokuyoshi.k"
#define point_pixel tokuyoshi_pixel
#include "points.glsl"
