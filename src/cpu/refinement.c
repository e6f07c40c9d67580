/* SPDX-License-Identifier: MIT
 * The leaves of method adaptive: the worth of their splits, the plan of a round, and memory. */
#include "cpu/refinement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/leaf_lane.h"

const uint8_t halvings[4][2] = {{1, 1}, {0, 2}, {2, 0}, {0, 0}};

/* One worker's histograms of cost by the worth of splits. They are whole numbers, so that the sum over workers does not depend on the distribution of tiles. */
struct census {
    uint64_t cells[WORTH_BUCKETS], points[WORTH_BUCKETS]; /* cost of splits and of points, in units of 1/COST_UNIT evaluation */
};

size_t leaf_pixel(const refinement *f, size_t tile, const leaf *l)
{
    const size_t x = tile % f->columns * TILE_WIDTH + (l->column >> l->across), y = tile / f->columns * TILE_HEIGHT + (l->row >> l->down);
    return y * f->out->width + x;
}

static const float areas[LEVELS] = {1, 0x1p-2f, 0x1p-4f, 0x1p-6f, 0x1p-8f, 0x1p-10f, 0x1p-12f, 0x1p-14f, 0x1p-16f}; /* area of a cell of each level, pixels */

void leaf_settle(const refinement *f, size_t tile, const leaf *l)
{
    const picture_planes *p = f->out;
    const size_t i = leaf_pixel(f, tile, l);
    const float area = areas[l->level];
    for (int k = 0; k < 3; k++)
        p->color[3 * i + (size_t)k] += area * l->color[k];
    p->coverage[i] += area * l->coverage;
    p->water[i] += area * l->water;
    if (l->level > 0 || l->points > 0)
        p->detail[i] += area * l->coverage;
    f->tiles[tile].final_variance += (double)(area * area * l->variance);
    f->tiles[tile].final_shown += (double)(area * area * l->contrast * f->weight[i]);
}

/* ---- worth of splits ---- */

const shutter_parts *refinement_parts(const refinement *f, const refinement_tile *t, int level)
{
    return &f->parts[lane_class(level, t->dark, f->a->frame->scene->camera_moves)];
}

/* Updates the cost and worth of splits after a level's cost became known. An unknown cost is estimated from that of the nearest level above. */
static void refinement_appraise(const refinement *f, refinement_tile *t)
{
    double cost = t->cost[0];
    for (int level = 0; level < LEVELS; level++) {
        const double known = level + 1 < LEVELS ? t->cost[level + 1] : 0;
        cost = next_cost(NULL, known, cost, refinement_parts(f, t, level)->count, refinement_parts(f, t, level + 1)->count);
        t->below[level] = 4 * cost;
        t->worth[level] = split_worth_of(NULL, areas[level], t->below[level]);
    }
}

void refinement_price(const refinement *f, refinement_tile *t, int level, int waves)
{
    t->cost[level] = cell_cost(NULL, refinement_parts(f, t, level)->count, waves, f->parts[0].sets[0]->view.wave_count);
    refinement_appraise(f, t);
}

static lane_leaf lane_of(const leaf *l) { return (lane_leaf){l->points, l->places, l->coverage}; }

int leaf_next_points(const leaf *l) { return lane_next_points(lane_of(l)); }

double leaf_cost(const refinement_tile *t, const leaf *l)
{
    return l->shape == SPLIT_POINTS ? (double)(leaf_next_points(l) - l->points) * POINT_COST : t->below[l->level];
}

static float worth_of(const refinement *f, const refinement_tile *t, const leaf *l)
{
    if (l->shape != SPLIT_POINTS)
        return lane_split_worth(f->by_display, l->places, t->worth[l->level]);
    return lane_points_worth(lane_of(l), areas[l->level], (float)leaf_cost(t, l));
}

bool refinement_add(const refinement *f, size_t tile, leaf l)
{
    refinement_tile *t = &f->tiles[tile];
    const float now = f->by_coverage ? l.variance : l.contrast * f->weight[leaf_pixel(f, tile, &l)];
    if (lane_takes_points(&f->a->frame->data, lane_of(&l), l.level))
        l.shape = SPLIT_POINTS;
    const bool ends = l.shape == SPLIT_POINTS ? leaf_next_points(&l) > LEAF_MOST_POINTS : l.level + 1 == LEVELS;
    l.bucket = now > 0 && !ends ? lane_bucket(now * worth_of(f, t, &l)) : 0;
    if (l.bucket <= f->least_bucket) {
        leaf_settle(f, tile, &l);
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

/* ---- the error that is left ---- */

static double coverage_error(const refinement *f)
{
    double sum = 0;
    for (size_t tile = 0; tile < (size_t)f->columns * f->rows; tile++) {
        const refinement_tile *t = &f->tiles[tile];
        sum += t->final_variance;
        for (size_t i = 0; i < t->count; i++)
            sum += (double)(areas[t->leaves[i].level] * areas[t->leaves[i].level] * t->leaves[i].variance);
    }
    return predicted_rmse(NULL, sum, (double)f->out->width * f->out->height);
}

static double displayed_error(const refinement *f)
{
    if (f->a->frame->data.sky_black)
        return coverage_error(f);
    double sum = 0;
    for (size_t tile = 0; tile < (size_t)f->columns * f->rows; tile++) {
        const refinement_tile *t = &f->tiles[tile];
        sum += t->final_shown;
        for (size_t i = 0; i < t->count; i++) {
            const leaf *l = &t->leaves[i];
            sum += (double)(areas[l->level] * areas[l->level] * l->contrast * f->weight[leaf_pixel(f, tile, l)]);
        }
    }
    return predicted_displayed(NULL, sum, (double)f->out->width * f->out->height);
}

error_goal refinement_goal(const refinement *f)
{
    const mgt_quality *q = &f->a->frame->scene->quality;
    if (q->target_rmse > 0)
        return (error_goal){coverage_error(f), q->target_rmse};
    return q->target_displayed > 0 ? (error_goal){displayed_error(f), q->target_displayed} : (error_goal){0, 0};
}

/* ---- rounds ---- */

static void count_tile(void *argument, size_t tile, uint32_t worker)
{
    const refinement *f = argument;
    const refinement_tile *t = &f->tiles[tile];
    struct census *census = f->census[worker];
    for (size_t i = 0; i < t->count; i++) {
        const leaf *l = &t->leaves[i];
        (l->shape == SPLIT_POINTS ? census->points : census->cells)[l->bucket] += (uint64_t)(leaf_cost(t, l) * COST_UNIT);
    }
}

bool refinement_plan(refinement *f, double budget, size_t round)
{
    for (size_t i = 0; i < f->workers; i++)
        memset(f->census[i], 0, sizeof **f->census);
    const thread_loop loop = {(size_t)f->columns * f->rows, count_tile, f, NULL};
    thread_pool_run(f->a->pool, &loop);
    RoundPlan plan = plan_begun(NULL, budget);
    for (int b = WORTH_BUCKETS - 1; b >= 0 && !plan.ended; b--) {
        uint64_t cells = 0, points = 0;
        for (size_t i = 0; i < f->workers; i++) {
            cells += f->census[i]->cells[b];
            points += f->census[i]->points[b];
        }
        plan = plan_with_bucket(NULL, plan, b, (double)cells, (double)points);
    }
    f->plan = plan_ended(NULL, plan);
    const error_goal goal = refinement_goal(f);
    f->least_bucket = settled_bucket(NULL, f->plan, (int)round, kept_octaves(NULL, goal.predicted, goal.target), false, f->least_bucket);
    return f->plan.any;
}

bool leaf_chosen(const refinement *f, size_t tile, const leaf *l)
{
    const bool points = l->shape == SPLIT_POINTS, on_edge = !points && l->bucket == f->plan.bucket;
    return plan_takes(NULL, f->plan, l->bucket, points, on_edge ? leaf_lot(NULL, (int)tile, place_of_leaf(l), 0) : 0);
}

double refinement_spent(const refinement *f)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)f->columns * f->rows; i++)
        sum += f->tiles[i].spent;
    return sum;
}

double refinement_water(const refinement *f)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)f->out->width * f->out->height; i++)
        sum += (double)f->out->water[i];
    /* Open leaves are not yet added to their pixels. */
    for (size_t tile = 0; tile < (size_t)f->columns * f->rows; tile++)
        for (size_t i = 0; i < f->tiles[tile].count; i++)
            sum += (double)f->tiles[tile].leaves[i].water;
    return sum;
}

/* ---- memory ---- */

void refinement_free(refinement *f)
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
        for (int i = 0; i < MOST_PARTS; i++)
            free(f->parts[k].sets[i]);
    free(f->cells);
    free(f->sums);
    free(f->census);
    free(f->tiles);
    free(f->weight);
    free(f->hit_height);
    free(f);
}

static bool make_memory(refinement *f)
{
    f->tiles = calloc((size_t)f->columns * f->rows, sizeof *f->tiles);
    f->weight = malloc((size_t)f->width * f->height * sizeof *f->weight);
    f->hit_height = malloc((size_t)f->width * f->height * sizeof *f->hit_height);
    f->cells = calloc(f->workers, sizeof *f->cells);
    f->sums = calloc(f->workers, sizeof *f->sums);
    f->census = calloc(f->workers, sizeof *f->census);
    bool all = f->tiles && f->weight && f->hit_height && f->cells && f->sums && f->census;
    for (size_t i = 0; all && i < f->workers; i++) {
        f->cells[i] = calloc(1, sizeof **f->cells);
        f->sums[i] = calloc(1, sizeof **f->sums);
        f->census[i] = calloc(1, sizeof **f->census);
        all = f->cells[i] && f->sums[i] && f->census[i];
    }
    for (int k = 0; all && k < INSTANTS; k++)
        all = (f->instants[k] = calloc(1, sizeof **f->instants)) != NULL;
    for (int k = 0; k < 3; k++)
        for (int i = 0; all && i < MOST_PARTS; i++)
            all = (f->parts[k].sets[i] = calloc(1, sizeof **f->parts[k].sets)) != NULL;
    return all;
}

refinement *refinement_make(const adaptive_frame *a, const picture_planes *out)
{
    refinement *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    f->width = out->width;
    f->height = out->height;
    f->columns = (out->width + TILE_WIDTH - 1) / TILE_WIDTH;
    f->rows = (out->height + TILE_HEIGHT - 1) / TILE_HEIGHT;
    f->workers = thread_pool_size(a->pool);
    if (make_memory(f))
        return f;
    refinement_free(f);
    return NULL;
}

void refinement_clear(refinement *f, const adaptive_frame *a, const picture_planes *out)
{
    f->a = a;
    f->out = out;
    f->by_coverage = a->frame->scene->quality.target_rmse > 0;
    f->by_display = !a->frame->data.sky_black && !f->by_coverage;
    f->least_bucket = 0;
    atomic_store(&f->failed, false);
    for (size_t i = 0; i < (size_t)f->columns * f->rows; i++)
        f->tiles[i] = (refinement_tile){.leaves = f->tiles[i].leaves, .capacity = f->tiles[i].capacity};
}
