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
layout(binding = 5) writeonly uniform image2D clear_image;    /* what objects and water leave of the light's disk */
layout(binding = 6) writeonly uniform image2D deep_image;     /* under water: what it shines where it has no surface */

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

/* ---- the surface ---- */

struct PixelWater {
    float share; /* of the pixel; 0: the rest is not set */
    WaterHit hit;
    vec3 slopes; /* covariance xx, xz, zz of those that the pixel does not resolve */
};

/* Through a place of the pixel, from its centre. */
PixelWater water_at(TilePixel where, vec2 place)
{
    PixelWater w;
    PixelRay p = pixel_ray_filtered(0, float(where.at.x) + place.x, float(where.at.y) + place.y);
    w.share = p.water;
    if (!(p.water > 0.0f))
        return w;
    SlopeState s = slope_state(0, p.ray, pixel_guess(where.at));
    vec2 slope = facing_slope(0, s.view, s.close);
    w.hit.view = scale(s.view, -1.0f);
    w.hit.along = s.along * sqrt(length_squared(p.ray));
    w.hit.normal = normalize(vec3(-slope.x, 1.0f, -slope.y));
    w.hit.column = float(where.texel.x + pass_data.area_x) + place.x;
    w.hit.row = float(where.texel.y + pass_data.area_y) + place.y;
    w.slopes = vec3(s.variance_xx, s.variance_xz, s.variance_zz);
    return w;
}

/* What objects, and under water the way from the surface, leave of the light's disk. */
vec3 clear_to_light(PixelWater w)
{
    vec3 at = vec3(narrow_data.foot_x, 0.0f, narrow_data.foot_z);
    if (!(w.share > 0.0f))
        return vec3(SUN_SHARE(0, at));
    float lit = SUN_SHARE(0, at + w.hit.along * vec3(w.hit.view.x, 0.0f, w.hit.view.z));
    if (narrow_data.side > 0.0f)
        return vec3(lit);
    return lit * exp(-w.hit.along * vec3(shade_data.absorption_r + shade_data.scattering_r, shade_data.absorption_g + shade_data.scattering_g,
                                         shade_data.absorption_b + shade_data.scattering_b));
}

/* ---- rays and where they end ---- */

struct RayEnd {
    int triangle;
    HitRay ray;
    float error;
    bool counts; /* false: there is nothing to shade */
};

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

/* Method `broad` knows the mean surface alone, `off` looks straight through. */
WaterHit surface_of_method(WaterHit hit)
{
    if (narrow_data.method != 3)
        return hit;
    hit.along = narrow_data.distance / max(-hit.view.y, 1e-6f);
    hit.normal = vec3(0.0f, 1.0f, 0.0f);
    return hit;
}

/* Through the surface, or what it mirrors of the camera's own side. */
RayEnd end_behind(PixelWater w, bool mirrors)
{
    WaterHit hit = w.hit;
    if (!mirrors)
        hit = surface_of_method(hit);
    Bent bent = bent_at(0, hit.view, hit.normal);
    if (narrow_data.method == 7)
        bent = Bent(hit.view, 0.0f);
    bool back = mirrors || bent.total > 0.0f;
    FoundPoint f;
    if (back)
        f = find_mirrored(0, hit);
    else
        f = find_refracted(0, hit, bent);
    bool above = narrow_data.side > 0.0f;
    float wet = above ? (mirrors ? 0.0f : f.after) : hit.along + (back ? f.after : 0.0f);
    RayEnd end;
    end.triangle = f.shown > 0.0f ? layer_triangle(back ? 1 : 0, ivec2(int(f.column), int(f.row))) : -1;
    end.ray = ray_of(hit, f, wet, mirrors ? vec3(0.0f) : w.slopes);
    end.error = f.residual < 1e28f ? f.residual : INFINITY;
    end.counts = !mirrors || end.triangle >= 0 || !above;
    return end;
}

vec3 camera_ray(ivec2 image, vec2 place) { return turned(0, layer_ray(0, float(image.x) + place.x, float(image.y) + place.y)); }

vec3 camera_position() { return vec3(narrow_data.foot_x, narrow_data.distance * narrow_data.side, narrow_data.foot_z); }

/* Under water without a surface. */
RayEnd end_in_deep(ivec2 image)
{
    RayEnd end;
    end.triangle = -1;
    end.ray = HitRay(vec3(0.0f), normalize(camera_ray(image, vec2(0.0f))), 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
    end.ray.direction.y = min(end.ray.direction.y, -1e-6f);
    end.error = 0.0f;
    end.counts = true;
    return end;
}

/* ---- in front of the water ----
 * The near layer knows what the centre of each pixel sees. At edges and along waterlines eight places of the pixel ask the triangles that it and its
 * neighbours see, and the surface's plane. */

const int PLACES = 8;

vec2 edge_place(int i)
{
    const float rows[PLACES] = float[PLACES](-1.0f, 5.0f, -5.0f, 3.0f, -7.0f, 7.0f, 1.0f, -3.0f);
    return vec2(float(2 * i - 7), rows[i]) * 0.0625f;
}

ivec2 near_texel(ivec2 image) { return image + ivec2(int(narrow_data.left), int(narrow_data.top)); }

int near_triangle_at(ivec2 at) { return texelFetch(near_triangle, at, 0).r; }

float near_depth_at(ivec2 at) { return objects_data.least_depth / texelFetch(near_depth, at, 0).r; }

bool are_like(ivec2 a, ivec2 b)
{
    int s = near_triangle_at(a), t = near_triangle_at(b);
    if (s == t)
        return true;
    if (s < 0 || t < 0)
        return false;
    bool level = abs(dot(texelFetch(plane_table, s).xyz, texelFetch(plane_table, t).xyz)) > 0.9f;
    float depth = near_depth_at(a);
    return level && abs(depth - near_depth_at(b)) < 0.05f * depth;
}

bool is_edge(ivec2 image, PixelWater w)
{
    ivec2 at = near_texel(image);
    if (!are_like(at, at - ivec2(1, 0)) || !are_like(at, at + ivec2(1, 0)) || !are_like(at, at - ivec2(0, 1)) || !are_like(at, at + ivec2(0, 1)))
        return true;
    if (near_triangle_at(at) < 0 || !(w.share > 0.0f))
        return false;
    /* A waterline: within a pixel or two the object may be on the other side of the surface. */
    float object = near_depth_at(at) * sqrt(length_squared(camera_ray(image, vec2(0.0f))));
    float pixel = w.hit.along * FRAME(0).pixel_angle / max(-w.hit.view.y, 0.02f);
    return abs(object - w.hit.along) < 2.0f * pixel;
}

/* Multiple of the camera's ray at which it meets a triangle. */
float meet_triangle(int triangle, vec3 ray)
{
    ivec3 corner = triangle_corners(triangle);
    vec3 p = texelFetch(vertex_table, 2 * corner.x).xyz;
    vec3 e1 = texelFetch(vertex_table, 2 * corner.y).xyz - p, e2 = texelFetch(vertex_table, 2 * corner.z).xyz - p;
    vec3 from = camera_position() - p, across = cross(ray, e2), around = cross(from, e1);
    float det = dot(e1, across);
    if (det == 0.0f)
        return INFINITY;
    float u = dot(from, across) / det, v = dot(ray, around) / det, along = dot(e2, around) / det;
    return u >= 0.0f && v >= 0.0f && u + v <= 1.0f && along > 0.0f ? along : INFINITY;
}

/* … and at which it meets the plane of the surface in the pixel. */
float meet_water(PixelWater w, vec3 ray)
{
    if (!(w.share > 0.0f))
        return INFINITY;
    vec3 normal = turned(0, w.hit.normal);
    float closing = dot(normal, ray);
    return closing < 0.0f ? w.hit.along * dot(normal, turned(0, w.hit.view)) / closing : INFINITY;
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
        float met = triangle >= 0 ? meet_triangle(triangle, ray) : INFINITY;
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
    end.ray.slope_xx = 0.0f;
    end.ray.slope_xz = 0.0f;
    end.ray.slope_zz = 0.0f;
    end.error = 0.0f;
    end.counts = end.triangle >= 0 && along < meet_water(w, ray);
    return end;
}

/* ---- all ---- */

/* What a pixel sees, one ray after the other: shaders hold the code of every call, so that there is but one of each. */
const int CENTRE = 0; /* the surface at the pixel's centre, where nothing is shaded, */
const int FRONT = 1;  /* … PLACES rays to what is in front, … */
const int MIRRORED = FRONT + PLACES;
const int DEEP = MIRRORED + 1;
const int THROUGH = DEEP + 1; /* … and places × places rays through the surface */

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    ivec2 image = pixel.texel + ivec2(pass_data.area_x, pass_data.area_y);
    PixelWater centre, water;
    bool edge = false, under = narrow_data.side < 0.0f;
    float seen = 0.0f, in_front = 0.0f, error = 0.0f;
    vec3 body = vec3(0.0f), front = vec3(0.0f), deep = vec3(0.0f);
    vec4 mirrored = vec4(0.0f), surface = vec4(0.0f, 0.0f, 0.0f, INFINITY);
    int last = THROUGH + objects_data.places * objects_data.places;
    for (int i = CENTRE; i < last; i++) {
        bool place = i >= THROUGH && objects_data.places > 1;
        if (i == CENTRE || place) {
            int k = i - THROUGH;
            vec2 offset = (vec2(float(k % objects_data.places), float(k / objects_data.places)) + 0.5f) / float(objects_data.places) - 0.5f;
            water = water_at(pixel, place ? offset : vec2(0.0f));
        }
        if (i == CENTRE) {
            centre = water;
            edge = is_edge(image, centre);
            continue;
        }
        RayEnd end;
        end.counts = false;
        if (i < MIRRORED) {
            if (i == FRONT || edge)
                end = end_in_front(image, centre, edge, edge ? edge_place(i - FRONT) : vec2(0.0f));
        } else if (i == DEEP) {
            if (under && centre.share < 1.0f)
                end = end_in_deep(image);
        } else if (water.share > 0.0f && in_front < (edge ? float(PLACES) : 1.0f) && (i != MIRRORED || objects_data.mirrors != 0)) {
            end = end_behind(water, i == MIRRORED);
        }
        if (!end.counts)
            continue;
        vec3 color = shaded(end.triangle, end.ray);
        if (i < MIRRORED) {
            vec3 normal = texelFetch(plane_table, end.triangle).xyz;
            front += color;
            in_front += 1.0f;
            surface = vec4(dot(normal, end.ray.direction) > 0.0f ? -normal : normal, end.ray.before);
        } else if (i == MIRRORED) {
            mirrored = vec4(color, 1.0f);
        } else if (i == DEEP) {
            deep = color;
        } else {
            body += color;
            seen += 1.0f;
            error = max(error, end.error);
        }
    }
    imageStore(body_image, pixel.texel, vec4(seen > 1.0f ? body / seen : body, 1.0f));
    imageStore(mirrored_image, pixel.texel, mirrored);
    imageStore(front_image, pixel.texel, vec4(in_front > 0.0f ? front / in_front : front, edge ? in_front / float(PLACES) : in_front));
    imageStore(surface_image, pixel.texel, surface);
    imageStore(error_image, pixel.texel, vec4(error));
    imageStore(clear_image, pixel.texel, vec4(clear_to_light(centre), 1.0f));
    imageStore(deep_image, pixel.texel, vec4(deep, 1.0f));
}
