/* SPDX-License-Identifier: MIT
 *
 * Computes the next coarser level of the map of slope moments.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/baselines/lean_moments.k"

layout(std140, binding = 3) uniform LeanPassBlock { LeanPass lean_pass; };
layout(binding = 1) uniform sampler2D mean_texture;
layout(binding = 2) uniform sampler2D square_texture; /* from level 1 on */
layout(binding = 0) writeonly uniform image2D mean_image;
layout(binding = 1) writeonly uniform image2D square_image;

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;

/* The moments of a texel of the next finer level. */
LeanMoments moments_at(ivec2 texel)
{
    vec2 mean = texelFetch(mean_texture, texel, lean_pass.level - 1).rg;
    if (lean_pass.level == 1)
        return point_moments(0, mean);
    return LeanMoments(mean, texelFetch(square_texture, texel, lean_pass.level - 2).rgb);
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int size = textureSize(mean_texture, lean_pass.level).x;
    if (texel.x >= size || texel.y >= size)
        return;
    ivec2 finer = 2 * texel;
    LeanMoments m = coarser_moments(0, moments_at(finer), moments_at(finer + ivec2(1, 0)), moments_at(finer + ivec2(0, 1)), moments_at(finer + ivec2(1)));
    imageStore(mean_image, texel, vec4(m.mean, 0.0f, 0.0f));
    imageStore(square_image, texel, vec4(m.square, 0.0f));
}
