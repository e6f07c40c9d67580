/* SPDX-License-Identifier: MIT
 *
 * Shades objects in front of the water. The front layer holds what the centre of each pixel sees. At edges and along waterlines, rays through eight places of
 * the pixel follow the surfaces of the triangles that the pixel and its neighbours see, and are tested against the plane of the water.
 */
#define OBJECTS_PASS
#include "gl_data.glsl"
#include "objects_shade.glsl"

layout(local_size_x = LIST_GROUP) in;
layout(binding = 2) writeonly uniform image2D front_image;   /* colour of objects in front of water and sky, and the fraction of the pixel that they cover */
layout(binding = 3) writeonly uniform image2D surface_image; /* its normal, and metres along the ray */

/* What the pixel's ray through `place` meets in front of the water. */
RayEnd end_in_front(ivec2 image, PixelWater w, bool edge, vec2 place)
{
    vec3 ray = camera_ray(image, place);
    FrontHit hit = edge ? hit_at_edge(image, place, ray) : FrontHit(front_triangle_at(front_texel(image)), front_depth_at(front_texel(image)));
    RayEnd end;
    end.triangle = hit.triangle;
    float along = hit.along;
    float size = sqrt(length_squared(ray));
    end.ray.position = camera_position() + ray * along;
    end.ray.direction = ray / size;
    end.ray.before = along * size;
    end.ray.after = 0.0f;
    end.ray.water = narrow_data.side > 0.0f ? 0.0f : along * size;
    if (end.triangle >= 0 && is_inside_dry(0, end.ray.position.y, dry_level(end.triangle, ray)))
        end.ray.water = IN_DRY_HULL;
    end.ray.footprint = edge ? place_footprint(0, along * size, shade_data.pixel_angle) : straight_footprint(0, along * size, shade_data.pixel_angle);
    end.ray.gain = 1.0f;
    end.error = 0.0f;
    end.counts = end.triangle >= 0 && is_in_front(end.triangle, along, w, ray);
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
    vec4 surface = vec4(0.0f, 0.0f, 0.0f, INFINITE);
    for (int i = 0; i < (edge ? EDGE_PLACES : 1); i++) {
        RayEnd end = end_in_front(image, water, edge, edge ? edge_place(0, i) : vec2(0.0f));
        if (!end.counts)
            continue;
        vec3 normal = texelFetch(plane_table, end.triangle).xyz;
        color += shaded(end.triangle, end.ray);
        met += 1.0f;
        surface = vec4(dot(normal, end.ray.direction) > 0.0f ? -normal : normal, end.ray.before);
    }
    ivec2 texel = texel_of_image(image);
    float share = met / float(edge ? EDGE_PLACES : 1);
    imageStore(front_image, texel, vec4(color / max(met, 1.0f), share));
    imageStore(surface_image, texel, share < FRONT_SHOWS ? vec4(surface.xyz, INFINITE) : surface);
}
