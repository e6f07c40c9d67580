/* SPDX-License-Identifier: MIT
 * The kernels of the baseline methods over the pixels of a tile, compiled once per lane width (MGT_LANES).
 *
 * Whatever the width, a pixel sees the same operations in the same order: the bits do not depend on it. */
#include "cpu/baseline_lanes.h"
#include "cpu/kernel_context.h"

#include "frame/atmosphere.h"
#include "params/methods.h"

#define LANES_NAME_(n) baseline_kernels_##n
#define LANES_NAME(n) LANES_NAME_(n)

#include "kernels/common/prelude_c.h"

#include "cpu/lane_access.h"
#include "cpu/lane_display.h"

#include "kernels/baselines/lean_moments.k"
#include "kernels/waves/lean_grid.k"

#define LEAN(cx) ((cx)->lean->data)

/* The moments of a texel. Level 0 stores none. */
static inline const float *lean_texel_at(const struct kernel_context *cx, int level, int column, int row)
{
    return cx->lean->levels[level] + (((size_t)row * LEAN_SIZE >> level) + (size_t)column) * LEAN_MOMENTS;
}

KERNEL vec2 LEAN_MEAN(CTX cx, real level, real column, real row)
{
    float at[3][MGT_LANES], mean[2][MGT_LANES];
    store(at[0], level), store(at[1], column), store(at[2], row);
    for (int i = 0; i < MGT_LANES; i++) {
        const int l = (int)at[0][i], x = (int)at[1][i], z = (int)at[2][i];
        if (l == 0) {
            mean[0][i] = cx->lean->slope_x[(size_t)z * LEAN_SIZE + (size_t)x];
            mean[1][i] = cx->lean->slope_z[(size_t)z * LEAN_SIZE + (size_t)x];
        } else {
            const float *texel = lean_texel_at(cx, l, x, z);
            mean[0][i] = texel[0], mean[1][i] = texel[1];
        }
    }
    return (vec2){load(mean[0]), load(mean[1])};
}

KERNEL vec3 LEAN_SQUARE(CTX cx, real level, real column, real row)
{
    float at[3][MGT_LANES], slope[2][MGT_LANES] = {{0}}, square[3][MGT_LANES] = {{0}};
    store(at[0], level), store(at[1], column), store(at[2], row);
    for (int i = 0; i < MGT_LANES; i++) {
        const int l = (int)at[0][i], x = (int)at[1][i], z = (int)at[2][i];
        if (l == 0) {
            slope[0][i] = cx->lean->slope_x[(size_t)z * LEAN_SIZE + (size_t)x];
            slope[1][i] = cx->lean->slope_z[(size_t)z * LEAN_SIZE + (size_t)x];
        } else {
            const float *texel = lean_texel_at(cx, l, x, z);
            square[0][i] = texel[2], square[1][i] = texel[3], square[2][i] = texel[4];
        }
    }
    const LeanMoments points = point_moments(cx, (vec2){load(slope[0]), load(slope[1])});
    return SELECT3(level < real(1.0f), points.square, ((vec3){load(square[0]), load(square[1]), load(square[2])}));
}

#include "kernels/baselines/bruneton.k"
#include "kernels/baselines/ggx_moments.k"
#include "kernels/baselines/leadr.k"
#include "kernels/baselines/msaa.k"
#include "kernels/adaptive/temporal_ray.k"
#include "kernels/baselines/tndf.k"
#include "kernels/baselines/tokuyoshi.k"

/* ---- pixels ---- */

static inline HitEstimate load_estimate(const tile_estimate *estimate, size_t i)
{
    const vec2 shift = vec2(load(estimate->shift_x + i), load(estimate->shift_z + i));
    return (HitEstimate){load(estimate->height + i), load(estimate->from + i), load(estimate->search + i), vec2(real(0.0f), real(0.0f)), shift};
}

static inline void store_result(tile_pixels *out, size_t i, PixelResult p)
{
    store(out->red + i, p.color.x);
    store(out->green + i, p.color.y);
    store(out->blue + i, p.color.z);
    store(out->coverage + i, p.coverage);
    store(out->water + i, p.water);
    store(out->foam + i, p.foam);
}

static PixelResult sky_alone(const struct kernel_context *cx, PixelRay p)
{
    PixelResult result = {vec3(real(0.0f), real(0.0f), real(0.0f)), real(0.0f), real(0.0f), real(0.0f)};
    if (FRAME(cx).want_color != 0)
        result.color = background(cx, p.sky_ray);
    return result;
}

static inline const float *light_at(const tile_light *light, size_t i) { return light ? &light->through[0][i] : NULL; }

static struct kernel_context context_of(const method_tile *t, const tile_waves *waves)
{
    struct kernel_context cx = context_for(t->frame, waves);
    cx.sky = t->sky;
    cx.lean = t->lean;
    return cx;
}

/* A method that shades a point of the surface with all its waves. */
typedef PixelResult point_method(CTX cx, real column, real row, HitEstimate estimate);

static void point_pixels(point_method *shade, const method_tile *t, tile_pixels *out)
{
    struct kernel_context cx = context_of(t, t->close);
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        cx.light = light_at(t->light, i);
        store_result(out, i, shade(&cx, lane_numbers() + (float)(i % TILE_WIDTH), real((float)(i / TILE_WIDTH)), load_estimate(t->close_estimate, i)));
    }
}

/* A method that shades a pixel by its slopes. `open` is `close` unless the camera moves. */
typedef PixelResult slope_method(CTX cx, PixelRay p, SlopeState open, SlopeState close);

static void slope_pixels(slope_method *shade, const method_tile *t, tile_pixels *out)
{
    struct kernel_context cx = context_of(t, t->close);
    const struct kernel_context open = t->open ? context_of(t, t->open) : cx;
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const real column = lane_numbers() + (float)(i % TILE_WIDTH), row = real((float)(i / TILE_WIDTH));
        const PixelRay p = pixel_ray_filtered(&cx, column, row);
        cx.light = light_at(t->light, i);
        if (!any_lane(p.water > real(0.0f))) {
            store_result(out, i, sky_alone(&cx, p));
            continue;
        }
        const SlopeState close = slope_state(&cx, p.ray, load_estimate(t->close_estimate, i));
        SlopeState before = close;
        if (t->open)
            before = slope_state(&open, pixel_ray_filtered(&open, column, row).ray, load_estimate(t->open_estimate, i));
        store_result(out, i, over_state(&cx, shade(&cx, p, before, close), p, close));
    }
}

/* The kernels' entry points by method. */
static point_method *const point_methods[METHOD_SLOTS] = {
    [MGT_METHOD_MSAA32] = msaa_pixel,
    [MGT_METHOD_TOKUYOSHI] = tokuyoshi_pixel,
};
static slope_method *const slope_methods[METHOD_SLOTS] = {
    [MGT_METHOD_LEAN] = lean_result,
    [MGT_METHOD_LEADR] = leadr_result,
    [MGT_METHOD_BRUNETON] = bruneton_result,
    [MGT_METHOD_TNDF] = tndf_result,
    [MGT_METHOD_GGX_MOMENTS] = ggx_moments_result,
};

static void lanes_pixels(mgt_method method, const method_tile *t, tile_pixels *out)
{
    if (point_methods[method])
        point_pixels(point_methods[method], t, out);
    else
        slope_pixels(slope_methods[method], t, out);
}

/* ---- rays over the shutter ---- */

static inline real gather(const float *plane, const uint16_t *list)
{
    float lanes[MGT_LANES];
    for (int i = 0; i < MGT_LANES; i++)
        lanes[i] = plane[list[i]];
    return load(lanes);
}

static inline HitEstimate gather_estimate(const tile_estimate *estimate, const uint16_t *list)
{
    const vec2 shift = vec2(gather(estimate->shift_x, list), gather(estimate->shift_z, list));
    return (HitEstimate){gather(estimate->height, list), gather(estimate->from, list), gather(estimate->search, list), vec2(real(0.0f), real(0.0f)), shift};
}

static void lanes_temporal(const method_tile *t, temporal_rays *rays)
{
    struct kernel_context cx = context_of(t, t->close);
    const struct kernel_context open = t->open ? context_of(t, t->open) : cx;
    for (size_t i = rays->count; i % MGT_LANES != 0; i++) {
        rays->pixel[i] = rays->pixel[i - 1];
        rays->column[i] = rays->column[i - 1];
        rays->row[i] = rays->row[i - 1];
    }
    for (size_t i = 0; i < rays->count; i += MGT_LANES) {
        const real column = load(rays->column + i), row = load(rays->row + i);
        cx.light = light_at(t->light, i);
        const vec3 ray = pixel_ray_at(&cx, column, row);
        const TemporalEnd close = temporal_end(&cx, ray, gather_estimate(t->close_estimate, rays->pixel + i));
        TemporalEnd before = close;
        if (t->open)
            before = temporal_end(&open, pixel_ray_at(&open, column, row), gather_estimate(t->open_estimate, rays->pixel + i));
        store_result(&rays->pixels, i, temporal_result(&cx, ray, before, close));
    }
}

/* Footprints are those on the mean surface. Waves without height are left out. */
static void lanes_frequencies(const method_tile *t, const wave_set *waves, float *most)
{
    const struct kernel_context cx = {.frame = t->frame, .tile = &t->close->data};
    const int count = sines_moving(waves);
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const PixelRay p = pixel_ray_filtered(&cx, lane_numbers() + (float)(i % TILE_WIDTH), real((float)(i / TILE_WIDTH)));
        const Footprint f = mean_footprint(&cx, p);
        real squared = real(0.0f);
        for (int w = 0; w < count; w++)
            squared = max(squared, wave_frequency(&cx, f, waves->data[w]));
        store(most + i, SELECT(p.water > real(0.0f), sqrt(squared), real(0.0f)));
    }
}

/* ---- the map's rows ---- */

static void lanes_lean_rows(const lean_waves *waves, const lean_phase *phases, float *slope_x, float *slope_z)
{
    for (size_t column = 0; column < LEAN_SIZE; column += MGT_LANES) {
        const float *wave = waves->columns + column / LEAN_BLOCK * waves->count * 2 * LEAN_BLOCK + column % LEAN_BLOCK;
        vec2 slopes[LEAN_ROWS];
        for (int r = 0; r < LEAN_ROWS; r++)
            slopes[r] = vec2(real(0.0f), real(0.0f));
        for (size_t i = 0; i < waves->count; i++, wave += 2 * LEAN_BLOCK) {
            const real cosine = load(wave), sine = load(wave + LEAN_BLOCK);
            for (int r = 0; r < LEAN_ROWS; r++) {
                const real steep = grid_cosine(NULL, cosine, sine, real(phases[i].cosine[r]), real(phases[i].minus_sine[r]));
                slopes[r] = grid_slopes(NULL, slopes[r], lean_wave(waves, i), steep);
            }
        }
        for (int r = 0; r < LEAN_ROWS; r++) {
            store(slope_x + (size_t)r * LEAN_SIZE + column, slopes[r].x);
            store(slope_z + (size_t)r * LEAN_SIZE + column, slopes[r].y);
        }
    }
}

/* ---- displayed pixels ---- */

static void lanes_luma(const FrameData *frame, const float *rgb, float *luma, size_t count)
{
    const struct kernel_context context = {.frame = frame};
    for (size_t i = 0; i < count; i += MGT_LANES) {
        const size_t valid = count - i < MGT_LANES ? count - i : MGT_LANES;
        float shown[MGT_LANES];
        store(shown, display_luma(&context, displayed_lanes(&context, rgb + 3 * i, count - i)));
        for (size_t lane = 0; lane < valid; lane++)
            luma[i + lane] = shown[lane];
    }
}

const baseline_kernels LANES_NAME(MGT_LANES) = {lanes_pixels, lanes_temporal, lanes_frequencies, lanes_lean_rows, lanes_luma};
