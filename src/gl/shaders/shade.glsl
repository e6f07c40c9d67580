/* SPDX-License-Identifier: MIT
 *
 * A filtered method over the pixels of a band. Define METHOD_STATE, method_state and method_result before.
 */
layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;
layout(binding = 0, rgba32f) uniform image2D color_image;
layout(binding = 1, r32f) uniform image2D coverage_image;
layout(binding = 2, r32f) uniform image2D water_image;
layout(binding = 3) writeonly uniform image2D depth_image;

PixelResult nothing_but_sky(PixelRay p)
{
    PixelResult result;
    result.color = FRAME(0).want_color != 0 ? background(0, p.sky_ray) : vec3(0.0f);
    result.coverage = 0.0f;
    result.water = 0.0f;
    return result;
}

/* `pixel`: the column and the row of the hit. */
PixelResult water_and_sky(PixelRay p, ivec2 pixel, ivec2 texel)
{
    METHOD_STATE close = method_state(0, p.ray, pixel_estimate(pixel));
    if (pass_data.write_depth != 0)
        imageStore(depth_image, texel, vec4(close.along * sqrt(length_squared(p.ray))));
    METHOD_STATE open = close;
    if (pass_data.open_slots != 0) {
        tile_slot += pass_data.open_slots;
        open = method_state(0, pixel_ray_filtered(0, float(pixel.x), float(pixel.y)).ray, pixel_estimate(pixel));
        tile_slot -= pass_data.open_slots;
    }
    return method_result(0, p, open, close);
}

PixelResult hit_result(ivec2 pixel, ivec2 texel)
{
    PixelRay p = pixel_ray_filtered(0, float(pixel.x), float(pixel.y));
    if (p.water > 0.0f)
        return water_and_sky(p, pixel, texel);
    return nothing_but_sky(p);
}

/* A part of the shutter, and what the layers hold of those before. */
PixelResult part_of_mean(PixelResult result, ivec2 texel)
{
    result.color *= pass_data.weight;
    result.coverage *= pass_data.weight;
    result.water *= pass_data.weight;
    if (pass_data.clear == 0) {
        if (FRAME(0).want_color != 0)
            result.color += imageLoad(color_image, texel).rgb;
        result.coverage += imageLoad(coverage_image, texel).r;
        result.water += imageLoad(water_image, texel).r;
    }
    return result;
}

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    int hits = int(TILE(0).hit_rows);
    PixelResult result = PixelResult(vec3(0.0f), 0.0f, 0.0f);
    for (int hit = 0; hit < hits; hit++) {
        PixelResult shown = hit_result(ivec2(pixel.at.x, first_row(pixel.at.y) + hit), pixel.texel);
        result.color += shown.color;
        result.coverage += shown.coverage;
        result.water += shown.water;
    }
    if (hits > 1) {
        result.color /= float(hits);
        result.coverage /= float(hits);
        result.water /= float(hits);
    }
    if (pass_data.weight != 1.0f)
        result = part_of_mean(result, pixel.texel);
    if (FRAME(0).want_color != 0)
        imageStore(color_image, pixel.texel, vec4(result.color, 1.0f));
    imageStore(coverage_image, pixel.texel, vec4(result.coverage));
    imageStore(water_image, pixel.texel, vec4(result.water));
}
