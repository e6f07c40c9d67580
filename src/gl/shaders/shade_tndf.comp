/* SPDX-License-Identifier: MIT
 *
 * Method `tndf`.
 */
#define SHARED_WAVES
#include "lattice_data.glsl"
#include "kernels/baselines/tndf.k"
#define METHOD_STATE SlopeState
#define method_state slope_state
#define method_result(cx, p, open, close) tndf_result(cx, p, open, close)
#include "shade.glsl"
