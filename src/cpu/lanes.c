/* SPDX-License-Identifier: MIT
 * The kernels over the pixels of a tile, compiled once per lane width (MGT_LANES).
 *
 * Whatever the width, a pixel sees the same operations in the same order: the bits do not depend on it. */
#include "cpu/lanes.h"

#include <math.h>

#include "precompute/atmosphere.h"

#define LANES_NAME_(n) lane_kernels_##n
#define LANES_NAME(n) LANES_NAME_(n)
static const float infinity = INFINITY;

#include "kernels/prelude_c.h"

#define FRAME(cx) (*(cx)->frame)
#define TILE(cx) (*(cx)->tile)
#define WAVE(cx, i) ((cx)->waves[i])
#define MARCH_WAVE(cx, i) ((cx)->march[i])

KERNEL vec3 SKY_TEXEL(CTX cx, real column, real row)
{
    const real index = real_fma(row, real_broadcast(SKY_COLUMNS), column);
#if MGT_LANES == 1
    const float *texel = cx->sky + 3 * (int)index;
    return (vec3){texel[0], texel[1], texel[2]};
#else
    const mask at = __builtin_convertvector(index, mask) * 3;
#if MGT_LANES == 16
    return (vec3){(real)_mm512_i32gather_ps((__m512i)at, cx->sky, 4), (real)_mm512_i32gather_ps((__m512i)at, cx->sky + 1, 4),
                  (real)_mm512_i32gather_ps((__m512i)at, cx->sky + 2, 4)};
#elif MGT_LANES == 8
    return (vec3){(real)_mm256_i32gather_ps(cx->sky, (__m256i)at, 4), (real)_mm256_i32gather_ps(cx->sky + 1, (__m256i)at, 4),
                  (real)_mm256_i32gather_ps(cx->sky + 2, (__m256i)at, 4)};
#else
    vec3 texel;
    for (int i = 0; i < MGT_LANES; i++) {
        texel.x[i] = cx->sky[at[i]];
        texel.y[i] = cx->sky[at[i] + 1];
        texel.z[i] = cx->sky[at[i] + 2];
    }
    return texel;
#endif
#endif
}

#include "kernels/glitter.k"
#include "kernels/podee.k"
#include "kernels/sample.k"
#include "kernels/tone.k"

/* ---- loads and stores ---- */

static inline real load(const float *p)
{
#if MGT_LANES == 1
    return *p;
#else
    real r;
    __builtin_memcpy(&r, p, sizeof r);
    return r;
#endif
}

static inline void store(float *p, real r)
{
    __builtin_memcpy(p, &r, sizeof r);
}

/* 0, 1, 2, … for the lanes. */
static inline real lane_numbers(void)
{
    static const float numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return load(numbers);
}

static inline HitGuess load_guess(const tile_guess *guess, size_t i)
{
    return (HitGuess){load(guess->height + i), load(guess->from + i), load(guess->march + i)};
}

/* ---- first-hit lattice ---- */

/* Hits at the nodes, as tangent planes: a ray meets the plane of a node where along · (slope·ray.xz − ray.y) = level. */
typedef struct tile_nodes {
    float ray_x[NODE_PADDED], ray_y[NODE_PADDED], ray_z[NODE_PADDED];
    float along[NODE_PADDED], height[NODE_PADDED], slope_x[NODE_PADDED], slope_z[NODE_PADDED], found[NODE_PADDED];
    float level[NODE_PADDED];
} tile_nodes;

static void march_nodes(const struct kernel_context *cx, tile_nodes *nodes)
{
    float column[NODE_PADDED], row[NODE_PADDED];
    for (int i = 0; i < NODE_PADDED; i++) {
        const int node = i < NODE_COUNT ? i : NODE_COUNT - 1;
        column[i] = (float)(node % NODE_COLUMNS * NODE_STEP_X);
        row[i] = (float)(node / NODE_COLUMNS * NODE_STEP_Y);
    }
    for (int i = 0; i < NODE_PADDED; i += MGT_LANES) {
        const vec3 ray = pixel_ray_at(cx, load(column + i), load(row + i));
        const NodeHit hit = node_hit(cx, ray);
        const mask found = hit.found > real(0.0f);
        const real height = SELECT(found, hit.height, real(0.0f));
        const real slope_x = SELECT(found, hit.slope.x, real(0.0f)), slope_z = SELECT(found, hit.slope.y, real(0.0f));
        store(nodes->ray_x + i, ray.x);
        store(nodes->ray_y + i, ray.y);
        store(nodes->ray_z + i, ray.z);
        store(nodes->along + i, hit.along);
        store(nodes->height + i, height);
        store(nodes->slope_x + i, slope_x);
        store(nodes->slope_z + i, slope_z);
        store(nodes->found + i, hit.found);
        store(nodes->level + i, real(cx->tile->camera_height) - height + hit.along * real_fma(slope_x, ray.x, slope_z * ray.z));
    }
}

/* Whether the tangent plane at node `from` leads to what node `to` found. Where it does not, a crest may stand between. */
static bool nodes_agree(const tile_nodes *n, int from, int to)
{
    const float closing = n->slope_x[from] * n->ray_x[to] + n->slope_z[from] * n->ray_z[to] - n->ray_y[to];
    const float miss = n->level[from] - n->along[to] * closing;
    const float tolerance = 0.3f * n->along[to] * closing;
    return closing > 0 && miss < tolerance && -miss < tolerance;
}

/* Rays so steep that no wave can hide another need no second look. */
static bool tile_may_occlude(const TileData *t, const tile_nodes *nodes)
{
    for (int corner = 0; corner < 4; corner++) {
        const int n = (corner & 1 ? NODE_COLUMNS - 1 : 0) + (corner & 2 ? NODE_COUNT - NODE_COLUMNS : 0);
        const float x = nodes->ray_x[n], y = nodes->ray_y[n], z = nodes->ray_z[n];
        if (y * y < t->march_slope * t->march_slope * (x * x + z * z) || y >= 0)
            return true;
    }
    return false;
}

/* The nodes at the left and right of every pixel column, for one row of nodes. */
typedef struct node_planes {
    float level[2][TILE_WIDTH], slope_x[2][TILE_WIDTH], slope_z[2][TILE_WIDTH], height[2][TILE_WIDTH];
} node_planes;

static void spread_nodes(const tile_nodes *nodes, int row, node_planes *out)
{
    for (int side = 0; side < 2; side++)
        for (int x = 0; x < TILE_WIDTH; x++) {
            const int n = row * NODE_COLUMNS + x / NODE_STEP_X + side;
            out->slope_x[side][x] = nodes->slope_x[n];
            out->slope_z[side][x] = nodes->slope_z[n];
            out->level[side][x] = nodes->level[n];
            out->height[side][x] = nodes->height[n];
        }
}

/* Height at which a ray meets a node's plane; the node's own height where it does not, or far off. */
static inline real plane_height(const TileData *t, const node_planes *p, int side, int x, vec3 ray)
{
    const real closing = real_fma(load(p->slope_x[side] + x), ray.x, real_fma(load(p->slope_z[side] + x), ray.z, -ray.y));
    const real own = load(p->height[side] + x);
    const mask meets = closing > abs(ray.y) * 0.1f;
    const real height = real_fma(ray.y, load(p->level[side] + x) / SELECT(meets, closing, real(1.0f)), real(t->camera_height));
    const real bound = real(t->march_bound);
    return SELECT(AND(meets, abs(height) <= bound), height, own);
}

/* Heights between nodes: the mean of interpolated heights and interpolated planes. Their errors of second order are opposite. */
static void guess_heights(const struct kernel_context *cx, const tile_nodes *nodes, tile_guess *guess)
{
    const TileData *t = cx->tile;
    node_planes planes[2];
    float shares[TILE_WIDTH];
    for (int x = 0; x < TILE_WIDTH; x++)
        shares[x] = (float)(x % NODE_STEP_X) / NODE_STEP_X;
    spread_nodes(nodes, 0, &planes[0]);
    for (int y = 0; y < TILE_HEIGHT; y++) {
        const node_planes *above = &planes[y / NODE_STEP_Y & 1], *below = &planes[(y / NODE_STEP_Y & 1) ^ 1];
        if (y % NODE_STEP_Y == 0)
            spread_nodes(nodes, y / NODE_STEP_Y + 1, &planes[(y / NODE_STEP_Y & 1) ^ 1]);
        const real v = real((float)(y % NODE_STEP_Y) / NODE_STEP_Y);
        for (int x = 0; x < TILE_WIDTH; x += MGT_LANES) {
            const real u = load(shares + x);
            const vec3 ray = pixel_ray_at(cx, lane_numbers() + (float)x, real((float)y));
            real top_left = load(above->height[0] + x) + plane_height(t, above, 0, x, ray);
            real top_right = load(above->height[1] + x) + plane_height(t, above, 1, x, ray);
            real low_left = load(below->height[0] + x) + plane_height(t, below, 0, x, ray);
            real low_right = load(below->height[1] + x) + plane_height(t, below, 1, x, ray);
            const real top = real_fma(u, top_right - top_left, top_left), low = real_fma(u, low_right - low_left, low_left);
            store(guess->height + y * TILE_WIDTH + x, real(0.5f) * real_fma(v, low - top, top));
        }
    }
}

/* Which pixels of a cell must march themselves, and from where. */
static void guess_march(const tile_nodes *nodes, bool may_occlude, int cell_x, int cell_y, tile_guess *guess)
{
    const int n00 = cell_y * NODE_COLUMNS + cell_x, n10 = n00 + 1, n01 = n00 + NODE_COLUMNS, n11 = n01 + 1;
    float march = 0, from = nodes->along[n00];
    from = nodes->along[n10] < from ? nodes->along[n10] : from;
    from = nodes->along[n01] < from ? nodes->along[n01] : from;
    from = nodes->along[n11] < from ? nodes->along[n11] : from;
    const float found = nodes->found[n00] + nodes->found[n10] + nodes->found[n01] + nodes->found[n11];
    if (may_occlude && found > 0) {
        const bool agree = found == 4 && nodes_agree(nodes, n00, n10) && nodes_agree(nodes, n10, n00) && nodes_agree(nodes, n01, n11) &&
                           nodes_agree(nodes, n11, n01) && nodes_agree(nodes, n00, n01) && nodes_agree(nodes, n01, n00) &&
                           nodes_agree(nodes, n10, n11) && nodes_agree(nodes, n11, n10);
        march = agree ? 0.0f : 1.0f;
    }
    for (int y = 0; y < NODE_STEP_Y; y++)
        for (int x = 0; x < NODE_STEP_X; x++) {
            const int i = (cell_y * NODE_STEP_Y + y) * TILE_WIDTH + cell_x * NODE_STEP_X + x;
            guess->march[i] = march;
            guess->from[i] = from;
        }
}

static void lanes_guess(const FrameData *frame, const tile_waves *tile, tile_guess *guess)
{
    const struct kernel_context cx = {frame, &tile->data, tile->waves, tile->march, NULL};
    if (tile->data.march_pixels) {
        *guess = (tile_guess){0};
        for (int i = 0; i < TILE_PIXELS; i++)
            guess->march[i] = 1;
        return;
    }
    tile_nodes nodes;
    march_nodes(&cx, &nodes);
    const bool may_occlude = tile_may_occlude(&tile->data, &nodes);
    for (int y = 0; y < NODE_ROWS - 1; y++)
        for (int x = 0; x < NODE_COLUMNS - 1; x++)
            guess_march(&nodes, may_occlude, x, y, guess);
    guess_heights(&cx, &nodes, guess);
}

/* ---- methods ---- */

static inline void accumulate(float *p, real value, float weight)
{
    store(p, load(p) + value * weight);
}

static void lanes_sample(const FrameData *frame, const float *sky, const tile_waves *tile, const tile_guess *guess, const float *dx,
                         const float *dy, float weight, tile_pixels *out)
{
    const struct kernel_context context = {frame, &tile->data, tile->waves, tile->march, sky};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        real column = lane_numbers() + (float)(i % TILE_WIDTH);
        real row = real_broadcast((float)(i / TILE_WIDTH));
        if (dx) {
            column = column + load(dx + i);
            row = row + load(dy + i);
        }
        const PixelResult p = sample_pixel(&context, column, row, load_guess(guess, i));
        accumulate(out->red + i, p.color.x, weight);
        accumulate(out->green + i, p.color.y, weight);
        accumulate(out->blue + i, p.color.z, weight);
        accumulate(out->coverage + i, p.coverage, weight);
        accumulate(out->water + i, p.water, weight);
    }
}

static PixelResult nothing_but_sky(const struct kernel_context *cx, PixelRay p)
{
    PixelResult result = {vec3(real(0.0f), real(0.0f), real(0.0f)), real(0.0f), real(0.0f)};
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
}

static void lanes_filtered(const FrameData *frame, const float *sky, mgt_method method, const tile_waves *close, const tile_guess *close_guess,
                           const tile_waves *open, const tile_guess *open_guess, tile_pixels *out)
{
    const struct kernel_context context = {frame, &close->data, close->waves, close->march, sky};
    struct kernel_context open_context = context;
    if (open)
        open_context.tile = &open->data, open_context.waves = open->waves, open_context.march = open->march;
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const real column = lane_numbers() + (float)(i % TILE_WIDTH);
        const real row = real_broadcast((float)(i / TILE_WIDTH));
        const PixelRay p = pixel_ray_filtered(&context, column, row);
        if (!any_lane(p.water > real(0.0f))) {
            store_pixels(out, i, nothing_but_sky(&context, p));
            continue;
        }
        if (method == MGT_METHOD_MANGATA) {
            const SlopeState state = slope_state(&context, p.ray, load_guess(close_guess, i));
            SlopeState before = state;
            if (open)
                before = slope_state(&open_context, pixel_ray_filtered(&open_context, column, row).ray, load_guess(open_guess, i));
            store_pixels(out, i, glitter_result(&context, p, before, state));
        } else {
            const PodeeState state = podee_state(&context, p.ray, load_guess(close_guess, i));
            PodeeState before = state;
            if (open)
                before = podee_state(&open_context, pixel_ray_filtered(&open_context, column, row).ray, load_guess(open_guess, i));
            store_pixels(out, i, podee_result(&context, p, before, state));
        }
    }
}

static void store_normal(tile_surface *out, size_t i, vec2 slope, mask water)
{
    const vec3 normal = normalize(vec3(real(0.0f) - slope.x, real(1.0f), real(0.0f) - slope.y));
    store(out->normal_x + i, SELECT(water, normal.x, real(0.0f)));
    store(out->normal_y + i, SELECT(water, normal.y, real(0.0f)));
    store(out->normal_z + i, SELECT(water, normal.z, real(0.0f)));
}

static void lanes_surface(const FrameData *frame, const tile_waves *tile, const tile_guess *guess, tile_surface *out)
{
    const struct kernel_context context = {frame, &tile->data, tile->waves, tile->march, NULL};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const vec3 ray = pixel_ray_at(&context, lane_numbers() + (float)(i % TILE_WIDTH), real_broadcast((float)(i / TILE_WIDTH)));
        const SampleHit hit = sample_hit(&context, ray, load_guess(guess, i));
        const mask water = hit.found > real(0.0f);
        store(out->along + i, SELECT(water, hit.along * sqrt(length_squared(ray)), real(infinity)));
        store_normal(out, i, hit.slope, water);
    }
}

static void lanes_filtered_normal(const FrameData *frame, const tile_waves *tile, const tile_guess *guess, tile_surface *out)
{
    const struct kernel_context context = {frame, &tile->data, tile->waves, tile->march, NULL};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const PixelRay p = pixel_ray_filtered(&context, lane_numbers() + (float)(i % TILE_WIDTH), real_broadcast((float)(i / TILE_WIDTH)));
        const SlopeState state = slope_state(&context, p.ray, load_guess(guess, i));
        store_normal(out, i, state.close, p.water > real(0.0f));
    }
}

/* ---- display ---- */

static void lanes_display(const FrameData *frame, const float *rgb, uint8_t *rgba, size_t count)
{
    const struct kernel_context context = {frame, NULL, NULL, NULL, NULL};
    for (size_t i = 0; i < count; i += MGT_LANES) {
        const size_t valid = count - i < MGT_LANES ? count - i : MGT_LANES;
        float channel[3][MGT_LANES] = {{0}};
        for (size_t lane = 0; lane < valid; lane++)
            for (int c = 0; c < 3; c++)
                channel[c][lane] = rgb[3 * (i + lane) + (size_t)c];
        const vec3 shown = display_color(&context, vec3(load(channel[0]), load(channel[1]), load(channel[2])), frame->tone_map);
        store(channel[0], shown.x);
        store(channel[1], shown.y);
        store(channel[2], shown.z);
        for (size_t lane = 0; lane < valid; lane++) {
            for (int c = 0; c < 3; c++)
                rgba[4 * (i + lane) + (size_t)c] = (uint8_t)(channel[c][lane] * 255.0f + 0.5f);
            rgba[4 * (i + lane) + 3] = 255;
        }
    }
}

const lane_kernels LANES_NAME(MGT_LANES) = {
    MGT_LANES, lanes_guess, lanes_sample, lanes_filtered, lanes_surface, lanes_filtered_normal, lanes_display,
};
