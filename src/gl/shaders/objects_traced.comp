/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface at their centres, along rays that are traced.
 */
#define OBJECTS_PASS
#include "gl_data.glsl"
#include "objects_tracing.glsl"

layout(local_size_x = LIST_GROUP) in;
layout(binding = 0) writeonly uniform image2D body_image;  /* as in objects_through.glsl */
layout(binding = 4) writeonly uniform image2D error_image;

void main()
{
    int pixel = listed_pixel(LIST_TRACED);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    RayEnd end = end_traced(water);
    ivec2 texel = texel_of_image(image_of(water));
    imageStore(body_image, texel, vec4(shaded(end.triangle, end.ray), 1.0f));
    imageStore(error_image, texel, vec4(end.error));
}
