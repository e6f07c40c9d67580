/* SPDX-License-Identifier: MIT
 *
 * One frame of method `taa`, as in src/frame/taa.c. The picture is blended into a history, which is reprojected for the camera's movement and clamped to the
 * range of the pixel's neighbours in the picture.
 */
#include "blend.glsl"
#include "kernels/display/reproject.k"

layout(binding = 4) uniform sampler2D history_color_texture;
layout(binding = 5) uniform sampler2D history_coverage_texture;
layout(binding = 6) uniform sampler2D history_water_texture;
layout(binding = 7) uniform sampler2D depth_texture; /* only where the camera moves */

BlendPixel pixel_of_history(ivec2 texel)
{
    return BlendPixel(texelFetch(history_color_texture, texel, 0).rgb,
                      texelFetch(history_coverage_texture, texel, 0).r, texelFetch(history_water_texture, texel, 0).r);
}

BlendPixel history_at(vec2 at)
{
    ivec2 first = ivec2(at), second = min(first + 1, blend_size() - 1);
    vec2 t = at - vec2(first);
    BlendPixel above = blend_lerp(0, pixel_of_history(first), pixel_of_history(ivec2(second.x, first.y)), t.x);
    BlendPixel below = blend_lerp(0, pixel_of_history(ivec2(first.x, second.y)), pixel_of_history(second), t.x);
    return blend_lerp(0, above, below, t.y);
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, blend_size())))
        return;
    BlendPixel now = pixel_of_current(texel);
    BlendPixel past;
    if (blend_data.still != 0) {
        past = pixel_of_history(texel);
    } else {
        /* Waves carry no point along, so the point seen is at rest. */
        ReprojectedPixel at = reproject(0, blend_data.history, float(blend_data.width), float(blend_data.height), float(texel.x), float(texel.y),
                                        texelFetch(depth_texture, texel, 0).r);
        if (!at.inside) {
            store_blend(texel, now);
            return;
        }
        past = history_at(vec2(at.column, at.row));
    }
    BlendPixel least = now, most = now;
    for (int i = 0; i < 9; i++) {
        ivec2 near = clamp(texel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), blend_size() - 1);
        BlendPixel p = pixel_of_current(near);
        least = blend_least(0, least, p);
        most = blend_most(0, most, p);
    }
    store_blend(texel, taa_blend(0, now, past, least, most, blend_data.share));
}
