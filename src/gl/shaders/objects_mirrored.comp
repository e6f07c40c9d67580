/* SPDX-License-Identifier: MIT
 *
 * Radiance that the surface mirrors of objects and, under water, of the water.
 */
#define OBJECTS_PASS
#include "gl_data.glsl"
#include "objects_behind.glsl"

layout(local_size_x = LIST_GROUP) in;
layout(binding = 1) writeonly uniform image2D mirrored_image; /* radiance that replaces the mirrored sky, and the fraction of the sky that it replaces */

void main()
{
    int pixel = listed_pixel(LIST_THROUGH);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    if (mirrors_all(water))
        return;
    vec4 mirrored = seen_mirrored(water);
    if (mirrored.a > 0.0f)
        imageStore(mirrored_image, texel_of_image(image_of(water)), mirrored);
}
