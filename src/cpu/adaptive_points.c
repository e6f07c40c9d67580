/* SPDX-License-Identifier: MIT
 * Point samples of method adaptive, for cells that show so many waves that many splits would not reduce the error. */
#include <stdlib.h>
#include <string.h>

#include "cpu/refinement.h"

/* Points that are still to be rendered. */
typedef struct point_batch {
    int count;
    uint32_t owner[TILE_PIXELS]; /* index of each point's leaf */
    uint16_t pixel[TILE_PIXELS]; /* each point's pixel in the tile */
} point_batch;

/* Appends point `index` of a leaf's sequence. The search of its hit begins with the estimate of its pixel. */
static void add_point(const leaf *l, double lot, int index, uint32_t owner, point_batch *batch, tile_scratch *s)
{
    const LeafPlace place = place_of_leaf(l);
    const int i = batch->count++;
    batch->owner[i] = owner;
    s->jitter_x[i] = point_place(NULL, place.column, place.across, point_across(NULL, lot, index), i % TILE_WIDTH);
    s->jitter_y[i] = point_place(NULL, place.row, place.down, point_down(NULL, lot, index), i / TILE_WIDTH);
    const size_t pixel = (size_t)(l->row >> l->down) * TILE_WIDTH + (l->column >> l->across);
    batch->pixel[i] = (uint16_t)pixel;
    s->close_estimate->height[i] = s->open_estimate->height[pixel];
    s->close_estimate->from[i] = s->open_estimate->from[pixel];
    s->close_estimate->search[i] = s->open_estimate->search[pixel];
    s->close_estimate->shift_x[i] = s->open_estimate->shift_x[pixel];
    s->close_estimate->shift_z[i] = s->open_estimate->shift_z[pixel];
}

/* Sums over a leaf's points: red, green, blue, coverage, water and squared luminance. */
enum { POINT_SUMS = 6 };

/* Renders the points and adds them to the sums of their owners, sums[POINT_SUMS × owner]. */
static void render_points(const refinement *f, size_t tile, point_batch *batch, tile_scratch *s, double *sums)
{
    const tile_opened *objects = f->a->objects;
    for (int i = batch->count; i < TILE_PIXELS; i++) {
        s->jitter_x[i] = s->jitter_x[0] - (float)(i % TILE_WIDTH);
        s->jitter_y[i] = s->jitter_y[0] - (float)(i / TILE_WIDTH);
    }
    memset(&s->pixels, 0, sizeof s->pixels);
    if (objects)
        light_of_pixels(&objects[tile].light, batch->pixel, (size_t)batch->count, &s->objects.light);
    f->a->kernels->sample(&f->a->frame->data, f->a->sky, objects ? &s->objects.light : NULL, &s->close, s->close_estimate, s->jitter_x, s->jitter_y, 1,
                          &s->pixels);
    for (int i = 0; i < batch->count; i++) {
        double *sum = sums + POINT_SUMS * batch->owner[i];
        const double luminance = point_luminance(NULL, (double)s->pixels.red[i], (double)s->pixels.green[i], (double)s->pixels.blue[i]);
        sum[0] += (double)s->pixels.red[i];
        sum[1] += (double)s->pixels.green[i];
        sum[2] += (double)s->pixels.blue[i];
        sum[3] += (double)s->pixels.coverage[i];
        sum[4] += (double)s->pixels.water[i];
        sum[5] += luminance * luminance;
    }
    batch->count = 0;
}

/* Sets the leaf's values to the mean of its points, old and new. */
static void take_points(leaf *l, const double sums[POINT_SUMS], bool sky_black)
{
    const int end = leaf_next_points(l);
    const PointSums all = {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5]};
    const LeafValues before = {l->color[0], l->color[1], l->color[2], l->coverage, l->water, l->variance, l->contrast, l->places};
    const LeafValues v = values_with_points(NULL, before, all, l->points, end, sky_black);
    l->color[0] = v.red, l->color[1] = v.green, l->color[2] = v.blue;
    l->coverage = v.coverage, l->water = v.water;
    l->variance = v.variance, l->contrast = v.contrast, l->places = v.places;
    l->points = (uint16_t)end;
}

bool refinement_scatter_points(const refinement *f, size_t tile, size_t end, uint32_t worker)
{
    const adaptive_frame *a = f->a;
    refinement_tile *t = &f->tiles[tile];
    tile_scratch *s = a->scratch[worker];
    double *sums = calloc(POINT_SUMS * end, sizeof *sums);
    point_batch batch = {0};
    if (!sums)
        return false;
    for (int k = 0; k < INSTANTS; k++) {
        const wave_set *set = f->instants[k];
        a->kernels->sort(&a->frame->data, set, &set->view, (uint32_t)(tile % f->columns), (uint32_t)(tile / f->columns), &s->close);
        tile_find_estimates(a->kernels, &a->frame->data, &s->close, s->open_estimate);
        for (size_t i = 0; i < end; i++) {
            const leaf *l = &t->leaves[i];
            if (!l->chosen || l->shape != SPLIT_POINTS)
                continue;
            const double lot = leaf_lot(NULL, (int)tile, place_of_leaf(l), ~a->frame->scene->quality.seed);
            for (int n = l->points + k; n < leaf_next_points(l); n += INSTANTS) {
                add_point(l, lot, n, (uint32_t)i, &batch, s);
                if (batch.count == TILE_PIXELS)
                    render_points(f, tile, &batch, s, sums);
            }
        }
        if (batch.count > 0)
            render_points(f, tile, &batch, s, sums);
    }
    bool added = true;
    for (size_t i = 0; i < end && added; i++) {
        leaf l = t->leaves[i];
        if (!l.chosen || l.shape != SPLIT_POINTS)
            continue;
        const double cost = leaf_cost(t, &l);
        take_points(&l, sums + POINT_SUMS * i, a->frame->data.sky_black);
        l.chosen = false;
        f->out->samples[leaf_pixel(f, tile, &l)] += (float)cost;
        t->spent += cost;
        added = refinement_add(f, tile, l);
    }
    free(sums);
    return added;
}
