/* SPDX-License-Identifier: MIT
 *
 * The filtered water in a pixel.
 */
#include "objects_pixel.glsl"
#include "kernels/refraction/water_seen.k"

/* The water at a place of the pixel, in pixels from its centre. */
PixelWater water_at(TilePixel where, vec2 place)
{
    PixelWater w;
    PixelRay p = pixel_ray_filtered(0, float(where.at.x) + place.x, float(where.at.y) + place.y);
    w.share = p.water;
    if (!(p.water > 0.0f))
        return w;
    SeenWater seen = seen_water(0, p.ray, pixel_estimate(where.at));
    w.hit.view = scale(seen.view, -1.0f);
    w.hit.along = seen.along * sqrt(length_squared(p.ray));
    w.hit.normal = seen.normal;
    w.hit.column = float(where.texel.x + pass_data.area_x) + place.x;
    w.hit.row = float(where.texel.y + pass_data.area_y) + place.y;
    w.variation = seen.variation;
    return w;
}
