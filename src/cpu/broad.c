/* SPDX-License-Identifier: MIT
 * The broad phase: the world's triangles cut at the mean surface, moved to their virtual images and split where these bend. */
#include "cpu/broad.h"

#include <stdlib.h>
#include <string.h>

#include "base/triples.h"

enum {
    MOST_SPLITS = 14, /* depth of splits; edges within the picture get too short for more splits long before */
    MOST_CORNERS = 5  /* corners of a triangle that two planes cut */
};

typedef struct chunk_job {
    const broad_view *view;
    broad_scratch *scratch;
    raster_bins *bins;
    broad_counts *counts;
} chunk_job;

/* A part of a triangle. */
typedef struct part {
    int count;                     /* number of corners */
    float corner[MOST_CORNERS][3]; /* relative to the point of the mean surface below the camera, metres */
    float far[MOST_CORNERS];       /* distance of each corner beyond the mean surface, metres */
} part;

/* ---- drawing ---- */

static void load_patch(patch_batch *b, size_t i, const patch *from)
{
    for (int corner = 0; corner < 3; corner++)
        for (int k = 0; k < 3; k++) {
            b->corner[corner][k][i] = from->corner[corner][k];
            b->image[corner][k][i] = from->image[corner][k];
        }
}

static void draw(const chunk_job *job, int layer, const patch *p, size_t i)
{
    const broad_scratch *s = job->scratch;
    job->counts->drawn[layer] += raster_bins_add(job->bins, &job->view->grid, layer, &s->setup, i, (const float(*)[3])p->image, p->triangle);
}

static void draw_straight(const chunk_job *job)
{
    broad_scratch *s = job->scratch;
    patch_batch *b = &s->straight;
    job->view->kernels->setups(&job->view->picture, b, &s->setup);
    for (size_t i = 0; i < b->count; i++)
        draw(job, s->straight_layer[i], &s->straight_taken[i], i);
    b->count = 0;
}

/* Whether all corners lie beyond one border of the picture, or all are nearer than the least depth. */
static bool is_outside(const PictureData *picture, const float image[3][3])
{
    bool left = true, right = true, top = true, bottom = true, near = true;
    for (int i = 0; i < 3; i++) {
        const float x = image[i][0], y = image[i][1], z = image[i][2];
        left &= x < z * picture->left;
        right &= x > z * picture->right;
        top &= y < z * picture->top;
        bottom &= y > z * picture->bottom;
        near &= z < picture->least_depth;
    }
    return left || right || top || bottom || near;
}

/* Appends a triangle whose images are straight to the batch of these. */
static void take_straight(const chunk_job *job, int layer, const patch *p)
{
    broad_scratch *s = job->scratch;
    if (is_outside(&job->view->picture, p->image))
        return;
    const size_t i = s->straight.count++;
    load_patch(&s->straight, i, p);
    s->straight_taken[i] = *p;
    s->straight_layer[i] = layer;
    if (s->straight.count == PATCH_BATCH)
        draw_straight(job);
}

/* ---- splitting ---- */

static void push(const chunk_job *job, patch_stack *s, const patch *p)
{
    if (s->count == s->room) {
        const size_t room = s->room ? 2 * s->room : 1024;
        patch *grown = realloc(s->patches, room * sizeof *grown);
        if (!grown) {
            job->scratch->failed = true;
            return;
        }
        s->patches = grown;
        s->room = room;
    }
    s->patches[s->count++] = *p;
}

/* Points 0 to 2 are the corners of a patch, points 3 to 5 the middles of its edges. */
typedef struct patch_points {
    float point[6][3], image[6][3];
} patch_points;

static patch_points points_of(const patch_batch *b, const patch *p, size_t i)
{
    patch_points points;
    memcpy(points.point, p->corner, sizeof p->corner);
    memcpy(points.image, p->image, sizeof p->image);
    for (int edge = 0; edge < 3; edge++)
        for (int k = 0; k < 3; k++) {
            points.point[3 + edge][k] = b->middle[edge][k][i];
            points.image[3 + edge][k] = b->middle_image[edge][k][i];
        }
    return points;
}

/* Triangles of patch_points that replace a patch, by the set of edges that are split. Bit e is edge e, from corner e to the next one. */
static const struct {
    int count;
    int8_t corner[4][3];
} divisions[8] = {
    {1, {{0, 1, 2}}},
    {2, {{0, 3, 2}, {3, 1, 2}}},
    {2, {{0, 1, 4}, {0, 4, 2}}},
    {3, {{3, 1, 4}, {0, 3, 4}, {0, 4, 2}}},
    {2, {{0, 1, 5}, {5, 1, 2}}},
    {3, {{0, 3, 5}, {3, 1, 2}, {3, 2, 5}}},
    {3, {{5, 4, 2}, {0, 1, 4}, {0, 4, 5}}},
    {4, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}},
};

static void divide(const chunk_job *job, const patch *p, size_t i, int edges)
{
    const patch_points points = points_of(&job->scratch->batch, p, i);
    patch child = {.triangle = p->triangle, .depth = p->depth + 1};
    for (int t = divisions[edges].count; t-- > 0;) {
        for (int corner = 0; corner < 3; corner++) {
            memcpy(child.corner[corner], points.point[divisions[edges].corner[t][corner]], sizeof child.corner[0]);
            memcpy(child.image[corner], points.image[divisions[edges].corner[t][corner]], sizeof child.image[0]);
        }
        push(job, &job->scratch->waiting, &child);
    }
    job->counts->splits += (size_t)divisions[edges].count - 1;
}

static int split_edges(const patch_batch *b, size_t i) { return (b->split[0][i] > 0 ? 1 : 0) | (b->split[1][i] > 0 ? 2 : 0) | (b->split[2][i] > 0 ? 4 : 0); }

/* Draws or divides the patches of the batch, scratch->taken. `place`: their images are still to be computed. */
static void work_batch(const chunk_job *job, bool place)
{
    broad_scratch *s = job->scratch;
    patch_batch *b = &s->batch;
    job->view->kernels->patches(&job->view->refract, &job->view->picture, place, b);
    job->view->kernels->setups(&job->view->picture, b, &s->setup);
    for (size_t i = 0; i < b->count; i++) {
        if (b->hidden[i] > 0)
            continue;
        patch *p = &s->taken[i];
        for (int k = 0; k < 9 && place; k++)
            p->image[k / 3][k % 3] = b->image[k / 3][k % 3][i];
        const int edges = p->depth < MOST_SPLITS ? split_edges(b, i) : 0;
        if (edges)
            divide(job, p, i, edges);
        else
            draw(job, REFRACTED_LAYER, p, i);
    }
    b->count = 0;
}

/* Works on the last patches of a stack, up to PATCH_BATCH. `place`: as in work_batch(). */
static void work_stack(const chunk_job *job, patch_stack *stack, bool place)
{
    broad_scratch *s = job->scratch;
    const size_t count = stack->count < PATCH_BATCH ? stack->count : PATCH_BATCH;
    stack->count -= count;
    memcpy(s->taken, stack->patches + stack->count, count * sizeof *s->taken);
    for (size_t i = 0; i < count; i++)
        load_patch(&s->batch, i, &s->taken[i]);
    s->batch.count = count;
    work_batch(job, place);
}

static void work_until(const chunk_job *job, size_t left)
{
    while (job->scratch->waiting.count > left && !job->scratch->failed)
        work_stack(job, &job->scratch->waiting, false);
}

/* ---- cutting ---- */

static void cut_edge(const part *p, int in, int out, float plane, part *to)
{
    const float share = (p->far[in] - plane) / (p->far[in] - p->far[out]);
    for (int k = 0; k < 3; k++)
        to->corner[to->count][k] = p->corner[in][k] + (p->corner[out][k] - p->corner[in][k]) * share;
    to->far[to->count++] = plane;
}

/* The part where far ≥ plane if `beyond`, else that where far ≤ plane. An edge is cut from its end with the larger `far`, so that both parts get the same
 * corner. */
static part cut(const part *p, float plane, bool beyond, float side)
{
    part out = {.count = 0};
    for (int i = 0; i < p->count; i++) {
        const int next = i + 1 == p->count ? 0 : i + 1;
        const float a = p->far[i] - plane, b = p->far[next] - plane;
        if (beyond ? a >= 0 : a <= 0) {
            memcpy(out.corner[out.count], p->corner[i], sizeof out.corner[0]);
            out.far[out.count++] = p->far[i];
        }
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            cut_edge(p, a > 0 ? i : next, a > 0 ? next : i, plane, &out);
            out.corner[out.count - 1][1] = -side * plane;
        }
    }
    return out;
}

static void draw_near(const chunk_job *job, const part *p, int32_t triangle)
{
    static const float here[2] = {0, 0};
    const broad_view *view = job->view;
    RefractData straight = view->refract;
    straight.map = MAP_STRAIGHT;
    float image[MOST_CORNERS][4];
    view->kernels->images(&straight, &view->picture, here, (size_t)p->count, p->corner[0], image[0]);
    for (int i = 1; i + 1 < p->count; i++) {
        patch flat = {.triangle = triangle};
        memcpy(flat.image[0], image[0], sizeof flat.image[0]);
        memcpy(flat.image[1], image[i], sizeof flat.image[0]);
        memcpy(flat.image[2], image[i + 1], sizeof flat.image[0]);
        take_straight(job, FRONT_LAYER, &flat);
    }
}

/* Pushes the part's triangles for later, because the images of new corners are not known yet. */
static void push_part(const chunk_job *job, const part *p, int32_t triangle)
{
    for (int i = 1; i + 1 < p->count; i++) {
        patch corners = {.triangle = triangle};
        memcpy(corners.corner[0], p->corner[0], sizeof corners.corner[0]);
        memcpy(corners.corner[1], p->corner[i], 2 * sizeof corners.corner[0]);
        push(job, &job->scratch->cut, &corners);
    }
}

/* Distance beyond the mean surface up to which the front layer shows an object, metres. Troughs may uncover a part of it, and dry hulls all of it. */
static float uncovered(const broad_view *view, int32_t triangle)
{
    const world *w = view->world;
    const bool all = w->dry && !view->mirrored && view->refract.side > 0 && w->objects[w->object[triangle]].in_dry;
    return all ? INFINITY : view->trough;
}

/* Cuts a triangle that meets the mean surface or comes near it from the camera's side, and draws the parts into their layers. */
static void cut_triangle(const chunk_job *job, const patch *whole, const float far[3])
{
    const broad_view *view = job->view;
    const float side = view->refract.side;
    part p = {.count = 3};
    memcpy(p.corner, whole->corner, sizeof whole->corner);
    memcpy(p.far, far, 3 * sizeof *far);
    if (MOST3(far) > 0) {
        const part near = cut(&p, uncovered(view, whole->triangle), false, side), beyond = cut(&p, 0, true, side);
        if (!view->mirrored)
            draw_near(job, &near, whole->triangle);
        push_part(job, &beyond, whole->triangle);
    } else if (!view->mirrored) {
        take_straight(job, FRONT_LAYER, whole);
    }
    if (view->crest > 0) {
        const part own = cut(&p, 0, false, side);
        const part behind = cut(&own, -view->crest, true, side);
        push_part(job, &behind, whole->triangle);
    }
}

/* Draws the part of a triangle beyond the surface that may be uncovered into the front layer. */
static void draw_uncovered(const chunk_job *job, const patch *whole, const float far[3])
{
    part p = {.count = 3};
    memcpy(p.corner, whole->corner, sizeof whole->corner);
    memcpy(p.far, far, 3 * sizeof *far);
    const part near = cut(&p, uncovered(job->view, whole->triangle), false, job->view->refract.side);
    draw_near(job, &near, whole->triangle);
}

/* ---- chunks ---- */

static void take_patch(const chunk_job *job, const patch *p)
{
    broad_scratch *s = job->scratch;
    load_patch(&s->batch, s->batch.count, p);
    s->taken[s->batch.count++] = *p;
    if (s->batch.count < PATCH_BATCH)
        return;
    work_batch(job, false);
    work_until(job, PATCH_BATCH - 1);
}

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/refraction/edges.k"

static vec3 corner_of(const patch *p, int i) { return vec3(p->corner[i][0], p->corner[i][1], p->corner[i][2]); }

/* Whether a triangle of a closed object that the surface cuts open shows the camera its back. */
static bool shows_inside(const broad_view *view, const patch *p)
{
    return view->world->objects[view->world->object[p->triangle]].cut &&
           shows_back(NULL, corner_of(p, 0), corner_of(p, 1), corner_of(p, 2), vec3(0.0f, view->picture.eye_height, 0.0f));
}

static void take_triangle(const chunk_job *job, size_t index)
{
    const broad_view *view = job->view;
    const uint32_t *vertex = view->world->indices + 3 * index;
    patch p = {.triangle = (int32_t)index};
    float far[3];
    for (int i = 0; i < 3; i++) {
        const float *at = view->world->positions + 3 * (size_t)vertex[i], *image = view->images + 4 * (size_t)vertex[i];
        p.corner[i][0] = at[0] - view->foot[0];
        p.corner[i][1] = at[1];
        p.corner[i][2] = at[2] - view->foot[1];
        memcpy(p.image[i], image, sizeof p.image[i]);
        far[i] = image[3];
    }
    if (view->mirrored && (MOST3(far) <= -view->crest || shows_inside(view, &p)))
        return;
    if (LEAST3(far) >= 0) {
        if (view->refract.map == MAP_STRAIGHT)
            take_straight(job, REFRACTED_LAYER, &p);
        else
            take_patch(job, &p);
        if (LEAST3(far) < uncovered(view, p.triangle))
            draw_uncovered(job, &p, far);
    } else if (MOST3(far) > -view->crest) {
        cut_triangle(job, &p, far);
    } else {
        take_straight(job, FRONT_LAYER, &p);
    }
}

void broad_chunk(const broad_view *view, size_t chunk, broad_scratch *scratch, raster_bins *bins, broad_counts *counts)
{
    const chunk_job job = {view, scratch, bins, counts};
    const size_t first = chunk * BROAD_CHUNK, all = view->world->triangle_count;
    const size_t end = first + BROAD_CHUNK < all ? first + BROAD_CHUNK : all;
    scratch->batch.count = scratch->straight.count = scratch->waiting.count = scratch->cut.count = 0;
    for (size_t i = first; i < end; i++)
        take_triangle(&job, i);
    work_batch(&job, false);
    work_until(&job, 0);
    while (scratch->cut.count > 0 && !scratch->failed) {
        work_stack(&job, &scratch->cut, true);
        work_until(&job, 0);
    }
    draw_straight(&job);
    raster_bins_sort(bins, &view->grid);
    bins->failed |= scratch->failed;
}

void broad_scratch_free(broad_scratch *scratch)
{
    if (!scratch)
        return;
    free(scratch->waiting.patches);
    free(scratch->cut.patches);
    free(scratch);
}
