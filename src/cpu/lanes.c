/* SPDX-License-Identifier: MIT
 * The kernels over the pixels of a tile, compiled once per lane width (MGT_LANES).
 *
 * Whatever the width, a pixel sees the same operations in the same order: the bits do not depend on it. */
#include "cpu/kernel_context.h"
#include "cpu/lanes.h"

#include <math.h>
#include <string.h>

#include "cpu/raster_lanes.h"
#include "cpu/sample_sums.h"
#include "cpu/baseline_lanes.h"
#include "frame/atmosphere.h"

#define LANES_NAME_(n) lane_kernels_##n
#define LANES_NAME(n) LANES_NAME_(n)
#define BASELINES_NAME_(n) baseline_kernels_##n
#define BASELINES_NAME(n) BASELINES_NAME_(n)
#define RASTER_NAME_(n) raster_kernels_##n
#define RASTER_NAME(n) RASTER_NAME_(n)
#define SHADE_NAME_(n) shade_kernels_##n
#define SHADE_NAME(n) SHADE_NAME_(n)
#define NARROW_NAME_(n) narrow_kernels_##n
#define NARROW_NAME(n) NARROW_NAME_(n)
#define FRONT_NAME_(n) front_kernels_##n
#define FRONT_NAME(n) FRONT_NAME_(n)
static const float infinity = INFINITY;

#include "kernels/common/prelude_c.h"

#include "cpu/lane_access.h"
#include "cpu/lane_display.h"

_Static_assert(PODEE_SLICES *PODEE_ROWS *PODEE_COLUMNS <= 1 << 24, "indices are exact in float");

KERNEL real SWEEP_TEXEL(CTX cx, real v, real u, real slice)
{
    const real row = real_fma(slice, real_broadcast(PODEE_ROWS), u);
    return gather_floats(cx->podee->sweep, whole(real_fma(row, real_broadcast(PODEE_COLUMNS), v)));
}

KERNEL real FRACTION_TEXEL(CTX cx, real r, real slice) { return gather_floats(cx->podee->share, whole(real_fma(slice, real_broadcast(PODEE_COLUMNS), r))); }

#include "kernels/glitter/pixel.k"

/* Stores a hit of each lane in `where`. Lanes store to scattered places, so they do it one by one. */
KERNEL void HIT_FOUND(CTX cx, real column, real row, HitEstimate hit, mask where)
{
    float at[MGT_LANES], height[MGT_LANES], slope_x[MGT_LANES], slope_z[MGT_LANES], shift_x[MGT_LANES], shift_z[MGT_LANES];
    store(at, real_fma(row, real_broadcast(TILE_WIDTH), column));
    store(height, hit.height);
    store(slope_x, hit.slope.x);
    store(slope_z, hit.slope.y);
    store(shift_x, hit.shift.x);
    store(shift_z, hit.shift.y);
    for (unsigned lanes = lane_bits(where); lanes != 0; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes), place = (int)at[i];
        tile_estimate *rows = cx->found + place / TILE_PIXELS;
        rows->height[place % TILE_PIXELS] = height[i];
        rows->slope_x[place % TILE_PIXELS] = slope_x[i];
        rows->slope_z[place % TILE_PIXELS] = slope_z[i];
        rows->shift_x[place % TILE_PIXELS] = shift_x[i];
        rows->shift_z[place % TILE_PIXELS] = shift_z[i];
    }
}

#include "kernels/adaptive/cells.k"
#include "kernels/glitter/glitter.k"
#include "kernels/glitter/lattice.k"
#include "kernels/baselines/podee.k"
#include "kernels/baselines/podee_mixture.k"
#include "kernels/glitter/sample.k"
#include "kernels/waves/tile.k"

static inline HitEstimate load_estimate(const tile_estimate *estimate, size_t i)
{
    const vec2 shift = vec2(load(estimate->shift_x + i), load(estimate->shift_z + i));
    return (HitEstimate){load(estimate->height + i), load(estimate->from + i), load(estimate->search + i), vec2(real(0.0f), real(0.0f)), shift};
}

static inline HitEstimate load_hit(const struct kernel_context *cx, const tile_estimate *estimate, size_t i)
{
    HitEstimate hit = load_estimate(estimate, i);
    if (TILE(cx).grazing != 0)
        hit.slope = vec2(load(estimate->slope_x + i), load(estimate->slope_z + i));
    return hit;
}

/* ---- tiles ---- */

/* The value that all lanes hold. */
static inline float any_of(real x)
{
    float lanes[MGT_LANES];
    store(lanes, x);
    return lanes[0];
}

/* WaveClass of all waves, one array per member. */
typedef struct wave_classes {
    float kind[MGT_MAX_WAVES + KEY_GAP], turns[MGT_MAX_WAVES + KEY_GAP], share[MGT_MAX_WAVES + KEY_GAP], lost[MGT_MAX_WAVES + KEY_GAP];
    float searched[MGT_MAX_WAVES + KEY_GAP], along[MGT_MAX_WAVES + KEY_GAP], most[MGT_MAX_WAVES + KEY_GAP];
} wave_classes;

_Static_assert(sizeof(SortWave) == SORT_KEYS * sizeof(real), "SortWave has no members but the keys");

static inline SortWave load_sort_wave(const wave_set *set, int i)
{
    SortWave w;
    real *members = (real *)&w;
    for (int key = 0; key < SORT_KEYS; key++)
        members[key] = load(set->keys[key] + i);
    return w;
}

static void classify_waves(const struct kernel_context *cx, const wave_set *set, TileView view, wave_classes *out)
{
    for (int i = 0; i < set->view.wave_count; i += MGT_LANES) {
        const WaveClass c = classify_wave(cx, view, load_sort_wave(set, i));
        store(out->kind + i, c.kind);
        store(out->turns + i, c.turns);
        store(out->share + i, c.share);
        store(out->lost + i, c.lost);
        store(out->searched + i, c.searched);
        store(out->along + i, c.along);
        store(out->most + i, c.most);
    }
}

static void list_wave(const struct kernel_context *cx, const wave_set *set, const wave_classes *c, int wave, WaveData *out)
{
    *out = wave_weighted(cx, wave_placed(cx, set->data[wave], c->turns[wave]), c->share[wave]);
}

/* Lists the resolved waves, then the mixed ones, each in the set's order. */
static TileData list_waves(const struct kernel_context *cx, const wave_set *set, const wave_classes *c, float rows, tile_waves *out)
{
    const int waves = set->view.wave_count;
    uint16_t searched[MGT_MAX_WAVES];
    int resolved = 0, all = 0, searched_count = 0;
    TileSums sums = no_sums(cx);
    for (int i = 0; i < waves; i++) {
        sums = sums_with_wave(cx, sums, set->data[i], c->lost[i], c->searched[i], c->most[i]);
        if (c->kind[i] == WAVE_RESOLVED)
            list_wave(cx, set, c, i, &out->waves[resolved++]);
        searched[searched_count] = (uint16_t)i;
        searched_count += c->searched[i] != 0;
    }
    all = resolved;
    for (int i = 0; i < waves; i++)
        if (c->kind[i] == WAVE_MIXED)
            list_wave(cx, set, c, i, &out->waves[all++]);
    const int coarse = coarse_waves(cx, searched_count);
    for (int place = 0; place < searched_count; place++) {
        const int i = searched[place];
        out->search[place] = search_wave_of(cx, set->data[i], c->turns[i]);
        sums = sums_with_search(cx, sums, set->data[i], c->along[i], place, coarse);
    }
    return sorted_tile(cx, sums, resolved, all - resolved, searched_count, rows);
}

/* A tile of the picture and the classes of its waves. */
typedef struct tile_sorting {
    real column, row;
    float width, height;
    TileView place;
    wave_classes classes;
} tile_sorting;

static void classify_tile(const struct kernel_context *cx, const wave_set *set, uint32_t tile_x, uint32_t tile_y, tile_sorting *out)
{
    out->width = TILE_WIDTH * cx->view->scale_x;
    out->height = TILE_HEIGHT * cx->view->scale_y;
    out->column = real((float)tile_x * out->width);
    out->row = real((float)tile_y * out->height);
    out->place = tile_view(cx, out->column, out->row, out->width, out->height);
    classify_waves(cx, set, out->place, &out->classes);
}

static void list_tile(const struct kernel_context *cx, const wave_set *set, const tile_sorting *sorting, tile_waves *out)
{
    const TileView *place = &sorting->place;
    out->data = list_waves(cx, set, &sorting->classes, any_of(place->rows), out);
    out->data.ray_x = any_of(place->ray.x);
    out->data.ray_y = any_of(place->ray.y);
    out->data.ray_z = any_of(place->ray.z);
    out->data.origin_x = any_of(place->origin_x);
    out->data.origin_z = any_of(place->origin_z);
    out->data.grazing = any_of(place->grazing) > 0;
    out->data.refined = any_of(place->refined) > 0;
    out->data.skyline = (int)any_of(place->skyline);
    out->data.whole_waves = any_of(place->whole);
    out->skyline = set->skyline[0];
    out->data.search_pixels = out->data.search_pixels || out->data.grazing;
    out->foam = set->has_foam ? &set->foam : NULL;
    out->data.light_reach = any_of(tile_meets_light(cx, sorting->column, sorting->row, sorting->width, sorting->height)) > 0;
}

static void lanes_sort(const FrameData *frame, const wave_set *set, const ViewData *view, uint32_t tile_x, uint32_t tile_y, tile_waves *out)
{
    const struct kernel_context cx = {.frame = frame, .view = view};
    tile_sorting sorting;
    classify_tile(&cx, set, tile_x, tile_y, &sorting);
    list_tile(&cx, set, &sorting, out);
}

#include "cpu/lattice_lane.h"

/* ---- methods ---- */

static inline const float *light_at(const tile_light *light, size_t i) { return light ? &light->through[0][i] : NULL; }

static inline void accumulate(float *p, real value, float weight) { store(p, load(p) + value * weight); }

static void lanes_sample(const FrameData *frame, const float *sky, const tile_light *light, const tile_waves *tile, const tile_estimate *estimate,
                         const float *dx, const float *dy, float weight, tile_pixels *out)
{
    struct kernel_context context = context_for(frame, tile);
    context.sky = sky;
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        real column = lane_numbers() + (float)(i % TILE_WIDTH);
        real row = real_broadcast((float)(i / TILE_WIDTH));
        if (dx) {
            column = column + load(dx + i);
            row = row + load(dy + i);
        }
        context.light = light_at(light, i);
        const PixelResult p = sample_pixel(&context, column, row, load_estimate(estimate, i));
        accumulate(out->red + i, p.color.x, weight);
        accumulate(out->green + i, p.color.y, weight);
        accumulate(out->blue + i, p.color.z, weight);
        accumulate(out->coverage + i, p.coverage, weight);
        accumulate(out->water + i, p.water, weight);
        accumulate(out->foam + i, p.foam, weight);
    }
}

static void lanes_sum(const float *values, sample_terms *terms)
{
    const double to_high = 0x1.8p44, to_low = 0x1.8p-4; /* adding these rounds to multiples of 2⁻⁸ and of 2⁻⁵⁶ */
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        const double number = values[i] == values[i] ? (double)values[i] : 0;
        const double above = number > -SAMPLE_TERM_MOST ? number : -SAMPLE_TERM_MOST;
        const double value = above < SAMPLE_TERM_MOST ? above : SAMPLE_TERM_MOST;
        const double high = (value + to_high) - to_high;
        terms->high[i] += high;
        terms->low[i] += ((value - high) + to_low) - to_low;
    }
}

static PixelResult nothing_but_sky(const struct kernel_context *cx, PixelRay p)
{
    PixelResult result = {vec3(real(0.0f), real(0.0f), real(0.0f)), real(0.0f), real(0.0f), real(0.0f)};
    if (FRAME(cx).want_color != 0)
        result.color = background(cx, p.sky_ray);
    return result;
}

static void store_pixels(tile_pixels *out, size_t i, PixelResult p)
{
    store(out->red + i, p.color.x);
    store(out->green + i, p.color.y);
    store(out->blue + i, p.color.z);
    store(out->coverage + i, p.coverage);
    store(out->water + i, p.water);
    store(out->foam + i, p.foam);
}

/* ---- the filtered surface of a tile ---- */

enum { SURFACE_FLOATS = sizeof(Surface) / sizeof(real) };

/* Pixels or cells of a tile. `count` is a multiple of MGT_LANES. */
typedef struct tile_places {
    const float *column, *row;
    size_t count;
} tile_places;

/* Places of TILE_HEIGHT rows of pixels. */
typedef struct row_grid {
    float column[TILE_PIXELS], row[TILE_PIXELS];
} row_grid;

static tile_places rows_from(int first, row_grid *grid)
{
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        store(grid->column + i, lane_numbers() + (float)(i % TILE_WIDTH));
        store(grid->row + i, real_broadcast((float)first + (float)(i / TILE_WIDTH)));
    }
    return (tile_places){grid->column, grid->row, TILE_PIXELS};
}

/* Intermediate values of slope_state() of glitter.k at each pixel. Few pixels need a search or a second look, so these pixels are gathered from the whole tile
 * into full vectors. */
typedef struct tile_looks {
    tile_places places;
    float surface[SURFACE_FLOATS][TILE_PIXELS];
    float along[TILE_PIXELS], correction[TILE_PIXELS], lost[TILE_PIXELS], again[TILE_PIXELS];
    float slope_x[TILE_PIXELS], slope_z[TILE_PIXELS], shift_x[TILE_PIXELS], shift_z[TILE_PIXELS]; /* see HitEstimate */
    uint16_t list[TILE_PIXELS + MGT_LANES];
} tile_looks;

/* The rays of the places i to i + MGT_LANES − 1. */
static inline PixelRay pixel_rays(const struct kernel_context *cx, const tile_places *p, size_t i)
{
    return pixel_ray_filtered(cx, load(p->column + i), load(p->row + i));
}

static Surface load_surface(const tile_looks *l, size_t i)
{
    Surface s;
    real *members = (real *)&s;
    for (int m = 0; m < SURFACE_FLOATS; m++)
        members[m] = load(l->surface[m] + i);
    return s;
}

/* Lists the pixels whose flag is set. The last vector is filled up with the last pixel. Returns the number of vectors. */
static size_t list_pixels(const float *flags, size_t places, uint16_t *list)
{
    size_t count = 0;
    for (size_t i = 0; i < places; i += MGT_LANES) {
        if (!any_lane(load(flags + i) > real(0.0f)))
            continue;
        for (size_t lane = 0; lane < MGT_LANES; lane++) {
            list[count] = (uint16_t)(i + lane);
            count += flags[i + lane] > 0;
        }
    }
    const size_t vectors = (count + MGT_LANES - 1) / MGT_LANES;
    for (size_t i = count; i < vectors * MGT_LANES; i++)
        list[i] = list[count - 1];
    return vectors;
}

static inline void scatter(float *plane, const uint16_t *list, real value)
{
    float lanes[MGT_LANES];
    store(lanes, value);
    for (int i = 0; i < MGT_LANES; i++)
        plane[list[i]] = lanes[i];
}

static inline vec3 listed_ray(const struct kernel_context *cx, const tile_places *p, const uint16_t *list)
{
    return pixel_ray_filtered(cx, gather(p->column, list), gather(p->row, list)).ray;
}

/* Replaces estimates whose HitEstimate.search is set by searched hits. */
static void search_doubtful(const struct kernel_context *cx, const tile_estimate *estimate, tile_looks *l)
{
    const size_t vectors = list_pixels(l->lost, l->places.count, l->list);
    for (size_t v = 0; v < vectors; v++) {
        const uint16_t *list = l->list + v * MGT_LANES;
        const SearchHit hit = search(cx, listed_ray(cx, &l->places, list), gather(estimate->from, list), real(1.0f));
        const mask found = hit.found > real(0.0f);
        scatter(l->along, list, SELECT(found, hit.along, gather(l->along, list)));
        scatter(l->slope_x, list, SELECT(found, hit.slope.x, gather(l->slope_x, list)));
        scatter(l->slope_z, list, SELECT(found, hit.slope.y, gather(l->slope_z, list)));
        scatter(l->shift_x, list, SELECT(found, hit.shift.x, gather(l->shift_x, list)));
        scatter(l->shift_z, list, SELECT(found, hit.shift.y, gather(l->shift_z, list)));
    }
}

static void search_lost(const struct kernel_context *cx, const tile_estimate *estimate, tile_looks *l)
{
    const size_t vectors = list_pixels(l->lost, l->places.count, l->list);
    for (size_t v = 0; v < vectors; v++) {
        const uint16_t *list = l->list + v * MGT_LANES;
        const SearchHit hit = search(cx, listed_ray(cx, &l->places, list), gather(estimate->from, list), real(1.0f));
        const mask found = hit.found > real(0.0f);
        scatter(l->correction, list, SELECT(found, hit.along - gather(l->along, list), gather(l->correction, list)));
        scatter(l->again, list, SELECT(found, real(1.0f), gather(l->again, list)));
        scatter(l->shift_x, list, SELECT(found, hit.shift.x, gather(l->shift_x, list)));
        scatter(l->shift_z, list, SELECT(found, hit.shift.y, gather(l->shift_z, list)));
    }
}

static void look_again(const struct kernel_context *cx, tile_looks *l)
{
    const size_t vectors = list_pixels(l->again, l->places.count, l->list);
    for (size_t v = 0; v < vectors; v++) {
        const uint16_t *list = l->list + v * MGT_LANES;
        const real along = gather(l->along, list) + gather(l->correction, list);
        const vec2 slope = vec2(gather(l->slope_x, list), gather(l->slope_z, list)), shift = vec2(gather(l->shift_x, list), gather(l->shift_z, list));
        const Surface s = surface_along(cx, listed_ray(cx, &l->places, list), along, slope, shift);
        const real *members = (const real *)&s;
        scatter(l->along, list, along);
        for (int m = 0; m < SURFACE_FLOATS; m++)
            scatter(l->surface[m], list, members[m]);
    }
}

/* Evaluates the surface at the pixels in which `wanted` is above 0. */
static void look_at_tile(const struct kernel_context *cx, const tile_estimate *estimate, const float *wanted, tile_looks *l)
{
    for (size_t i = 0; i < l->places.count; i += MGT_LANES) {
        const HitEstimate e = load_hit(cx, estimate, i);
        store(l->along + i, estimated_along(cx, pixel_rays(cx, &l->places, i).ray, e));
        store(l->slope_x + i, e.slope.x);
        store(l->slope_z + i, e.slope.y);
        store(l->shift_x + i, e.shift.x);
        store(l->shift_z + i, e.shift.y);
        store(l->lost + i, SELECT(load(wanted + i) > real(0.0f), load(estimate->search + i), real(0.0f)));
    }
    search_doubtful(cx, estimate, l);
    for (size_t i = 0; i < l->places.count; i += MGT_LANES) {
        const mask water = load(wanted + i) > real(0.0f);
        store(l->lost + i, real(0.0f));
        store(l->again + i, real(0.0f));
        if (!any_lane(water))
            continue;
        const vec2 slope = vec2(load(l->slope_x + i), load(l->slope_z + i));
        const vec2 shift = vec2(load(l->shift_x + i), load(l->shift_z + i));
        const SurfaceLook look = look_at_estimate(cx, pixel_rays(cx, &l->places, i).ray, load(l->along + i), slope, shift);
        store(l->shift_x + i, look.surface.shift.x);
        store(l->shift_z + i, look.surface.shift.y);
        const real *members = (const real *)&look.surface;
        for (int m = 0; m < SURFACE_FLOATS; m++)
            store(l->surface[m] + i, members[m]);
        store(l->correction + i, look.correction);
        store(l->lost + i, SELECT(water, look.lost, real(0.0f)));
        store(l->again + i, SELECT(water, look.again, real(0.0f)));
    }
    search_lost(cx, estimate, l);
    look_again(cx, l);
}

static inline SlopeState looked_slopes(const struct kernel_context *cx, const tile_looks *l, size_t i, vec3 ray)
{
    return slopes_at(cx, ray, load(l->along + i), load_surface(l, i));
}

static void store_cell(tile_pixels *out, tile_detail *detail, size_t i, CellResult c)
{
    store_pixels(out, i, c.pixel);
    if (detail) {
        store(detail->height + i, c.height);
        store(detail->variance + i, c.variance);
        store(detail->contrast + i, c.contrast);
        store(detail->display_slope_squared + i, c.display_slope_squared);
        store(detail->aspect + i, c.aspect);
        store(detail->places + i, c.places);
    }
}

static CellResult cell_without_water(PixelResult sky) { return (CellResult){sky, real(0.0f), real(0.0f), real(0.0f), real(0.0f), real(1.0f), real(1.0f)}; }

/* `detail` NULL: errors are not estimated, which saves time. */
static void render_glitter(const struct kernel_context *cx, const tile_light *light, tile_places places, const tile_estimate *estimate, tile_pixels *out,
                           tile_detail *detail)
{
    struct kernel_context here = *cx;
    tile_looks looks;
    looks.places = places;
    for (size_t i = 0; i < places.count; i += MGT_LANES)
        store(out->water + i, pixel_rays(cx, &places, i).water);
    look_at_tile(cx, estimate, out->water, &looks);
    for (size_t i = 0; i < places.count; i += MGT_LANES) {
        const PixelRay p = pixel_rays(cx, &places, i);
        here.light = light_at(light, i);
        if (!any_lane(p.water > real(0.0f))) {
            store_cell(out, detail, i, cell_without_water(nothing_but_sky(&here, p)));
            continue;
        }
        const SlopeState state = looked_slopes(cx, &looks, i, p.ray);
        if (detail)
            store_cell(out, detail, i, cell_result_of(&here, p, state));
        else
            store_pixels(out, i, over_state(&here, glitter_result(&here, p, state), p, state));
    }
}

/* Sets where the cells' searches begin. The ray two pixels below has passed over all water up to its hit, so cells above it start from there. */
static void place_starts(const struct kernel_context *cx, size_t count, tile_cells *cells)
{
    for (size_t i = 0; i < count; i += MGT_LANES) {
        float column[MGT_LANES], row[MGT_LANES], known[MGT_LANES], height[MGT_LANES];
        for (size_t lane = 0; lane < MGT_LANES; lane++) {
            /* The middle of the pixel two rows below, in units of cells. */
            column[lane] = ldexpf(floorf(ldexpf(cells->column[i + lane], -cells->across)) + 0.5f, cells->across) - 0.5f;
            row[lane] = ldexpf(floorf(ldexpf(cells->row[i + lane], -cells->down)) + 2.5f, cells->down) - 0.5f;
            known[lane] = isnan(cells->below[i + lane]) ? 0.0f : 1.0f;
            height[lane] = known[lane] > 0 ? cells->below[i + lane] : 0.0f;
        }
        const vec3 ray = pixel_ray_at(cx, load(column), load(row));
        const real along = SELECT(ray.y < real(-1e-7f), load(known) * (real(TILE(cx).camera_height) - load(height)) / (real(0.0f) - ray.y), real(0.0f));
        const vec3 above = pixel_ray_filtered(cx, load(cells->column + i), load(cells->row + i)).ray;
        store(cells->estimate.from + i, row_start(cx, above, inverse_speed_of(cx, above), ray, inverse_speed_of(cx, ray), along).along);
    }
}

static void lanes_cells(const FrameData *frame, const float *sky, const tile_waves *waves, tile_cells *cells)
{
    struct kernel_context cx = context_for(frame, waves);
    cx.sky = sky;
    size_t count = cells->count;
    for (; count % MGT_LANES != 0; count++) {
        cells->column[count] = cells->column[count - 1];
        cells->row[count] = cells->row[count - 1];
        cells->estimate.height[count] = cells->estimate.height[count - 1];
        cells->below[count] = cells->below[count - 1];
    }
    /* The parent's height says nothing about its parts' hits in grazing water, nor about their places at rest in choppy water. */
    const bool grazing = waves->data.grazing;
    const float searched = grazing || waves->data.pressed > 0 ? 1 : 0;
    for (size_t i = 0; i < count; i++) {
        cells->estimate.search[i] = searched;
        cells->estimate.from[i] = 0;
        cells->estimate.slope_x[i] = cells->estimate.slope_z[i] = 0;
        cells->estimate.shift_x[i] = cells->estimate.shift_z[i] = 0;
    }
    if (grazing)
        place_starts(&cx, count, cells);
    const tile_places places = {cells->column, cells->row, count};
    render_glitter(&cx, cells->light, places, &cells->estimate, &cells->pixels, &cells->detail);
}

static struct kernel_context context_of(const method_tile *t, const tile_waves *waves)
{
    struct kernel_context cx = context_for(t->frame, waves);
    cx.sky = t->sky;
    cx.podee = t->podee;
    cx.lean = t->lean;
    return cx;
}

/* Copies the light of pixels that have `hits` hits each to the rows of hits of part `part` of the tile. */
static const tile_light *light_of_rows(const tile_light *light, int hits, int part, tile_light *rows)
{
    enum { PLANES = sizeof *light / sizeof light->through[0] };
    if (!light)
        return NULL;
    for (size_t plane = 0; plane < PLANES; plane++)
        for (int row = 0; row < TILE_HEIGHT; row++)
            memcpy(rows->through[0] + plane * TILE_PIXELS + row * TILE_WIDTH,
                   light->through[0] + plane * TILE_PIXELS + (part * TILE_HEIGHT + row) / hits * TILE_WIDTH, TILE_WIDTH * sizeof(float));
    return rows;
}

/* Adds TILE_HEIGHT rows of hits from row `first` on to their pixels, which have `hits` hits each. */
static void add_rows(const tile_pixels *rows, int hits, int first, tile_pixels *out)
{
    const float *const from[] = {rows->red, rows->green, rows->blue, rows->coverage, rows->water, rows->foam};
    float *const into[] = {out->red, out->green, out->blue, out->coverage, out->water, out->foam};
    for (size_t k = 0; k < sizeof into / sizeof *into; k++)
        for (int row = 0; row < TILE_HEIGHT; row++)
            for (size_t x = 0; x < TILE_WIDTH; x += MGT_LANES)
                accumulate(into[k] + (first + row) / hits * TILE_WIDTH + x, load(from[k] + row * TILE_WIDTH + x), 1.0f / (float)hits);
}

/* Renders pixels that are the mean of several hits, one above the other. */
static void several_hits(const method_tile *t, const struct kernel_context *cx, tile_pixels *out)
{
    row_grid grid;
    tile_pixels rows;
    tile_light light;
    const int hits = (int)t->close->data.hit_rows;
    memset(out, 0, sizeof *out);
    for (int part = 0; part < hits; part++) {
        render_glitter(cx, light_of_rows(t->light, hits, part, &light), rows_from(part * TILE_HEIGHT, &grid), t->close_estimate + part, &rows, NULL);
        add_rows(&rows, hits, part * TILE_HEIGHT, out);
    }
}

static void mangata_pixels(const method_tile *t, tile_pixels *out)
{
    const struct kernel_context cx = context_of(t, t->close);
    row_grid grid;
    if (t->close->data.hit_rows > 1)
        several_hits(t, &cx, out);
    else
        render_glitter(&cx, t->light, rows_from(0, &grid), t->close_estimate, out, t->detail);
}

static void podee_pixels(const method_tile *t, tile_pixels *out)
{
    struct kernel_context cx = context_of(t, t->close);
    const struct kernel_context open = t->open ? context_of(t, t->open) : cx;
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const real column = lane_numbers() + (float)(i % TILE_WIDTH), row = real_broadcast((float)(i / TILE_WIDTH));
        const PixelRay p = pixel_ray_filtered(&cx, column, row);
        cx.light = light_at(t->light, i);
        if (!any_lane(p.water > real(0.0f))) {
            store_pixels(out, i, nothing_but_sky(&cx, p));
            continue;
        }
        const PodeeState state = podee_state(&cx, p.ray, load_estimate(t->close_estimate, i));
        PodeeState before = state;
        if (t->open)
            before = podee_state(&open, pixel_ray_filtered(&open, column, row).ray, load_estimate(t->open_estimate, i));
        const real coverage = FRAME(&cx).podee_kernels == 0 ? podee_coverage(&cx, before, state) : podee_mixture_coverage(&cx, before, state);
        store_pixels(out, i, podee_result_of(&cx, p, before, state, coverage));
    }
}

static void none_pixels(const method_tile *t, tile_pixels *out)
{
    memset(out, 0, sizeof *out);
    lanes_sample(t->frame, t->sky, t->light, t->close, t->close_estimate, NULL, NULL, 1, out);
}

static void lanes_method(mgt_method method, const method_tile *tile, tile_pixels *out)
{
    switch (method) {
    case MGT_METHOD_NONE:
        none_pixels(tile, out);
        break;
    case MGT_METHOD_MANGATA:
        mangata_pixels(tile, out);
        break;
    case MGT_METHOD_PODEE_UNIFORM:
    case MGT_METHOD_PODEE_PIXEL:
        podee_pixels(tile, out);
        break;
    default:
        BASELINES_NAME(MGT_LANES).pixels(method, tile, out);
    }
}

static void store_normal(tile_surface *out, size_t i, vec2 slope, mask water)
{
    const vec3 normal = normalize(vec3(real(0.0f) - slope.x, real(1.0f), real(0.0f) - slope.y));
    store(out->normal_x + i, SELECT(water, normal.x, real(0.0f)));
    store(out->normal_y + i, SELECT(water, normal.y, real(0.0f)));
    store(out->normal_z + i, SELECT(water, normal.z, real(0.0f)));
}

static void lanes_surface(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, tile_surface *out)
{
    const struct kernel_context context = context_for(frame, tile);
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const vec3 ray = pixel_ray_at(&context, lane_numbers() + (float)(i % TILE_WIDTH), real_broadcast((float)(i / TILE_WIDTH)));
        const SampleHit hit = sample_hit(&context, ray, load_estimate(estimate, i));
        const mask water = hit.found > real(0.0f);
        /* A camera within a wave has the surface behind it. */
        store(out->along + i, SELECT(water, max(hit.along, real(0.0f)) * sqrt(length_squared(ray)), real(infinity)));
        store_normal(out, i, hit.slope, water);
    }
}

static void lanes_filtered_normal(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, tile_surface *out)
{
    const struct kernel_context context = context_for(frame, tile);
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const real column = lane_numbers() + (float)(i % TILE_WIDTH);
        vec2 slope = vec2(real(0.0f), real(0.0f));
        real water = real(0.0f);
        for (int hit = 0; hit < (int)tile->data.hit_rows; hit++) {
            const size_t row = i / TILE_WIDTH * (size_t)tile->data.hit_rows + (size_t)hit, at = row * TILE_WIDTH + i % TILE_WIDTH;
            const PixelRay p = pixel_ray_filtered(&context, column, real_broadcast((float)row));
            const SlopeState state = slope_state(&context, p.ray, load_hit(&context, estimate + at / TILE_PIXELS, at % TILE_PIXELS));
            const real share = SELECT(p.water > real(0.0f), real(1.0f), real(0.0f));
            slope = add(slope, scale(state.close, share));
            water = water + share;
        }
        store_normal(out, i, scale(slope, real(1.0f) / max(water, real(1.0f))), water > real(0.0f));
    }
}

/* ---- display ---- */

static void lanes_display(const FrameData *frame, const float *rgb, uint8_t *rgba, size_t count)
{
    const struct kernel_context context = {.frame = frame};
    for (size_t i = 0; i < count; i += MGT_LANES) {
        const size_t valid = count - i < MGT_LANES ? count - i : MGT_LANES;
        const vec3 shown = displayed_lanes(&context, rgb + 3 * i, count - i);
        float channel[3][MGT_LANES];
        store(channel[0], display_code(&context, shown.x));
        store(channel[1], display_code(&context, shown.y));
        store(channel[2], display_code(&context, shown.z));
        for (size_t lane = 0; lane < valid; lane++) {
            for (int c = 0; c < 3; c++)
                rgba[4 * (i + lane) + (size_t)c] = (uint8_t)channel[c][lane];
            rgba[4 * (i + lane) + 3] = 255;
        }
    }
}

const lane_kernels LANES_NAME(MGT_LANES) = {
    MGT_LANES,
    lanes_sort,
    lanes_estimate,
    lanes_sample,
    lanes_sum,
    lanes_method,
    lanes_cells,
    lanes_surface,
    lanes_filtered_normal,
    lanes_display,
    &BASELINES_NAME(MGT_LANES),
    &SHADE_NAME(MGT_LANES),
    &NARROW_NAME(MGT_LANES),
    &FRONT_NAME(MGT_LANES),
    &RASTER_NAME(MGT_LANES),
};
