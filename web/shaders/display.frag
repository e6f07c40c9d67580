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
uniform int wipe;    /* columns of the first picture */
uniform vec2 texels; /* of a picture over pixels of the canvas, each way */
layout(location = 0) out vec4 shown;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy * texels);
    at.y = textureSize(first_texture, 0).y - 1 - at.y;
    vec3 color = vec3(0.0f);
    if (at.x < wipe)
        color = texelFetch(first_texture, at, 0).rgb;
    else
        color = texelFetch(second_texture, at, 0).rgb;
    color = display_color(0, color, FRAME(0).tone_map);
    shown = vec4(vec3(display_code(0, color.x), display_code(0, color.y), display_code(0, color.z)) / 255.0f, 1.0f);
}
