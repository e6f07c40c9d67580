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
    SHARP_LEVEL = 5,        /* from which cells see glints so sharp that the bend of a path shows */
    MOST_PARTS = 16,        /* straight pieces of the shutter */
    POINTS_PLACES = 16,     /* cells of more places are given points: splits would long say the same */
    LEAST_POINTS = 256,
    MOST_POINTS = 4096,
    INSTANTS = 8,           /* of the shutter, that points are spread over */
    BUCKETS_PER_OCTAVE = 32,
    OCTAVES = 96,
    BUCKETS = BUCKETS_PER_OCTAVE * OCTAVES,
    BUCKET_ZERO = (127 - 80) * BUCKETS_PER_OCTAVE, /* of 2^-80 */
    KEPT_OCTAVES = 5, /* leaves worth less than 2^-5 of what was split last are settled, … */
    KEPT_ROUNDS = 2,  /* … after the first rounds, which take only the best */
};
static const double cost_unit = 65536; /* evaluations of all waves are counted in these parts */
/* What a cell and a point sample cost besides their waves, in waves of a cell; measured, as is the 1.1 that a wave of a sample costs. */
static const double cell_waves = 20, sample_waves = 1;
/* Of a point, evaluations of all waves: points lie where rays graze, and march to their hits over every wave. Measured. */
static const double point_cost = 12;

/* A pixel or cell that may be split. */
typedef struct leaf {
    uint32_t column, row; /* within the tile, in cells of this size */
    uint8_t across, down; /* how often the pixel has been halved each way */
    uint8_t level;        /* (across + down) / 2 */
    uint8_t shape;        /* of the split to come, see shape_of() */
    bool chosen;          /* to be split in this round */
    uint16_t bucket;      /* of what a split is worth */
    uint16_t points;      /* samples that its values are the mean of; 0: it is a cell */
    float color[3], coverage, water, height, variance, contrast, places;
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

/* The shutter in straight pieces. While the camera stands, sets[i] is over piece i; where it moves, sets[i] and sets[i + 1] are the instants around it. */
typedef struct shutter_parts {
    int count;
    wave_set *sets[MOST_PARTS + 1];
} shutter_parts;

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
    bool moves;            /* the camera does */
    shutter_parts parts[3]; /* of pixels, of cells and of sharp cells */
    wave_set *instants[INSTANTS]; /* as points see them */
    tile_cells **cells;    /* one a worker, … */
    tile_cells **sums;     /* … and one for the mean over the shutter's parts */
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
    if (l->level > 0 || l->points > 0)
        p->detail[i] += area * l->coverage;
    f->tiles[tile].final_variance += (double)(area * area * l->variance);
}

/* ---- what a split is worth ---- */

/* Into 2 × 2, four rows or four columns, whatever makes the parts' shape on the water rounder; or points instead. */
enum { SHAPE_EVEN, SHAPE_ROWS, SHAPE_COLUMNS, SHAPE_POINTS };
static const uint8_t halvings[4][2] = {{1, 1}, {0, 2}, {2, 0}, {0, 0}}; /* across, down */

static uint8_t shape_of(float aspect_squared)
{
    return aspect_squared > 8 ? SHAPE_ROWS : aspect_squared < 0.125f ? SHAPE_COLUMNS : SHAPE_EVEN;
}


static const shutter_parts *parts_of(const forest *f, int level)
{
    return &f->parts[level == 0 ? 0 : level < SHARP_LEVEL ? 1 : 2];
}

/* What splits cost and are worth, after a level's cost became known: where it is not, by the nearest level above. */
static void appraise(const forest *f, forest_tile *t)
{
    double cost = t->cost[0];
    for (int level = 0; level < LEVELS; level++) {
        const double next = level + 1 < LEVELS ? t->cost[level + 1] : 0;
        cost = next > 0 ? next : 1.2 * cost * parts_of(f, level + 1)->count / parts_of(f, level)->count;
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

/* What the model gets wrong where waves hide each other, a tenth or two of the light, over what it cannot know. */
static float wrong_of(const leaf *l)
{
    return l->points > 0 ? 0 : 0.0225f * l->places * l->coverage;
}

/* At first as many as halve the squared error. */
static int next_points(const leaf *l)
{
    if (l->points > 0)
        return 4 * l->points;
    int points = LEAST_POINTS;
    while (points < MOST_POINTS && (float)points * (1 + wrong_of(l)) < 2 * l->places)
        points *= 4;
    return points;
}

static double cost_of(const forest_tile *t, const leaf *l)
{
    return l->shape == SHAPE_POINTS ? (next_points(l) - l->points) * point_cost : t->below[l->level];
}

/* How much of its squared error a split may save for each evaluation. Four parts of a cell show the mean of a quarter of its places each; n points
 * that of n, and get nothing wrong. */
static float worth_of(const forest_tile *t, const leaf *l)
{
    const float area = areas[l->level];
    if (l->shape != SHAPE_POINTS)
        return 4 / (l->places + 3) * t->worth[l->level];
    return fmaxf(1 - l->places / (float)next_points(l) + wrong_of(l), 0) * area * area / (float)cost_of(t, l);
}

/* Adds a leaf, or settles it where a split is worth nothing. */
static bool add_leaf(const forest *f, size_t tile, leaf l)
{
    forest_tile *t = &f->tiles[tile];
    const float now = f->by_coverage ? l.variance : l.contrast * f->weight[pixel_of(f, tile, &l)];
    if (l.points > 0 || (l.places > POINTS_PLACES && f->a->frame->data.sky_black))
        l.shape = SHAPE_POINTS;
    const bool ends = l.shape == SHAPE_POINTS ? next_points(&l) > MOST_POINTS : l.level + 1 == LEVELS;
    l.bucket = now > 0 && !ends ? bucket_of(now * worth_of(t, &l)) : 0;
    if (l.bucket <= f->least_bucket) {
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
                  .contrast = d->contrast[i],
                  .places = d->places[i],
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

/* Sorts the tile's waves of a set for cells; returns what the kernels are told of the frame then. */
static FrameData sort_set(const forest *f, size_t tile, const wave_set *set, int across, int down, tile_waves *out)
{
    FrameData data = f->a->frame->data;
    data.pixel_angle = ldexpf(data.pixel_angle, across > down ? -across : -down);
    if (across + down > 0) {
        /* Small cells see glints so sharp that no wave's share may be a tile's mean. */
        data.sort_shares = 0;
        data.sort_start = 1e-3f;
    }
    const ViewData view = finer(&set->view, across, down);
    f->a->kernels->sort(&data, set, &view, (uint32_t)(tile % f->columns), (uint32_t)(tile / f->columns), out);
    return data;
}

/* One piece of the shutter: into s->close, and s->open where the camera moves. */
static FrameData sort_cells(const forest *f, size_t tile, int across, int down, int part, tile_scratch *s)
{
    forest_tile *t = &f->tiles[tile];
    const shutter_parts *parts = parts_of(f, (across + down) / 2);
    const FrameData data = sort_set(f, tile, parts->sets[f->moves ? part + 1 : part], across, down, &s->close);
    if (f->moves)
        sort_set(f, tile, parts->sets[part], across, down, &s->open);
    const TileData *d = &s->close.data;
    const double all = 1.1 * parts->sets[0]->view.wave_count + sample_waves, cost = (d->resolved_count + d->mixed_count + cell_waves) / all;
    t->cost[(across + down) / 2] = parts->count * cost;
    appraise(f, t);
    return data;
}

static void guess_tile(const forest *f, const tile_waves *waves, tile_guess *guess)
{
    if (tile_sees_water(waves))
        f->a->kernels->guess(&f->a->frame->data, waves, guess);
    else
        memset(guess, 0, sizeof *guess);
}

/* What a squared error of the pixel's luminance is worth in the displayed picture: tone maps show relative errors where it is bright, and to the eye many
 * small errors are worse than few large ones, so that it is divided by the 3/4th power of what the pixel begins with. Under a black sky, where the
 * glitter is all there is, only the first holds. */
static float weight_of(const forest *f, const leaf *l)
{
    const float luminance = 0.2126f * l->color[0] + 0.7152f * l->color[1] + 0.0722f * l->color[2];
    const float slope = 1 / (1 + f->a->frame->data.exposure * luminance), weight = slope * slope;
    if (f->a->frame->data.sky_black)
        return weight;
    const float root = sqrtf(weight * l->contrast + 1e-6f);
    return weight / (root * sqrtf(root));
}

static void plant_tile(void *argument, size_t tile, uint32_t worker)
{
    forest *f = argument;
    const adaptive_frame *a = f->a;
    const picture_planes *p = f->out;
    tile_scratch *s = a->scratch[worker];
    tile_detail *detail = &f->cells[worker]->detail;
    forest_tile *t = &f->tiles[tile];
    const FrameData data = sort_cells(f, tile, 0, 0, 0, s);
    guess_tile(f, &s->close, &s->close_guess);
    if (f->moves)
        guess_tile(f, &s->open, &s->open_guess);
    a->kernels->filtered(&data, a->sky, NULL, MGT_METHOD_MANGATA, &s->close, &s->close_guess, f->moves ? &s->open : NULL,
                         f->moves ? &s->open_guess : NULL, &s->pixels, detail);
    const uint32_t left = (uint32_t)(tile % f->columns) * TILE_WIDTH, top = (uint32_t)(tile / f->columns) * TILE_HEIGHT;
    for (uint32_t y = 0; y < TILE_HEIGHT && top + y < p->height; y++)
        for (uint32_t x = 0; x < TILE_WIDTH && left + x < p->width; x++) {
            const size_t from = (size_t)y * TILE_WIDTH + x, to = (size_t)(top + y) * p->width + left + x;
            leaf l = leaf_from(&s->pixels, detail, from);
            l.column = x;
            l.row = y;
            f->weight[to] = weight_of(f, &l);
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
    for (size_t i = 0; i < t->count; i++)
        cost[t->leaves[i].bucket] += (uint64_t)(cost_of(t, &t->leaves[i]) * cost_unit);
}

/* Which leaves may be split for `budget` evaluations. False: none. */
static bool make_plan(forest *f, double budget, size_t round)
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
    if (round >= KEPT_ROUNDS && least > f->least_bucket)
        f->least_bucket = least;
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

/* Adds what a piece of the shutter shows; of detail heights alone are its own, and those of the last piece stay. */
static void add_part(const tile_cells *part, float share, tile_cells *sum)
{
    const float *const from[] = {part->pixels.red, part->pixels.green, part->pixels.blue, part->pixels.coverage, part->pixels.water,
                                 part->detail.variance, part->detail.contrast, part->detail.places, part->detail.aspect};
    float *const into[] = {sum->pixels.red, sum->pixels.green, sum->pixels.blue, sum->pixels.coverage, sum->pixels.water,
                           sum->detail.variance, sum->detail.contrast, sum->detail.places, sum->detail.aspect};
    for (size_t k = 0; k < sizeof into / sizeof *into; k++)
        for (size_t i = 0; i < part->count; i++)
            into[k][i] += share * from[k][i];
    memcpy(sum->detail.height, part->detail.height, part->count * sizeof *part->detail.height);
}

/* Renders the cells that wait, all of one size. */
static bool grow(const forest *f, size_t tile, int across, int down, uint32_t worker)
{
    const adaptive_frame *a = f->a;
    tile_cells *cells = f->cells[worker], *sum = f->sums[worker];
    tile_scratch *s = a->scratch[worker];
    forest_tile *t = &f->tiles[tile];
    const int level = (across + down) / 2, parts = parts_of(f, level)->count;
    memset(&sum->pixels, 0, sizeof sum->pixels);
    memset(&sum->detail, 0, sizeof sum->detail);
    for (int part = 0; part < parts; part++) {
        const FrameData data = sort_cells(f, tile, across, down, part, s);
        a->kernels->cells(&data, a->sky, &s->close, f->moves ? &s->open : NULL, cells);
        add_part(cells, 1.0f / (float)parts, sum);
    }
    for (size_t i = 0; i < cells->count; i++) {
        leaf l = leaf_from(&sum->pixels, &sum->detail, i);
        l.column = (uint32_t)cells->column[i];
        l.row = (uint32_t)cells->row[i];
        l.across = (uint8_t)across;
        l.down = (uint8_t)down;
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
    cells->count = 0;
    for (size_t i = 0; i < end; i++) {
        const leaf *l = &t->leaves[i];
        if (!l->chosen || l->shape == SHAPE_POINTS || l->across + halvings[l->shape][0] != across || l->down + halvings[l->shape][1] != down)
            continue;
        add_children(cells, l);
        if (cells->count == TILE_PIXELS && !grow(f, tile, across, down, worker))
            return false;
    }
    return cells->count == 0 || grow(f, tile, across, down, worker);
}

/* Points that wait to be rendered, and the leaf that each belongs to. */
typedef struct point_batch {
    int count;
    uint32_t owner[TILE_PIXELS];
} point_batch;

/* Point `index` of a leaf's sequence: the R2 sequence (Roberts 2018), shifted by the leaf and the seed. Its hit is looked for as its pixel's is. */
static void add_point(const leaf *l, double shift, int index, uint32_t owner, point_batch *batch, tile_scratch *s)
{
    const double u = shift + index * 0.75487766624669276, v = 0.5 + shift * 977 + index * 0.56984029099805327;
    const int i = batch->count++;
    batch->owner[i] = owner;
    s->jitter_x[i] = (float)(ldexp(l->column + u - floor(u), -l->across) - 0.5 - i % TILE_WIDTH);
    s->jitter_y[i] = (float)(ldexp(l->row + v - floor(v), -l->down) - 0.5 - i / TILE_WIDTH);
    const size_t pixel = (size_t)(l->row >> l->down) * TILE_WIDTH + (l->column >> l->across);
    s->close_guess.height[i] = s->open_guess.height[pixel];
    s->close_guess.from[i] = s->open_guess.from[pixel];
    s->close_guess.march[i] = s->open_guess.march[pixel];
}

/* Sums of color, coverage and water go to sums[5 × owner]. */
static void render_points(const forest *f, point_batch *batch, tile_scratch *s, double *sums)
{
    for (int i = batch->count; i < TILE_PIXELS; i++) {
        s->jitter_x[i] = s->jitter_x[0] - (float)(i % TILE_WIDTH);
        s->jitter_y[i] = s->jitter_y[0] - (float)(i / TILE_WIDTH);
    }
    memset(&s->pixels, 0, sizeof s->pixels);
    f->a->kernels->sample(&f->a->frame->data, f->a->sky, &s->close, &s->close_guess, s->jitter_x, s->jitter_y, 1, &s->pixels);
    for (int i = 0; i < batch->count; i++) {
        double *sum = sums + 5 * batch->owner[i];
        sum[0] += (double)s->pixels.red[i];
        sum[1] += (double)s->pixels.green[i];
        sum[2] += (double)s->pixels.blue[i];
        sum[3] += (double)s->pixels.coverage[i];
        sum[4] += (double)s->pixels.water[i];
    }
    batch->count = 0;
}

/* The leaf's values become the mean of all its points, old and new. */
static void take_points(leaf *l, const double sums[5])
{
    const int first = l->points, end = next_points(l);
    float *const values[] = {&l->color[0], &l->color[1], &l->color[2], &l->coverage, &l->water};
    for (int k = 0; k < 5; k++)
        *values[k] = (float)((first * (double)*values[k] + sums[k]) / end);
    l->contrast *= l->places / (float)end;
    l->variance = l->coverage * fmaxf(l->water - l->coverage, 0) / (float)end;
    l->places = (float)end;
    l->points = (uint16_t)end;
}

static bool scatter_points(const forest *f, size_t tile, size_t end, uint32_t worker)
{
    const adaptive_frame *a = f->a;
    forest_tile *t = &f->tiles[tile];
    tile_scratch *s = a->scratch[worker];
    double *sums = calloc(5 * end, sizeof *sums);
    point_batch batch = {0};
    if (!sums)
        return false;
    for (int k = 0; k < INSTANTS; k++) {
        const wave_set *set = f->instants[k];
        a->kernels->sort(&a->frame->data, set, &set->view, (uint32_t)(tile % f->columns), (uint32_t)(tile / f->columns), &s->close);
        guess_tile(f, &s->close, &s->open_guess);
        for (size_t i = 0; i < end; i++) {
            const leaf *l = &t->leaves[i];
            if (!l->chosen || l->shape != SHAPE_POINTS)
                continue;
            const double shift = lot_of(tile ^ (size_t)(a->frame->scene->quality.seed * 0x9e3779b97f4a7c15u), l);
            for (int n = l->points + k; n < next_points(l); n += INSTANTS) {
                add_point(l, shift, n, (uint32_t)i, &batch, s);
                if (batch.count == TILE_PIXELS)
                    render_points(f, &batch, s, sums);
            }
        }
        if (batch.count > 0)
            render_points(f, &batch, s, sums);
    }
    bool added = true;
    for (size_t i = 0; i < end && added; i++) {
        leaf l = t->leaves[i];
        if (!l.chosen || l.shape != SHAPE_POINTS)
            continue;
        const double cost = cost_of(t, &l);
        take_points(&l, sums + 5 * i);
        l.chosen = false;
        f->out->samples[pixel_of(f, tile, &l)] += (float)cost;
        t->spent += cost;
        added = add_leaf(f, tile, l);
    }
    free(sums);
    return added;
}

static void split_tile(void *argument, size_t tile, uint32_t worker)
{
    forest *f = argument;
    forest_tile *t = &f->tiles[tile];
    const size_t end = t->count;
    bool sizes[SIDES][SIDES] = {{false}}, points = false;
    for (size_t i = 0; i < end; i++) {
        leaf *l = &t->leaves[i];
        l->chosen = is_chosen(f, tile, l);
        if (l->shape == SHAPE_POINTS)
            points |= l->chosen;
        else
            sizes[l->across + halvings[l->shape][0]][l->down + halvings[l->shape][1]] |= l->chosen;
    }
    for (int across = 0; across < SIDES; across++)
        for (int down = 0; down < SIDES; down++)
            if (sizes[across][down] && !split_size(f, tile, across, down, end, worker)) {
                atomic_store(&f->failed, true);
                return;
            }
    if (points && !scatter_points(f, tile, end, worker)) {
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
    double round_began, before; /* when the last round began, and what had been spent then */
} frame_budget;

/* How much the next round may spend; 0: it is enough. Little at first, while little is known. */
static double next_share(const forest *f, frame_budget *b, size_t round)
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
        const double speed = round == 0 ? 0.5 * used / (time - b->began) : (used - b->before) / (time - b->round_began);
        /* A round may be three times as slow as the last one, when its cells turn to points. */
        const double share = round == 0 ? 0.2 : 0.3;
        b->round_began = time;
        b->before = used;
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
    double share;
    for (size_t round = 0; !atomic_load(&f->failed) && (share = next_share(f, &budget, round)) > 0 && make_plan(f, share, round); round++) {
        thread_pool_run(a->pool, &split);
        if (a->keep_going && !a->keep_going(a->keep_going_argument, fmin(spent(f) / budget.evaluations, 1)))
            return MGT_CANCELLED;
    }
    thread_pool_run(a->pool, &end);
    return atomic_load(&f->failed) ? MGT_ERROR_MEMORY : MGT_OK;
}

/* ---- a frame ---- */

/* In the middle of strata of the shutter. */
static void place_instants(forest *f)
{
    const frame *whole = f->a->frame;
    for (int k = 0; k < INSTANTS; k++) {
        const double share = (k + 0.5) / INSTANTS;
        const camera_rays camera = camera_at(whole, share);
        wave_set_build(whole, &camera, (interval){whole->scene->time - (1 - share) * whole->scene->shutter, 0}, false, f->instants[k]);
    }
}

/* How far the slopes' path over a piece of the shutter strays from a straight one, RMS, over the light's radius in slopes. */
static double path_bend(const forest *f, int parts)
{
    const mgt_scene *s = f->a->frame->scene;
    double sum = 0;
    for (size_t i = 0; i < s->water.wave_count; i++) {
        const mgt_wave *w = &s->water.waves[i];
        const double away = 1 - cos(fmin(fabs(w->c) * s->shutter / 2 / parts, 3.14159265358979323846));
        sum += w->amplitude * w->amplitude * (w->a * w->a + w->b * w->b) / 2 * away * away;
    }
    return sqrt(sum) / (0.5 * (double)f->a->frame->data.light_radius);
}

static void place_parts(const forest *f, shutter_parts *p)
{
    const frame *whole = f->a->frame;
    const mgt_scene *s = whole->scene;
    for (int i = 0; i < (f->moves ? p->count + 1 : p->count); i++) {
        const double share = f->moves ? (double)i / p->count : (i + 0.5) / p->count;
        const camera_rays camera = camera_at(whole, share);
        wave_set_build(whole, &camera, (interval){s->time - (1 - share) * s->shutter, f->moves ? 0 : s->shutter / 2 / p->count}, true, p->sets[i]);
    }
}

static void place_waves(forest *f)
{
    static const double allowed[] = {1e9, 0.5, 0.02};
    for (int k = 0; k < 3; k++) {
        shutter_parts *p = &f->parts[k];
        p->count = 1;
        while (p->count < MOST_PARTS && path_bend(f, p->count) > allowed[k])
            p->count *= 2;
        place_parts(f, p);
    }
    place_instants(f);
}

void forest_free(forest *f)
{
    if (!f)
        return;
    for (size_t i = 0; f->tiles && i < (size_t)f->columns * f->rows; i++)
        free(f->tiles[i].leaves);
    for (size_t i = 0; i < f->workers; i++) {
        free(f->cells ? f->cells[i] : NULL);
        free(f->sums ? f->sums[i] : NULL);
        free(f->census ? f->census[i] : NULL);
    }
    for (int k = 0; k < INSTANTS; k++)
        free(f->instants[k]);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i <= MOST_PARTS; i++)
            free(f->parts[k].sets[i]);
    free(f->cells);
    free(f->sums);
    free(f->census);
    free(f->tiles);
    free(f->weight);
    free(f);
}

static bool make_memory(forest *f)
{
    f->tiles = calloc((size_t)f->columns * f->rows, sizeof *f->tiles);
    f->weight = malloc((size_t)f->width * f->height * sizeof *f->weight);
    f->cells = calloc(f->workers, sizeof *f->cells);
    f->sums = calloc(f->workers, sizeof *f->sums);
    f->census = calloc(f->workers, sizeof *f->census);
    bool all = f->tiles && f->weight && f->cells && f->sums && f->census;
    for (size_t i = 0; all && i < f->workers; i++) {
        f->cells[i] = calloc(1, sizeof **f->cells);
        f->sums[i] = calloc(1, sizeof **f->sums);
        f->census[i] = calloc(1, sizeof **f->census);
        all = f->cells[i] && f->sums[i] && f->census[i];
    }
    for (int k = 0; all && k < INSTANTS; k++)
        all = (f->instants[k] = calloc(1, sizeof **f->instants)) != NULL;
    for (int k = 0; k < 3; k++)
        for (int i = 0; all && i <= MOST_PARTS; i++)
            all = (f->parts[k].sets[i] = calloc(1, sizeof **f->parts[k].sets)) != NULL;
    return all;
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
    if (make_memory(f))
        return f;
    forest_free(f);
    return NULL;
}

/* Ready for a frame: empty but for memory. */
static void clear_forest(forest *f, const adaptive_frame *a, const picture_planes *out)
{
    f->a = a;
    f->out = out;
    f->moves = a->frame->scene->camera_moves;
    f->by_coverage = a->frame->scene->quality.target_rmse > 0;
    f->least_bucket = 0;
    atomic_store(&f->failed, false);
    for (size_t i = 0; i < (size_t)f->columns * f->rows; i++)
        f->tiles[i] = (forest_tile){.leaves = f->tiles[i].leaves, .capacity = f->tiles[i].capacity};
}

mgt_status adaptive_render(const adaptive_frame *a, forest **kept, const picture_planes *out)
{
    if (*kept && ((*kept)->width != out->width || (*kept)->height != out->height)) {
        forest_free(*kept);
        *kept = NULL;
    }
    if (!*kept)
        *kept = make_forest(a, out);
    if (!*kept)
        return MGT_ERROR_MEMORY;
    clear_forest(*kept, a, out);
    place_waves(*kept);
    return run_rounds(*kept);
}
