/* SPDX-License-Identifier: MIT
 *
 * Methods that shade a pixel from its slopes; method.k is the method's kernel, method_result its function, but for
 * `mangata`, which sees the whole shutter in one state.
 */
#include "web_data.glsl"
#ifdef LEAN_MAP
#include "lean_map.glsl"
#endif
#include "method.k"
#include "kernels/glitter/foam_over.k"
#ifndef method_result
#define method_result(cx, p, open, close) glitter_result(cx, p, close)
#endif

layout(location = 0) out vec4 shown;

vec4 hit_result(ivec2 pixel)
{
    PixelRay p = pixel_ray_filtered(0, float(pixel.x), float(pixel.y));
    if (!(p.water > 0.0f))
        return vec4(background(0, p.sky_ray), 0.0f);
    SlopeState state = slope_state(0, p.ray, pixel_estimate(pixel));
    PixelResult result = over_state(0, method_result(0, p, state, state), p, state);
    return vec4(result.color, result.coverage);
}

void main()
{
    ivec2 pixel = enter_pixel();
    int hits = int(TILE(0).hit_rows);
    vec4 sum = vec4(0.0f);
    for (int hit = 0; hit < hits; hit++)
        sum += hit_result(ivec2(pixel.x, pixel.y * hits + hit));
    shown = sum / float(hits);
}
