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
#include "kernels/waves/no_foam_accessors_glsl.k"
#endif
