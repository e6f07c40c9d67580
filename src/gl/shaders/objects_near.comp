/* SPDX-License-Identifier: MIT
 *
 * Pixels that see objects in front of the water. The near layer knows what the centre of each pixel sees. At edges and along waterlines eight places of
 * the pixel ask the triangles that it and its neighbours see, and the surface's plane.
 */
#define OBJECTS_PASS
#include "gl_data.glsl"
#include "objects_shade.glsl"

layout(local_size_x = LIST_GROUP) in;
layout(binding = 2) writeonly uniform image2D front_image;   /* what stands in front of water and sky, and its share of the pixel */
layout(binding = 3) writeonly uniform image2D surface_image; /* its normal, and metres along the ray */

const int PLACES = 8;

vec2 edge_place(int i)
{
    const float rows[PLACES] = float[PLACES](-1.0f, 5.0f, -5.0f, 3.0f, -7.0f, 7.0f, 1.0f, -3.0f);
    return vec2(float(2 * i - 7), rows[i]) * 0.0625f;
}

/* Whether the place lies between two pixels that both see something: then it does, too, even if it meets none of the tiny triangles at hand. */
bool between_objects(ivec2 at, vec2 place)
{
    ivec2 step = abs(place.x) > abs(place.y) ? ivec2(place.x > 0.0f ? 1 : -1, 0) : ivec2(0, place.y > 0.0f ? 1 : -1);
    return near_triangle_at(at) >= 0 && near_triangle_at(at + step) >= 0;
}

RayEnd end_in_front(ivec2 image, PixelWater w, bool edge, vec2 place)
{
    ivec2 at = near_texel(image);
    vec3 ray = camera_ray(image, place);
    float along = INFINITY;
    RayEnd end;
    end.triangle = -1;
    for (int i = 0; edge && i < 9; i++) {
        int triangle = near_triangle_at(at + ivec2(i % 3 - 1, i / 3 - 1));
        float met = triangle >= 0 ? meet_triangle(triangle, camera_position(), ray) : INFINITY;
        if (met < along) {
            along = met;
            end.triangle = triangle;
        }
    }
    if (end.triangle < 0 && (!edge || between_objects(at, place))) {
        end.triangle = near_triangle_at(at);
        along = near_depth_at(at);
    }
    float size = sqrt(length_squared(ray));
    end.ray.position = camera_position() + ray * along;
    end.ray.direction = ray / size;
    end.ray.before = along * size;
    end.ray.after = 0.0f;
    end.ray.water = narrow_data.side > 0.0f ? 0.0f : along * size;
    end.ray.footprint = straight_footprint(0, along * size, shade_data.pixel_angle);
    end.ray.gain = 1.0f;
    end.error = 0.0f;
    end.counts = end.triangle >= 0 && along < meet_water(w, ray);
    return end;
}

void main()
{
    bool edge = pass_data.edges != 0;
    int pixel = listed_pixel(edge ? LIST_EDGES : LIST_FRONT);
    if (pixel < 0)
        return;
    PixelWater water = known_water(pixel);
    ivec2 image = image_of(water);
    float met = 0.0f;
    vec3 color = vec3(0.0f);
    vec4 surface = vec4(0.0f, 0.0f, 0.0f, INFINITY);
    for (int i = 0; i < (edge ? PLACES : 1); i++) {
        RayEnd end = end_in_front(image, water, edge, edge ? edge_place(i) : vec2(0.0f));
        if (!end.counts)
            continue;
        vec3 normal = texelFetch(plane_table, end.triangle).xyz;
        color += shaded(end.triangle, end.ray);
        met += 1.0f;
        surface = vec4(dot(normal, end.ray.direction) > 0.0f ? -normal : normal, end.ray.before);
    }
    ivec2 texel = texel_of_image(image);
    float share = met / float(edge ? PLACES : 1);
    imageStore(front_image, texel, vec4(color / max(met, 1.0f), share));
    imageStore(surface_image, texel, share < 0.5f ? vec4(surface.xyz, INFINITY) : surface);
}
