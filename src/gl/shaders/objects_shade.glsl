/* SPDX-License-Identifier: MIT
 *
 * Rays that end on objects or nowhere, and their light.
 */
#include "objects_pixel.glsl"
#include "kernels/sky/sky.k"
#undef SEARCH_WAVE
#define SEARCH_WAVE(cx, i) caustic_wave(i)
#include "kernels/refraction/material.k"

/* Radiance at the camera over that behind the surface; `total`: it is mirrored there. */
float gain_behind(bool total)
{
    float squared = shade_data.index * shade_data.index;
    return total ? 1.0f : narrow_data.side > 0.0f ? 1.0f / squared : squared;
}

struct RayEnd {
    int triangle;
    HitRay ray;
    float error;
    bool counts; /* false: there is nothing to shade */
};

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

vec3 shaded(int triangle, HitRay ray)
{
    if (triangle < 0)
        return shade_nothing(0, ray, sky_radiance(0, ray.direction));
    int object = int(texelFetch(owner_table, triangle).r);
    bool smooth_normals = material_texel(object, 2).w != 0.0f;
    return shade_hit(0, material_of(object), triangle_of(triangle, smooth_normals), ray);
}
