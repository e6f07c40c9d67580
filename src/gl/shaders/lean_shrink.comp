/* SPDX-License-Identifier: MIT
 *
 * The next coarser level of the map of slope moments.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"

layout(std140, binding = 3) uniform LeanPassBlock { LeanPass lean_pass; };
layout(binding = 1) uniform sampler2D mean_texture;
layout(binding = 2) uniform sampler2D square_texture; /* from level 1 on */
layout(binding = 0) writeonly uniform image2D mean_image;
layout(binding = 1) writeonly uniform image2D square_image;

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;

vec3 square_of(ivec2 texel, vec2 mean)
{
    if (lean_pass.level == 1)
        return vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y);
    return texelFetch(square_texture, texel, lean_pass.level - 2).rgb;
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int size = textureSize(mean_texture, lean_pass.level).x;
    if (texel.x >= size || texel.y >= size)
        return;
    vec2 mean = vec2(0.0f);
    vec3 square = vec3(0.0f);
    for (int i = 0; i < 4; i++) {
        ivec2 finer = 2 * texel + ivec2(i & 1, i >> 1);
        vec2 slope = texelFetch(mean_texture, finer, lean_pass.level - 1).rg;
        mean += slope;
        square += square_of(finer, slope);
    }
    imageStore(mean_image, texel, vec4(0.25f * mean, 0.0f, 0.0f));
    imageStore(square_image, texel, vec4(0.25f * square, 0.0f));
}
