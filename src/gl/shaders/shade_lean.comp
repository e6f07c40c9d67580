/* SPDX-License-Identifier: MIT
 *
 * Method `lean`.
 */
#define SHARED_WAVES
#include "lattice_data.glsl"
#include "lean_data.glsl"
#include "kernels/baselines/lean.k"
#define METHOD_STATE SlopeState
#define method_state slope_state
#define method_result(cx, p, open, close) lean_result(cx, p, close)
#include "shade.glsl"
