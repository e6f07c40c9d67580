/* SPDX-License-Identifier: MIT
 *
 * Draws objects in front of water and sky over the layers of a band.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/refraction/compose.k"

layout(std140, binding = 2) uniform PassBlock { PassData pass_data; };

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0, rgba32f) uniform image2D color_image;
layout(binding = 1, r32f) uniform image2D coverage_image;
layout(binding = 2, r32f) uniform image2D water_image;
layout(binding = 3) writeonly uniform image2D depth_image;
layout(binding = 4) writeonly uniform image2D normal_image;
layout(binding = 5) writeonly uniform image2D body_image;
layout(binding = 6) writeonly uniform image2D error_image;
layout(binding = 7, r32f) uniform image2D foam_image;
layout(binding = 1) uniform sampler2D front_texture;
layout(binding = 2) uniform sampler2D surface_texture;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    texel += ivec2(pass_data.tile_x * TILE_WIDTH - pass_data.area_x, pass_data.tile_y * TILE_HEIGHT - pass_data.area_y);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(pass_data.area_width, pass_data.area_height))))
        return;
    vec4 front = texelFetch(front_texture, texel, 0);
    if (!(front.w > 0.0f))
        return;
    vec3 behind = imageLoad(color_image, texel).rgb;
    imageStore(color_image, texel, vec4(put_before(0, behind.r, front.r, front.w), put_before(0, behind.g, front.g, front.w), put_before(0, behind.b, front.b, front.w), 1.0f));
    imageStore(coverage_image, texel, vec4(left_behind(0, imageLoad(coverage_image, texel).r, front.w)));
    float water = imageLoad(water_image, texel).r;
    imageStore(water_image, texel, vec4(pass_data.front_shows != 0 ? put_before(0, water, 1.0f, front.w) : left_behind(0, water, front.w)));
    if (pass_data.write_foam != 0)
        imageStore(foam_image, texel, vec4(left_behind(0, imageLoad(foam_image, texel).r, front.w)));
    /* Depth and normal are those of the instant at which the shutter closes. Shares may be means over the shutter. */
    vec4 surface = texelFetch(surface_texture, texel, 0);
    if (!(surface.w < INFINITE))
        return;
    imageStore(depth_image, texel, vec4(surface.w));
    imageStore(normal_image, texel, vec4(surface.xyz, 1.0f));
    /* The layers of refraction show water alone. */
    imageStore(body_image, texel, vec4(0.0f, 0.0f, 0.0f, 1.0f));
    imageStore(error_image, texel, vec4(0.0f));
}
