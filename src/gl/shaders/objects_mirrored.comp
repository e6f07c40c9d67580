/* SPDX-License-Identifier: MIT
 *
 * What the surface mirrors of objects and, under water, of the water.
 */
#define OBJECTS_PASS
#include "gl_data.glsl"
#include "objects_behind.glsl"

layout(local_size_x = 64) in;
layout(binding = 1) writeonly uniform image2D mirrored_image; /* what objects shine instead of what they hide of the sky, and how much that is */

void main()
{
    int pixel = listed_pixel(LIST_THROUGH);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    Bent bent = Bent(mirrored_by_mean(0, water.hit.view, water.hit.normal), 1.0f);
    FoundPoint f = find_mirrored(0, water.hit, bent.direction);
    bool above = narrow_data.side > 0.0f;
    int triangle = f.shown > 0.0f ? layer_triangle(1, ivec2(int(f.column), int(f.row))) : -1;
    if (triangle < 0 && above)
        return;
    HitRay ray = ray_of(water.hit, f, above ? 0.0f : water.hit.along + f.after);
    ray.footprint = footprint_behind(water.hit, bent, water.variation, f.after);
    vec3 color = shaded(triangle, ray);
    imageStore(mirrored_image, texel_of_image(image_of(water)), vec4(color, 1.0f));
}
