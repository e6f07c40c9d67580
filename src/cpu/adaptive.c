/* SPDX-License-Identifier: MIT
 * Method adaptive: pixels of method `mangata` are split into four cells again and again where that is worth most.
 *
 * A picture of pixels comes first. Every pixel or cell says how far off its coverage may be; the leaves of this forest are split in order of the
 * squared error that this may save for each evaluation of the waves. That goes in rounds, for the cells of a round tell what the next one is worth.
 * Sums are kept per tile in a fixed order and counted in whole numbers across tiles, so that threads change nothing. */
#define _POSIX_C_SOURCE 199309L
#include "cpu/adaptive.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    LEVELS = 7, /* a pixel has up to 64 × 64 cells */
    BUCKETS_PER_OCTAVE = 32,
    OCTAVES = 96,
    BUCKETS = BUCKETS_PER_OCTAVE * OCTAVES,
    BUCKET_ZERO = (127 - 80) * BUCKETS_PER_OCTAVE, /* of 2^-80 */
    KEPT_OCTAVES = 5, /* leaves worth less than 2^-5 of what was split last are settled */
};
static const double cost_unit = 65536; /* evaluations of all waves are counted in these parts */

/* A pixel or cell that may be split. */
typedef struct leaf {
    uint16_t column, row; /* within the tile, in cells of the level */
    uint16_t level;
    uint16_t bucket;      /* of what a split is worth */
    float color[3], coverage, water, height, variance, contrast;
} leaf;

typedef struct forest_tile {
    leaf *leaves;
    size_t count, capacity;
    double cost[LEVELS];  /* of a cell, evaluations of all waves; 0 as long as it is unknown */
    double spent;
    double final_variance; /* of what is split no more: sum of squared errors of pixels */
    bool sees_water;
} forest_tile;

typedef struct round_plan {
    int bucket;     /* leaves above this bucket are split, … */
    double share;   /* … and this share of those in it */
} round_plan;

/* Of one worker; whole numbers, so that their sum does not depend on who counted what. */
typedef struct census {
    uint64_t cost[BUCKETS];
} census;

typedef struct forest {
    const adaptive_frame *a;
    const picture_planes *out;
    uint32_t columns, rows;
    forest_tile *tiles;
    float *weight;         /* a pixel's, squared */
    wave_set *close;       /* LEVELS of them, and as many for `open` where the camera moves */
    wave_set *open;
    FrameData data[LEVELS];
    tile_cells **cells;    /* one a worker */
    census **census;
    size_t workers;
    round_plan plan;
    atomic_bool failed;    /* memory was short */
} forest;

/* ---- places ---- */

static size_t pixel_of(const forest *f, size_t tile, const leaf *l)
{
    const size_t x = tile % f->columns * TILE_WIDTH + (l->column >> l->level), y = tile / f->columns * TILE_HEIGHT + (l->row >> l->level);
    return y * f->out->width + x;
}

static double area_of(uint16_t level)
{
    return ldexp(1, -2 * level);
}

/* A cell is final: its share of the pixel. */
static void settle(const forest *f, size_t tile, const leaf *l)
{
    const picture_planes *p = f->out;
    const size_t i = pixel_of(f, tile, l);
    const float area = (float)area_of(l->level);
    for (int k = 0; k < 3; k++)
        p->color[3 * i + (size_t)k] += area * l->color[k];
    p->coverage[i] += area * l->coverage;
    p->water[i] += area * l->water;
    if (l->level > 0)
        p->detail[i] += area * l->coverage;
    f->tiles[tile].final_variance += area_of(l->level) * area_of(l->level) * (double)l->variance;
}

/* ---- what a split is worth ---- */

/* Of a cell of the next level, from the nearest one that is known. */
static double cost_below(const forest_tile *t, uint16_t level)
{
    for (int k = level + 1; k >= 0; k--)
        if (t->cost[k] > 0)
            return fmin(t->cost[k] * (1 + 0.3 * (level + 1 - k)), 1);
    return 1;
}

/* Steps of a 32nd octave, straight within an octave: the upper bits of the float. */
static uint16_t bucket_of(double worth)
{
    const float scaled = (float)worth;
    uint32_t bits;
    memcpy(&bits, &scaled, sizeof bits);
    const int32_t bucket = (int32_t)(bits >> 18) - BUCKET_ZERO;
    return bucket <= 0 ? 0 : bucket >= BUCKETS ? BUCKETS - 1 : (uint16_t)bucket;
}

/* Adds a leaf, or settles it where a split is worth nothing. */
static bool add_leaf(const forest *f, size_t tile, leaf l)
{
    forest_tile *t = &f->tiles[tile];
    const double area = area_of(l.level);
    const double worth = area * area * (double)l.contrast * (double)f->weight[pixel_of(f, tile, &l)] / (4 * cost_below(t, l.level));
    l.bucket = worth > 0 ? bucket_of(worth) : 0;
    if (l.bucket == 0 || l.level + 1 == LEVELS) {
        settle(f, tile, &l);
        return true;
    }
    if (t->count == t->capacity) {
        const size_t capacity = t->capacity ? 2 * t->capacity : 64;
        leaf *grown = realloc(t->leaves, capacity * sizeof *grown);
        if (!grown)
            return false;
        t->leaves = grown;
        t->capacity = capacity;
    }
    t->leaves[t->count++] = l;
    return true;
}

static leaf leaf_from(const tile_pixels *p, const tile_detail *d, size_t i)
{
    return (leaf){.color = {p->red[i], p->green[i], p->blue[i]},
                  .coverage = p->coverage[i],
                  .water = p->water[i],
                  .height = d->height[i],
                  .variance = d->variance[i],
                  .contrast = d->contrast[i]};
}

/* ---- the picture of pixels ---- */

static void sort_level(const forest *f, size_t tile, int level, tile_scratch *s)
{
    const adaptive_frame *a = f->a;
    const uint32_t x = (uint32_t)(tile % f->columns), y = (uint32_t)(tile / f->columns);
    forest_tile *t = &f->tiles[tile];
    a->kernels->sort(&f->data[level], &f->close[level], x, y, &s->close);
    if (f->open)
        a->kernels->sort(&f->data[level], &f->open[level], x, y, &s->open);
    const TileData *d = &s->close.data;
    const int waves = f->close[level].view.wave_count;
    t->cost[level] = waves > 0 ? fmax((double)(d->resolved_count + d->mixed_count) / waves, 1e-3) : 1;
}

static void guess_tile(const forest *f, const tile_waves *waves, tile_guess *guess)
{
    if (tile_sees_water(waves))
        f->a->kernels->guess(&f->data[0], waves, guess);
    else
        memset(guess, 0, sizeof *guess);
}

/* What an error of the pixel's luminance is worth in the displayed picture, squared: tone maps show relative errors where it is bright. */
static float weight_of(const forest *f, const float color[3])
{
    const float luminance = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
    const float slope = 1 / (1 + f->data[0].exposure * luminance);
    return slope * slope;
}

static void plant_tile(void *argument, size_t tile, uint32_t worker)
{
    forest *f = argument;
    const adaptive_frame *a = f->a;
    const picture_planes *p = f->out;
    tile_scratch *s = a->scratch[worker];
    tile_detail *detail = &f->cells[worker]->detail;
    forest_tile *t = &f->tiles[tile];
    sort_level(f, tile, 0, s);
    guess_tile(f, &s->close, &s->close_guess);
    if (f->open)
        guess_tile(f, &s->open, &s->open_guess);
    a->kernels->filtered(&f->data[0], a->sky, NULL, MGT_METHOD_MANGATA, &s->close, &s->close_guess, f->open ? &s->open : NULL,
                         f->open ? &s->open_guess : NULL, &s->pixels, detail);
    const uint32_t left = (uint32_t)(tile % f->columns) * TILE_WIDTH, top = (uint32_t)(tile / f->columns) * TILE_HEIGHT;
    for (uint32_t y = 0; y < TILE_HEIGHT && top + y < p->height; y++)
        for (uint32_t x = 0; x < TILE_WIDTH && left + x < p->width; x++) {
            const size_t from = (size_t)y * TILE_WIDTH + x, to = (size_t)(top + y) * p->width + left + x;
            leaf l = leaf_from(&s->pixels, detail, from);
            l.column = (uint16_t)x;
            l.row = (uint16_t)y;
            f->weight[to] = weight_of(f, l.color);
            p->importance[to] = sqrtf(l.variance);
            p->samples[to] = l.water > 0 ? (float)t->cost[0] : 0;
            t->spent += (double)p->samples[to];
            if (!add_leaf(f, tile, l))
                atomic_store(&f->failed, true);
        }
}

/* ---- rounds ---- */

static void count_tile(void *argument, size_t tile, uint32_t worker)
{
    const forest *f = argument;
    const forest_tile *t = &f->tiles[tile];
    uint64_t *cost = f->census[worker]->cost;
    uint64_t units[LEVELS];
    for (uint16_t level = 0; level < LEVELS; level++)
        units[level] = level + 1 < LEVELS ? (uint64_t)(4 * cost_below(t, level) * cost_unit) : 0;
    for (size_t i = 0; i < t->count; i++)
        cost[t->leaves[i].bucket] += units[t->leaves[i].level];
}

/* Which leaves may be split for `budget` evaluations. False: none. */
static bool make_plan(forest *f, double budget)
{
    for (size_t i = 0; i < f->workers; i++)
        memset(f->census[i], 0, sizeof **f->census);
    const thread_loop loop = {(size_t)f->columns * f->rows, count_tile, f, NULL};
    thread_pool_run(f->a->pool, &loop);
    double left = budget * cost_unit;
    f->plan = (round_plan){-1, 0};
    bool any = false;
    for (int b = BUCKETS - 1; b >= 0; b--) {
        uint64_t cost = 0;
        for (size_t i = 0; i < f->workers; i++)
            cost += f->census[i]->cost[b];
        any |= cost > 0;
        if ((double)cost > left) {
            f->plan = (round_plan){b, left / (double)cost};
            break;
        }
        left -= (double)cost;
    }
    return any;
}

/* A number in [0, 1) that is the leaf's own. */
static double lot_of(size_t tile, const leaf *l)
{
    uint64_t x = (uint64_t)tile << 40 ^ (uint64_t)l->level << 32 ^ (uint64_t)l->column << 16 ^ l->row;
    x = (x + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 29)) * 0x94d049bb133111ebu;
    return (double)(x >> 11) * 0x1p-53;
}

static bool is_chosen(const forest *f, size_t tile, const leaf *l)
{
    return l->bucket > f->plan.bucket || (l->bucket == f->plan.bucket && lot_of(tile, l) < f->plan.share);
}

/* Renders the children that wait in `cells`. */
static bool grow(const forest *f, size_t tile, int level, uint32_t worker)
{
    const adaptive_frame *a = f->a;
    tile_cells *cells = f->cells[worker];
    tile_scratch *s = a->scratch[worker];
    forest_tile *t = &f->tiles[tile];
    a->kernels->cells(&f->data[level], a->sky, &s->close, f->open ? &s->open : NULL, cells);
    for (size_t i = 0; i < cells->count; i++) {
        leaf l = leaf_from(&cells->pixels, &cells->detail, i);
        l.column = (uint16_t)cells->column[i];
        l.row = (uint16_t)cells->row[i];
        l.level = (uint16_t)level;
        f->out->samples[pixel_of(f, tile, &l)] += (float)t->cost[level];
        t->spent += t->cost[level];
        if (!add_leaf(f, tile, l))
            return false;
    }
    cells->count = 0;
    return true;
}

/* The chosen leaves of one level make room for their children; `end` is how many leaves there were before the round. */
static bool split_level(const forest *f, size_t tile, int level, size_t end, uint32_t worker)
{
    forest_tile *t = &f->tiles[tile];
    tile_cells *cells = f->cells[worker];
    bool sorted = false;
    cells->count = 0;
    for (size_t i = 0; i < end; i++) {
        const leaf l = t->leaves[i];
        if (l.level != level || !is_chosen(f, tile, &l))
            continue;
        if (!sorted)
            sort_level(f, tile, level + 1, f->a->scratch[worker]);
        sorted = true;
        for (int k = 0; k < 4; k++) {
            cells->column[cells->count] = (float)(2 * l.column + k % 2);
            cells->row[cells->count] = (float)(2 * l.row + k / 2);
            cells->guess.height[cells->count++] = l.height;
        }
        if (cells->count == TILE_PIXELS && !grow(f, tile, level + 1, worker))
            return false;
    }
    return cells->count == 0 || grow(f, tile, level + 1, worker);
}

static void split_tile(void *argument, size_t tile, uint32_t worker)
{
    forest *f = argument;
    forest_tile *t = &f->tiles[tile];
    const size_t end = t->count;
    bool chosen[LEVELS] = {false};
    for (size_t i = 0; i < end; i++)
        chosen[t->leaves[i].level] |= is_chosen(f, tile, &t->leaves[i]);
    for (int level = 0; level + 1 < LEVELS; level++)
        if (chosen[level] && !split_level(f, tile, level, end, worker)) {
            atomic_store(&f->failed, true);
            return;
        }
    size_t kept = 0;
    for (size_t i = 0; i < t->count; i++) {
        const leaf *l = &t->leaves[i];
        if (i < end && is_chosen(f, tile, l))
            continue;
        if (l->bucket < f->plan.bucket - KEPT_OCTAVES * BUCKETS_PER_OCTAVE)
            settle(f, tile, l);
        else
            t->leaves[kept++] = *l;
    }
    t->count = kept;
}

static void settle_tile(void *argument, size_t tile, uint32_t worker)
{
    (void)worker;
    const forest *f = argument;
    for (size_t i = 0; i < f->tiles[tile].count; i++)
        settle(f, tile, &f->tiles[tile].leaves[i]);
}

static double spent(const forest *f)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)f->columns * f->rows; i++)
        sum += f->tiles[i].spent;
    return sum;
}

/* Pixels of water. Those whose leaves are open have their share there. */
static double water_of(const forest *f)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)f->out->width * f->out->height; i++)
        sum += (double)f->out->water[i];
    for (size_t tile = 0; tile < (size_t)f->columns * f->rows; tile++)
        for (size_t i = 0; i < f->tiles[tile].count; i++)
            sum += (double)f->tiles[tile].leaves[i].water;
    return sum;
}

static mgt_status run_rounds(forest *f)
{
    const adaptive_frame *a = f->a;
    const size_t tiles = (size_t)f->columns * f->rows;
    const thread_loop plant = {tiles, plant_tile, f, NULL}, split = {tiles, split_tile, f, NULL}, end = {tiles, settle_tile, f, NULL};
    thread_pool_run(a->pool, &plant);
    const mgt_quality *q = &a->frame->scene->quality;
    const double budget = (q->samples > 0 ? q->samples : 8) * water_of(f);
    /* What a round may take of what is left: little at first, while little is known. */
    static const double shares[] = {0.15, 0.25, 0.35, 0.5, 0.7, 1, 1, 1, 1, 1};
    for (size_t round = 0; round < sizeof shares / sizeof *shares && !atomic_load(&f->failed); round++) {
        const double left = budget - spent(f);
        if (left < 0.005 * budget || !make_plan(f, shares[round] * left))
            break;
        thread_pool_run(a->pool, &split);
        if (a->keep_going && !a->keep_going(a->keep_going_argument, fmin(spent(f) / budget, 1)))
            return MGT_CANCELLED;
    }
    thread_pool_run(a->pool, &end);
    return atomic_load(&f->failed) ? MGT_ERROR_MEMORY : MGT_OK;
}

/* ---- a frame ---- */

/* The camera of a picture `scale` times as large, for the same view. */
static camera_rays finer(const camera_rays *camera, double scale)
{
    camera_rays c = *camera;
    for (int i = 0; i < 3; i++) {
        c.right[i] /= scale;
        c.down[i] /= scale;
        c.corner[i] += (0.5 - 0.5 * scale) * (c.right[i] + c.down[i]);
    }
    return c;
}

static void build_levels(forest *f)
{
    const frame *whole = f->a->frame;
    const mgt_scene *s = whole->scene;
    const interval shutter = {s->time - s->shutter / 2, s->shutter / 2}, now = {s->time, 0}, before = {s->time - s->shutter, 0};
    for (int level = 0; level < LEVELS; level++) {
        const float scale = ldexpf(1, level);
        const camera_rays close = finer(&whole->close, (double)scale);
        wave_set_build(whole, &close, s->camera_moves ? now : shutter, true, &f->close[level]);
        f->close[level].view.scale = scale;
        if (f->open) {
            const camera_rays open = finer(&whole->open, (double)scale);
            wave_set_build(whole, &open, before, true, &f->open[level]);
            f->open[level].view.scale = scale;
        }
        f->data[level] = whole->data;
        f->data[level].pixel_angle /= scale;
    }
}

static void free_forest(forest *f)
{
    for (size_t i = 0; f->tiles && i < (size_t)f->columns * f->rows; i++)
        free(f->tiles[i].leaves);
    for (size_t i = 0; f->cells && i < f->workers; i++)
        free(f->cells[i]);
    for (size_t i = 0; f->census && i < f->workers; i++)
        free(f->census[i]);
    free(f->cells);
    free(f->census);
    free(f->tiles);
    free(f->weight);
    free(f->close);
    free(f->open);
    free(f);
}

static forest *make_forest(const adaptive_frame *a, const picture_planes *out)
{
    forest *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    f->a = a;
    f->out = out;
    f->columns = (out->width + TILE_WIDTH - 1) / TILE_WIDTH;
    f->rows = (out->height + TILE_HEIGHT - 1) / TILE_HEIGHT;
    f->workers = thread_pool_size(a->pool);
    const bool moves = a->frame->scene->camera_moves;
    f->tiles = calloc((size_t)f->columns * f->rows, sizeof *f->tiles);
    f->weight = malloc((size_t)out->width * out->height * sizeof *f->weight);
    f->close = calloc(LEVELS, sizeof *f->close);
    f->open = moves ? calloc(LEVELS, sizeof *f->open) : NULL;
    f->cells = calloc(f->workers, sizeof *f->cells);
    f->census = calloc(f->workers, sizeof *f->census);
    bool all = f->tiles && f->weight && f->close && (!moves || f->open) && f->cells && f->census;
    for (size_t i = 0; all && i < f->workers; i++) {
        f->cells[i] = calloc(1, sizeof **f->cells);
        f->census[i] = calloc(1, sizeof **f->census);
        all = f->cells[i] && f->census[i];
    }
    if (all)
        return f;
    free_forest(f);
    return NULL;
}

mgt_status adaptive_render(const adaptive_frame *a, const picture_planes *out)
{
    forest *f = make_forest(a, out);
    if (!f)
        return MGT_ERROR_MEMORY;
    build_levels(f);
    const mgt_status status = run_rounds(f);
    free_forest(f);
    return status;
}
