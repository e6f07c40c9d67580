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

enum { TILE_SHIFT = 6 };
_Static_assert(1 << TILE_SHIFT == RASTER_TILE, "a column's tile");

/* Layers are larger than caches, and most of a mirrored one is empty: tiles that show nothing are not read. */
KERNEL LayerPixel LAYER(CTX cx, int layer, real column, real row)
{
    const gbuffer *g = cx->narrow->layers[layer];
    const gbuffers *drawn = cx->narrow->drawn[layer];
    const mask x = whole(column), y = whole(row), at = y * (int)g->width + x;
    LayerPixel p = {INFINITE, vec3(real(0.0f), real(1.0f), real(0.0f)), real(0.0f)};
    if (!any_lane(gather_bytes(drawn->empty, (y >> TILE_SHIFT) * (int)drawn->columns + (x >> TILE_SHIFT)) == 0))
        return p;
    p.depth = gather_floats(g->depth, at);
    if (!any_lane(p.depth < real(1e30f)))
        return p;
    const mask triangle = gather_ints(g->triangle, at), shown = triangle >= 0;
    const float *planes = cx->narrow->planes;
    const mask plane = 4 * (triangle & ~(triangle >> 31));
    p.normal = SELECT3(shown, vec3(gather_floats(planes, plane), gather_floats(planes + 1, plane), gather_floats(planes + 2, plane)), p.normal);
    p.level = SELECT(shown, gather_floats(planes + 3, plane), p.level);
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
    const struct kernel_context cx = {.frame = data, .tile = &tile->data, .waves = tile->waves, .search = tile->search};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const real column = lane_numbers() + ((float)(i % TILE_WIDTH) + at->dx), row = real((float)(i / TILE_WIDTH) + at->dy);
        const PixelRay p = pixel_ray_filtered(&cx, column, row);
        store(out->share + i, p.water);
        if (!any_lane(p.water > real(0.0f)))
            continue;
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

static WaterHit load_water(const tile_water *w, const tile_offset *at, size_t i)
{
    WaterHit hit;
    hit.view = vec3(load(w->view[0] + i), load(w->view[1] + i), load(w->view[2] + i));
    hit.along = load(w->along + i);
    hit.normal = vec3(load(w->normal[0] + i), load(w->normal[1] + i), load(w->normal[2] + i));
    hit.column = lane_numbers() + ((float)(at->column + i % TILE_WIDTH) + at->dx);
    hit.row = real((float)(at->row + i / TILE_WIDTH) + at->dy);
    return hit;
}

static WaterVariation load_variation(const tile_water *w, size_t i)
{
    WaterVariation v;
    v.bend_xx = load(w->bend[0] + i), v.bend_xz = load(w->bend[1] + i), v.bend_zz = load(w->bend[2] + i);
    v.path = vec2(load(w->path[0] + i), load(w->path[1] + i));
    v.path_along = load(w->path[2] + i);
    v.variance_xx = load(w->slopes[0] + i), v.variance_xz = load(w->slopes[1] + i), v.variance_zz = load(w->slopes[2] + i);
    return v;
}

static void store_whole(int32_t *p, mask m) { memcpy(p, &m, sizeof m); }

/* Whether the pictures do not certify a point: 1 or 0. */
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

/* `mirrored`: looked for in the layer that the surface mirrors; `wet`: metres in water. */
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

/* Where the ray met the surface last, after store_found(). */
static void store_way(const struct kernel_context *cx, tile_ends *out, size_t i, WaterHit hit, SeenBehind seen)
{
    const narrow_scene *n = cx->narrow;
    store(out->before + i, hit.along);
    store(out->after + i, seen.way + seen.found.after);
    store(out->way + i, seen.way);
    store(out->wet + i, seen.wet);
    store(out->part + i, seen.part);
    if (!any_lane(seen.way > real(0.0f)))
        return;
    const vec3 from = turned(cx, left_at(cx, seen.from));
    store_vector(out->from, i, vec3(from.x + n->data.foot_x, from.y, from.z + n->data.foot_z));
}

static void lanes_beside(const narrow_scene *n, const tile_offset *at, const tile_water *water, const float *edge, tile_water *out)
{
    const struct kernel_context cx = {.narrow = n};
    const tile_offset centres = {at->column, at->row, 0, 0};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const real share = SELECT(load(edge + i) > real(0.0f), load(water->share + i), real(0.0f));
        store(out->share + i, share);
        if (!any_lane(share > real(0.0f)))
            continue;
        const WaterHit centre = load_water(water, &centres, i);
        const WaterHit hit = hit_beside(&cx, centre, load_variation(water, i), vec2(real(at->dx), real(at->dy)));
        const mask moves = share > real(0.0f);
        store_vector(out->view, i, SELECT3(moves, hit.view, centre.view));
        store(out->along + i, SELECT(moves, hit.along, centre.along));
        store_vector(out->normal, i, SELECT3(moves, hit.normal, centre.normal));
    }
}

static void lanes_refracted(const narrow_scene *n, const tile_offset *at, const tile_water *water, int branch, tile_ends *out)
{
    const struct kernel_context cx = {.narrow = n, .search = n->waves};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        mask wet = load(water->share + i) > real(0.0f);
        if (branch > 0)
            wet = AND(wet, is_split(&cx, load(out->part + i)));
        if (!any_lane(wet))
            continue;
        const WaterHit hit = surface_of_method(&cx, load_water(water, at, i));
        const Bent bent = bent_by_method(&cx, hit);
        const SeenBehind seen = find_behind(&cx, hit, wet, branch);
        const mask total = AND(wet, seen.bent.total > real(0.0f));
        const real in_water = metres_in_water(&cx, n->data.side, hit.along, seen.found.after, total) + seen.wet;
        store_found(&cx, out, i, seen.from, seen.found, total, in_water, n->data.method <= MGT_REFRACTION_HYBRID);
        store(out->total + i, SELECT(total, real(1.0f), real(0.0f)));
        store_way(&cx, out, i, hit, seen);
        store(out->first + i, bent.total);
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

static void lanes_mirrored(const narrow_scene *n, const tile_offset *at, const tile_water *water, tile_ends *out)
{
    const struct kernel_context cx = {.narrow = n};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const mask wet = load(water->share + i) > real(0.0f);
        if (!any_lane(wet))
            continue;
        const WaterHit hit = load_water(water, at, i);
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
