/* SPDX-License-Identifier: MIT
 *
 * Adds the coarser level to a level of the pyramid: keep · level + gain · U · coarser level.
 */
#include "glare.glsl"

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;
layout(binding = 0, rgba32f) uniform image2D fine_image;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= glare_data.fine_width || texel.y >= glare_data.fine_height)
        return;
    vec3 own = imageLoad(fine_image, texel).rgb;
    imageStore(fine_image, texel, vec4(glare_data.keep * own + glare_data.gain * glare_up(texel), 1.0f));
}
