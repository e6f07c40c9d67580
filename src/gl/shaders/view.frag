/* SPDX-License-Identifier: MIT
 *
 * Draws the layers of a view into the host's framebuffer: premultiplied colour, and the depth of the first hit.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
#include "pass_data.k"

layout(std140, binding = 0) uniform FrameBlock { FrameData frame_data; };
layout(std140, binding = 3) uniform WindowBlock { WindowData window_data; };
#define FRAME(cx) frame_data

#include "kernels/display/tone.k"

layout(binding = 1) uniform sampler2D color_texture;
layout(binding = 2) uniform sampler2D water_texture;
layout(binding = 3) uniform sampler2D depth_texture;

/* This replaces gl_FragCoord, which some drivers turn upside down if the default framebuffer and others take turns. */
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 shown;

float srgb_decode(float encoded) { return encoded <= 0.04045f ? encoded / 12.92f : pow((encoded + 0.055f) / 1.055f, 2.4f); }

vec3 host_color(vec3 radiance)
{
    if (window_data.color == HOST_COLOR_RADIANCE)
        return radiance;
    if (window_data.color == HOST_COLOR_EXPOSED)
        return radiance * FRAME(0).exposure;
    vec3 display = display_color(0, radiance, FRAME(0).tone_map);
    return window_data.encodes != 0 ? vec3(srgb_decode(display.x), srgb_decode(display.y), srgb_decode(display.z)) : display;
}

/* Depth in the host's depth buffer of a point `metres` along the pixel's ray; infinity is allowed. */
float window_depth(ivec2 texel, float metres)
{
    vec2 at = vec2(texel);
    vec3 ray = vec3(window_data.ray_x, window_data.ray_y, window_data.ray_z);
    ray += at.x * vec3(window_data.right_x, window_data.right_y, window_data.right_z);
    ray += at.y * vec3(window_data.down_x, window_data.down_y, window_data.down_z);
    float clip = window_data.clip_depth + at.x * window_data.clip_depth_x + at.y * window_data.clip_depth_y;
    clip += window_data.clip_offset * length(ray) / metres; /* 0 at infinity */
    return clamp(clip * window_data.depth_scale + window_data.depth_offset, window_data.depth_low, window_data.depth_high);
}

void main()
{
    ivec2 size = ivec2(window_data.width, window_data.height);
    ivec2 texel = clamp(ivec2(floor(place * vec2(size))), ivec2(0), size - 1);
    float water = clamp(texelFetch(water_texture, texel, 0).r, 0.0f, 1.0f);
    float alpha = window_data.draw_sky != 0 ? 1.0f : water;
    if (alpha <= 0.0f)
        discard;
    vec3 radiance = texelFetch(color_texture, texel, 0).rgb;
    shown = vec4(host_color(radiance / alpha) * alpha, alpha);
    float metres = water > 0.0f ? texelFetch(depth_texture, texel, 0).r : INFINITE;
    gl_FragDepth = window_depth(texel, metres);
}
