/* SPDX-License-Identifier: MIT
 *
 * Luma of the displayed picture before glare, in which method `fxaa` finds edges.
 */
#include "glare.glsl"
#include "kernels/common/types.k"

layout(std140, binding = 0) uniform FrameBlock { FrameData frame_data; };
#define FRAME(cx) frame_data

#include "kernels/display/tone.k"

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;
layout(binding = 0) writeonly uniform image2D luma_image;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x < glare_data.fine_width && texel.y < glare_data.fine_height)
        imageStore(luma_image, texel, vec4(display_luma(0, display_color(0, texelFetch(fine_texture, texel, 0).rgb, FRAME(0).tone_map))));
}
