/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface, through several places of each.
 */
#define SHARED_WAVES
#define OBJECTS_PASS
#include "lattice_data.glsl"
#include "glitter.k"
#include "objects_water.glsl"
#include "objects_through.glsl"

void main()
{
    int pixel = listed_pixel(LIST_THROUGH);
    if (pixel < 0)
        return;
    ivec2 texel = texel_of_image(image_of(known_water(pixel)));
    tile_slot = pixel / (TILE_WIDTH * TILE_HEIGHT);
    TilePixel where = TilePixel(ivec2(pixel % TILE_WIDTH, pixel / TILE_WIDTH % TILE_HEIGHT), texel, true);
    int places = objects_data.places;
    float seen = 0.0f, error = 0.0f;
    vec3 color = vec3(0.0f);
    for (int i = 0; i < places * places; i++) {
        PixelWater water = water_at(where, (vec2(float(i % places), float(i / places)) + 0.5f) / float(places) - 0.5f);
        if (!(water.share > 0.0f))
            continue;
        RayEnd end = end_through(water);
        color += shaded(end.triangle, end.ray);
        error = max(error, end.error);
        seen += 1.0f;
    }
    imageStore(body_image, texel, vec4(color / max(seen, 1.0f), 1.0f));
    imageStore(error_image, texel, vec4(error));
}
