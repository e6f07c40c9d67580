/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface at their centres.
 */
#define OBJECTS_PASS
#define LISTS_GROW
#include "gl_data.glsl"
#include "objects_through.glsl"

layout(local_size_x = LIST_GROUP) in;

void main()
{
    int pixel = listed_pixel(LIST_THROUGH);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    ThroughEnd through = end_through(water);
    if (through.traced) {
        append(LIST_TRACED, pixel);
        return;
    }
    ivec2 texel = texel_of_image(image_of(water));
    imageStore(body_image, texel, vec4(shaded(through.end.triangle, through.end.ray), 1.0f));
    imageStore(error_image, texel, vec4(through.end.error));
}
