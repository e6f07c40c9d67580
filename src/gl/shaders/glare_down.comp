/* SPDX-License-Identifier: MIT
 *
 * One texel of D times the finer level.
 */
#include "glare.glsl"

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;
layout(binding = 0) writeonly uniform image2D coarse_image;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= glare_data.coarse_width || texel.y >= glare_data.coarse_height)
        return;
    vec4 across = glare_weights[glare_data.across + texel.x];
    vec4 down = glare_weights[glare_data.down + texel.y];
    ivec2 last = ivec2(glare_data.fine_width, glare_data.fine_height) - 1;
    vec3 sum = vec3(0.0f);
    for (int j = 0; j < 4; j++) {
        vec3 row = vec3(0.0f);
        for (int i = 0; i < 4; i++) {
            ivec2 at = clamp(2 * texel + ivec2(i, j) - 1, ivec2(0), last); /* what lies beyond an edge has no weight */
            row += across[i] * texelFetch(fine_texture, at, 0).rgb;
        }
        sum += down[j] * row;
    }
    imageStore(coarse_image, texel, vec4(sum, 1.0f));
}
