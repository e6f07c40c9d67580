/* SPDX-License-Identifier: MIT
 *
 * Where the kernels find foam: a foam_set, in programs that are built for it; in others there is none.
 */
#include "kernels/waves/foam_types.k"

#ifdef FOAMY_WATER
layout(std430, binding = 7) restrict readonly buffer FoamBlock
{
    FoamData foam_data;
    FoamSine foam_sines[2 * FOAM_SINES];
    FoamWave foam_waves[];
};
#define FOAMY(cx) 1
#define FOAM(cx) foam_data
#define FOAM_WAVE(cx, i) foam_waves[i]
#define FOAM_SINE(cx, i) foam_sines[i]
#else
FoamData no_foam;
FoamWave no_foam_wave;
FoamSine no_foam_sine;
#define FOAMY(cx) 0
#define FOAM(cx) no_foam
#define FOAM_WAVE(cx, i) no_foam_wave
#define FOAM_SINE(cx, i) no_foam_sine
#endif
