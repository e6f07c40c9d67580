/* SPDX-License-Identifier: MIT
 *
 * Where the kernels find foam: nowhere, for there is none.
 */
#include "kernels/waves/foam_types.k"

#define FOAMY(cx) 0
#define FOAM(cx) no_foam
#define FOAM_WAVE(cx, i) no_foam_wave
#define FOAM_SINE(cx, i) no_foam_sine
FoamData no_foam;
FoamWave no_foam_wave;
FoamSine no_foam_sine;
