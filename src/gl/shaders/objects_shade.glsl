/* SPDX-License-Identifier: MIT
 *
 * Rays that end on objects or nowhere, and their light.
 */
#include "objects_pixel.glsl"
#include "kernels/sky/sky.k"
#undef SEARCH_WAVE
#define SEARCH_WAVE(cx, i) caustic_wave(i)
#include "kernels/refraction/material.k"

/* Whether the surface reflects totally, so that it mirrors all the light that the pixel's ray finds. */
bool mirrors_all(PixelWater water) { return objects_data.mirrors != 0 && bent_by_method(0, surface_of_method(0, water.hit)).total > 0.0f; }

struct RayEnd {
    int triangle;
    HitRay ray;
    float error;
    bool counts; /* false: there is nothing to shade */
};

/* A ray behind the surface, from the last point at which it met the surface. */
struct TracedRay {
    vec3 from, direction;
    float way;    /* length of the path from the pixel's hit to `from`, metres */
    float wet;    /* metres of `way` in water */
    float part;   /* fraction of the pixel's light */
    bool total;   /* it is on the camera's side */
    float unsure; /* SeenBehind.unsure */
};

int ray_place(int pixel, int branch) { return WATER_FLOATS * pixel + WATER_RAYS + RAY_FLOATS * branch; }

/* The ray of a branch. If the branch is not traced, its `part` is 0. */
TracedRay known_ray(int pixel, int branch)
{
    int i = ray_place(pixel, branch);
    TracedRay r;
    r.from = vec3(water_data[i], water_data[i + 1], water_data[i + 2]);
    r.direction = vec3(water_data[i + 3], water_data[i + 4], water_data[i + 5]);
    r.way = water_data[i + 6];
    r.wet = water_data[i + 7];
    r.part = water_data[i + 8];
    r.total = water_data[i + 9] > 0.0f;
    r.unsure = water_data[i + 10];
    return r;
}

vec3 known_light(int pixel)
{
    int i = WATER_FLOATS * pixel + WATER_LIGHT;
    return vec3(water_data[i], water_data[i + 1], water_data[i + 2]);
}

#ifdef LISTS_GROW
void keep_ray(int pixel, int branch, TracedRay r)
{
    int i = ray_place(pixel, branch);
    for (int k = 0; k < 3; k++) {
        water_data[i + k] = r.from[k];
        water_data[i + 3 + k] = r.direction[k];
    }
    water_data[i + 6] = r.way;
    water_data[i + 7] = r.wet;
    water_data[i + 8] = r.part;
    water_data[i + 9] = r.total ? 1.0f : 0.0f;
    water_data[i + 10] = r.unsure;
}

void keep_light(int pixel, vec3 color)
{
    for (int k = 0; k < 3; k++)
        water_data[WATER_FLOATS * pixel + WATER_LIGHT + k] = color[k];
}
#endif

HitMaterial material_of(int object)
{
    vec4 a = material_texel(object, 0), b = material_texel(object, 1), c = material_texel(object, 2), d = material_texel(object, 3);
    HitMaterial m;
    m.base = a.xyz;
    m.alpha = a.w;
    m.metallic = c.x;
    m.kind = b.w;
    m.color = b.xyz;
    m.inverse_size = c.y;
    m.joint = c.z;
    m.texture = float(object);
    m.texture_width = d.x;
    m.texture_height = d.y;
    return m;
}

HitTriangle triangle_of(int triangle, bool smooth_normals)
{
    ivec3 corner = triangle_corners(triangle);
    vec4 a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = texelFetch(vertex_table, 2 * corner[i]);
        b[i] = smooth_normals ? texelFetch(vertex_table, 2 * corner[i] + 1) : vec4(0.0f, 0.0f, 0.0f, texelFetch(vertex_table, 2 * corner[i] + 1).w);
    }
    HitTriangle t;
    t.corner = a[0].xyz;
    t.edge_1 = a[1].xyz - a[0].xyz;
    t.edge_2 = a[2].xyz - a[0].xyz;
    t.normal_0 = b[0].xyz;
    t.normal_1 = b[1].xyz;
    t.normal_2 = b[2].xyz;
    t.texcoord_0 = vec2(a[0].w, b[0].w);
    t.texcoord_1 = vec2(a[1].w, b[1].w);
    t.texcoord_2 = vec2(a[2].w, b[2].w);
    return t;
}

RayFootprint footprint_behind(WaterHit hit, Bent bent, WaterVariation variation, float after)
{
    vec3 f = spread_after(0, turned_spread(0, spread_of(0, hit, bent, variation)), after);
    return RayFootprint(f.x, f.y, f.z);
}

/* Completes an end whose `after` is measured from r.from. `bent` is the ray as the surface bends it at the pixel's hit. */
RayEnd end_behind(RayEnd end, PixelWater w, TracedRay r, Bent bent)
{
    end.ray.before = w.hit.along;
    end.ray.water = metres_in_water(0, narrow_data.side, w.hit.along, end.ray.after, r.total) + r.wet;
    end.ray.after += r.way;
    end.ray.footprint = footprint_behind(w.hit, bent, w.variation, end.ray.after);
    end.ray.gain = gain_behind(0, narrow_data.gain, r.total);
    return end;
}

vec3 shaded(int triangle, HitRay ray)
{
    if (triangle < 0)
        return shade_nothing(0, ray, sky_radiance(0, ray.direction));
    int object = object_of(triangle);
    bool smooth_normals = material_texel(object, 2).w != 0.0f;
    return shade_hit(0, material_of(object), triangle_of(triangle, smooth_normals), ray);
}
