/* SPDX-License-Identifier: MIT
 *
 * Copies a layer to a texture of the host. The texture may have any format.
 */
#include "glare.glsl"

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;
layout(binding = 0) writeonly uniform image2D host_image;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x < glare_data.fine_width && texel.y < glare_data.fine_height)
        imageStore(host_image, texel, texelFetch(fine_texture, texel + ivec2(glare_data.across, glare_data.down), 0));
}
