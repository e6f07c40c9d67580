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
    LEVELS = 9,             /* a pixel has up to 4^8 cells, … */
    SIDES = 2 * LEVELS - 1, /* … split up to 16 times one way */
    HALVES_LEVEL = 5,       /* from which cells see the shutter in two halves */
    BUCKETS_PER_OCTAVE = 32,
    OCTAVES = 96,
    BUCKETS = BUCKETS_PER_OCTAVE * OCTAVES,
    BUCKET_ZERO = (127 - 80) * BUCKETS_PER_OCTAVE, /* of 2^-80 */
    KEPT_OCTAVES = 5, /* leaves worth less than 2^-5 of what was split last are settled */
};
static const double cost_unit = 65536; /* evaluations of all waves are counted in these parts */
/* What a cell and a point sample cost besides their waves, in waves; measured. */
static const double cell_waves = 20, sample_waves = 2;

/* A pixel or cell that may be split. */
typedef struct leaf {
    uint32_t column, row; /* within the tile, in cells of this size */
    uint8_t across, down; /* how often the pixel has been halved each way */
    uint8_t level;        /* (across + down) / 2 */
    uint8_t shape;        /* of the split to come, see shape_of() */
    bool chosen;          /* to be split in this round */
    uint16_t bucket;      /* of what a split is worth */
    float color[3], coverage, water, height, variance, contrast;
} leaf;

typedef struct forest_tile {
    leaf *leaves;
    size_t count, capacity;
    double cost[LEVELS];  /* of a cell, evaluations of all waves; 0 as long as it is unknown */
    double below[LEVELS]; /* of the four cells that one of this level is split into, as far as is known */
    float worth[LEVELS];  /* of a split, for each unit of squared error */
    double spent;
    double final_variance; /* of what is split no more: sum of squared errors of pixels */
} forest_tile;

typedef struct round_plan {
    int bucket;     /* leaves above this bucket are split, … */
    double share;   /* … and this share of those in it */
} round_plan;

/* Of one worker; whole numbers, so that their sum does not depend on who counted what. */
typedef struct census {
    uint64_t cost[BUCKETS];
} census;

struct forest {
    const adaptive_frame *a;
    const picture_planes *out;
    uint32_t width, height; /* that the memory is for */
    uint32_t columns, rows;
    bool by_coverage;       /* leaves are worth what they save of the coverage's error, not of the picture's */
    forest_tile *tiles;
    float *weight;         /* a pixel's, squared */
    wave_set *close;       /* when the shutter closes, or over it, … */
    wave_set *open;        /* … and when it opens, where the camera moves; else NULL */
    wave_set *halves[2];   /* over the two halves of the shutter, from the last, while the camera stands */
    wave_set *moving;      /* memory for `open`, NULL until needed */
    tile_cells **cells;    /* one a worker, … */
    tile_cells **last;     /* … and one for the shutter's last half */
    census **census;
    size_t workers;
    round_plan plan;
    int least_bucket;      /* leaves up to this one are settled */
    atomic_bool failed;    /* memory was short */
};

/* ---- places ---- */

static size_t pixel_of(const forest *f, size_t tile, const leaf *l)
{
    const size_t x = tile % f->columns * TILE_WIDTH + (l->column >> l->across), y = tile / f->columns * TILE_HEIGHT + (l->row >> l->down);
    return y * f->out->width + x;
}

static const float areas[LEVELS] = {1, 0x1p-2f, 0x1p-4f, 0x1p-6f, 0x1p-8f, 0x1p-10f, 0x1p-12f, 0x1p-14f, 0x1p-16f}; /* of a cell, pixels */

/* A cell is final: its share of the pixel. */
static void settle(const forest *f, size_t tile, const leaf *l)
{
    const picture_planes *p = f->out;
    const size_t i = pixel_of(f, tile, l);
    const float area = areas[l->level];
    for (int k = 0; k < 3; k++)
        p->color[3 * i + (size_t)k] += area * l->color[k];
    p->coverage[i] += area * l->coverage;
    p->water[i] += area * l->water;
    if (l->level > 0)
        p->detail[i] += area * l->coverage;
    f->tiles[tile].final_variance += (double)(area * area * l->variance);
}

/* ---- what a split is worth ---- */

/* What splits cost and are worth, after a level's cost became known: where it is not, by the nearest level above. */
static void appraise(forest_tile *t)
{
    double cost = t->cost[0];
    for (int level = 0; level < LEVELS; level++) {
        const double next = level + 1 < LEVELS ? t->cost[level + 1] : 0;
        cost = next > 0 ? next : 1.2 * cost;
        t->below[level] = 4 * cost;
        t->worth[level] = (float)((double)(areas[level] * areas[level]) / t->below[level]);
    }
}

/* Steps of a 32nd octave, straight within an octave: the upper bits of the float. */
static uint16_t bucket_of(float worth)
{
    uint32_t bits;
    memcpy(&bits, &worth, sizeof bits);
    const int32_t bucket = (int32_t)(bits >> 18) - BUCKET_ZERO;
    return bucket <= 0 ? 0 : bucket >= BUCKETS ? BUCKETS - 1 : (uint16_t)bucket;
}

/* Adds a leaf, or settles it where a split is worth nothing. */
static bool add_leaf(const forest *f, size_t tile, leaf l)
{
    forest_tile *t = &f->tiles[tile];
    const float gain = f->by_coverage ? l.variance : l.contrast * f->weight[pixel_of(f, tile, &l)];
    l.bucket = gain > 0 ? bucket_of(gain * t->worth[l.level]) : 0;
    if (l.bucket <= f->least_bucket || l.level + 1 == LEVELS) {
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

/* Into 2 × 2, four rows or four columns: whatever makes the parts' shape on the water rounder. */
enum { SHAPE_EVEN, SHAPE_ROWS, SHAPE_COLUMNS };
static const uint8_t halvings[3][2] = {{1, 1}, {0, 2}, {2, 0}}; /* across, down */

static uint8_t shape_of(float aspect_squared)
{
    return aspect_squared > 8 ? SHAPE_ROWS : aspect_squared < 0.125f ? SHAPE_COLUMNS : SHAPE_EVEN;
}

static leaf leaf_from(const tile_pixels *p, const tile_detail *d, size_t i)
{
    return (leaf){.color = {p->red[i], p->green[i], p->blue[i]},
                  .coverage = p->coverage[i],
                  .water = p->water[i],
                  .height = d->height[i],
                  .variance = d->variance[i],
                  .contrast = d->contrast[i],
                  .shape = shape_of(d->aspect[i])};
}

/* ---- the picture of pixels ---- */

/* Rays of cells: every pixel is halved so many times each way. */
static ViewData finer(const ViewData *view, int across, int down)
{
    ViewData v = *view;
    v.scale_x = ldexpf(1, across);
    v.scale_y = ldexpf(1, down);
    v.right_x /= v.scale_x, v.right_y /= v.scale_x, v.right_z /= v.scale_x;
    v.down_x /= v.scale_y, v.down_y /= v.scale_y, v.down_z /= v.scale_y;
    const float x = 0.5f - 0.5f * v.scale_x, y = 0.5f - 0.5f * v.scale_y;
    v.corner_x += x * v.right_x + y * v.down_x;
    v.corner_y += x * v.right_y + y * v.down_y;
    v.corner_z += x * v.right_z + y * v.down_z;
    return v;
}

/* Whether cells of this size see the two halves of the shutter apart: their glints are so sharp that a path's bend shows. */
static bool sees_halves(const forest *f, int level)
{
    return level >= HALVES_LEVEL && !f->open && f->a->frame->scene->shutter > 0;
}

/* Sorts the tile's waves for cells; returns what the kernels are told of the frame then. */
static FrameData sort_cells(const forest *f, size_t tile, int across, int down, tile_scratch *s)
{
    const adaptive_frame *a = f->a;
    const uint32_t x = (uint32_t)(tile % f->columns), y = (uint32_t)(tile / f->columns);
    forest_tile *t = &f->tiles[tile];
    FrameData data = a->frame->data;
    data.pixel_angle = ldexpf(data.pixel_angle, across > down ? -across : -down);
    if (across + down > 0) {
        /* Small cells see glints so sharp that no wave's share may be a tile's mean. */
        data.sort_shares = 0;
        data.sort_start = 1e-3f;
    }
    const ViewData close = finer(&f->close->view, across, down);
    const bool halves = sees_halves(f, (across + down) / 2);
    a->kernels->sort(&data, halves ? f->halves[0] : f->close, &close, x, y, &s->close);
    if (halves)
        a->kernels->sort(&data, f->halves[1], &close, x, y, &s->open);
    if (f->open) {
        const ViewData open = finer(&f->open->view, across, down);
        a->kernels->sort(&data, f->open, &open, x, y, &s->open);
    }
    const TileData *d = &s->close.data;
    const double cost = (d->resolved_count + d->mixed_count + cell_waves) / (close.wave_count + sample_waves);
    t->cost[(across + down) / 2] = halves ? 2 * cost : cost;
    appraise(t);
    return data;
}

static void guess_tile(const forest *f, const tile_waves *waves, tile_guess *guess)
{
    if (tile_sees_water(waves))
        f->a->kernels->guess(&f->a->frame->data, waves, guess);
    else
        memset(guess, 0, sizeof *guess);
}

/* What an error of the pixel's luminance is worth in the displayed picture, squared: tone maps show relative errors where it is bright. */
static float weight_of(const forest *f, const float color[3])
{
    const float luminance = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
    const float slope = 1 / (1 + f->a->frame->data.exposure * luminance);
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
    const FrameData data = sort_cells(f, tile, 0, 0, s);
    guess_tile(f, &s->close, &s->close_guess);
    if (f->open)
        guess_tile(f, &s->open, &s->open_guess);
    a->kernels->filtered(&data, a->sky, NULL, MGT_METHOD_MANGATA, &s->close, &s->close_guess, f->open ? &s->open : NULL,
                         f->open ? &s->open_guess : NULL, &s->pixels, detail);
    const uint32_t left = (uint32_t)(tile % f->columns) * TILE_WIDTH, top = (uint32_t)(tile / f->columns) * TILE_HEIGHT;
    for (uint32_t y = 0; y < TILE_HEIGHT && top + y < p->height; y++)
        for (uint32_t x = 0; x < TILE_WIDTH && left + x < p->width; x++) {
            const size_t from = (size_t)y * TILE_WIDTH + x, to = (size_t)(top + y) * p->width + left + x;
            leaf l = leaf_from(&s->pixels, detail, from);
            l.column = x;
            l.row = y;
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
    for (int level = 0; level < LEVELS; level++)
        units[level] = (uint64_t)(t->below[level] * cost_unit);
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
    f->plan = (round_plan){0, 0};
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
    const int least = f->plan.bucket - KEPT_OCTAVES * BUCKETS_PER_OCTAVE;
    f->least_bucket = least > f->least_bucket ? least : f->least_bucket;
    return any;
}

/* A number in [0, 1) that is the leaf's own. */
static double lot_of(size_t tile, const leaf *l)
{
    uint64_t x = (uint64_t)tile << 44 ^ (uint64_t)l->across << 40 ^ (uint64_t)l->down << 36 ^ (uint64_t)l->column << 18 ^ l->row;
    x = (x + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 29)) * 0x94d049bb133111ebu;
    return (double)(x >> 11) * 0x1p-53;
}

static bool is_chosen(const forest *f, size_t tile, const leaf *l)
{
    return l->bucket > f->plan.bucket || (l->bucket == f->plan.bucket && lot_of(tile, l) < f->plan.share);
}

/* Cells of one size that wait to be rendered. */
typedef struct brood {
    FrameData data;
    int across, down;
} brood;

/* Of both halves of the shutter; heights are those of the last. */
static void take_mean(tile_cells *cells, const tile_cells *last)
{
    float *const into[] = {cells->pixels.red, cells->pixels.green, cells->pixels.blue, cells->pixels.coverage, cells->detail.variance, cells->detail.contrast};
    const float *const from[] = {last->pixels.red, last->pixels.green, last->pixels.blue, last->pixels.coverage, last->detail.variance, last->detail.contrast};
    for (size_t k = 0; k < sizeof into / sizeof *into; k++)
        for (size_t i = 0; i < cells->count; i++)
            into[k][i] = 0.5f * (into[k][i] + from[k][i]);
    memcpy(cells->detail.height, last->detail.height, cells->count * sizeof *cells->detail.height);
}

static bool grow(const forest *f, size_t tile, const brood *b, uint32_t worker)
{
    const adaptive_frame *a = f->a;
    tile_cells *cells = f->cells[worker];
    tile_scratch *s = a->scratch[worker];
    forest_tile *t = &f->tiles[tile];
    const int level = (b->across + b->down) / 2;
    a->kernels->cells(&b->data, a->sky, &s->close, f->open ? &s->open : NULL, cells);
    if (sees_halves(f, level)) {
        tile_cells *last = f->last[worker];
        *last = *cells;
        a->kernels->cells(&b->data, a->sky, &s->open, NULL, cells);
        take_mean(cells, last);
    }
    for (size_t i = 0; i < cells->count; i++) {
        leaf l = leaf_from(&cells->pixels, &cells->detail, i);
        l.column = (uint32_t)cells->column[i];
        l.row = (uint32_t)cells->row[i];
        l.across = (uint8_t)b->across;
        l.down = (uint8_t)b->down;
        l.level = (uint8_t)level;
        f->out->samples[pixel_of(f, tile, &l)] += (float)t->cost[level];
        t->spent += t->cost[level];
        if (!add_leaf(f, tile, l))
            return false;
    }
    cells->count = 0;
    return true;
}

static void add_children(tile_cells *cells, const leaf *l)
{
    const uint32_t wide = 1u << halvings[l->shape][0];
    for (uint32_t k = 0; k < 4; k++) {
        cells->column[cells->count] = (float)(l->column * wide + k % wide);
        cells->row[cells->count] = (float)((l->row << halvings[l->shape][1]) + k / wide);
        cells->guess.height[cells->count++] = l->height;
    }
}

/* The chosen leaves whose children have one size; `end` is how many leaves there were before the round. */
static bool split_size(const forest *f, size_t tile, int across, int down, size_t end, uint32_t worker)
{
    forest_tile *t = &f->tiles[tile];
    tile_cells *cells = f->cells[worker];
    const brood b = {sort_cells(f, tile, across, down, f->a->scratch[worker]), across, down};
    cells->count = 0;
    for (size_t i = 0; i < end; i++) {
        const leaf *l = &t->leaves[i];
        if (!l->chosen || l->across + halvings[l->shape][0] != across || l->down + halvings[l->shape][1] != down)
            continue;
        add_children(cells, l);
        if (cells->count == TILE_PIXELS && !grow(f, tile, &b, worker))
            return false;
    }
    return cells->count == 0 || grow(f, tile, &b, worker);
}

static void split_tile(void *argument, size_t tile, uint32_t worker)
{
    forest *f = argument;
    forest_tile *t = &f->tiles[tile];
    const size_t end = t->count;
    bool sizes[SIDES][SIDES] = {{false}};
    for (size_t i = 0; i < end; i++) {
        leaf *l = &t->leaves[i];
        l->chosen = is_chosen(f, tile, l);
        sizes[l->across + halvings[l->shape][0]][l->down + halvings[l->shape][1]] |= l->chosen;
    }
    for (int across = 0; across < SIDES; across++)
        for (int down = 0; down < SIDES; down++)
            if (sizes[across][down] && !split_size(f, tile, across, down, end, worker)) {
                atomic_store(&f->failed, true);
                return;
            }
    size_t kept = 0;
    for (size_t i = 0; i < t->count; i++) {
        const leaf *l = &t->leaves[i];
        if (l->chosen)
            continue;
        if (l->bucket <= f->least_bucket)
            settle(f, tile, l);
        else if (i > kept++)
            t->leaves[kept - 1] = *l;
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

/* Of the coverage over the picture, as far as the leaves tell. */
static double predicted_rmse(const forest *f)
{
    double sum = 0;
    for (size_t tile = 0; tile < (size_t)f->columns * f->rows; tile++) {
        const forest_tile *t = &f->tiles[tile];
        sum += t->final_variance;
        for (size_t i = 0; i < t->count; i++)
            sum += (double)(areas[t->leaves[i].level] * areas[t->leaves[i].level] * t->leaves[i].variance);
    }
    /* Against brute force on four scenes the variance of a cell is about a third of what it says. */
    return sqrt(0.35 * sum / ((double)f->out->width * f->out->height));
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* What a frame has used and may use. */
typedef struct frame_budget {
    double evaluations; /* in all, for a number of samples */
    double began, end;  /* seconds, for a budget of time */
    double rounds_began, before; /* when the rounds began, and what had been spent then */
} frame_budget;

/* How much the next round may spend; 0: it is enough. Little at first, while little is known. */
static double next_share(const forest *f, const frame_budget *b, size_t round)
{
    static const double shares[] = {0.15, 0.25, 0.35, 0.5, 0.7, 1, 1, 1, 1, 1};
    enum { SHARES = sizeof shares / sizeof *shares, MOST_ROUNDS = 40 };
    const mgt_quality *q = &f->a->frame->scene->quality;
    const double used = spent(f);
    if (q->target_rmse > 0)
        return round < MOST_ROUNDS && predicted_rmse(f) > q->target_rmse ? 0.3 * used : 0;
    if (q->budget_ms > 0) {
        const double time = now(), left = b->end - time;
        /* The first pixels are cheaper than cells: half of their speed is a careful guess. */
        const double speed = round == 0 ? 0.5 * used / (time - b->began) : (used - b->before) / (time - b->rounds_began);
        const double share = round == 0 ? 0.2 : 0.6;
        return round < MOST_ROUNDS && left > 0.02 * (b->end - b->began) ? share * left * speed : 0;
    }
    const double left = b->evaluations - used;
    return round < SHARES && left > 0.005 * b->evaluations ? shares[round] * left : 0;
}

static mgt_status run_rounds(forest *f)
{
    const adaptive_frame *a = f->a;
    const mgt_quality *q = &a->frame->scene->quality;
    const size_t tiles = (size_t)f->columns * f->rows;
    const thread_loop plant = {tiles, plant_tile, f, NULL}, split = {tiles, split_tile, f, NULL}, end = {tiles, settle_tile, f, NULL};
    frame_budget budget = {.began = now()};
    /* Some of the time is for what follows: settling the leaves, and the display. */
    budget.end = budget.began + 1e-3 * q->budget_ms - 4e-9 * (double)f->out->width * f->out->height;
    thread_pool_run(a->pool, &plant);
    budget.evaluations = (q->samples > 0 ? q->samples : 8) * water_of(f);
    budget.before = spent(f);
    budget.rounds_began = now();
    double share;
    for (size_t round = 0; !atomic_load(&f->failed) && (share = next_share(f, &budget, round)) > 0 && make_plan(f, share); round++) {
        thread_pool_run(a->pool, &split);
        if (a->keep_going && !a->keep_going(a->keep_going_argument, fmin(spent(f) / budget.evaluations, 1)))
            return MGT_CANCELLED;
    }
    thread_pool_run(a->pool, &end);
    return atomic_load(&f->failed) ? MGT_ERROR_MEMORY : MGT_OK;
}

/* ---- a frame ---- */

static void place_waves(forest *f)
{
    const frame *whole = f->a->frame;
    const mgt_scene *s = whole->scene;
    const interval shutter = {s->time - s->shutter / 2, s->shutter / 2}, instant = {s->time, 0}, before = {s->time - s->shutter, 0};
    wave_set_build(whole, &whole->close, s->camera_moves ? instant : shutter, true, f->close);
    if (f->open)
        wave_set_build(whole, &whole->open, before, true, f->open);
    for (int i = 0; i < 2 && !f->open; i++)
        wave_set_build(whole, &whole->close, (interval){s->time - s->shutter * (0.25 + 0.5 * i), s->shutter / 4}, true, f->halves[i]);
}

void forest_free(forest *f)
{
    if (!f)
        return;
    for (size_t i = 0; f->tiles && i < (size_t)f->columns * f->rows; i++)
        free(f->tiles[i].leaves);
    for (size_t i = 0; f->cells && i < f->workers; i++)
        free(f->cells[i]);
    for (size_t i = 0; f->last && i < f->workers; i++)
        free(f->last[i]);
    for (size_t i = 0; f->census && i < f->workers; i++)
        free(f->census[i]);
    free(f->cells);
    free(f->last);
    free(f->halves[0]);
    free(f->halves[1]);
    free(f->census);
    free(f->tiles);
    free(f->weight);
    free(f->close);
    free(f->moving);
    free(f);
}

static forest *make_forest(const adaptive_frame *a, const picture_planes *out)
{
    forest *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    f->width = out->width;
    f->height = out->height;
    f->columns = (out->width + TILE_WIDTH - 1) / TILE_WIDTH;
    f->rows = (out->height + TILE_HEIGHT - 1) / TILE_HEIGHT;
    f->workers = thread_pool_size(a->pool);
    f->tiles = calloc((size_t)f->columns * f->rows, sizeof *f->tiles);
    f->weight = malloc((size_t)out->width * out->height * sizeof *f->weight);
    f->close = calloc(1, sizeof *f->close);
    f->halves[0] = calloc(1, sizeof **f->halves);
    f->halves[1] = calloc(1, sizeof **f->halves);
    f->cells = calloc(f->workers, sizeof *f->cells);
    f->last = calloc(f->workers, sizeof *f->last);
    f->census = calloc(f->workers, sizeof *f->census);
    bool all = f->tiles && f->weight && f->close && f->halves[0] && f->halves[1] && f->cells && f->last && f->census;
    for (size_t i = 0; all && i < f->workers; i++) {
        f->cells[i] = calloc(1, sizeof **f->cells);
        f->census[i] = calloc(1, sizeof **f->census);
        f->last[i] = calloc(1, sizeof **f->last);
        all = f->cells[i] && f->last[i] && f->census[i];
    }
    if (all)
        return f;
    forest_free(f);
    return NULL;
}

/* Ready for a frame: empty but for memory. */
static bool clear_forest(forest *f, const adaptive_frame *a, const picture_planes *out)
{
    const bool moves = a->frame->scene->camera_moves;
    f->a = a;
    f->out = out;
    f->by_coverage = a->frame->scene->quality.target_rmse > 0;
    f->least_bucket = 0;
    atomic_store(&f->failed, false);
    for (size_t i = 0; i < (size_t)f->columns * f->rows; i++)
        f->tiles[i] = (forest_tile){.leaves = f->tiles[i].leaves, .capacity = f->tiles[i].capacity};
    if (moves && !f->moving)
        f->moving = calloc(1, sizeof *f->moving);
    f->open = moves ? f->moving : NULL;
    return !moves || f->open;
}

mgt_status adaptive_render(const adaptive_frame *a, forest **kept, const picture_planes *out)
{
    if (*kept && ((*kept)->width != out->width || (*kept)->height != out->height)) {
        forest_free(*kept);
        *kept = NULL;
    }
    if (!*kept)
        *kept = make_forest(a, out);
    if (!*kept || !clear_forest(*kept, a, out))
        return MGT_ERROR_MEMORY;
    place_waves(*kept);
    return run_rounds(*kept);
}
