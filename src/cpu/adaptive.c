/* SPDX-License-Identifier: MIT
 * Method adaptive: splits pixels of method mangata into four cells again and again where that saves the most error.
 *
 * The picture of method mangata is rendered first. Its pixels are the first leaves of the refinement tree. Each leaf has an expected squared error, and leaves
 * are split in the order of the squared error that a split may save per evaluation of the waves. Splits go in rounds, because the cells of a round decide which
 * splits are worth most in the next one. Sums are kept per tile in a fixed order and counted in whole numbers across tiles, so that the result does not depend
 * on threads. */
#define _POSIX_C_SOURCE 199309L
#include "cpu/adaptive.h"

#include <math.h>
#include <string.h>
#include <time.h>

#include "cpu/leaf_lane.h"
#include "cpu/refinement.h"
#include "frame/cell_waves.h"
#include "frame/skyline.h"

/* ---- the picture of pixels ---- */

static leaf leaf_from(const tile_pixels *p, const tile_detail *d, size_t i)
{
    return (leaf){.color = {p->red[i], p->green[i], p->blue[i]},
                  .coverage = p->coverage[i],
                  .water = p->water[i],
                  .height = d->height[i],
                  .variance = d->variance[i],
                  .contrast = d->contrast[i],
                  .places = d->places[i],
                  .shape = lane_split(d->aspect[i])};
}

/* Sorts the waves of a set for a tile's cells. Returns the FrameData for these cells. */
static FrameData sort_set(const refinement *f, size_t tile, const wave_set *set, int across, int down, tile_waves *out)
{
    const FrameData data = cell_frame(&f->a->frame->data, across, down);
    const ViewData view = cell_view(&set->view, across, down);
    f->a->kernels->sort(&data, set, &view, (uint32_t)(tile % f->columns), (uint32_t)(tile / f->columns), out);
    return data;
}

/* Sorts the waves of one piece of the shutter into s->close. */
static FrameData sort_cells(const refinement *f, size_t tile, int across, int down, int part, tile_scratch *s)
{
    refinement_tile *t = &f->tiles[tile];
    const shutter_parts *parts = refinement_parts(f, t, (across + down) / 2);
    const FrameData data = sort_set(f, tile, parts->sets[part], across, down, &s->close);
    s->close.data.parts = across + down > 0 && !data.sky_black ? 1 << down : 0;
    if (across + down == 0)
        t->dark = lane_dark(&data, s->close.data.light_reach, f->by_display, lights_dark(&data));
    refinement_price(f, t, (across + down) / 2, s->close.data.resolved_count + s->close.data.mixed_count);
    return data;
}

static void plant_tile(void *argument, size_t tile, uint32_t worker)
{
    refinement *f = argument;
    const adaptive_frame *a = f->a;
    const picture_planes *p = f->out;
    tile_scratch *s = a->scratch[worker];
    tile_detail *detail = &f->cells[worker]->detail;
    refinement_tile *t = &f->tiles[tile];
    const FrameData data = sort_cells(f, tile, 0, 0, 0, s);
    tile_find_estimates(a->kernels, &data, &s->close, s->close_estimate);
    const method_tile shaded = {.frame = &data,
                                .sky = a->sky,
                                .light = a->objects ? &a->objects[tile].light : NULL,
                                .close = &s->close,
                                .close_estimate = s->close_estimate,
                                .detail = detail};
    a->kernels->method(MGT_METHOD_MANGATA, &shaded, &s->pixels);
    const uint32_t left = (uint32_t)(tile % f->columns) * TILE_WIDTH, top = (uint32_t)(tile / f->columns) * TILE_HEIGHT;
    for (uint32_t y = 0; y < TILE_HEIGHT && top + y < p->height; y++)
        for (uint32_t x = 0; x < TILE_WIDTH && left + x < p->width; x++) {
            const size_t from = (size_t)y * TILE_WIDTH + x, to = (size_t)(top + y) * p->width + left + x;
            leaf l = leaf_from(&s->pixels, detail, from);
            l.column = x;
            l.row = y;
            f->hit_height[to] = l.water >= 1 ? l.height : NAN;
            f->weight[to] = lane_weight(&a->frame->data, l.color, detail->display_slope_squared[from]);
            p->importance[to] = sqrtf(l.variance);
            p->samples[to] = l.water > 0 ? (float)t->cost[0] : 0;
            t->spent += (double)p->samples[to];
            if (!refinement_add(f, tile, l))
                atomic_store(&f->failed, true);
        }
}

/* ---- rounds ---- */

/* Adds one piece of the shutter to the sums of cells. Pixel values count with the fraction that the cells do not keep of their leaf. Heights are not summed:
 * those of the last piece stay. */
static void add_part(const tile_cells *part, float share, tile_cells *sum)
{
    enum { PIXEL_PLANES = 5 };
    const float *const from[] = {part->pixels.red,      part->pixels.green,    part->pixels.blue,   part->pixels.coverage, part->pixels.water,
                                 part->detail.variance, part->detail.contrast, part->detail.places, part->detail.aspect};
    float *const into[] = {sum->pixels.red,      sum->pixels.green,    sum->pixels.blue,   sum->pixels.coverage, sum->pixels.water,
                           sum->detail.variance, sum->detail.contrast, sum->detail.places, sum->detail.aspect};
    for (size_t k = 0; k < sizeof into / sizeof *into; k++)
        for (size_t i = 0; i < part->count; i++)
            into[k][i] += (k < PIXEL_PLANES ? share * (1 - part->kept[i]) : share) * from[k][i];
    memcpy(sum->detail.height, part->detail.height, part->count * sizeof *part->detail.height);
}

/* Applies parts_contrast(). The four parts of a leaf are neighbours in the arrays. */
static void average_contrasts(tile_detail *detail, size_t count)
{
    for (size_t i = 0; i < count; i += 4) {
        float parts[4];
        memcpy(parts, detail->contrast + i, sizeof parts);
        for (size_t k = 0; k < 4; k++)
            detail->contrast[i + k] = lane_parts_contrast(parts[k], parts);
    }
}

/* Renders the worker's cells, which are all of one size, and adds them as leaves. */
static bool grow(const refinement *f, size_t tile, int across, int down, uint32_t worker)
{
    const adaptive_frame *a = f->a;
    tile_cells *cells = f->cells[worker], *sum = f->sums[worker];
    tile_scratch *s = a->scratch[worker];
    refinement_tile *t = &f->tiles[tile];
    const int level = (across + down) / 2, parts = refinement_parts(f, t, level)->count;
    memset(&sum->detail, 0, sizeof sum->detail);
    cells->light = NULL;
    if (a->objects) {
        uint16_t pixels[TILE_PIXELS];
        for (size_t i = 0; i < cells->count; i++)
            pixels[i] = (uint16_t)(((uint32_t)cells->row[i] >> down) * TILE_WIDTH + ((uint32_t)cells->column[i] >> across));
        light_of_pixels(&a->objects[tile].light, pixels, cells->count, &s->objects.light);
        cells->light = &s->objects.light;
    }
    cells->across = across;
    cells->down = down;
    for (int part = 0; part < parts; part++) {
        const FrameData data = sort_cells(f, tile, across, down, part, s);
        a->kernels->cells(&data, a->sky, &s->close, cells);
        add_part(cells, 1.0f / (float)parts, sum);
    }
    if (!a->frame->data.sky_black)
        average_contrasts(&sum->detail, cells->count);
    for (size_t i = 0; i < cells->count; i++) {
        leaf l = leaf_from(&sum->pixels, &sum->detail, i);
        l.column = (uint32_t)cells->column[i];
        l.row = (uint32_t)cells->row[i];
        l.across = (uint8_t)across;
        l.down = (uint8_t)down;
        l.level = (uint8_t)level;
        f->out->samples[leaf_pixel(f, tile, &l)] += (float)t->cost[level];
        t->spent += t->cost[level];
        if (!refinement_add(f, tile, l))
            return false;
    }
    cells->count = 0;
    return true;
}

/* Appends the four cells of a leaf. A cell may begin its search at the hit of a pixel below if its class sees the shutter as one piece. `sum` starts with the
 * values that the cells keep of their leaf. */
static void add_children(const refinement *f, size_t tile, tile_cells *cells, tile_pixels *sum, const leaf *l)
{
    const float kept = lane_kept(f->tiles[tile].dark, l->variance);
    const size_t below = leaf_pixel(f, tile, l) + 2 * (size_t)f->out->width;
    const bool whole = !f->a->frame->data.sky_black && refinement_parts(f, &f->tiles[tile], l->level + 1)->count == 1;
    const bool known = whole && below < (size_t)f->width * f->height;
    const uint32_t wide = 1u << halvings[l->shape][0];
    for (uint32_t k = 0; k < 4; k++) {
        cells->column[cells->count] = (float)(l->column * wide + k % wide);
        cells->row[cells->count] = (float)((l->row << halvings[l->shape][1]) + k / wide);
        cells->below[cells->count] = known ? f->hit_height[below] : NAN;
        cells->kept[cells->count] = kept;
        sum->red[cells->count] = kept * l->color[0];
        sum->green[cells->count] = kept * l->color[1];
        sum->blue[cells->count] = kept * l->color[2];
        sum->coverage[cells->count] = kept * l->coverage;
        sum->water[cells->count] = kept * l->water;
        cells->estimate.height[cells->count++] = l->height;
    }
}

/* Splits the chosen leaves whose cells have this size. `end`: number of leaves before the round. */
static bool split_size(const refinement *f, size_t tile, int across, int down, size_t end, uint32_t worker)
{
    refinement_tile *t = &f->tiles[tile];
    tile_cells *cells = f->cells[worker];
    cells->count = 0;
    for (size_t i = 0; i < end; i++) {
        const leaf *l = &t->leaves[i];
        if (!l->chosen || l->shape == SPLIT_POINTS || l->across + halvings[l->shape][0] != across || l->down + halvings[l->shape][1] != down)
            continue;
        add_children(f, tile, cells, &f->sums[worker]->pixels, l);
        if (cells->count == TILE_PIXELS && !grow(f, tile, across, down, worker))
            return false;
    }
    return cells->count == 0 || grow(f, tile, across, down, worker);
}

static void split_tile(void *argument, size_t tile, uint32_t worker)
{
    refinement *f = argument;
    refinement_tile *t = &f->tiles[tile];
    const size_t end = t->count;
    bool sizes[SIDES][SIDES] = {{false}}, points = false;
    for (size_t i = 0; i < end; i++) {
        leaf *l = &t->leaves[i];
        l->chosen = leaf_chosen(f, tile, l);
        if (l->shape == SPLIT_POINTS)
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
    if (points && !refinement_scatter_points(f, tile, end, worker)) {
        atomic_store(&f->failed, true);
        return;
    }
    size_t kept = 0;
    for (size_t i = 0; i < t->count; i++) {
        const leaf *l = &t->leaves[i];
        if (l->chosen)
            continue;
        if (l->bucket <= f->least_bucket)
            leaf_settle(f, tile, l);
        else if (i > kept++)
            t->leaves[kept - 1] = *l;
    }
    t->count = kept;
}

static void settle_tile(void *argument, size_t tile, uint32_t worker)
{
    (void)worker;
    const refinement *f = argument;
    for (size_t i = 0; i < f->tiles[tile].count; i++)
        leaf_settle(f, tile, &f->tiles[tile].leaves[i]);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Evaluations and time of a frame. */
typedef struct frame_budget {
    double evaluations;         /* budget of evaluations, for a number of samples */
    double began, end;          /* seconds, for a budget of time */
    double round_began, before; /* time at which the last round began, and evaluations before it */
} frame_budget;

/* Evaluations that the next round may spend; 0: the frame is done. */
static double next_share(const refinement *f, frame_budget *b, size_t round)
{
    enum { MOST_ROUNDS = 40 };
    const mgt_quality *q = &f->a->frame->scene->quality;
    const double used = refinement_spent(f);
    const error_goal goal = refinement_goal(f);
    if (goal.target > 0)
        return round < MOST_ROUNDS ? share_towards(NULL, goal.predicted, goal.target, used) : 0;
    if (q->budget_ms > 0) {
        const double time = now(), left = b->end - time;
        /* Pixels are cheaper than cells, so half of the speed with pixels is a careful estimate for the first round. */
        const double speed = round == 0 ? 0.5 * used / (time - b->began) : (used - b->before) / (time - b->round_began);
        /* A round whose cells turn to points may be three times as slow as the round before it. */
        const double share = round == 0 ? 0.2 : 0.3;
        b->round_began = time;
        b->before = used;
        return round < MOST_ROUNDS && left > 0.02 * (b->end - b->began) ? share * left * speed : 0;
    }
    return share_of_samples(NULL, (int)round, b->evaluations, used);
}

/* Called within a round on the caller's thread. */
static bool report_progress(void *argument, double fraction)
{
    const refinement *f = argument;
    return f->a->keep_going(f->a->keep_going_argument, fmin(f->done + f->share * fraction, 1));
}

static mgt_status run_rounds(refinement *f)
{
    const adaptive_frame *a = f->a;
    const mgt_quality *q = &a->frame->scene->quality;
    const size_t tiles = (size_t)f->columns * f->rows;
    const thread_loop plant = {tiles, plant_tile, f, NULL}, split = {tiles, split_tile, f, report_progress}, end = {tiles, settle_tile, f, NULL};
    frame_budget budget = {.began = now()};
    /* A part of the time is left for settling the leaves and for display. */
    budget.end = budget.began + 1e-3 * q->budget_ms - 4e-9 * (double)f->out->width * f->out->height;
    thread_pool_run(a->pool, &plant);
    budget.evaluations = (q->samples > 0 ? q->samples : 8) * refinement_water(f);
    double share;
    for (size_t round = 0; !atomic_load(&f->failed) && (share = next_share(f, &budget, round)) > 0 && refinement_plan(f, share, round); round++) {
        f->done = refinement_spent(f) / budget.evaluations;
        f->share = share / budget.evaluations;
        if (!thread_pool_run(a->pool, &split))
            return MGT_CANCELLED;
    }
    thread_pool_run(a->pool, &end);
    return atomic_load(&f->failed) ? MGT_ERROR_MEMORY : MGT_OK;
}

/* ---- a frame ---- */

static void place_waves(refinement *f)
{
    const frame *whole = f->a->frame;
    int counts[CELL_CLASSES];
    cell_part_counts(whole, counts);
    /* A skyline takes long to find, and skylines of pieces of the shutter are nearly the same. */
    wave_set *const skyline = f->instants[0];
    wave_set_build(whole, &whole->close, frame_shutter(whole), true, skyline);
    for (int k = 0; k < CELL_CLASSES; k++) {
        shutter_parts *p = &f->parts[k];
        p->count = counts[k];
        for (int i = 0; i < p->count; i++) {
            const double from = (double)i / p->count, to = (i + 1.0) / p->count;
            const camera_rays open = camera_at(whole, from), close = camera_at(whole, to);
            wave_set_sweep(whole, &open, &close, from, to, p->sets[i]);
            skyline_copy(skyline, p->sets[i]);
        }
    }
    for (int k = 0; k < INSTANTS; k++) {
        const double instant = cell_instant(k);
        const camera_rays camera = camera_at(whole, instant);
        wave_set_build(whole, &camera, frame_part(whole, instant, instant), false, f->instants[k]);
    }
}

mgt_status adaptive_render(const adaptive_frame *a, refinement **kept, const picture_planes *out)
{
    if (*kept && ((*kept)->width != out->width || (*kept)->height != out->height)) {
        refinement_free(*kept);
        *kept = NULL;
    }
    if (!*kept)
        *kept = refinement_make(a, out);
    if (!*kept)
        return MGT_ERROR_MEMORY;
    refinement_clear(*kept, a, out);
    place_waves(*kept);
    return run_rounds(*kept);
}
