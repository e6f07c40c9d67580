/* SPDX-License-Identifier: MIT
 *
 * Methods `podee-uniform` and `podee-pixel`.
 */
#include "lattice_data.glsl"
#include "kernels/baselines/podee.k"
#define METHOD_STATE PodeeState
#define method_state podee_state
#define method_result podee_result
#include "shade.glsl"
