/* SPDX-License-Identifier: MIT
 *
 * Method `mangata`.
 */
#define SHARED_WAVES
#include "lattice_data.glsl"
#include "kernels/glitter/glitter.k"
#define METHOD_STATE SlopeState
#define method_state slope_state
#define method_result glitter_result
#include "shade.glsl"
