/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface at their centres.
 */
#define OBJECTS_PASS
#define LISTS_GROW
#include "gl_data.glsl"
#include "objects_through.glsl"

layout(local_size_x = LIST_GROUP) in;
layout(binding = 1) writeonly uniform image2D mirrored_image; /* as in objects_mirrored.comp */

void main()
{
    int pixel = listed_pixel(LIST_THROUGH);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    vec3 color = vec3(0.0f);
    float error = 0.0f, part = 0.0f;
    bool traced = false;
    for (int branch = 0; branch < 2; branch++) {
        keep_ray(pixel, branch, TracedRay(vec3(0.0f), vec3(0.0f), 0.0f, 0.0f, 0.0f, false));
        if (!(part < LEAST_WHOLE))
            continue;
        ThroughEnd through = end_through(water, branch);
        part = through.ray.part;
        if (through.traced)
            keep_ray(pixel, branch, through.ray);
        else
            color += through.ray.part * shaded(through.end.triangle, through.end.ray);
        traced = traced || through.traced;
        error = max(error, through.traced ? 0.0f : through.end.error);
    }
    if (traced) {
        keep_light(pixel, color);
        append(LIST_TRACED, pixel);
        return;
    }
    ivec2 texel = texel_of_image(image_of(water));
    imageStore(body_image, texel, vec4(color, 1.0f));
    if (mirrors_all(water))
        imageStore(mirrored_image, texel, vec4(color, 1.0f));
    imageStore(error_image, texel, vec4(error));
}
