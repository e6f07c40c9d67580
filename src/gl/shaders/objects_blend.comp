/* SPDX-License-Identifier: MIT
 *
 * The mean of what a band's pixels see of objects at both ends of the shutter, where the camera moves.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/refraction/edges.k"

layout(std140, binding = 2) uniform PassBlock { PassData pass_data; };

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0, rgba32f) uniform image2D body_image;
layout(binding = 1, rgba32f) uniform image2D mirrored_image;
layout(binding = 2, rgba32f) uniform image2D front_image;
layout(binding = 5, rgba32f) uniform image2D clear_image;
layout(binding = 6, rgba32f) uniform image2D deep_image;
/* When the shutter opened. */
layout(binding = 1) uniform sampler2D body_texture;
layout(binding = 2) uniform sampler2D mirrored_texture;
layout(binding = 3) uniform sampler2D front_texture;
layout(binding = 4) uniform sampler2D clear_texture;
layout(binding = 5) uniform sampler2D deep_texture;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    texel += ivec2(pass_data.tile_x * TILE_WIDTH - pass_data.area_x, pass_data.tile_y * TILE_HEIGHT - pass_data.area_y);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(pass_data.area_width, pass_data.area_height))))
        return;
    vec4 close = imageLoad(front_image, texel), open = texelFetch(front_texture, texel, 0);
    float both = close.w + open.w;
    float share = opened_weight(0, close.w, open.w);
    imageStore(body_image, texel, mix(imageLoad(body_image, texel), texelFetch(body_texture, texel, 0), share));
    imageStore(mirrored_image, texel, mix(imageLoad(mirrored_image, texel), texelFetch(mirrored_texture, texel, 0), share));
    imageStore(clear_image, texel, mix(imageLoad(clear_image, texel), texelFetch(clear_texture, texel, 0), share));
    imageStore(deep_image, texel, mix(imageLoad(deep_image, texel), texelFetch(deep_texture, texel, 0), share));
    if (both > 0.0f)
        imageStore(front_image, texel, vec4((close.w * close.rgb + open.w * open.rgb) / both, 0.5f * both));
}
