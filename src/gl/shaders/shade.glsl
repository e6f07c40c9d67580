/* SPDX-License-Identifier: MIT
 *
 * Shades the pixels of a band by a filtered method. Before including this file, define CACHES_TILE, include lattice_data.glsl, and define METHOD_STATE,
 * state_where() and method_result.
 */
layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0, rgba32f) uniform image2D color_image;
layout(binding = 1, r32f) uniform image2D coverage_image;
layout(binding = 2, r32f) uniform image2D water_image;
layout(binding = 3) writeonly uniform image2D depth_image;

float wet_hits = 0.0f; /* number of the pixel's hits that met water */
float nearness = 0.0f; /* sum of 1/distance of these hits, 1/metres; it is linear over the screen */

PixelResult nothing_but_sky(PixelRay p)
{
    PixelResult result;
    result.color = FRAME(0).want_color != 0 ? background(0, p.sky_ray) : vec3(0.0f);
    result.coverage = 0.0f;
    result.water = 0.0f;
    result.foam = 0.0f;
    return result;
}

void turn_to(int slot)
{
    tile_slot = slot;
    enter_tile(GROUP_PIXELS);
}

/* The result of one hit of a pixel. `pixel` is the pixel's column and the row of the hit, `middle` the row of the pixel's centre among the hits. The whole
 * workgroup must call it, because state_where() may wait for all invocations. */
PixelResult hit_result(ivec2 pixel, float middle, bool inside)
{
    PixelRay p = pixel_ray_filtered(0, float(pixel.x), float(pixel.y));
    bool water = inside && p.water > 0.0f;
    METHOD_STATE close, open;
    int cameras = pass_data.open_slots != 0 ? 2 : 1;
    for (int camera = 0; camera < cameras; camera++) { /* a loop, so that compilers build its body once */
        if (camera > 0)
            turn_to(tile_slot + pass_data.open_slots);
        open = state_where(water, pixel_ray_filtered(0, float(pixel.x), float(pixel.y)).ray, pixel);
        if (camera == 0)
            close = open;
    }
    if (cameras > 1)
        turn_to(tile_slot - pass_data.open_slots);
    if (!water)
        return nothing_but_sky(p);
    wet_hits += 1.0f;
    nearness += nearness_beside(0, p.ray, close.along, close.close, pixel_ray_at(0, float(pixel.x), middle));
#ifdef OVER_STATE
    return over_state(0, method_result(0, p, open, close), p, close);
#else
    return method_result(0, p, open, close);
#endif
}

/* The weighted result of a part of the shutter, added to what the layers hold of the parts before it. */
PixelResult part_of_mean(PixelResult result, ivec2 texel)
{
    result.color *= pass_data.weight;
    result.coverage *= pass_data.weight;
    result.water *= pass_data.weight;
    result.foam *= pass_data.weight;
    if (pass_data.clear == 0) {
        if (FRAME(0).want_color != 0)
            result.color += imageLoad(color_image, texel).rgb;
        result.coverage += imageLoad(coverage_image, texel).r;
        result.water += imageLoad(water_image, texel).r;
        result.foam += stored_foam(texel);
    }
    return result;
}

void main()
{
    TilePixel pixel = tile_pixel();
    turn_to(tile_slot);
    int hits = int(TILE(0).hit_rows);
    PixelResult result = PixelResult(vec3(0.0f), 0.0f, 0.0f, 0.0f);
    float middle = float(first_row(pixel.at.y)) + 0.5f * float(hits - 1);
    for (int hit = 0; hit < hits; hit++) {
        PixelResult shown = hit_result(ivec2(pixel.at.x, first_row(pixel.at.y) + hit), middle, pixel.inside);
        result.color += shown.color;
        result.coverage += shown.coverage;
        result.water += shown.water;
        result.foam += shown.foam;
    }
    if (!pixel.inside)
        return;
    if (pass_data.write_depth != 0 && wet_hits > 0.0f)
        imageStore(depth_image, pixel.texel, vec4(wet_hits / nearness));
    if (hits > 1) {
        result.color /= float(hits);
        result.coverage /= float(hits);
        result.water /= float(hits);
        result.foam /= float(hits);
    }
    if (pass_data.weight != 1.0f)
        result = part_of_mean(result, pixel.texel);
    if (FRAME(0).want_color != 0)
        imageStore(color_image, pixel.texel, vec4(result.color, 1.0f));
    imageStore(coverage_image, pixel.texel, vec4(result.coverage));
    imageStore(water_image, pixel.texel, vec4(result.water));
    store_foam(pixel.texel, result.foam);
}
