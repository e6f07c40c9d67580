/* SPDX-License-Identifier: MIT
 *
 * What the pixels of a band see of objects: through the water's surface, mirrored by it, and in front of it. The waves are filtered, at one instant.
 */
#define SHARED_WAVES
#define OBJECTS_PASS
#include "lattice_data.glsl"
#include "glitter.k"
#include "objects_data.glsl"
#include "narrow.k"
#include "material.k"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D body_image;     /* what comes through the surface */
layout(binding = 1) writeonly uniform image2D mirrored_image; /* what objects shine instead of what they hide of the sky, and how much that is */
layout(binding = 2) writeonly uniform image2D front_image;    /* what stands in front of water and sky, and its share of the pixel */
layout(binding = 3) writeonly uniform image2D surface_image;  /* its normal, and metres along the ray */
layout(binding = 4) writeonly uniform image2D error_image;    /* pixels that the point behind the surface is off by */
layout(binding = 5) writeonly uniform image2D clear_image;    /* under water: what it leaves of light from the surface, … */
layout(binding = 6) writeonly uniform image2D deep_image;     /* … and what it shines where it has none */

const float INFINITY = uintBitsToFloat(0x7f800000u);

/* ---- shading ---- */

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

vec3 shaded(int triangle, HitRay ray)
{
    if (triangle < 0)
        return shade_nothing(0, ray, sky_radiance(0, ray.direction));
    int object = int(texelFetch(owner_table, triangle).r);
    bool smooth_normals = material_texel(object, 2).w != 0.0f;
    return shade_hit(0, material_of(object), triangle_of(triangle, smooth_normals), ray);
}

/* ---- rays from the surface ---- */

struct PixelWater {
    WaterHit hit;
    vec3 slopes; /* covariance xx, xz, zz of those that the pixel does not resolve */
};

PixelWater pixel_water(PixelRay p, TilePixel where)
{
    SlopeState s = slope_state(0, p.ray, pixel_guess(where.at));
    vec2 slope = facing_slope(0, s.view, s.close);
    PixelWater w;
    w.hit.view = scale(s.view, -1.0f);
    w.hit.along = s.along * sqrt(length_squared(p.ray));
    w.hit.normal = normalize(vec3(-slope.x, 1.0f, -slope.y));
    w.hit.column = float(where.texel.x + pass_data.area_x);
    w.hit.row = float(where.texel.y + pass_data.area_y);
    w.slopes = vec3(s.variance_xx, s.variance_xz, s.variance_zz);
    return w;
}

/* `wet`: metres in water. */
HitRay ray_of(WaterHit hit, FoundPoint f, float wet, vec3 slopes)
{
    vec3 position = turned(0, f.position);
    HitRay r;
    r.position = vec3(position.x + narrow_data.foot_x, position.y, position.z + narrow_data.foot_z);
    r.direction = turned(0, f.direction);
    r.before = hit.along;
    r.after = f.after;
    r.water = wet;
    r.slope_xx = slopes.x;
    r.slope_xz = slopes.y;
    r.slope_zz = slopes.z;
    return r;
}

int found_triangle(int layer, FoundPoint f)
{
    return f.shown > 0.0f ? layer_triangle(layer, ivec2(int(f.column), int(f.row))) : -1;
}

/* Method `broad` knows the mean surface alone, `off` looks straight through. */
WaterHit surface_of_method(WaterHit hit)
{
    if (narrow_data.method != 3)
        return hit;
    hit.along = narrow_data.distance / max(-hit.view.y, 1e-6f);
    hit.normal = vec3(0.0f, 1.0f, 0.0f);
    return hit;
}

struct Through {
    vec3 color;
    float error;
};

Through seen_through(PixelWater w)
{
    WaterHit hit = surface_of_method(w.hit);
    Bent bent = bent_at(0, hit.view, hit.normal);
    if (narrow_data.method == 7)
        bent = Bent(hit.view, 0.0f);
    bool total = bent.total > 0.0f;
    FoundPoint f;
    if (total)
        f = find_mirrored(0, hit);
    else
        f = find_refracted(0, hit, bent);
    float wet = narrow_data.side > 0.0f ? f.after : hit.along + (total ? f.after : 0.0f);
    Through t;
    t.color = shaded(found_triangle(total ? 1 : 0, f), ray_of(hit, f, wet, w.slopes));
    t.error = f.residual < 1e28f ? f.residual : INFINITY;
    return t;
}

vec4 seen_mirrored(PixelWater w)
{
    if (objects_data.mirrors == 0)
        return vec4(0.0f);
    FoundPoint f = find_mirrored(0, w.hit);
    int triangle = found_triangle(1, f);
    if (triangle < 0 && narrow_data.side > 0.0f)
        return vec4(0.0f);
    return vec4(shaded(triangle, ray_of(w.hit, f, narrow_data.side > 0.0f ? 0.0f : w.hit.along + f.after, vec3(0.0f))), 1.0f);
}

/* ---- in front of the water ---- */

struct Front {
    vec4 color; /* and share */
    vec4 surface;
};

Front seen_in_front(TilePixel where, float water_along)
{
    Front f = Front(vec4(0.0f), vec4(0.0f, 0.0f, 0.0f, INFINITY));
    ivec2 image = where.texel + ivec2(pass_data.area_x, pass_data.area_y);
    ivec2 at = image + ivec2(int(narrow_data.left), int(narrow_data.top));
    int triangle = texelFetch(near_triangle, at, 0).r;
    if (triangle < 0)
        return f;
    vec3 ray = turned(0, layer_ray(0, float(image.x), float(image.y)));
    float depth = objects_data.least_depth / texelFetch(near_depth, at, 0).r;
    float size = sqrt(length_squared(ray)), along = depth * size;
    if (along >= water_along)
        return f;
    vec3 camera = vec3(narrow_data.foot_x, narrow_data.distance * narrow_data.side, narrow_data.foot_z);
    HitRay r;
    r.position = camera + ray * depth;
    r.direction = ray / size;
    r.before = along;
    r.after = 0.0f;
    r.water = narrow_data.side > 0.0f ? 0.0f : along;
    r.slope_xx = 0.0f;
    r.slope_xz = 0.0f;
    r.slope_zz = 0.0f;
    vec3 normal = texelFetch(plane_table, triangle).xyz;
    f.color = vec4(shaded(triangle, r), 1.0f);
    f.surface = vec4(dot(normal, ray) > 0.0f ? -normal : normal, along);
    return f;
}

/* ---- under water ---- */

vec3 clear_water(float along)
{
    return exp(-along * vec3(shade_data.absorption_r + shade_data.scattering_r, shade_data.absorption_g + shade_data.scattering_g,
                             shade_data.absorption_b + shade_data.scattering_b));
}

vec3 deep_water(TilePixel where)
{
    vec3 ray = turned(0, layer_ray(0, float(where.texel.x + pass_data.area_x), float(where.texel.y + pass_data.area_y)));
    HitRay r;
    r.position = vec3(0.0f);
    r.direction = normalize(ray);
    r.direction.y = min(r.direction.y, -1e-6f);
    r.before = 0.0f;
    r.after = 0.0f;
    r.water = 0.0f;
    r.slope_xx = 0.0f;
    r.slope_xz = 0.0f;
    r.slope_zz = 0.0f;
    return shaded(-1, r);
}

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    PixelRay p = pixel_ray_filtered(0, float(pixel.at.x), float(pixel.at.y));
    Through through = Through(vec3(0.0f), 0.0f);
    vec4 mirrored = vec4(0.0f);
    Front front;
    float surface = 0.0f;
    if (p.water > 0.0f) {
        PixelWater water = pixel_water(p, pixel);
        surface = water.hit.along;
        front = seen_in_front(pixel, water.hit.along);
        if (front.color.w == 0.0f) {
            through = seen_through(water);
            mirrored = seen_mirrored(water);
        }
    } else {
        front = seen_in_front(pixel, INFINITY);
    }
    imageStore(body_image, pixel.texel, vec4(through.color, 1.0f));
    imageStore(mirrored_image, pixel.texel, mirrored);
    imageStore(front_image, pixel.texel, front.color);
    imageStore(surface_image, pixel.texel, front.surface);
    imageStore(error_image, pixel.texel, vec4(through.error));
    if (FRAME(0).camera_under == 0)
        return;
    imageStore(clear_image, pixel.texel, vec4(clear_water(surface), 1.0f));
    imageStore(deep_image, pixel.texel, vec4(p.water < 1.0f ? deep_water(pixel) : vec3(0.0f), 1.0f));
}
