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

/* Radiance on the branches that are not traced. */
struct PlaceLight {
    vec3 color;
    float error;
};

/* The light that a pixel on an outline sees through another place of it. */
PlaceLight light_beside(PixelWater water, vec2 place)
{
    PlaceLight light = PlaceLight(vec3(0.0f), 0.0f);
    float part = 0.0f;
    water.hit = hit_beside(0, water.hit, water.variation, place);
    for (int branch = 0; branch < 2 && part < LEAST_WHOLE; branch++) {
        ThroughEnd through = end_through(water, branch);
        part = through.ray.part;
        light.color += part * shaded(through.end.triangle, through.end.ray);
        light.error = max(light.error, through.end.error);
    }
    return light;
}

void main()
{
    int pixel = listed_pixel(LIST_THROUGH);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    vec3 color = vec3(0.0f);
    float error = 0.0f, part = 0.0f;
    bool traced = false, doubtful = false;
    for (int branch = 0; branch < 2; branch++) {
        keep_ray(pixel, branch, TracedRay(vec3(0.0f), vec3(0.0f), 0.0f, 0.0f, 0.0f, false, 0.0f));
        if (!(part < LEAST_WHOLE))
            continue;
        ThroughEnd through = end_through(water, branch);
        part = through.ray.part;
        if (through.traced)
            keep_ray(pixel, branch, through.ray);
        else
            color += through.ray.part * shaded(through.end.triangle, through.end.ray);
        traced = traced || through.traced;
        doubtful = doubtful || (branch == 0 && through.doubtful);
        error = max(error, through.traced ? 0.0f : through.end.error);
    }
    if (traced) {
        keep_light(pixel, color);
        append(LIST_TRACED, pixel);
        return;
    }
    ivec2 image = image_of(water);
    bool edge = narrow_data.edge_rays > 0 && is_at_front(pixel), hidden = edge && is_hidden(image, water, vec2(0.0f));
    int rays = doubtful || hidden ? narrow_data.edge_rays : 0;
    PlaceLight beside = PlaceLight(vec3(0.0f), 0.0f);
    float seen = 0.0f;
    for (int i = 0; i < rays; i++) {
        if (edge && is_hidden(image, water, edge_ray(0, i)))
            continue;
        PlaceLight light = light_beside(water, edge_ray(0, i));
        beside.color += light.color;
        beside.error = max(beside.error, light.error);
        seen += 1.0f;
    }
    float centre = centre_weight(0, hidden, seen);
    color = (centre * color + beside.color) / (centre + seen);
    error = max(centre > 0.0f ? error : 0.0f, beside.error);
    ivec2 texel = texel_of_image(image);
    imageStore(body_image, texel, vec4(color, 1.0f));
    if (mirrors_all(water))
        imageStore(mirrored_image, texel, vec4(color, 1.0f));
    imageStore(error_image, texel, vec4(error));
}
