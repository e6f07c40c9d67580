/* SPDX-License-Identifier: MIT
 * Points of objects shaded in lanes, compiled once per lane width (MGT_LANES).
 *
 * Whatever the width, a point sees the same operations in the same order: the bits do not depend on it. */
#include "cpu/kernel_context.h"
#include "cpu/shade.h"

#include <math.h>
#include <string.h>

#include "frame/mesh.h"
#include "frame/atmosphere.h"

#define LANES_NAME_(n) shade_kernels_##n
#define LANES_NAME(n) LANES_NAME_(n)

/* ---- what kernels read ---- */

#include "kernels/common/prelude_c.h"

#include "cpu/lane_access.h"
#include "cpu/texture_lane.h"

#define SHADE(cx) ((cx)->shade->data)
#define CHOPPY_LIGHT(cx) SHADE(cx).choppy

KERNEL vec3 TEXTURE(CTX cx, real texture, real u, real v, real level) { return object_texture(cx->shade, texture, u, v, level); }

#include "kernels/sky/sky.k"

KERNEL real SHADOW_TEXEL(CTX cx, real column, real row)
{
    return gather_floats(cx->shade->shadows->height, whole(row) * (int)SHADE(cx).shadow_columns + whole(column));
}

enum { SHADOW_SHIFT = 3 };
_Static_assert(1 << SHADOW_SHIFT == SHADOW_BLOCK, "a texel's block");

/* Blocks as wide as the texels asked for, or wider: these lie in four of them. */
KERNEL vec2 SHADOW_RANGE(CTX cx, real column, real row, real width, mask dry)
{
    const shadow_map *m = cx->shade->shadows;
    const mask none = whole(real(0.0f)), blocks = whole(width * (1.0f / SHADOW_BLOCK)), most = none + (m->levels - 1);
    mask level = (real_bits(real_from_int(blocks)) >> 23) - 126;
    level = whole_select(blocks > 0, level, none);
    level = whole_select(level < most, level, most);
    const mask shift = level + SHADOW_SHIFT, across = gather_ints(m->across, level);
    const mask half = whole_select(dry, none + (int)(m->halves - 1) * m->blocks, none);
    const mask block = gather_ints(m->start, level) + half + (whole(row) >> shift) * across + (whole(column) >> shift);
    return vec2(gather_floats(m->range, 2 * block), gather_floats(m->range, 2 * block + 1));
}

#include "kernels/refraction/shadow.k"
#define SUN_VISIBILITY(cx, position, first, second, dry) shadow_over(cx, position, first, second, dry)

#include "kernels/refraction/material.k"

/* ---- hits ---- */

/* The numbers of a hit that are read from a triangle and its object, as in HitTriangle and HitMaterial. */
enum { TRIANGLE_FLOATS = 24, MATERIAL_FLOATS = 14, OBJECT_FLOATS = TRIANGLE_FLOATS + MATERIAL_FLOATS };

static void read_triangle(const shade_scene *s, size_t triangle, float *out)
{
    const world *w = s->world;
    const uint32_t object = w->object[triangle];
    const bool smooth = w->objects[object].smooth;
    const uint32_t *corner = w->indices + 3 * triangle;
    const float *p0 = w->positions + 3 * (size_t)corner[0];
    for (int k = 0; k < 3; k++) {
        out[k] = p0[k];
        out[3 + k] = w->positions[3 * (size_t)corner[1] + (size_t)k] - p0[k];
        out[6 + k] = w->positions[3 * (size_t)corner[2] + (size_t)k] - p0[k];
        for (int c = 0; c < 3; c++)
            out[9 + 3 * c + k] = smooth ? w->normals[3 * (size_t)corner[c] + (size_t)k] : 0;
    }
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 2; k++)
            out[18 + 2 * c + k] = w->texcoords[2 * (size_t)corner[c] + (size_t)k];
    const shade_material *m = &s->materials[object];
    float *values = out + TRIANGLE_FLOATS;
    for (int k = 0; k < 3; k++)
        values[k] = m->base[k], values[6 + k] = m->color[k];
    values[3] = m->alpha, values[4] = m->metallic, values[5] = m->kind;
    values[9] = m->inverse_size, values[10] = m->joint, values[11] = (float)object;
    values[12] = m->texture_width, values[13] = m->texture_height;
}

/* Where a hit has no triangle: one that does no harm. */
static const float no_triangle[OBJECT_FLOATS] = {[3] = 1, [8] = 1, [TRIANGLE_FLOATS + 3] = 1, [TRIANGLE_FLOATS + 9] = 1};

static vec3 triple(const real *v) { return (vec3){v[0], v[1], v[2]}; }

/* Triangles and materials of MGT_LANES hits; neighbours mostly share theirs. */
static void read_objects(const shade_scene *s, const int32_t *triangle, HitTriangle *t, HitMaterial *m)
{
    float one[OBJECT_FLOATS];
    real v[OBJECT_FLOATS];
    mask triangles;
    memcpy(&triangles, triangle, sizeof triangles);
    for (int k = 0; k < OBJECT_FLOATS; k++)
        v[k] = real(no_triangle[k]);
    for (int i = 0; i < MGT_LANES; i++) {
        if (triangle[i] < 0 || (i > 0 && triangle[i] == triangle[i - 1]))
            continue;
        read_triangle(s, (size_t)triangle[i], one);
        const mask same = triangles == triangle[i];
        for (int k = 0; k < OBJECT_FLOATS; k++)
            v[k] = SELECT(same, real(one[k]), v[k]);
    }
    *t = (HitTriangle){triple(v), triple(v + 3), triple(v + 6), triple(v + 9), triple(v + 12), triple(v + 15), {v[18], v[19]}, {v[20], v[21]}, {v[22], v[23]}};
    const real *o = v + TRIANGLE_FLOATS;
    *m = (HitMaterial){triple(o), o[3], o[4], o[5], triple(o + 6), o[9], o[10], o[11], o[12], o[13]};
}

/* `count` floats from `p`, the last one repeated. */
static real load_some(const float *p, size_t count)
{
    if (count >= MGT_LANES)
        return load(p);
    float lanes[MGT_LANES];
    for (size_t i = 0; i < MGT_LANES; i++)
        lanes[i] = p[i < count ? i : count - 1];
    return load(lanes);
}

static HitRay ray_of(const shade_hits *h, size_t i, size_t count, mask found)
{
    HitRay r;
    r.position = vec3(load_some(h->position[0] + i, count), load_some(h->position[1] + i, count), load_some(h->position[2] + i, count));
    r.position = SELECT3(found, r.position, vec3(real(0.0f), real(0.0f), real(0.0f)));
    r.direction = vec3(load_some(h->direction[0] + i, count), load_some(h->direction[1] + i, count), load_some(h->direction[2] + i, count));
    r.before = load_some(h->before + i, count);
    r.after = load_some(h->after + i, count);
    r.water = load_some(h->water + i, count);
    r.footprint = (RayFootprint){load_some(h->spread[0] + i, count), load_some(h->spread[1] + i, count), load_some(h->spread[2] + i, count)};
    r.gain = h->gain ? load_some(h->gain + i, count) : real(1.0f);
    return r;
}

static void lanes_points(const shade_scene *s, const shade_hits *h, float *rgb)
{
    const struct kernel_context cx = {.frame = &s->frame, .sky = s->sky, .shade = s, .search = s->waves};
    for (size_t i = 0; i < h->count; i += MGT_LANES) {
        const size_t count = h->count - i < MGT_LANES ? h->count - i : MGT_LANES;
        int32_t triangle[MGT_LANES];
        float met[MGT_LANES];
        for (size_t lane = 0; lane < MGT_LANES; lane++) {
            triangle[lane] = h->triangle[i + (lane < count ? lane : count - 1)];
            met[lane] = triangle[lane] >= 0 ? 1.0f : 0.0f;
        }
        const mask found = load(met) > real(0.0f);
        const HitRay ray = ray_of(h, i, count, found);
        vec3 color = vec3(real(0.0f), real(0.0f), real(0.0f));
        if (any_lane(found)) {
            HitTriangle t;
            HitMaterial m;
            read_objects(s, triangle, &t, &m);
            color = shade_hit(&cx, m, t, ray);
        }
        if (any_lane(NOT(found)))
            color = SELECT3(found, color, shade_nothing(&cx, ray, sky_radiance(&cx, ray.direction)));
        float lanes[3][MGT_LANES];
        store(lanes[0], color.x), store(lanes[1], color.y), store(lanes[2], color.z);
        for (size_t lane = 0; lane < count; lane++)
            for (int k = 0; k < 3; k++)
                rgb[3 * (i + lane) + (size_t)k] = lanes[k][lane];
    }
}

static void lanes_disk(const shade_scene *s, size_t count, const float *x, const float *z, const float *way, float *const clear[3])
{
    const struct kernel_context cx = {.shade = s};
    for (size_t i = 0; i < count; i += MGT_LANES) {
        const size_t some = count - i < MGT_LANES ? count - i : MGT_LANES;
        const vec3 at = vec3(load_some(x + i, some), real(0.0f), load_some(z + i, some)), point = vec3(real(0.0f), real(0.0f), real(0.0f));
        const real lit = shadow_over(&cx, at, point, point, lane_numbers() < real(0.0f));
        const vec3 left = disk_through_water(&cx, lit, load_some(way + i, some));
        float lanes[3][MGT_LANES];
        store(lanes[0], left.x), store(lanes[1], left.y), store(lanes[2], left.z);
        for (size_t lane = 0; lane < some; lane++)
            for (int k = 0; k < 3; k++)
                clear[k][i + lane] = lanes[k][lane];
    }
}

const shade_kernels LANES_NAME(MGT_LANES) = {lanes_points, lanes_disk};
