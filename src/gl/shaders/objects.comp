/* SPDX-License-Identifier: MIT
 *
 * Finds the filtered water over the shutter in the pixels of a band, and lists the pixels by the way in which they see objects.
 */
#define WEIGHTED_WAVES
#define OBJECTS_PASS
#define LISTS_GROW
#include "lattice_data.glsl"
#include "kernels/glitter/glitter.k"
#include "objects_water.glsl"
#include "kernels/refraction/water_path.k"

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0) writeonly uniform image2D body_image;
layout(binding = 1) writeonly uniform image2D mirrored_image;
layout(binding = 2) writeonly uniform image2D front_image;
layout(binding = 3) writeonly uniform image2D surface_image;
layout(binding = 4) writeonly uniform image2D error_image;
layout(binding = 5) writeonly uniform image2D clear_image; /* fraction of the light's disk that gets through objects and water */
layout(binding = 6) writeonly uniform image2D deep_image;

/* Fraction of the light's disk that objects and, for a camera under water, the water before the surface let through. */
vec3 clear_to_light(PixelWater w)
{
    vec3 at = vec3(narrow_data.foot_x, 0.0f, narrow_data.foot_z);
    if (w.share > 0.0f)
        at += w.hit.along * vec3(w.hit.view.x, 0.0f, w.hit.view.z);
    bool wet = w.share > 0.0f && narrow_data.side < 0.0f;
    return disk_through_water(0, shadow_at_point(0, at, false), wet ? w.hit.along : 0.0f);
}

/* Whether two texels of the front layer show the same surface, or both show nothing. */
bool are_like(ivec2 a, ivec2 b)
{
    int s = front_triangle_at(a), t = front_triangle_at(b);
    if (s == t)
        return true;
    if (s < 0 || t < 0)
        return false;
    vec3 here = texelFetch(plane_table, s).xyz, there = texelFetch(plane_table, t).xyz;
    return surface_goes_on(0, object_of(s) == object_of(t), here, there, front_depth_at(a), front_depth_at(b));
}

/* Whether the pixel sees an edge of an object in front, or a waterline. */
bool is_edge(ivec2 image, PixelWater w)
{
    ivec2 at = front_texel(image);
    if (!are_like(at, at - ivec2(1, 0)) || !are_like(at, at + ivec2(1, 0)) || !are_like(at, at - ivec2(0, 1)) || !are_like(at, at + ivec2(0, 1)))
        return true;
    if (front_triangle_at(at) < 0 || !(w.share > 0.0f))
        return false;
    float object = front_depth_at(at) * sqrt(length_squared(camera_ray(image, vec2(0.0f))));
    return front_waterline(0, object, w.hit.along, w.hit.view.y, FRAME(0).pixel_angle);
}

void keep_water(int pixel, PixelWater w)
{
    int i = WATER_FLOATS * pixel;
    water_data[i] = w.share;
    water_data[i + 1] = w.hit.view.x;
    water_data[i + 2] = w.hit.view.y;
    water_data[i + 3] = w.hit.view.z;
    water_data[i + 4] = w.hit.along;
    water_data[i + 5] = w.hit.normal.x;
    water_data[i + 6] = w.hit.normal.y;
    water_data[i + 7] = w.hit.normal.z;
    water_data[i + 8] = w.variation.bend_xx;
    water_data[i + 9] = w.variation.bend_xz;
    water_data[i + 10] = w.variation.bend_zz;
    water_data[i + 11] = w.variation.path.x;
    water_data[i + 12] = w.variation.path.y;
    water_data[i + 13] = w.variation.path_along;
    water_data[i + 14] = w.variation.variance_xx;
    water_data[i + 15] = w.variation.variance_xz;
    water_data[i + 16] = w.variation.variance_zz;
}

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    int number = tile_slot * TILE_PIXELS + pixel.at.y * TILE_WIDTH + pixel.at.x;
    ivec2 image = pixel.texel + ivec2(pass_data.area_x, pass_data.area_y);
    PixelWater water = water_at(pixel, vec2(0.0f));
    keep_water(number, water);
    imageStore(clear_image, pixel.texel, vec4(clear_to_light(water), 1.0f));
    imageStore(body_image, pixel.texel, vec4(0.0f, 0.0f, 0.0f, 1.0f));
    imageStore(mirrored_image, pixel.texel, vec4(0.0f));
    imageStore(front_image, pixel.texel, vec4(0.0f));
    imageStore(surface_image, pixel.texel, vec4(0.0f, 0.0f, 0.0f, INFINITE));
    imageStore(error_image, pixel.texel, vec4(0.0f));
    imageStore(deep_image, pixel.texel, vec4(0.0f));
    bool edge = is_edge(image, water), front = false;
    if (!edge && front_triangle_at(front_texel(image)) >= 0)
        front = is_in_front(front_triangle_at(front_texel(image)), front_depth_at(front_texel(image)), water, camera_ray(image, vec2(0.0f)));
    if (edge)
        append(LIST_EDGES, number);
    if (front)
        append(LIST_FRONT, number);
    bool through = water.share > 0.0f && !front;
    water_data[WATER_FLOATS * number + WATER_THROUGH] = !through ? 0.0f : edge ? 2.0f : 1.0f;
    if (through)
        append(LIST_THROUGH, number);
    if (narrow_data.side < 0.0f && water.share < 1.0f)
        append(LIST_DEEP, number);
}
