/* SPDX-License-Identifier: MIT
 *
 * Accessors of foam. Programs that are built for foam read a foam_set. For cells and their points there is a foam_set for each set of waves, and foam_place is
 * the number of the current one. Other programs have no foam.
 */
#include "kernels/waves/foam_types.k"

#if defined(FOAMY_WATER) && defined(CELLS_PASS)
struct FoamSet {
    FoamData data;
    FoamSine sines[2 * FOAM_SINES];
    FoamWave waves[MAX_WAVES];
};
layout(std430, binding = 7) restrict readonly buffer FoamBlock { FoamSet foam_sets[]; };
#define FOAMY(cx) 1
#define FOAM(cx) foam_sets[foam_place].data
#define FOAM_WAVE(cx, i) foam_sets[foam_place].waves[i]
#define FOAM_SINE(cx, i) foam_sets[foam_place].sines[i]
#elif defined(FOAMY_WATER)
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
