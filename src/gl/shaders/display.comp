/* SPDX-License-Identifier: MIT
 *
 * Computes the displayed colour: glare, exposure, tone map, sRGB.
 */
#include "glare.glsl"
#include "kernels/common/types.k"

layout(std140, binding = 0) uniform FrameBlock { FrameData frame_data; };
#define FRAME(cx) frame_data

#include "kernels/display/tone.k"

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;
layout(binding = 0) writeonly uniform image2D display_image;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= glare_data.fine_width || texel.y >= glare_data.fine_height)
        return;
    vec3 radiance = texelFetch(fine_texture, texel, 0).rgb;
    if (glare_data.coarse_width > 0)
        radiance = glare_data.keep * radiance + glare_data.gain * glare_up(texel);
    vec3 shown = display_color(0, radiance, FRAME(0).tone_map);
    imageStore(display_image, texel, vec4(vec3(display_code(0, shown.x), display_code(0, shown.y), display_code(0, shown.z)) / 255.0f, 1.0f));
}
