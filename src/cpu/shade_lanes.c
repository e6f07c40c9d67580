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

KERNEL vec3 TEXTURE(CTX cx, real texture, real u, real v, real level) { return object_texture(cx, texture, u, v, level); }

#include "kernels/sky/sky.k"

KERNEL real SHADOW_TEXEL(CTX cx, real column, real row)
{
    return gather_floats(cx->shade->shadows->height, whole(row) * (int)SHADE(cx).shadow_columns + whole(column));
}

enum { SHADOW_SHIFT = 3 };
_Static_assert(1 << SHADOW_SHIFT == SHADOW_BLOCK, "a texel's block");

/* Blocks of the chosen level are as wide as the square of texels or wider, so four of them contain it. shadow_map.range holds the bounds over such four
 * blocks. */
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

/* Reads a record of `floats` floats per lane. Neighbours often have the same record, so that case takes one read. */
static inline void read_records(const float *table, int floats, mask record, real *out)
{
    int records[MGT_LANES];
    memcpy(records, &record, sizeof records);
    if (all_lanes(record == records[0])) {
        for (int k = 0; k < floats; k++)
            out[k] = real(table[(size_t)floats * (size_t)records[0] + (size_t)k]);
        return;
    }
    for (int k = 0; k < floats; k += 4) {
        const four_reals four = gather_fours(table + k, floats * record);
        out[k] = four.x, out[k + 1] = four.y, out[k + 2] = four.z, out[k + 3] = four.w;
    }
}

static vec3 triple(const real *v) { return (vec3){v[0], v[1], v[2]}; }

/* Reads the triangles and materials of MGT_LANES hits. */
static void read_objects(const shade_scene *s, const int32_t *triangle, HitTriangle *t, HitMaterial *m)
{
    real v[HIT_TRIANGLE_FLOATS], o[HIT_MATERIAL_FLOATS];
    mask triangles;
    memcpy(&triangles, triangle, sizeof triangles);
    const mask none = triangles >> 31, zero = none & 0;
    const mask object = gather_ints((const int *)s->world->object, triangles & ~none);
    read_records(s->triangles, HIT_TRIANGLE_FLOATS, whole_select(none, zero + (int)s->world->triangle_count, triangles), v);
    read_records(s->material_rows, HIT_MATERIAL_FLOATS, whole_select(none, zero + (int)s->world->object_count, object), o);
    *t = (HitTriangle){triple(v), triple(v + 3), triple(v + 6), triple(v + 9), triple(v + 12), triple(v + 15), {v[18], v[19]}, {v[20], v[21]}, {v[22], v[23]}};
    *m = (HitMaterial){triple(o), o[3], o[4], o[5], triple(o + 6), o[9], o[10], real_from_int(object & ~none), o[11], o[12]};
}

/* Loads `count` floats from `p`. Further lanes repeat the last one. */
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
