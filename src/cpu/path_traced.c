/* SPDX-License-Identifier: MIT
 *
 * Traces rays through the wavy surface in batches of a tile: finds the next crossing and the nearest triangle before it, then splits rays at the crossing.
 *
 * Rays in water are searched in the mirror image of the scene, with y and the waves' heights negated. So the search that finds the surface from above also
 * finds it from below.
 */
#include "cpu/path_traced.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "reference/reference_frame.h"

enum { BATCH = REFERENCE_BATCH, MOST_PARTS = BATCH * (PATH_MOST_EVENTS + 4) };

_Static_assert((int)BATCH == (int)TILE_PIXELS, "a tile's rays are one batch");

/* Differential of a ray for a step of the camera's ray by one pixel to the right or down. */
typedef struct ray_step {
    double at[3];   /* change of the hit with the surface, metres */
    double turn[3]; /* change of the direction behind it */
} ray_step;

/* A part of a pixel's light on its path. */
typedef struct light_part {
    double origin[3], direction[3]; /* x and z relative to the camera's foot */
    double time;                    /* seconds relative to scene.time */
    double pixel_fraction;          /* 1 / the length of the camera's ray before it was normalised: scales steps of that ray */
    double before, after, water;    /* as in shade_hits */
    double share;                   /* fraction of the sample's light */
    ray_step steps[2];              /* the footprint of the sample's part of the pixel; refractions after the first one are left out */
    uint16_t pixel;                 /* pixel of the tile */
    uint8_t events;                 /* number of hits with the surface */
    bool wet;                       /* the part is in water */
    bool mirrored;                  /* the part belongs to the mirrored radiance */
    bool dry;                       /* the part goes on inside of a dry hull */
} light_part;

/* A ray's hit with the surface. */
typedef struct surface_point {
    double distance;  /* metres; +inf: there is no hit */
    double normal[3]; /* unit normal towards the ray's origin */
    double bend[3];   /* second derivatives xx, xz, zz; set at the first hit of a camera's ray */
} surface_point;

typedef struct batch_hits {
    int32_t triangle[BATCH];
    float position[3][BATCH], direction[3][BATCH], before[BATCH], after[BATCH], water[BATCH], gain[BATCH], spread[3][BATCH];
    float rgb[3 * BATCH];
    float share[BATCH];
    uint16_t pixel[BATCH];
    bool mirrored[BATCH];
    size_t count;
} batch_hits;

typedef struct path_traced_scratch {
    reference_batch search;
    surface_point surface[BATCH];
    trace_ray rays[BATCH];
    trace_hit met[BATCH];
    batch_hits ends;
    light_part batch[BATCH], parts[MOST_PARTS];
    size_t part_count;
    double through[3][BATCH], mirror[3][BATCH];
    uint32_t samples[BATCH]; /* number of samples that have met the surface */
} path_traced_scratch;

struct path_traced {
    path_traced_job job;
    reference_frame *above, *below; /* the surface for rays in air, and its mirror image for rays in water */
    double offset[3];               /* added to positions relative to the camera's foot, it gives those of the world */
    uint32_t side;                  /* a pixel has side × side samples */
    path_traced_scratch **scratch;
};

/* ---- creation ---- */

static bool create_scratch(path_traced *t)
{
    t->scratch = calloc(t->job.workers, sizeof *t->scratch);
    for (uint32_t i = 0; t->scratch && i < t->job.workers; i++)
        if (!(t->scratch[i] = aligned_alloc(64, (sizeof **t->scratch + 63) / 64 * 64)))
            return false;
    return t->scratch != NULL;
}

mgt_status path_traced_create(path_traced **truth, const path_traced_job *job)
{
    *truth = NULL;
    path_traced *t = calloc(1, sizeof *t);
    if (!t)
        return MGT_ERROR_MEMORY;
    t->job = *job;
    t->side = job->scene->quality.refraction_samples ? job->scene->quality.refraction_samples : 4;
    t->offset[0] = job->camera.position[0] - job->world->origin[0];
    t->offset[2] = job->camera.position[2] - job->world->origin[1];
    mgt_scene scene = *job->scene; /* phases are relative to the camera, so the reference frames need its place */
    scene.camera.position[0] = job->camera.position[0];
    scene.camera.position[2] = job->camera.position[2];
    scene.camera_moves = false;
    const reference_options options = {.isa = job->isa};
    mgt_status status = reference_frame_create(&t->above, &scene, NULL, &options);
    if (status == MGT_OK)
        status = reference_frame_create(&t->below, &scene, NULL, &options);
    if (status == MGT_OK && !create_scratch(t))
        status = MGT_ERROR_MEMORY;
    if (status != MGT_OK) {
        path_traced_free(t);
        return status;
    }
    reference_frame_mirror(t->below);
    *truth = t;
    return MGT_OK;
}

void path_traced_free(path_traced *truth)
{
    if (!truth)
        return;
    for (uint32_t i = 0; truth->scratch && i < truth->job.workers; i++)
        free(truth->scratch[i]);
    free(truth->scratch);
    reference_frame_destroy(truth->above);
    reference_frame_destroy(truth->below);
    free(truth);
}

/* ---- rays ---- */

static void scale_to_unit(double a[3])
{
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Finds the next crossings of the batch's parts in water if `wet`, else of those in air. `first`: the parts come from the camera, and bends are wanted. */
static void search_side(const path_traced *t, path_traced_scratch *s, size_t count, bool wet, bool first)
{
    uint16_t from[BATCH];
    uint32_t used = 0;
    const double up = wet ? -1 : 1;
    for (size_t i = 0; i < count; i++) {
        const light_part *p = &s->batch[i];
        if (p->wet != wet)
            continue;
        s->search.origin_x[used] = p->origin[0];
        s->search.origin_y[used] = up * p->origin[1];
        s->search.origin_z[used] = p->origin[2];
        s->search.direction_x[used] = p->direction[0];
        s->search.direction_y[used] = up * p->direction[1];
        s->search.direction_z[used] = p->direction[2];
        s->search.time_offset[used] = p->time;
        from[used++] = (uint16_t)i;
    }
    if (used == 0)
        return;
    const reference_frame *side = wet ? t->below : t->above;
    side->search(side, &s->search, used);
    if (first)
        side->bend(side, &s->search, used);
    for (uint32_t i = 0; i < used; i++) {
        surface_point *w = &s->surface[from[i]];
        w->distance = s->search.distance[i];
        w->normal[0] = -s->search.slope_x[i];
        w->normal[1] = up;
        w->normal[2] = -s->search.slope_z[i];
        scale_to_unit(w->normal);
        if (first)
            w->bend[0] = s->search.bend_xx[i], w->bend[1] = s->search.bend_xz[i], w->bend[2] = s->search.bend_zz[i];
    }
}

static trace_ray ray_of(const path_traced *t, const light_part *p, double most)
{
    trace_ray ray = {.most = most < (double)FLT_MAX ? (float)most : FLT_MAX};
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = (float)(p->origin[k] + t->offset[k]);
        ray.direction[k] = (float)p->direction[k];
    }
    return ray;
}

/* There is no water inside of dry hulls: parts in air whose hit with the surface lies in one go on to the next triangle. */
static void pass_dry(const path_traced *t, path_traced_scratch *s, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        light_part *p = &s->batch[i];
        surface_point *w = &s->surface[i];
        if (s->met[i].triangle >= 0 || p->wet || !(w->distance < HUGE_VAL))
            continue;
        double point[3];
        for (int k = 0; k < 3; k++)
            point[k] = p->origin[k] + w->distance * p->direction[k] + t->offset[k];
        if (!path_dry_holds(t->job.dry, point))
            continue;
        p->dry = true;
        w->distance = HUGE_VAL;
        s->rays[i].most = FLT_MAX;
        trace_nearest(t->job.trace, 1, &s->rays[i], &s->met[i]);
    }
}

/* Fills `surface` and `met` for the first `count` parts of the batch. `first`: the parts come from the camera. */
static void look_ahead(const path_traced *t, path_traced_scratch *s, size_t count, bool first)
{
    search_side(t, s, count, false, first);
    search_side(t, s, count, true, first);
    for (size_t i = 0; i < count; i++)
        s->rays[i] = ray_of(t, &s->batch[i], s->surface[i].distance);
    trace_nearest(t->job.trace, count, s->rays, s->met);
    if (t->job.dry)
        pass_dry(t, s, count);
}

/* ---- at the surface ---- */

typedef struct crossing {
    double through[3], mirrored[3]; /* unit directions */
    double reflectance;             /* of unpolarised light; 1: total reflection, and `through` is not set */
} crossing;

/* Refracts and mirrors a ray. `index`: index of refraction behind the surface divided by that before it. */
static crossing cross_surface(const double direction[3], const double normal[3], double index)
{
    crossing c = {.reflectance = 1};
    const double cosine = -dot(direction, normal);
    if (!(cosine > 0)) { /* the camera is inside of a wave, so the ray goes on straight */
        memcpy(c.through, direction, sizeof c.through);
        memcpy(c.mirrored, direction, sizeof c.mirrored);
        c.reflectance = 0;
        return c;
    }
    for (int k = 0; k < 3; k++)
        c.mirrored[k] = direction[k] + 2 * cosine * normal[k];
    const double squared = 1 - (1 - cosine * cosine) / (index * index); /* squared cosine of the refracted angle */
    if (!(squared > 0))
        return c;
    const double refracted = sqrt(squared);
    for (int k = 0; k < 3; k++)
        c.through[k] = direction[k] / index + (cosine / index - refracted) * normal[k];
    scale_to_unit(c.through);
    const double across = (cosine - index * refracted) / (cosine + index * refracted), along = (index * cosine - refracted) / (index * cosine + refracted);
    c.reflectance = 0.5 * (across * across + along * along);
    return c;
}

/* Pushes a part that leaves the surface. It begins a little beside the surface, on the side that it goes to, so that rounding does not make it cross again. */
static void push_part(path_traced_scratch *s, const light_part *from, const surface_point *w, const double direction[3], bool crosses, double share)
{
    if (share < PATH_LEAST_WEIGHT || s->part_count == MOST_PARTS)
        return;
    light_part *p = &s->parts[s->part_count++];
    *p = *from;
    p->share = share;
    p->wet = from->wet != crosses;
    p->events++;
    const double aside = (crosses ? -2e-8 : 2e-8) * (1 + w->distance);
    for (int k = 0; k < 3; k++) {
        p->origin[k] = from->origin[k] + w->distance * from->direction[k] + aside * w->normal[k];
        p->direction[k] = direction[k];
    }
}

static void advance(light_part *p, double distance, bool first)
{
    if (first)
        p->before += distance;
    else
        p->after += distance;
    if (p->wet)
        p->water += distance;
}

/* Differential quotient for a ray beside the camera's ray, over `step`: the change of its hit with the surface's tangent plane, and of its direction behind the
 * surface, whose normal changes with its second derivatives. */
static ray_step step_aside(const light_part *p, const surface_point *w, const double step[3], double index, const crossing *c, bool through)
{
    static const double small = 1e-3;
    ray_step s = {0};
    double view[3], normal[3], slope[2], towards = 0;
    for (int k = 0; k < 3; k++)
        view[k] = p->direction[k] + small * step[k];
    scale_to_unit(view);
    for (int k = 0; k < 3; k++)
        towards += (view[k] - p->direction[k]) * w->normal[k];
    const double closing = fmax(-dot(p->direction, w->normal), 0.25 * fabs(p->direction[1] * w->normal[1])); /* a bound at outlines */
    for (int k = 0; k < 3; k++)
        s.at[k] = w->distance * (view[k] - p->direction[k] + p->direction[k] * towards / fmax(closing, 1e-9)) / small;
    slope[0] = w->bend[0] * s.at[0] + w->bend[1] * s.at[2];
    slope[1] = w->bend[1] * s.at[0] + w->bend[2] * s.at[2];
    const double length = 1 / fabs(w->normal[1]);
    for (int k = 0; k < 3; k++)
        normal[k] = length * w->normal[k] - (k == 1 ? 0 : small * slope[k / 2]);
    scale_to_unit(normal);
    const crossing aside = cross_surface(view, normal, index);
    if (through && !(aside.reflectance < 1))
        return s;
    for (int k = 0; k < 3; k++)
        s.turn[k] = (through ? aside.through[k] - c->through[k] : aside.mirrored[k] - c->mirrored[k]) / small;
    return s;
}

static void set_steps(const path_traced *t, light_part *p, const surface_point *w, double index, const crossing *c, bool through)
{
    const camera_rays *r = &t->job.camera;
    const double size = p->pixel_fraction / t->side;
    for (int i = 0; i < 2; i++) {
        double step[3];
        for (int k = 0; k < 3; k++)
            step[k] = size * (i == 0 ? r->right[k] : r->down[k]);
        p->steps[i] = step_aside(p, w, step, index, c, through);
    }
}

/* Pushes the parts of a camera's ray behind its first hit with the surface. */
static void begin_parts(const path_traced *t, path_traced_scratch *s, light_part p, const surface_point *w, bool mirrored)
{
    const double n = t->job.scene->water.index_of_refraction;
    const double index = p.wet ? 1 / n : n;
    const crossing c = cross_surface(p.direction, w->normal, index);
    s->samples[p.pixel]++;
    advance(&p, w->distance, true);
    set_steps(t, &p, w, index, &c, c.reflectance < 1);
    if (c.reflectance < 1)
        push_part(s, &p, w, c.through, true, 1);
    else
        push_part(s, &p, w, c.mirrored, false, 1);
    p.mirrored = true;
    if (!mirrored)
        return;
    set_steps(t, &p, w, index, &c, false);
    push_part(s, &p, w, c.mirrored, false, 1);
}

static void split_part(const path_traced *t, path_traced_scratch *s, light_part p, const surface_point *w)
{
    const double n = t->job.scene->water.index_of_refraction;
    const crossing c = cross_surface(p.direction, w->normal, p.wet ? 1 / n : n);
    advance(&p, w->distance, false);
    push_part(s, &p, w, c.mirrored, false, p.share * c.reflectance);
    if (c.reflectance < 1)
        push_part(s, &p, w, c.through, true, p.share * (1 - c.reflectance));
}

/* ---- where rays end ---- */

/* Fills the covariance of the footprint across the ray. The ray is uniformly distributed over each step, with the variance 1/12. */
static void spread_ray(const light_part *p, float spread[3])
{
    const double *d = p->direction, level = hypot(d[0], d[2]);
    const double side[3] = {level > 1e-4 ? -d[2] / level : 0, 0, level > 1e-4 ? d[0] / level : 1};
    const double rise[3] = {-side[2] * d[1], side[2] * d[0] - side[0] * d[2], side[0] * d[1]};
    double sum[3] = {0};
    for (int i = 0; i < 2; i++) {
        double aside[3];
        for (int k = 0; k < 3; k++)
            aside[k] = p->steps[i].at[k] + p->after * p->steps[i].turn[k];
        const double x = dot(aside, side), y = dot(aside, rise);
        sum[0] += x * x / 12, sum[1] += x * y / 12, sum[2] += y * y / 12;
    }
    for (int k = 0; k < 3; k++)
        spread[k] = (float)sum[k];
}

/* `first`: the part comes from the camera. */
static void end_part(const path_traced *t, path_traced_scratch *s, light_part p, const trace_ray *ray, const trace_hit *met, bool first)
{
    batch_hits *e = &s->ends;
    const size_t i = e->count++;
    const double n = t->job.scene->water.index_of_refraction;
    const bool wet = t->job.camera.position[1] < 0;
    if (met->triangle >= 0)
        advance(&p, (double)met->along, first);
    e->triangle[i] = met->triangle;
    for (int k = 0; k < 3; k++) {
        e->position[k][i] = met->triangle >= 0 ? ray->origin[k] + met->along * ray->direction[k] : 0;
        e->direction[k][i] = ray->direction[k];
    }
    e->before[i] = (float)p.before;
    e->after[i] = (float)p.after;
    e->water[i] = p.dry && p.water == 0 ? IN_DRY_HULL : (float)p.water;
    e->gain[i] = p.wet == wet ? 1 : (float)(wet ? n * n : 1 / (n * n));
    e->share[i] = (float)p.share;
    float spread[3];
    spread_ray(&p, spread);
    for (int k = 0; k < 3; k++)
        e->spread[k][i] = spread[k];
    e->pixel[i] = p.pixel;
    e->mirrored[i] = p.mirrored;
}

static void shade_ends(const path_traced *t, path_traced_scratch *s)
{
    batch_hits *e = &s->ends;
    const shade_hits hits = {.count = e->count,
                             .triangle = e->triangle,
                             .position = {e->position[0], e->position[1], e->position[2]},
                             .direction = {e->direction[0], e->direction[1], e->direction[2]},
                             .before = e->before,
                             .after = e->after,
                             .water = e->water,
                             .gain = e->gain,
                             .spread = {e->spread[0], e->spread[1], e->spread[2]}};
    t->job.shade(t->job.user, &hits, e->rgb);
    for (size_t i = 0; i < e->count; i++)
        for (int k = 0; k < 3; k++)
            (e->mirrored[i] ? s->mirror : s->through)[k][e->pixel[i]] += (double)e->share[i] * (double)e->rgb[3 * i + (size_t)k];
    e->count = 0;
}

/* Follows all parts to their ends. The newest parts come first, so that few wait at a time. */
static void follow_parts(const path_traced *t, path_traced_scratch *s)
{
    while (s->part_count) {
        const size_t count = s->part_count < BATCH ? s->part_count : BATCH;
        s->part_count -= count;
        memcpy(s->batch, s->parts + s->part_count, count * sizeof *s->batch);
        look_ahead(t, s, count, false);
        for (size_t i = 0; i < count; i++) {
            const bool again = s->met[i].triangle < 0 && s->surface[i].distance < HUGE_VAL;
            if (again && s->batch[i].events < PATH_MOST_EVENTS)
                split_part(t, s, s->batch[i], &s->surface[i]);
            else
                end_part(t, s, s->batch[i], &s->rays[i], &s->met[i], false);
        }
        shade_ends(t, s);
    }
}

/* ---- a tile ---- */

/* The camera's ray through a place (x, y) of the picture, in which pixel centres are at whole numbers. */
static light_part camera_part(const path_traced *t, double x, double y, uint16_t pixel)
{
    const camera_rays *c = &t->job.camera;
    light_part p = {.origin = {0, c->position[1], 0}, .pixel = pixel, .wet = c->position[1] < 0};
    for (int k = 0; k < 3; k++)
        p.direction[k] = c->corner[k] + x * c->right[k] + y * c->down[k];
    p.pixel_fraction = 1 / sqrt(dot(p.direction, p.direction));
    scale_to_unit(p.direction);
    return p;
}

static void aim_sample(const path_traced *t, path_traced_scratch *s, uint32_t tile_x, uint32_t tile_y, uint32_t sample)
{
    const mgt_scene *scene = t->job.scene;
    const uint32_t strata = t->side * t->side;
    const double shutter = scene->camera_moves ? 0 : scene->shutter;
    const uint64_t key = hash_of_sample(t->job.scene->quality.seed, sample);
    for (uint32_t i = 0; i < BATCH; i++) {
        const uint32_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH;
        double dx = 0, dy = 0, share = 0.5; /* `share`: fraction of the shutter's time */
        if (t->side > 1) {
            const uint64_t bits = hash_of_pixel(key, x, y);
            dx = (sample % t->side + (double)hash_unit(bits)) / t->side - 0.5;
            dy = (sample / t->side + (double)hash_unit(hash_of(bits))) / t->side - 0.5;
            const uint64_t first = hash_of(scene->quality.seed ^ hash_of((uint64_t)x << 32 | y));
            share = ((double)((first + sample) % strata) + (double)hash_unit(hash_of(~bits))) / strata;
        }
        s->batch[i] = camera_part(t, x + dx, y + dy, (uint16_t)i);
        s->batch[i].time = (share - 1) * shutter;
    }
}

static void write_mean(const double sum[3][BATCH], const uint32_t *count, float *red, float *green, float *blue)
{
    for (size_t i = 0; i < BATCH; i++) {
        const double share = count[i] ? 1.0 / count[i] : 0;
        red[i] = (float)(share * sum[0][i]);
        green[i] = (float)(share * sum[1][i]);
        blue[i] = (float)(share * sum[2][i]);
    }
}

/* Fills `through`, `mirror` and out->object of pixels that path_traced_pixels.object describes. out->water is known. */
static void see_waterlines(const path_traced *t, path_traced_scratch *s, uint32_t tile_x, uint32_t tile_y, const float *front, path_traced_pixels *out)
{
    bool any = false;
    for (size_t i = 0; i < BATCH; i++) {
        out->object[i] = out->water[i] == 0 && front[i] < 1;
        any = any || out->object[i] > 0;
    }
    if (!any)
        return;
    aim_sample(t, s, tile_x, tile_y, 0);
    look_ahead(t, s, BATCH, true);
    for (size_t i = 0; i < BATCH; i++) {
        out->object[i] = out->object[i] > 0 && s->met[i].triangle >= 0;
        if (!(out->object[i] > 0))
            continue;
        s->batch[i].share = 1;
        end_part(t, s, s->batch[i], &s->rays[i], &s->met[i], true);
        s->samples[i] = 1;
    }
    shade_ends(t, s);
    for (size_t i = 0; i < BATCH; i++)
        for (int k = 0; k < 3 && out->object[i] > 0; k++)
            s->mirror[k][i] = s->through[k][i];
}

void path_traced_tile(const path_traced *truth, uint32_t tile_x, uint32_t tile_y, uint32_t worker, bool mirrored, const float *front, path_traced_pixels *out)
{
    path_traced_scratch *s = truth->scratch[worker];
    const uint32_t samples = truth->side * truth->side;
    s->part_count = s->ends.count = 0;
    memset(s->through, 0, sizeof s->through);
    memset(s->mirror, 0, sizeof s->mirror);
    memset(s->samples, 0, sizeof s->samples);
    for (uint32_t sample = 0; sample < samples; sample++) {
        aim_sample(truth, s, tile_x, tile_y, sample);
        look_ahead(truth, s, BATCH, true);
        for (size_t i = 0; i < BATCH; i++)
            if (s->met[i].triangle < 0 && s->surface[i].distance < HUGE_VAL)
                begin_parts(truth, s, s->batch[i], &s->surface[i], mirrored);
        follow_parts(truth, s);
    }
    for (size_t i = 0; i < BATCH; i++)
        out->water[i] = (float)s->samples[i] / (float)samples;
    see_waterlines(truth, s, tile_x, tile_y, front, out);
    write_mean((const double(*)[BATCH])s->through, s->samples, out->red, out->green, out->blue);
    if (mirrored)
        write_mean((const double(*)[BATCH])s->mirror, s->samples, out->mirrored_red, out->mirrored_green, out->mirrored_blue);
}

/* ---- objects along rays ---- */

/* Pushes the refracted ray, or the mirrored one if the ray is totally reflected. Returns the reflectance. */
static double go_on(const path_traced *t, path_traced_scratch *s, light_part p, const surface_point *w)
{
    const double n = t->job.scene->water.index_of_refraction;
    const crossing c = cross_surface(p.direction, w->normal, p.wet ? 1 / n : n);
    const bool through = c.reflectance < 1;
    push_part(s, &p, w, through ? c.through : c.mirrored, through, 1);
    return c.reflectance;
}

static int32_t seen_at_end(const path_traced *t, const light_part *p, const trace_hit *met)
{
    if (met->triangle >= 0)
        return (int32_t)t->job.world->object[met->triangle];
    /* A ray of a camera in air that has met the surface counts as water even if it has left a crest. A ray of a camera under water may end in the sky. */
    const bool wet = t->job.camera.position[1] < 0;
    return (wet ? p->wet : p->events > 0) ? SEEN_WATER : SEEN_SKY;
}

void path_traced_see(const path_traced *truth, uint32_t tile_x, uint32_t tile_y, uint32_t worker, uint32_t sample, path_traced_seen *out)
{
    path_traced_scratch *s = truth->scratch[worker];
    s->part_count = 0;
    aim_sample(truth, s, tile_x, tile_y, sample);
    look_ahead(truth, s, BATCH, true);
    for (size_t i = 0; i < BATCH; i++) {
        const bool surface = s->met[i].triangle < 0 && s->surface[i].distance < HUGE_VAL;
        out->mirrored[i] = surface ? (float)go_on(truth, s, s->batch[i], &s->surface[i]) : 0;
        if (!surface)
            out->object[i] = seen_at_end(truth, &s->batch[i], &s->met[i]);
    }
    while (s->part_count) {
        const size_t count = s->part_count;
        s->part_count = 0;
        memcpy(s->batch, s->parts, count * sizeof *s->batch);
        look_ahead(truth, s, count, false);
        for (size_t i = 0; i < count; i++) {
            const bool again = s->met[i].triangle < 0 && s->surface[i].distance < HUGE_VAL;
            if (again && s->batch[i].events < PATH_MOST_EVENTS)
                go_on(truth, s, s->batch[i], &s->surface[i]);
            else
                out->object[s->batch[i].pixel] = seen_at_end(truth, &s->batch[i], &s->met[i]);
        }
    }
}
