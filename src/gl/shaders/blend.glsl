/* SPDX-License-Identifier: MIT
 *
 * What methods that work on whole pictures read and write: color, coverage and mask of the current picture, and those of their own.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/display/blend.k"

layout(std140, binding = 3) uniform BlendBlock { BlendData blend_data; };
layout(binding = 1) uniform sampler2D color_texture;
layout(binding = 2) uniform sampler2D coverage_texture;
layout(binding = 3) uniform sampler2D water_texture;

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;
layout(binding = 0) writeonly uniform image2D color_image;
layout(binding = 1) writeonly uniform image2D coverage_image;
layout(binding = 2) writeonly uniform image2D water_image;

ivec2 blend_size() { return ivec2(blend_data.width, blend_data.height); }

BlendPixel pixel_of_current(ivec2 texel)
{
    return BlendPixel(texelFetch(color_texture, texel, 0).rgb, texelFetch(coverage_texture, texel, 0).r, texelFetch(water_texture, texel, 0).r);
}

/* A store to a layer that does not exist has no effect. */
void store_blend(ivec2 texel, BlendPixel p)
{
    imageStore(color_image, texel, vec4(p.color, 1.0f));
    imageStore(coverage_image, texel, vec4(p.coverage));
    imageStore(water_image, texel, vec4(p.water));
}
