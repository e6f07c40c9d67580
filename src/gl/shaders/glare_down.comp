/* SPDX-License-Identifier: MIT
 *
 * Computes a level of the pyramid: D times the next finer level.
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
    vec3 sum = vec3(0.0f);
    for (int j = 0; j < 4; j++) {
        vec3 row = vec3(0.0f);
        for (int i = 0; i < 4; i++) {
            ivec2 at = ivec2(glare_finer(0, texel.x, i, glare_data.fine_width), glare_finer(0, texel.y, j, glare_data.fine_height));
            row += across[i] * texelFetch(fine_texture, at, 0).rgb;
        }
        sum += down[j] * row;
    }
    imageStore(coarse_image, texel, vec4(sum, 1.0f));
}
