/* SPDX-License-Identifier: MIT
 *
 * Radiance of the water in pixels that see no surface, for a camera under water.
 */
#define OBJECTS_PASS
#include "gl_data.glsl"
#include "objects_pixel.glsl"
#include "kernels/sky/sky.k"
#undef SEARCH_WAVE
#define SEARCH_WAVE(cx, i) caustic_wave(i)
#include "kernels/refraction/material.k"

layout(local_size_x = LIST_GROUP) in;
layout(binding = 6) writeonly uniform image2D deep_image;

void main()
{
    int pixel = listed_pixel(LIST_DEEP);
    if (pixel < 0)
        return;
    ivec2 image = image_of(known_water(pixel));
    HitRay ray = HitRay(vec3(0.0f), normalize(camera_ray(image, vec2(0.0f))), 0.0f, 0.0f, 0.0f, RayFootprint(0.0f, 0.0f, 0.0f), 1.0f);
    ray.direction.y = min(ray.direction.y, -1e-6f);
    imageStore(deep_image, texel_of_image(image), vec4(shade_nothing(0, ray, sky_radiance(0, ray.direction)), 1.0f));
}
