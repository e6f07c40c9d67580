/* SPDX-License-Identifier: MIT
 *
 * Displayed colour of two pictures side by side: left of the wipe the first, right of it the second.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
layout(std140) uniform FrameBlock { FrameData frame_data; };
#define FRAME(cx) frame_data
#include "kernels/display/tone.k"

precision highp sampler2D;
uniform sampler2D first_texture;
uniform sampler2D second_texture;
uniform vec2 window; /* of the canvas, pixels */
uniform float wipe;  /* pixels from its left edge; none where it is below 0 */
layout(location = 0) out vec4 shown;

vec3 picture_at(sampler2D picture, vec2 place)
{
    ivec2 size = textureSize(picture, 0);
    if (vec2(size) == window)
        return display_color(0, texelFetch(picture, ivec2(place), 0).rgb, FRAME(0).tone_map);
    vec2 at = place / window * vec2(size) - 0.5f;
    ivec2 low = ivec2(floor(at)), last = size - 1;
    vec2 t = at - vec2(low);
    vec3 c[4];
    for (int i = 0; i < 4; i++)
        c[i] = display_color(0, texelFetch(picture, clamp(low + ivec2(i & 1, i >> 1), ivec2(0), last), 0).rgb, FRAME(0).tone_map);
    return mix(mix(c[0], c[1], t.x), mix(c[2], c[3], t.x), t.y);
}

void main()
{
    vec2 place = vec2(gl_FragCoord.x, window.y - gl_FragCoord.y);
    vec3 color = vec3(0.0f);
    if (wipe >= 0.0f && place.x >= wipe)
        color = picture_at(second_texture, place);
    else
        color = picture_at(first_texture, place);
    float near = wipe < 0.0f ? 0.0f : clamp(1.5f - abs(place.x - wipe), 0.0f, 1.0f);
    color = mix(color, vec3(0.93f, 0.9f, 0.82f), 0.8f * near);
    shown = vec4(vec3(display_code(0, color.x), display_code(0, color.y), display_code(0, color.z)) / 255.0f, 1.0f);
}
