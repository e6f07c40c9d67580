/* SPDX-License-Identifier: MIT
 *
 * Methods that shade a pixel from its slopes. Assembled once a method: method.k is its kernel, method_result the kernel's function.
 */
#define SHARED_WAVES
#include "lattice_data.glsl"
#ifdef LEAN_MAP
#include "lean_data.glsl"
#endif
#include "method.k"
#define METHOD_STATE SlopeState
#define method_state slope_state
#include "shade.glsl"
