/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface at their centres, along rays that are traced.
 */
#define OBJECTS_PASS
#include "gl_data.glsl"
#include "objects_tracing.glsl"

layout(local_size_x = LIST_GROUP) in;
layout(binding = 1) writeonly uniform image2D mirrored_image; /* as in objects_mirrored.comp */
layout(binding = 0) writeonly uniform image2D body_image;  /* as in objects_through.glsl */
layout(binding = 4) writeonly uniform image2D error_image;

void main()
{
    int pixel = listed_pixel(LIST_TRACED);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    vec3 color = known_light(pixel);
    float error = 0.0f;
    for (int branch = 0; branch < 2; branch++) {
        TracedRay ray = known_ray(pixel, branch);
        if (!(ray.part > 0.0f))
            continue;
        RayEnd end = end_traced(water, ray);
        color += ray.part * shaded(end.triangle, end.ray);
        error = max(error, end.error);
    }
    ivec2 texel = texel_of_image(image_of(water));
    imageStore(body_image, texel, vec4(color, 1.0f));
    if (mirrors_all(water))
        imageStore(mirrored_image, texel, vec4(color, 1.0f));
    imageStore(error_image, texel, vec4(error));
}
