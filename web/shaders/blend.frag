/* SPDX-License-Identifier: MIT
 *
 * A frame of method `taa` into its history, before a camera that stands still.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/display/blend.k"

precision highp sampler2D;
uniform sampler2D current_texture;
uniform sampler2D history_texture;
uniform float weight; /* of the newest frame; 1: there is no history */
layout(location = 0) out vec4 shown;

BlendPixel pixel_of(vec4 v)
{
    BlendPixel p;
    p.color = v.rgb;
    p.coverage = v.a;
    p.water = 0.0f;
    return p;
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(current_texture, 0) - 1;
    BlendPixel now = pixel_of(texelFetch(current_texture, texel, 0));
    BlendPixel least = now, most = now;
    for (int i = 0; i < 9; i++) {
        BlendPixel p = pixel_of(texelFetch(current_texture, clamp(texel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last), 0));
        least = blend_least(0, least, p);
        most = blend_most(0, most, p);
    }
    BlendPixel mixed_pixel = now;
    if (weight < 1.0f)
        mixed_pixel = taa_blend(0, now, pixel_of(texelFetch(history_texture, texel, 0)), least, most, weight);
    shown = vec4(mixed_pixel.color, mixed_pixel.coverage);
}
