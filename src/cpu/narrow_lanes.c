/* SPDX-License-Identifier: MIT
 * The narrow phase of refraction over the pixels of a tile, compiled once per lane width (MGT_LANES).
 *
 * Whatever the width, a pixel sees the same operations in the same order: the bits do not depend on it. */
#include "cpu/kernel_context.h"
#include "cpu/narrow_lanes.h"

#include <math.h>
#include <string.h>

#include "frame/atmosphere.h"

#define LANES_NAME_(n) narrow_kernels_##n
#define LANES_NAME(n) LANES_NAME_(n)

#include "kernels/common/prelude_c.h"

#include "cpu/lane_access.h"

#define REFRACT(cx) ((cx)->narrow->refract)
#define NARROW(cx) ((cx)->narrow->data)
#define CHOPPY_BEHIND(cx) NARROW(cx).choppy

#include "kernels/glitter/glitter.k"

#include "kernels/refraction/layer.k"

enum { BLOCK_SHIFT = 3 };
_Static_assert(1 << BLOCK_SHIFT == GBUFFER_BLOCK, "a column's block");

KERNEL real LAYER_NEAREST(CTX cx, int layer, real column, real row)
{
    const gbuffers *drawn = cx->narrow->drawn[layer];
    return gather_floats(drawn->nearest, (whole(row) >> BLOCK_SHIFT) * (int)drawn->columns + (whole(column) >> BLOCK_SHIFT));
}

/* Blocks that show nothing are not read, because layers are larger than caches and most of a mirrored layer is empty. */
KERNEL real LAYER_DEPTH(CTX cx, int layer, real column, real row)
{
    if (cx->narrow->drawn[layer]->empties > 0 && !any_lane(LAYER_NEAREST(cx, layer, column, row) < real(1e30f)))
        return INFINITE;
    const gbuffer *g = cx->narrow->layers[layer];
    return gather_floats(g->depth, whole(row) * (int)g->width + whole(column));
}

KERNEL LayerPlane LAYER_PLANE(CTX cx, int layer, real column, real row)
{
    const gbuffer *g = cx->narrow->layers[layer];
    const mask triangle = gather_ints(g->triangle, whole(row) * (int)g->width + whole(column)), shown = triangle >= 0;
    LayerPlane p = {vec3(real(0.0f), real(1.0f), real(0.0f)), real(0.0f), SELECT(shown, real(1.0f), real(0.0f))};
    if (!any_lane(shown))
        return p;
    const four_reals plane = gather_rows(cx->narrow->planes, triangle & ~(triangle >> 31));
    p.normal = SELECT3(shown, vec3(plane.x, plane.y, plane.z), p.normal);
    p.level = SELECT(shown, plane.w, p.level);
    return p;
}

#define MIRRORED_WITHIN(cx, a, b) shows_within((cx)->narrow->drawn[LAYER_REFLECTED]->within, (a).x, (a).y, (b).x, (b).y)

static inline mask shows_within(const float within[4], real x0, real y0, real x1, real y1)
{
    const mask across = AND(max(x0, x1) >= real(within[0]), min(x0, x1) <= real(within[1]));
    return AND(across, AND(max(y0, y1) >= real(within[2]), min(y0, y1) <= real(within[3])));
}

#include "kernels/refraction/again.k"
#include "kernels/refraction/edges.k"
#include "kernels/refraction/water_seen.k"

static void store_vector(float (*planes)[TILE_PIXELS], size_t i, vec3 v)
{
    store(planes[0] + i, v.x);
    store(planes[1] + i, v.y);
    store(planes[2] + i, v.z);
}

/* ---- the surface ---- */

static void lanes_water(const FrameData *data, const tile_waves *tile, const tile_estimate *estimate, const tile_offset *at, tile_water *out)
{
    const struct kernel_context cx = context_for(data, tile);
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const real column = lane_numbers() + ((float)(i % TILE_WIDTH) + at->dx), row = real((float)(i / TILE_WIDTH) + at->dy);
        const PixelRay p = pixel_ray_filtered(&cx, column, row);
        store(out->share + i, p.water);
        if (!any_lane(p.water > real(0.0f)))
            continue;
        store(out->column + i, lane_numbers() + ((float)(at->column + i % TILE_WIDTH) + at->dx));
        store(out->row + i, real((float)(at->row + i / TILE_WIDTH) + at->dy));
        const SeenWater w = seen_water(&cx, p.ray,
                                       (HitEstimate){load(estimate->height + i), load(estimate->from + i), load(estimate->search + i),
                                                     vec2(real(0.0f), real(0.0f)), vec2(load(estimate->shift_x + i), load(estimate->shift_z + i))});
        const WaterVariation v = w.variation;
        store_vector(out->view, i, scale(w.view, real(-1.0f)));
        store(out->along + i, w.along * sqrt(length_squared(p.ray)));
        store_vector(out->normal, i, w.normal);
        store_vector(out->slopes, i, vec3(v.variance_xx, v.variance_xz, v.variance_zz));
        store_vector(out->bend, i, vec3(v.bend_xx, v.bend_xz, v.bend_zz));
        store_vector(out->path, i, vec3(v.path.x, v.path.y, v.path_along));
    }
}

/* ---- what lies behind it ---- */

static vec3 load_vector(const float (*planes)[TILE_PIXELS], size_t i) { return vec3(load(planes[0] + i), load(planes[1] + i), load(planes[2] + i)); }

static WaterHit load_water(const tile_water *w, size_t i)
{
    return (WaterHit){load_vector(w->view, i), load(w->along + i), load_vector(w->normal, i), load(w->column + i), load(w->row + i)};
}

static WaterVariation variation_of(vec3 slopes, vec3 bend, vec3 path)
{
    WaterVariation v;
    v.bend_xx = bend.x, v.bend_xz = bend.y, v.bend_zz = bend.z;
    v.path = vec2(path.x, path.y);
    v.path_along = path.z;
    v.variance_xx = slopes.x, v.variance_xz = slopes.y, v.variance_zz = slopes.z;
    return v;
}

static WaterVariation load_variation(const tile_water *w, size_t i)
{
    return variation_of(load_vector(w->slopes, i), load_vector(w->bend, i), load_vector(w->path, i));
}

static void store_whole(int32_t *p, mask m) { memcpy(p, &m, sizeof m); }

/* 1: the layers do not certify the point; else 0. `asked`: lanes whose answer has a pixel. */
static real doubt_of(const struct kernel_context *cx, WaterHit hit, FoundPoint f, mask asked, mask pixel, mask mirrored)
{
    const narrow_scene *n = cx->narrow;
    mask breaks = AND(asked, NOT(asked));
    if (any_lane(AND(asked, NOT(mirrored))))
        breaks = gather_bytes(n->breaks[0], pixel) > 0;
    if (any_lane(AND(asked, mirrored)))
        breaks = whole_select(mirrored, gather_bytes(n->breaks[1], pixel) > 0, breaks);
    mask doubt = AND(asked, point_is_doubtful(cx, f.residual, breaks));
    for (int layer = 0; layer < 2 && n->data.method == MGT_REFRACTION_HYBRID; layer++) {
        const mask wanted = AND(AND(asked, NOT(doubt)), layer == LAYER_REFLECTED ? mirrored : NOT(mirrored));
        if (any_lane(wanted))
            doubt = OR(doubt, passed_place(cx, layer, hit, f, SELECT(wanted, real(1.0f), real(0.0f))).inside > real(0.0f));
    }
    return SELECT(doubt, real(1.0f), real(0.0f));
}

static mask element_of(const narrow_scene *n, real column, real row)
{
    return whole(max(row, real(0.0f))) * (int)n->layers[0]->width + whole(max(column, real(0.0f)));
}

/* Stores a point that was found. `mirrored`: lanes whose search was in LAYER_REFLECTED. `wet`: metres of the ray in water. `certifies`: fill `doubt` and
 * `last`. */
static void store_found(const struct kernel_context *cx, tile_ends *out, size_t i, WaterHit hit, FoundPoint f, mask mirrored, real wet, bool certifies)
{
    const narrow_scene *n = cx->narrow;
    const mask asked = f.column >= real(0.0f), shown = f.shown > real(0.0f);
    const mask pixel = element_of(n, f.column, f.row);
    const mask nothing = whole(real(-1.0f));
    mask triangle = nothing;
    if (any_lane(AND(AND(asked, shown), NOT(mirrored))))
        triangle = gather_ints(n->layers[0]->triangle, pixel);
    if (any_lane(AND(AND(asked, shown), mirrored)))
        triangle = whole_select(mirrored, gather_ints(n->layers[1]->triangle, pixel), triangle);
    store_whole(out->triangle + i, whole_select(AND(asked, shown), triangle, nothing));
    store_whole(out->pixel + i, whole_select(asked, pixel, nothing));
    if (certifies)
        store_whole(out->last + i, whole_select(f.last_column >= real(0.0f), element_of(n, f.last_column, f.last_row), nothing));
    if (certifies)
        store(out->doubt + i, doubt_of(cx, hit, f, asked, pixel, mirrored));
    const vec3 position = turned(cx, f.position);
    store_vector(out->position, i, vec3(position.x + n->data.foot_x, position.y, position.z + n->data.foot_z));
    store_vector(out->direction, i, turned(cx, f.direction));
    store(out->before + i, hit.along);
    store(out->after + i, f.after);
    store(out->water + i, wet);
    store(out->error + i, point_error(cx, f.residual));
}

/* Stores the ray's last hit with the surface. It follows store_found(), of which it replaces `before` and `after`. */
static void store_way(const struct kernel_context *cx, tile_ends *out, size_t i, WaterHit hit, SeenBehind seen)
{
    const narrow_scene *n = cx->narrow;
    store(out->before + i, hit.along);
    store(out->after + i, seen.way + seen.found.after);
    store(out->way + i, seen.way);
    store(out->wet + i, seen.wet);
    store(out->part + i, seen.part);
    store(out->unsure + i, seen.unsure);
    if (!any_lane(seen.way > real(0.0f)))
        return;
    const vec3 from = turned(cx, left_at(cx, seen.from));
    store_vector(out->from, i, vec3(from.x + n->data.foot_x, from.y, from.z + n->data.foot_z));
}

static vec3 gather_vector(const float (*planes)[TILE_PIXELS], mask at)
{
    return vec3(gather_floats(planes[0], at), gather_floats(planes[1], at), gather_floats(planes[2], at));
}

static void lanes_beside(const narrow_scene *n, const ray_places *places, const tile_water *water, tile_water *out)
{
    const struct kernel_context cx = {.narrow = n};
    memset(out->share, 0, sizeof out->share);
    for (size_t i = 0; i < places->count; i += MGT_LANES) {
        int pixels[MGT_LANES];
        float shares[MGT_LANES], dx[MGT_LANES], dy[MGT_LANES];
        for (size_t lane = 0; lane < MGT_LANES; lane++) {
            const size_t place = i + lane < places->count ? i + lane : places->count - 1;
            pixels[lane] = places->pixel[place];
            shares[lane] = i + lane < places->count ? 1 : 0;
            dx[lane] = places->dx[place], dy[lane] = places->dy[place];
        }
        mask at;
        memcpy(&at, pixels, sizeof at);
        const WaterHit centre = {gather_vector(water->view, at), gather_floats(water->along, at), gather_vector(water->normal, at),
                                 gather_floats(water->column, at), gather_floats(water->row, at)};
        const vec3 slopes = gather_vector(water->slopes, at), bend = gather_vector(water->bend, at), path = gather_vector(water->path, at);
        const WaterHit hit = hit_beside(&cx, centre, variation_of(slopes, bend, path), vec2(load(dx), load(dy)));
        store(out->share + i, load(shares));
        store(out->column + i, hit.column);
        store(out->row + i, hit.row);
        store_vector(out->view, i, hit.view);
        store(out->along + i, hit.along);
        store_vector(out->normal, i, hit.normal);
        store_vector(out->slopes, i, slopes);
        store_vector(out->bend, i, bend);
        store_vector(out->path, i, path);
    }
}

static void lanes_refracted(const narrow_scene *n, const tile_water *water, int branch, tile_ends *out)
{
    const struct kernel_context cx = {.narrow = n, .search = n->waves};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        mask wet = load(water->share + i) > real(0.0f);
        if (branch > 0)
            wet = AND(wet, is_split(&cx, load(out->part + i)));
        if (!any_lane(wet))
            continue;
        const WaterHit hit = surface_of_method(&cx, load_water(water, i));
        const Bent bent = bent_by_method(&cx, hit);
        const SeenBehind seen = find_behind(&cx, hit, wet, branch);
        const mask total = AND(wet, seen.bent.total > real(0.0f));
        const real in_water = metres_in_water(&cx, n->data.side, hit.along, seen.found.after, total) + seen.wet;
        store_found(&cx, out, i, seen.from, seen.found, total, in_water, n->data.method <= MGT_REFRACTION_HYBRID);
        store(out->total + i, SELECT(total, real(1.0f), real(0.0f)));
        store_way(&cx, out, i, hit, seen);
        store(out->first + i, bent.total);
        const mask unsure = seen.unsure > real(0.0f);
        if (any_lane(unsure)) {
            store(out->doubt + i, SELECT(unsure, real(1.0f), load(out->doubt + i)));
            store_vector(out->toward, i, turned(&cx, bent.direction));
        }
        const Spread s = turned_spread(&cx, spread_of(&cx, hit, bent, load_variation(water, i)));
        store_vector(out->spread, i, spread_after(&cx, s, seen.way + seen.found.after));
        const bool certified = n->data.method <= MGT_REFRACTION_HYBRID && !any_lane(load(out->doubt + i) > real(0.0f));
        if (certified || (n->data.method > MGT_REFRACTION_HYBRID && n->data.method != MGT_REFRACTION_DISTANCE_FIELD))
            continue;
        store_vector(out->terms, i, s.constant);
        store_vector(out->terms + 3, i, s.linear);
        store_vector(out->terms + 6, i, s.square);
    }
}

static void lanes_mirrored(const narrow_scene *n, const tile_water *water, tile_ends *out)
{
    const struct kernel_context cx = {.narrow = n};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const mask wet = load(water->share + i) > real(0.0f);
        if (!any_lane(wet))
            continue;
        const WaterHit hit = load_water(water, i);
        const Bent bent = {mirrored_by_mean(&cx, hit.view, hit.normal), real(1.0f)};
        const FoundPoint f = find_mirrored(&cx, hit, bent.direction);
        store_found(&cx, out, i, hit, f, wet, n->data.side > 0 ? real(0.0f) : hit.along + f.after, false);
        store(out->total + i, real(0.0f));
        if (!any_lane(f.shown > real(0.0f)))
            continue;
        const Spread s = turned_spread(&cx, spread_of(&cx, hit, bent, load_variation(water, i)));
        store_vector(out->spread, i, spread_after(&cx, s, f.after));
    }
}

static void lanes_along(const narrow_scene *n, int layer, const float from[3], const float direction[3], float after, int32_t pixels[SHARP_PLACES])
{
    _Static_assert(SHARP_PLACES % 16 == 0, "whole vectors of any width");
    const struct kernel_context cx = {.narrow = n};
    const vec3 begin = vec3(real(from[0]), real(from[1]), real(from[2])), turn = vec3(real(direction[0]), real(direction[1]), real(direction[2]));
    for (int i = 0; i < SHARP_PLACES; i += MGT_LANES) {
        const real share = (lane_numbers() + ((float)i + 0.5f)) * (1.0f / SHARP_PLACES);
        const Place p = place_along(&cx, layer, begin, turn, real(after), share);
        const LayerPlace at = layer_place(&cx, p.column, p.row);
        store_whole(pixels + i, whole_select(p.inside > real(0.0f), whole(at.y) * (int)n->layers[0]->width + whole(at.x), whole(real(-1.0f))));
    }
}

const narrow_kernels LANES_NAME(MGT_LANES) = {lanes_water, lanes_beside, lanes_refracted, lanes_mirrored, lanes_along};
