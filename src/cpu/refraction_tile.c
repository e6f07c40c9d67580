/* SPDX-License-Identifier: MIT
 * Scenes with objects: fills the tile_objects of a tile. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/refraction_state.h"

/* ---- light of lists of ends ---- */

static void take(float *plane, const uint16_t *list, size_t count)
{
    for (size_t i = 0; i < count; i++)
        plane[i] = plane[list[i]];
}

void refraction_shade(const refraction *r, tile_objects *o, size_t count)
{
    const tile_ends *e = &o->ends;
    const shade_hits hits = {
        .count = count,
        .triangle = e->triangle,
        .position = {e->position[0], e->position[1], e->position[2]},
        .direction = {e->direction[0], e->direction[1], e->direction[2]},
        .before = e->before,
        .after = e->after,
        .water = e->water,
        .spread = {e->spread[0], e->spread[1], e->spread[2]},
        .gain = e->gain,
    };
    r->kernels->shade->points(r->shade, &hits, o->rgb);
}

void refraction_shade_listed(const refraction *r, tile_objects *o, size_t count)
{
    tile_ends *e = &o->ends;
    if (count < TILE_PIXELS) {
        for (size_t i = 0; i < count; i++)
            e->triangle[i] = e->triangle[o->list[i]];
        for (int k = 0; k < 3; k++) {
            take(e->position[k], o->list, count);
            take(e->direction[k], o->list, count);
            take(e->spread[k], o->list, count);
        }
        take(e->before, o->list, count);
        take(e->after, o->list, count);
        take(e->water, o->list, count);
        take(e->gain, o->list, count);
    }
    refraction_shade(r, o, count);
}

void refraction_spread(const tile_objects *o, size_t count, float (*planes)[TILE_PIXELS])
{
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            planes[k][o->list[i]] = o->rgb[3 * i + (size_t)k];
}

/* ---- through the surface ---- */

/* Lists the pixels that are water. `unseen`: only those of which no ray has met water yet. */
static size_t list_water(tile_objects *o, bool unseen)
{
    size_t count = 0;
    for (uint32_t i = 0; i < TILE_PIXELS; i++)
        if (o->water.share[i] > 0 && !(unseen && o->seen[i] > 0))
            o->list[count++] = (uint16_t)i;
    return count;
}

/* Removes pixels that objects in front cover entirely from the water, so that nothing is searched behind them. */
static void leave_covered(tile_objects *o)
{
    for (size_t i = 0; i < TILE_PIXELS; i++)
        o->water.share[i] = o->share[i] < 1 ? o->water.share[i] : 0;
}

/* Removes pixels from the water if an object in front hides the place (at->dx, at->dy) of them. */
static void leave_hidden(const refraction *r, const tile_offset *at, tile_objects *o)
{
    for (size_t i = 0; i < TILE_PIXELS; i++)
        if (o->water.share[i] > 0 && refraction_is_hidden(r, at, o, i, at->dx, at->dy))
            o->water.share[i] = 0;
}

/* Fills light.clear: what objects, and for a camera under water the water on the ray, let through of the light's disk. */
static void see_light(const refraction *r, tile_objects *o)
{
    const float foot_x = r->narrow.data.foot_x, foot_z = r->narrow.data.foot_z;
    float x[TILE_PIXELS], z[TILE_PIXELS], way[TILE_PIXELS];
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        const float along = o->water.share[i] > 0 ? o->water.along[i] : 0;
        x[i] = along > 0 ? foot_x + along * o->water.view[0][i] : foot_x;
        z[i] = along > 0 ? foot_z + along * o->water.view[2][i] : foot_z;
        way[i] = r->frame->under ? along : 0;
    }
    r->kernels->shade->disk(r->shade, TILE_PIXELS, x, z, way, (float *const[3]){o->light.clear[0], o->light.clear[1], o->light.clear[2]});
}

/* Fills light.deep: radiance of rays that meet no surface, for a camera under water. */
static void see_deep(const refraction *r, uint32_t column, uint32_t row, tile_objects *o)
{
    const camera_rays *c = &r->camera;
    tile_ends *e = &o->ends;
    size_t count = 0;
    memset(o->light.deep, 0, sizeof o->light.deep);
    memset(o->deep_known, 0, sizeof o->deep_known);
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        if (o->water.share[i] >= 1 || o->share[i] >= 1)
            continue;
        double ray[3], squared = 0;
        for (int k = 0; k < 3; k++) {
            ray[k] = c->corner[k] + (double)(column + i % TILE_WIDTH) * c->right[k] + (double)(row + i / TILE_WIDTH) * c->down[k];
            squared += ray[k] * ray[k];
        }
        for (int k = 0; k < 3; k++) {
            e->direction[k][count] = (float)(ray[k] / sqrt(squared));
            e->position[k][count] = e->spread[k][count] = 0;
        }
        e->direction[1][count] = fminf(e->direction[1][count], -1e-6f);
        e->triangle[count] = -1;
        e->before[count] = e->after[count] = e->water[count] = 0;
        e->gain[count] = 1;
        o->deep_known[i] = 1;
        o->list[count++] = (uint16_t)i;
    }
    refraction_shade(r, o, count);
    refraction_spread(o, count, o->light.deep);
}

static void keep_layers(tile_objects *o)
{
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        const bool seen = o->water.share[i] > 0 && o->share[i] < FRONT_SHOWS;
        for (int k = 0; k < 3; k++)
            o->refraction[k][i] = seen ? o->light.through[k][i] : 0;
        o->error[i] = seen ? o->error[i] : 0;
    }
}

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/refraction/compose.k"
#include "kernels/refraction/edges.k"

void refraction_end_at(const refraction *r, tile_objects *o, size_t i, float last)
{
    tile_ends *e = &o->ends;
    e->after[i] = e->way[i] + last;
    e->water[i] = metres_in_water(NULL, r->narrow.data.side, o->met->along[i], last, e->total[i] > 0) + e->wet[i];
    for (int k = 0; k < 3; k++)
        e->spread[k][i] = e->terms[k][i] + e->after[i] * (e->terms[3 + k][i] + e->after[i] * e->terms[6 + k][i]);
}

/* The ray from the pixel's first hit with the surface, or from its last one. */
static trace_ray ray_behind(const refraction *r, const tile_objects *o, size_t i, bool first)
{
    const tile_ends *e = &o->ends;
    const camera_rays *c = &r->camera;
    const double foot[3] = {c->position[0] - r->world->origin[0], c->position[1], c->position[2] - r->world->origin[1]};
    const double side = r->frame->under ? -1 : 1, along = (double)o->met->along[i] * TRACE_START;
    trace_ray ray = {.least = 0, .most = first ? e->unsure[i] : INFINITY};
    for (int axis = 0; axis < 3; axis++) {
        const double view = (double)o->met->view[axis][i] * (axis == 1 ? side : 1);
        ray.origin[axis] = e->way[i] > 0 && !first ? e->from[axis][i] : (float)(foot[axis] + along * view);
        ray.direction[axis] = first ? e->toward[axis][i] : e->direction[axis][i];
    }
    return ray;
}

/* Traces listed rays up to where they meet the surface again, where the layers do not tell whether something stops them before. Those that are stopped are left
 * at their first hit with the surface. */
static void trace_unsure(refraction *r, tile_objects *o, size_t count)
{
    tile_ends *e = &o->ends;
    size_t unsure = 0;
    uint16_t list[TILE_PIXELS];
    for (size_t k = 0; k < count; k++) {
        const size_t i = o->list[k];
        if (!(e->unsure[i] > 0))
            continue;
        o->rays[unsure] = ray_behind(r, o, i, true);
        list[unsure++] = (uint16_t)i;
    }
    if (unsure == 0)
        return;
    trace_nearest(r->trace, unsure, o->rays, o->hits);
    for (size_t k = 0; k < unsure; k++) {
        const size_t i = list[k];
        if (o->hits[k].triangle < 0)
            continue;
        e->way[i] = e->wet[i] = 0;
        e->total[i] = e->first[i];
        for (int axis = 0; axis < 3; axis++)
            e->direction[axis][i] = e->toward[axis][i];
    }
    atomic_fetch_add_explicit(&r->traced, unsure, memory_order_relaxed);
}

/* Replaces doubtful ends of listed rays by traced ones; method distance-field traces all listed rays. They are traced together. Which ones these are depends on
 * the tile alone. */
static void trace_doubtful(refraction *r, tile_objects *o, size_t count)
{
    const bool searches = r->frame->scene->quality.refraction == MGT_REFRACTION_DISTANCE_FIELD;
    tile_ends *e = &o->ends;
    if (!searches)
        trace_unsure(r, o, count);
    size_t doubtful = 0;
    uint16_t list[TILE_PIXELS];
    for (size_t k = 0; k < count; k++) {
        const size_t i = o->list[k];
        if (!searches && e->doubt[i] == 0)
            continue;
        o->rays[doubtful] = ray_behind(r, o, i, false);
        list[doubtful++] = (uint16_t)i;
    }
    if (doubtful == 0)
        return;
    if (searches)
        distance_field_nearest(r->field, doubtful, o->rays, o->hits);
    else
        trace_nearest(r->trace, doubtful, o->rays, o->hits);
    for (size_t k = 0; k < doubtful; k++) {
        const size_t i = list[k];
        const bool found = o->hits[k].triangle >= 0;
        e->triangle[i] = o->hits[k].triangle;
        const float last = found ? o->hits[k].along : 0;
        refraction_end_at(r, o, i, last);
        for (int axis = 0; axis < 3 && found; axis++)
            e->position[axis][i] = o->rays[k].origin[axis] + last * e->direction[axis][i];
        e->error[i] = searches ? INFINITY : 0;
    }
    atomic_fetch_add_explicit(&r->traced, doubtful, memory_order_relaxed);
}

/* Replaces refracted and mirrored radiance by that of method path-traced. */
static void see_path_traced(const refraction *r, uint32_t tile_x, uint32_t tile_y, uint32_t worker, tile_objects *o)
{
    const bool mirrored = r->mirrors;
    path_traced_tile(r->truth, tile_x, tile_y, worker, mirrored, o->share, &o->truth);
    const path_traced_pixels *t = &o->truth;
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        o->light.through[0][i] = t->red[i], o->light.through[1][i] = t->green[i], o->light.through[2][i] = t->blue[i];
        o->error[i] = 0;
        if (!mirrored || (t->water[i] == 0 && t->object[i] == 0))
            continue;
        o->light.mirrored[0][i] = t->mirrored_red[i], o->light.mirrored[1][i] = t->mirrored_green[i], o->light.mirrored[2][i] = t->mirrored_blue[i];
        o->light.share[i] = 1;
    }
}

/* Shows deep water where, for a camera under water, all traced rays of a pixel pass below the horizon and its edge reaches over it. */
static void see_deep_for_truth(tile_objects *o)
{
    for (size_t i = 0; i < TILE_PIXELS; i++)
        if (o->truth.water[i] == 0 && o->truth.object[i] == 0 && o->deep_known[i] > 0) {
            for (int k = 0; k < 3; k++)
                o->light.through[k][i] = o->light.mirrored[k][i] = o->light.deep[k][i];
            o->light.share[i] = 1;
        }
}

/* Adds o->rgb to the planes' elements of the pixels in o->list. */
static void add_listed(const tile_objects *o, size_t count, float (*planes)[TILE_PIXELS])
{
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            planes[k][o->list[i]] += o->rgb[3 * i + (size_t)k];
}

/* Adds the radiance that the surface mirrors at one place of every listed pixel. The list is overwritten. */
static void see_mirrored(const refraction *r, size_t count, tile_objects *o)
{
    if (!r->mirrors || count == 0)
        return;
    r->kernels->narrow->mirrored(&r->narrow, o->met, &o->ends);
    size_t mirrored = 0;
    for (size_t k = 0; k < count; k++) {
        const uint16_t i = o->list[k];
        const bool seen = r->frame->under || o->ends.triangle[i] >= 0;
        o->light.share[i] += seen ? 1 : 0;
        o->ends.gain[i] = 1;
        o->list[mirrored] = i;
        mirrored += seen;
    }
    refraction_shade_listed(r, o, mirrored);
    add_listed(o, mirrored, o->light.mirrored);
}

/* Fills o->rgb with the radiance on one branch of the listed rays of o->met, times their part of the light. */
static void end_branch(refraction *r, int branch, size_t count, tile_objects *o)
{
    tile_ends *e = &o->ends;
    float part[TILE_PIXELS];
    r->kernels->narrow->refracted(&r->narrow, o->met, branch, e);
    const mgt_refraction method = r->frame->scene->quality.refraction;
    if (method == MGT_REFRACTION_TWO_PHASE)
        refraction_sharpen(r, o, count);
    if (method == MGT_REFRACTION_HYBRID || method == MGT_REFRACTION_DISTANCE_FIELD)
        trace_doubtful(r, o, count);
    for (size_t k = 0; k < count; k++) {
        const size_t i = o->list[k];
        part[k] = e->part[i];
        e->gain[i] = gain_behind(NULL, r->narrow.data.gain, e->total[i] > 0);
    }
    refraction_shade_listed(r, o, count);
    for (size_t k = 0; k < count; k++)
        for (size_t c = 0; c < 3; c++)
            o->rgb[3 * k + c] *= part[k];
}

static float greater(float a, float b) { return a > b ? a : b; }

/* Adds the radiance on one branch of the rays through a place of every listed pixel to light.through. */
static void see_branch(refraction *r, int branch, size_t count, tile_objects *o)
{
    end_branch(r, branch, count, o);
    for (size_t k = 0; k < count; k++)
        o->error[o->list[k]] = greater(o->error[o->list[k]], o->ends.error[o->list[k]]);
    add_listed(o, count, o->light.through);
    for (size_t k = 0; k < count; k++)
        for (size_t c = 0; c < 3 && o->ends.first[o->list[k]] > 0; c++)
            o->light.mirrored[c][o->list[k]] += o->rgb[3 * k + c];
}

/* Lists those of the first `count` rays of `all` that are split, so that their second branch counts. Returns their number. */
static size_t list_split(tile_objects *o, const uint16_t *all, size_t count)
{
    size_t split = 0;
    for (size_t k = 0; k < count; k++)
        if (o->ends.part[all[k]] < LEAST_WHOLE)
            o->list[split++] = all[k];
    return split;
}

/* Removes totally reflected rays from the list, because their mirrored radiance is already known. Returns the number of the others. */
static size_t leave_total(tile_objects *o, size_t count)
{
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        const uint16_t pixel = o->list[i];
        if (o->ends.first[pixel] > 0)
            o->light.share[pixel] += 1;
        else
            o->list[left++] = pixel;
    }
    return left;
}

/* Adds the refracted and mirrored radiance at one place of every listed pixel. The list is overwritten. */
static void see_place(refraction *r, size_t count, tile_objects *o)
{
    o->met = &o->water;
    see_branch(r, 0, count, o);
    uint16_t all[TILE_PIXELS];
    memcpy(all, o->list, count * sizeof *all);
    for (size_t k = 0; k < count; k++) {
        o->seen[all[k]] += 1;
        o->edge[all[k]] = o->ends.doubt[all[k]];
    }
    const size_t split = list_split(o, all, count);
    if (split > 0)
        see_branch(r, 1, split, o);
    memcpy(o->list, all, count * sizeof *all);
    see_mirrored(r, leave_total(o, count), o);
}

/* Adds the radiance of further rays through these pixels, without rays that objects in front hide. */
static void see_beside(refraction *r, const tile_offset *at, const uint16_t *pixels, size_t count, tile_objects *o)
{
    const int rays = r->narrow.data.edge_rays;
    ray_places *p = &o->places;
    p->count = 0;
    for (int ray = 0; ray < rays; ray++) {
        const vec2 place = edge_ray(NULL, ray);
        for (size_t k = 0; k < count; k++) {
            if (refraction_is_hidden(r, at, o, pixels[k], place.x, place.y))
                continue;
            p->pixel[p->count] = pixels[k];
            p->dx[p->count] = place.x, p->dy[p->count++] = place.y;
        }
    }
    if (p->count == 0)
        return;
    o->met = &o->beside;
    r->kernels->narrow->beside(&r->narrow, p, &o->water, &o->beside);
    uint16_t all[TILE_PIXELS];
    for (size_t k = 0; k < p->count; k++)
        o->list[k] = all[k] = (uint16_t)k;
    end_branch(r, 0, p->count, o);
    float *first = o->first;
    memcpy(first, o->rgb, 3 * p->count * sizeof *first);
    for (size_t k = 0; k < p->count; k++)
        o->error[p->pixel[k]] = greater(o->error[p->pixel[k]], o->ends.error[k]);
    const size_t split = list_split(o, all, p->count);
    if (split > 0)
        end_branch(r, 1, split, o);
    for (size_t k = 0, other = 0; k < p->count; k++) {
        const size_t pixel = p->pixel[k];
        const bool both = other < split && o->list[other] == k;
        for (size_t c = 0; c < 3; c++) {
            o->light.through[c][pixel] += first[3 * k + c];
            if (both)
                o->light.through[c][pixel] += o->rgb[3 * other + c];
        }
        if (both)
            o->error[pixel] = greater(o->error[pixel], o->ends.error[k]);
        other += both;
        o->seen[pixel] += 1;
    }
}

/* Weight of the ray through a pixel's centre. */
static float weight_of_centre(const refraction *r, const tile_offset *at, const tile_objects *o, size_t i)
{
    if (!refraction_is_hidden(r, at, o, i, 0, 0))
        return 1;
    int others = 0;
    for (int ray = 0; ray < r->narrow.data.edge_rays; ray++) {
        const vec2 place = edge_ray(NULL, ray);
        others += !refraction_is_hidden(r, at, o, i, place.x, place.y);
    }
    return centre_weight(NULL, true, (float)others);
}

/* Replaces light.through of pixels that an outline may cross by the mean over more rays. Rays that objects in front hide do not count. Mirrored radiance stays
 * that at the pixel's centre. */
static void see_outlines(refraction *r, const tile_offset *at, tile_objects *o)
{
    uint16_t edges[TILE_PIXELS];
    float total[TILE_PIXELS];
    size_t count = 0;
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        if (!(o->water.share[i] > 0))
            continue;
        const float centre = weight_of_centre(r, at, o, i);
        if (centre > 0 && !(o->edge[i] > 0))
            continue;
        total[count] = o->ends.first[i];
        edges[count++] = (uint16_t)i;
        for (size_t c = 0; c < 3; c++)
            o->light.through[c][i] *= centre;
        o->seen[i] = centre;
        o->error[i] = centre > 0 ? o->error[i] : 0; /* a factor would not do, since the error may be infinite */
    }
    const size_t most = TILE_PIXELS / (size_t)r->narrow.data.edge_rays;
    for (size_t first = 0; first < count; first += most)
        see_beside(r, at, edges + first, count - first < most ? count - first : most, o);
    for (size_t k = 0; k < count; k++)
        for (size_t c = 0; c < 3; c++) {
            o->light.through[c][edges[k]] /= o->seen[edges[k]];
            if (total[k] > 0)
                o->light.mirrored[c][edges[k]] = o->light.through[c][edges[k]];
        }
    memset(o->seen, 0, sizeof o->seen);
}

static void look_at_water(const refraction *r, const tile_waves *waves, const tile_estimate *estimate, const tile_offset *at, tile_objects *o)
{
    r->kernels->narrow->water(&r->frame->through, waves, estimate, at, &o->water);
    leave_covered(o);
}

/* Fills light.through, light.mirrored and light.share by n × n places of every pixel that is water. Pixels without a place that meets water take their centre.
 * At the end o->water is that through the pixels' centres. */
static void see_refracted(refraction *r, const tile_waves *waves, const tile_estimate *estimate, tile_offset at, tile_objects *o)
{
    const uint32_t n = r->frame->scene->quality.refraction_samples ? r->frame->scene->quality.refraction_samples : 1;
    memset(o->light.through, 0, sizeof o->light.through);
    memset(o->light.mirrored, 0, sizeof o->light.mirrored);
    memset(o->light.share, 0, sizeof o->light.share);
    memset(o->seen, 0, sizeof o->seen);
    memset(o->error, 0, sizeof o->error);
    for (uint32_t place = 0; place < n * n && n > 1 && !r->truth; place++) {
        at.dx = ((float)(place % n) + 0.5f) / (float)n - 0.5f;
        at.dy = ((float)(place / n) + 0.5f) / (float)n - 0.5f;
        look_at_water(r, waves, estimate, &at, o);
        leave_hidden(r, &at, o);
        const size_t count = list_water(o, false);
        if (count > 0)
            see_place(r, count, o);
    }
    at.dx = at.dy = 0;
    if (n > 1 && !r->truth)
        look_at_water(r, waves, estimate, &at, o);
    const size_t count = list_water(o, true);
    if (count > 0 && !r->truth)
        see_place(r, count, o);
    if (r->narrow.data.edge_rays > 0)
        see_outlines(r, &at, o);
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        if (o->seen[i] <= 1)
            continue;
        o->light.share[i] /= o->seen[i];
        for (int k = 0; k < 3; k++) {
            o->light.through[k][i] /= o->seen[i];
            o->light.mirrored[k][i] /= o->seen[i];
        }
    }
}

void refraction_tile(refraction *r, const tile_waves *waves, const tile_estimate *estimate, uint32_t tile_x, uint32_t tile_y, uint32_t worker, tile_objects *o)
{
    const tile_offset at = {tile_x * TILE_WIDTH, tile_y * TILE_HEIGHT, 0, 0};
    r->kernels->narrow->water(&r->frame->through, waves, estimate, &at, &o->water);
    refraction_front(r, at.column, at.row, o);
    leave_covered(o);
    see_refracted(r, waves, estimate, at, o);
    const size_t count = list_water(o, false);
    atomic_fetch_add_explicit(&r->pixels, count, memory_order_relaxed);
    if (r->truth)
        see_path_traced(r, tile_x, tile_y, worker, o);
    if (r->frame->under)
        see_deep(r, at.column, at.row, o);
    if (r->frame->under && r->truth)
        see_deep_for_truth(o);
    see_light(r, o);
    memcpy(o->light.front, o->share, sizeof o->share);
    keep_layers(o);
}

/* ---- over the water ---- */

static void put_plane_before(float *behind, const float *objects, const float *share)
{
    for (size_t i = 0; i < TILE_PIXELS; i++)
        behind[i] = put_before(NULL, behind[i], objects[i], share[i]);
}

void light_of_pixels(const tile_light *light, const uint16_t *pixels, size_t count, tile_light *out)
{
    enum { PLANES = sizeof(tile_light) / sizeof(float) / TILE_PIXELS };
    for (size_t plane = 0; plane < PLANES; plane++) {
        const float *from = light->through[0] + plane * TILE_PIXELS;
        float *to = out->through[0] + plane * TILE_PIXELS;
        for (size_t i = 0; i < count; i++)
            to[i] = from[pixels[i]];
        for (size_t i = count; i < TILE_PIXELS; i++)
            to[i] = to[count > 0 ? count - 1 : 0];
    }
}

void refraction_keep(const tile_objects *o, tile_opened *opened)
{
    opened->light = o->light;
    memcpy(opened->share, o->share, sizeof o->share);
    memcpy(opened->color, o->color, sizeof o->color);
    memcpy(opened->deep_known, o->deep_known, sizeof o->deep_known);
}

/* Blends `count` planes with others. `weight`: weight of the others in each pixel. */
static void blend_planes(float *planes, const float *others, size_t count, const float *weight)
{
    for (size_t plane = 0; plane < count; plane++, planes += TILE_PIXELS, others += TILE_PIXELS)
        for (size_t i = 0; i < TILE_PIXELS; i++)
            planes[i] = light_of_ends(NULL, planes[i], others[i], weight[i]);
}

void refraction_blend(tile_objects *o, const tile_opened *opened, bool under)
{
    _Static_assert(sizeof(tile_light) % (TILE_PIXELS * sizeof(float)) == 0, "planes of floats");
    enum { COLOR_PLANES = 3 };
    float weight[TILE_PIXELS], deep[COLOR_PLANES][TILE_PIXELS];
    memcpy(deep, o->light.deep, sizeof deep);
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        weight[i] = opened_weight(NULL, water_is_known(NULL, o->share[i], o->light.share[i], under),
                                  water_is_known(NULL, opened->share[i], opened->light.share[i], under));
        for (int k = 0; k < 3; k++)
            o->color[k][i] = objects_of_ends(NULL, o->color[k][i], opened->color[k][i], o->share[i], opened->share[i]);
    }
    for (size_t i = 0; i < TILE_PIXELS; i++)
        o->share[i] = share_of_ends(NULL, o->share[i], opened->share[i]);
    blend_planes(o->light.through[0], opened->light.through[0], sizeof o->light / sizeof o->light.share, weight);
    if (under) {
        for (size_t i = 0; i < TILE_PIXELS; i++)
            weight[i] = opened_weight(NULL, o->deep_known[i], opened->deep_known[i]);
        memcpy(o->light.deep, deep, sizeof deep);
        blend_planes(o->light.deep[0], opened->light.deep[0], COLOR_PLANES, weight);
    }
    memcpy(o->light.front, o->share, sizeof o->share);
}

bool refraction_covers(const tile_objects *o)
{
    float least = 1;
    for (size_t i = 0; i < TILE_PIXELS; i++)
        least = o->share[i] < least ? o->share[i] : least;
    return least >= 1;
}

void refraction_compose(const tile_objects *o, tile_pixels *pixels, tile_surface *surface)
{
    if (pixels) {
        put_plane_before(pixels->red, o->color[0], o->share);
        put_plane_before(pixels->green, o->color[1], o->share);
        put_plane_before(pixels->blue, o->color[2], o->share);
        for (size_t i = 0; i < TILE_PIXELS; i++) {
            pixels->coverage[i] = left_behind(NULL, pixels->coverage[i], o->share[i]);
            pixels->water[i] = left_behind(NULL, pixels->water[i], o->share[i]);
            pixels->foam[i] = left_behind(NULL, pixels->foam[i], o->share[i]);
        }
    }
    if (!surface)
        return;
    /* Depth and normal are those when the shutter closes, so `along` decides: shares may be means over the shutter. */
    for (size_t i = 0; i < TILE_PIXELS; i++)
        if (o->along[i] < INFINITY) {
            surface->along[i] = o->along[i];
            surface->normal_x[i] = o->normal[0][i];
            surface->normal_y[i] = o->normal[1][i];
            surface->normal_z[i] = o->normal[2][i];
        }
}
