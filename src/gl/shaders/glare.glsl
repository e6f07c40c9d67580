/* SPDX-License-Identifier: MIT
 *
 * The pyramid of src/cpu/glare.c: the matrix D maps a level to the next coarser one, and U maps a level to the next finer one.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/display/glare.k"

layout(std140, binding = 3) uniform GlareBlock { GlareData glare_data; };
layout(std430, binding = 4) readonly buffer GlareWeightBlock { vec4 glare_weights[]; };
layout(binding = 1) uniform sampler2D fine_texture;
layout(binding = 2) uniform sampler2D coarse_texture;

/* One texel of U times the coarser level: three quarters of the nearer texel and a quarter of the farther, each way. */
vec3 glare_up(ivec2 texel)
{
    ivec2 near = texel / 2;
    ivec2 far = ivec2(glare_beside(0, texel.x, glare_data.coarse_width), glare_beside(0, texel.y, glare_data.coarse_height));
    vec3 upper = GLARE_NEAR * texelFetch(coarse_texture, near, 0).rgb + GLARE_FAR * texelFetch(coarse_texture, ivec2(far.x, near.y), 0).rgb;
    vec3 lower = GLARE_NEAR * texelFetch(coarse_texture, ivec2(near.x, far.y), 0).rgb + GLARE_FAR * texelFetch(coarse_texture, far, 0).rgb;
    return GLARE_NEAR * upper + GLARE_FAR * lower;
}
