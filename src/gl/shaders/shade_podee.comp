/* SPDX-License-Identifier: MIT
 *
 * Methods `podee-uniform` and `podee-pixel`.
 */
#define CACHES_TILE
#define FOAM_LAYER
#include "lattice_data.glsl"
#include "kernels/baselines/podee.k"
#define METHOD_STATE PodeeState
#define method_result podee_result
#include "shade_podee.glsl"
#include "shade.glsl"
