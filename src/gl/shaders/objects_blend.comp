/* SPDX-License-Identifier: MIT
 *
 * Computes the mean of what a band's pixels see of objects at both ends of the shutter, if the camera moves.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/refraction/compose.k"

layout(std140, binding = 2) uniform PassBlock { PassData pass_data; };

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0, rgba32f) uniform image2D body_image;
layout(binding = 1, rgba32f) uniform image2D mirrored_image;
layout(binding = 2, rgba32f) uniform image2D front_image;
layout(binding = 5, rgba32f) uniform image2D clear_image;
layout(binding = 6, rgba32f) uniform image2D deep_image;
/* These show what the pixels saw when the shutter opened. */
layout(binding = 1) uniform sampler2D body_texture;
layout(binding = 2) uniform sampler2D mirrored_texture;
layout(binding = 3) uniform sampler2D front_texture;
layout(binding = 4) uniform sampler2D clear_texture;
layout(binding = 5) uniform sampler2D deep_texture;

vec4 light_of_both(vec4 closed, vec4 opened, float weight)
{
    return vec4(light_of_ends(0, closed.r, opened.r, weight), light_of_ends(0, closed.g, opened.g, weight), light_of_ends(0, closed.b, opened.b, weight),
                light_of_ends(0, closed.a, opened.a, weight));
}

/* Mean of the objects in front: their colour, and in alpha the fraction of the pixel that they cover. */
vec4 objects_of_both(vec4 closed, vec4 opened)
{
    return vec4(objects_of_ends(0, closed.r, opened.r, closed.a, opened.a), objects_of_ends(0, closed.g, opened.g, closed.a, opened.a),
                objects_of_ends(0, closed.b, opened.b, closed.a, opened.a), share_of_ends(0, closed.a, opened.a));
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    texel += ivec2(pass_data.tile_x * TILE_WIDTH - pass_data.area_x, pass_data.tile_y * TILE_HEIGHT - pass_data.area_y);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(pass_data.area_width, pass_data.area_height))))
        return;
    vec4 closed = imageLoad(front_image, texel), opened = texelFetch(front_texture, texel, 0);
    vec4 mirrored = imageLoad(mirrored_image, texel), mirrored_opened = texelFetch(mirrored_texture, texel, 0);
    float weight = opened_weight(0, water_is_known(0, closed.a, mirrored.a, pass_data.under), water_is_known(0, opened.a, mirrored_opened.a, pass_data.under));
    imageStore(body_image, texel, light_of_both(imageLoad(body_image, texel), texelFetch(body_texture, texel, 0), weight));
    imageStore(mirrored_image, texel, light_of_both(mirrored, mirrored_opened, weight));
    imageStore(clear_image, texel, light_of_both(imageLoad(clear_image, texel), texelFetch(clear_texture, texel, 0), weight));
    if (pass_data.under != 0) {
        vec4 deep = imageLoad(deep_image, texel), deep_opened = texelFetch(deep_texture, texel, 0);
        imageStore(deep_image, texel, light_of_both(deep, deep_opened, opened_weight(0, deep.a, deep_opened.a)));
    }
    imageStore(front_image, texel, objects_of_both(closed, opened));
}
