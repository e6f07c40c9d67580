/* SPDX-License-Identifier: MIT
 *
 * One frame of method `taa`, as src/frame/taa.c has it: the picture is blended into a history that follows the camera and is clamped to what
 * the pixel's neighbours show now.
 */
#include "blend.glsl"

layout(binding = 4) uniform sampler2D history_color_texture;
layout(binding = 5) uniform sampler2D history_coverage_texture;
layout(binding = 6) uniform sampler2D history_water_texture;
layout(binding = 7) uniform sampler2D depth_texture; /* only where the camera moves */

BlendPixel pixel_of_history(ivec2 texel)
{
    return BlendPixel(texelFetch(history_color_texture, texel, 0).rgb,
                      texelFetch(history_coverage_texture, texel, 0).r, texelFetch(history_water_texture, texel, 0).r);
}

/* Where the history shows what the pixel shows now. */
struct HistoryPlace {
    vec2 at;
    bool known;
};

/* Waves carry no point along: water stays where it is. */
HistoryPlace history_place(ivec2 texel)
{
    if (blend_data.still != 0)
        return HistoryPlace(vec2(texel), true);
    vec3 ray = vec3(blend_data.ray_x, blend_data.ray_y, blend_data.ray_z);
    ray += float(texel.x) * vec3(blend_data.right_x, blend_data.right_y, blend_data.right_z);
    ray += float(texel.y) * vec3(blend_data.down_x, blend_data.down_y, blend_data.down_z);
    float far = min(texelFetch(depth_texture, texel, 0).r, 1e9f);
    vec3 point = vec3(blend_data.moved_x, blend_data.moved_y, blend_data.moved_z) + ray * (far / length(ray));
    float ahead = dot(vec3(blend_data.ahead_x, blend_data.ahead_y, blend_data.ahead_z), point);
    if (!(ahead > 0.0f))
        return HistoryPlace(vec2(0.0f), false);
    point /= ahead;
    vec2 at = vec2(dot(vec3(blend_data.column_x, blend_data.column_y, blend_data.column_z), point) - blend_data.first_column,
                   dot(vec3(blend_data.row_x, blend_data.row_y, blend_data.row_z), point) - blend_data.first_row);
    vec2 last = vec2(blend_size() - 1);
    bool inside = all(greaterThanEqual(at, vec2(-0.001f))) && all(lessThanEqual(at, last + 0.001f)); /* rounding */
    return HistoryPlace(clamp(at, vec2(0.0f), last), inside);
}

BlendPixel history_at(vec2 at)
{
    ivec2 first = ivec2(at), second = min(first + 1, blend_size() - 1);
    vec2 t = at - vec2(first);
    BlendPixel above = blend_mixed(0, pixel_of_history(first), pixel_of_history(ivec2(second.x, first.y)), t.x);
    BlendPixel below = blend_mixed(0, pixel_of_history(ivec2(first.x, second.y)), pixel_of_history(second), t.x);
    return blend_mixed(0, above, below, t.y);
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, blend_size())))
        return;
    BlendPixel now = pixel_of_current(texel);
    HistoryPlace place = history_place(texel);
    if (!place.known) {
        store_blend(texel, now);
        return;
    }
    BlendPixel least = now, most = now;
    for (int i = 0; i < 9; i++) {
        ivec2 near = clamp(texel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), blend_size() - 1);
        BlendPixel p = pixel_of_current(near);
        least = blend_least(0, least, p);
        most = blend_most(0, most, p);
    }
    BlendPixel past;
    if (blend_data.still != 0)
        past = pixel_of_history(texel);
    else
        past = history_at(place.at);
    store_blend(texel, taa_blend(0, now, past, least, most, blend_data.share));
}
