/* SPDX-License-Identifier: MIT
 *
 * Method `bruneton`.
 */
#define SHARED_WAVES
#include "lattice_data.glsl"
#include "kernels/baselines/bruneton.k"
#define METHOD_STATE SlopeState
#define method_state slope_state
#define method_result(cx, p, open, close) bruneton_result(cx, p, close)
#include "shade.glsl"
