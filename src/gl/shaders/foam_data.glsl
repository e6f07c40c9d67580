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
    FoamWave waves[MAX_WAVES + 1];
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

/* The layer of foam, which programs for water without foam do not write. Programs that write it define FOAM_LAYER. */
#if defined(FOAMY_WATER) && defined(FOAM_LAYER)
layout(binding = 7, r32f) uniform image2D foam_image;

float stored_foam(ivec2 texel) { return pass_data.write_foam != 0 ? imageLoad(foam_image, texel).r : 0.0f; }

void store_foam(ivec2 texel, float foam)
{
    if (pass_data.write_foam != 0)
        imageStore(foam_image, texel, vec4(foam));
}
#else
#define stored_foam(texel) 0.0f
#define store_foam(texel, foam)
#endif
