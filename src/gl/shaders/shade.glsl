/* SPDX-License-Identifier: MIT
 *
 * A filtered method over the pixels of a band. Define METHOD_STATE, method_state and method_result before.
 */
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D color_image;
layout(binding = 1) writeonly uniform image2D coverage_image;
layout(binding = 2) writeonly uniform image2D water_image;
layout(binding = 3) writeonly uniform image2D depth_image;

PixelResult nothing_but_sky(PixelRay p)
{
    PixelResult result;
    result.color = FRAME(0).want_color != 0 ? background(0, p.sky_ray) : vec3(0.0f);
    result.coverage = 0.0f;
    result.water = 0.0f;
    return result;
}

PixelResult water_and_sky(PixelRay p, TilePixel where)
{
    ivec2 pixel = where.at;
    METHOD_STATE close = method_state(0, p.ray, pixel_guess(pixel));
    if (pass_data.write_depth != 0)
        imageStore(depth_image, where.texel, vec4(close.along * sqrt(length_squared(p.ray))));
    METHOD_STATE open = close;
    if (pass_data.open_slots != 0) {
        tile_slot += pass_data.open_slots;
        open = method_state(0, pixel_ray_filtered(0, float(pixel.x), float(pixel.y)).ray, pixel_guess(pixel));
        tile_slot -= pass_data.open_slots;
    }
    return method_result(0, p, open, close);
}

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    PixelRay p = pixel_ray_filtered(0, float(pixel.at.x), float(pixel.at.y));
    PixelResult result;
    if (p.water > 0.0f)
        result = water_and_sky(p, pixel);
    else
        result = nothing_but_sky(p);
    if (FRAME(0).want_color != 0)
        imageStore(color_image, pixel.texel, vec4(result.color, 1.0f));
    imageStore(coverage_image, pixel.texel, vec4(result.coverage));
    imageStore(water_image, pixel.texel, vec4(result.water));
}
