/* SPDX-License-Identifier: MIT
 * Renders one tile of a frame by any method into the worker's planes. */
#include "cpu/tile_job.h"

#include "base/hash.h"
#include "frame/skyline.h"
#include "params/methods.h"

#include <math.h>
#include <string.h>

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/common/strata.k"
#include "kernels/waves/light_reach.k"

bool tile_sees_water(const tile_waves *tile)
{
    const TileData *d = &tile->data;
    if (d->camera_height < d->search_bound)
        return true;
    const float width = TILE_WIDTH, height = TILE_HEIGHT * d->hit_rows;
    const float steep = fabsf(d->right_y) + fabsf(d->down_y); /* a margin of one pixel, because partly covered pixels count */
    float least = d->ray_y;
    least = fminf(least, d->ray_y + width * d->right_y);
    least = fminf(least, d->ray_y + height * d->down_y);
    least = fminf(least, d->ray_y + width * d->right_y + height * d->down_y);
    return least < steep;
}

void tile_find_estimates(const lane_kernels *kernels, const FrameData *data, const tile_waves *tile, tile_estimate *estimate)
{
    if (tile_sees_water(tile))
        kernels->estimate(data, tile, estimate);
    else
        memset(estimate, 0, (size_t)tile->data.hit_rows * sizeof *estimate);
}

typedef struct tile_place {
    const tile_job *job;
    uint32_t x, y;
} tile_place;

static void build_with(const FrameData *data, tile_place place, const wave_set *set, tile_waves *waves, tile_estimate *estimate)
{
    const tile_job *job = place.job;
    job->kernels->sort(data, set, &set->view, place.x, place.y, waves);
    tile_find_estimates(job->kernels, data, waves, estimate);
}

static void build(tile_place place, const wave_set *set, tile_waves *waves, tile_estimate *estimate)
{
    build_with(&place.job->frame->data, place, set, waves, estimate);
}

static const tile_light *light_of(const tile_job *job, const tile_scratch *scratch) { return job->objects ? &scratch->objects.light : NULL; }

/* ---- point samples ---- */

/* Sets a random place in stratum `index` of n × n for every pixel of the tile. */
static void jitter(tile_place place, uint64_t seed, uint32_t n, uint64_t index, uint64_t sample, tile_scratch *scratch)
{
    const int strata = (int)n, column = (int)(index % n), row = (int)(index / n);
    const uint64_t key = hash_of_sample(seed, sample);
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint64_t bits = hash_of_pixel(key, place.x * TILE_WIDTH + i % TILE_WIDTH, place.y * TILE_HEIGHT + i / TILE_WIDTH);
        scratch->jitter_x[i] = stratum_place(NULL, column, hash_unit(bits), strata);
        scratch->jitter_y[i] = stratum_place(NULL, row, hash_unit(hash_of(bits)), strata);
    }
}

static void take_sample(tile_place place, uint64_t sample, tile_scratch *scratch)
{
    const tile_job *job = place.job;
    const FrameData *data = &job->frame->data;
    const mgt_quality *q = &job->frame->scene->quality;
    const uint64_t per_time = (uint64_t)q->spatial_samples * q->spatial_samples;
    jitter(place, q->seed, q->spatial_samples, sample % per_time, sample, scratch);
    memset(&scratch->sample, 0, sizeof scratch->sample);
    job->kernels->sample(data, job->sky, light_of(job, scratch), &scratch->close, scratch->close_estimate, scratch->jitter_x, scratch->jitter_y, 1,
                         &scratch->sample);
    sample_sums_add(&scratch->sums, job->kernels, &scratch->sample, data->want_color != 0, scratch->close.foam != NULL);
}

/* Adds the samples [first, first + count) to the sums. False: cancelled. */
static bool take_samples(tile_place place, uint64_t first, uint64_t count, tile_scratch *scratch)
{
    const tile_job *job = place.job;
    const frame *f = job->frame;
    const mgt_quality *q = &f->scene->quality;
    const uint64_t per_time = (uint64_t)q->spatial_samples * q->spatial_samples;
    for (uint64_t sample = first; sample < first + count;) {
        const uint64_t m = sample / per_time, end = (m + 1) * per_time < first + count ? (m + 1) * per_time : first + count;
        const double share = shutter_fraction(q, m);
        const camera_rays camera = camera_at(f, share);
        const wave_set *waves = &job->waves->samples;
        if (q->time_samples > 1) {
            wave_set_build(f, &camera, (interval){f->scene->time - (1 - share) * f->scene->shutter, 0}, false, &scratch->sample_waves);
            waves = &scratch->sample_waves;
        }
        build(place, waves, &scratch->close, scratch->close_estimate);
        for (; sample < end; sample++) {
            if (sample % 16 == 15 && job->keep_going && !job->keep_going(job->keep_going_argument, scratch->worker))
                return false;
            take_sample(place, sample, scratch);
        }
    }
    sample_sums_settle(&scratch->sums);
    return true;
}

static void render_samples(tile_place place, tile_scratch *scratch)
{
    const tile_job *job = place.job;
    const mgt_quality *q = &job->frame->scene->quality;
    const uint64_t count = q->sample_count ? q->sample_count : quality_samples(q) - q->sample_first;
    sample_sums_clear(&scratch->sums);
    if (!job->sums.show && !take_samples(place, q->sample_first, count, scratch))
        return;
    sample_sums_exchange(&scratch->sums, &job->sums, place.x, place.y);
    if (!job->sums.add)
        sample_sums_mean(&scratch->sums, count, &scratch->pixels);
}

/* ---- one shading a pixel ---- */

void tile_join_reach(tile_scratch *scratch)
{
    TileData *close = &scratch->close.data, *open = &scratch->open.data;
    close->light_reach = open->light_reach = reach_of_both(NULL, close->light_reach, open->light_reach);
}

static void shade_pixels(const tile_job *job, bool moves, tile_scratch *scratch, tile_pixels *out)
{
    const method_tile tile = {.frame = &job->frame->data,
                              .sky = job->sky,
                              .light = light_of(job, scratch),
                              .podee = job->podee,
                              .lean = job->lean,
                              .close = &scratch->close,
                              .close_estimate = scratch->close_estimate,
                              .open = moves ? &scratch->open : NULL,
                              .open_estimate = scratch->open_estimate};
    job->kernels->method(job->frame->scene->quality.method, &tile, out);
}

static void add_weighted(const tile_pixels *part, float weight, tile_pixels *sum)
{
    for (size_t p = 0; p < TILE_PIXELS; p++) {
        sum->red[p] += weight * part->red[p];
        sum->green[p] += weight * part->green[p];
        sum->blue[p] += weight * part->blue[p];
        sum->coverage[p] += weight * part->coverage[p];
        sum->water[p] += weight * part->water[p];
        sum->foam[p] += weight * part->foam[p];
    }
}

static const wave_set *waves_of(const tile_job *job)
{
    const mgt_method_waves waves = method_of(job->frame->scene->quality.method)->properties.waves;
    return waves == MGT_WAVES_POINT ? &job->waves->samples : waves == MGT_WAVES_INSTANT ? &job->waves->now : &job->waves->shutter;
}

/* Renders the mean over the parts of the shutter, each from the middle of the camera's way in it. */
static void render_moving(tile_place place, tile_scratch *scratch)
{
    tile_pixels part;
    memset(&scratch->pixels, 0, sizeof scratch->pixels);
    for (int i = 0; i < CAMERA_PARTS; i++) {
        build(place, &place.job->waves->parts[i], &scratch->close, scratch->close_estimate);
        shade_pixels(place.job, false, scratch, &part);
        add_weighted(&part, 1.0f / CAMERA_PARTS, &scratch->pixels);
    }
}

static void render_shaded(tile_place place, tile_scratch *scratch)
{
    const tile_job *job = place.job;
    const wave_set *waves = waves_of(job);
    const bool moves = waves == &job->waves->shutter && job->frame->scene->camera_moves;
    build(place, waves, &scratch->close, scratch->close_estimate);
    if (moves) {
        build(place, &job->waves->open, &scratch->open, scratch->open_estimate);
        tile_join_reach(scratch);
    }
    shade_pixels(job, moves, scratch, &scratch->pixels);
}

/* Builds the tile for a part of the shutter between two fractions of it. Skylines of the parts are nearly the same, so that of the whole shutter serves. */
static void build_segment(tile_place place, double from, double to, tile_scratch *scratch)
{
    const frame *f = place.job->frame;
    const mgt_scene *s = f->scene;
    const double open = s->time - (1 - from) * s->shutter, close = s->time - (1 - to) * s->shutter;
    const camera_rays camera = camera_at(f, to);
    const interval shutter = {0.5 * (open + close), 0.5 * (close - open)};
    wave_set_place(f, &camera, s->camera_moves ? (interval){close, 0} : shutter, true, &scratch->sample_waves);
    skyline_copy(&place.job->waves->shutter, &scratch->sample_waves);
    build(place, &scratch->sample_waves, &scratch->close, scratch->close_estimate);
    if (!s->camera_moves)
        return;
    const camera_rays before = camera_at(f, from);
    wave_set_place(f, &before, (interval){open, 0}, true, &scratch->sample_waves);
    skyline_copy(&place.job->waves->open, &scratch->sample_waves);
    build(place, &scratch->sample_waves, &scratch->open, scratch->open_estimate);
    tile_join_reach(scratch);
}

/* Renders the mean over parts of the shutter, which replaces the path of the mirrored ray by several straight pieces: Podee et al. 2021, §3.4. */
static void render_segments(tile_place place, tile_scratch *scratch)
{
    const tile_job *job = place.job;
    const uint32_t count = job->frame->scene->quality.path_segments;
    tile_pixels *sum = &scratch->pixels, part;
    memset(sum, 0, sizeof *sum);
    for (uint32_t i = 0; i < count; i++) {
        if (job->keep_going && !job->keep_going(job->keep_going_argument, scratch->worker))
            return;
        build_segment(place, (double)i / count, (double)(i + 1) / count, scratch);
        shade_pixels(job, job->frame->scene->camera_moves, scratch, &part);
        add_weighted(&part, 1.0f / (float)count, sum);
    }
}

static void render_surface(tile_place place, tile_scratch *scratch)
{
    const tile_job *job = place.job;
    const frame *f = job->frame;
    build(place, &job->waves->samples, &scratch->close, scratch->close_estimate);
    job->kernels->surface(&f->data, &scratch->close, scratch->close_estimate, &scratch->surface);
    if (waves_of(job) == &job->waves->samples)
        return;
    build(place, &job->waves->now, &scratch->close, scratch->close_estimate);
    job->kernels->filtered_normal(&f->data, &scratch->close, scratch->close_estimate, &scratch->surface);
}

static void see_objects(tile_place place, tile_scratch *scratch)
{
    const tile_job *job = place.job;
    const FrameData *through = &job->frame->through;
    refraction *opened = refraction_opened(job->objects);
    if (opened) {
        build_with(through, place, &job->waves->open, &scratch->close, scratch->close_estimate);
        refraction_tile(opened, &scratch->close, scratch->close_estimate, place.x, place.y, scratch->worker, &scratch->objects);
        refraction_keep(&scratch->objects, &scratch->opened);
    }
    build_with(through, place, &job->waves->shutter, &scratch->close, scratch->close_estimate);
    refraction_tile(job->objects, &scratch->close, scratch->close_estimate, place.x, place.y, scratch->worker, &scratch->objects);
    if (opened)
        refraction_blend(&scratch->objects, &scratch->opened, job->frame->under);
}

static void render_pixels(tile_place place, tile_scratch *scratch)
{
    const mgt_quality *q = &place.job->frame->scene->quality;
    if (method_of(q->method)->way == METHOD_SAMPLES)
        render_samples(place, scratch);
    else if (q->path_segments > 1)
        render_segments(place, scratch);
    else if (frame_from_middle(place.job->frame))
        render_moving(place, scratch);
    else
        render_shaded(place, scratch);
}

void tile_see_objects(const tile_job *job, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch) { see_objects((tile_place){job, tile_x, tile_y}, scratch); }

void tile_render(const tile_job *job, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch)
{
    const tile_place place = {job, tile_x, tile_y};
    if (job->objects)
        see_objects(place, scratch);
    const bool covered = job->objects && !job->behind && refraction_covers(&scratch->objects);
    if (covered)
        memset(&scratch->pixels, 0, sizeof scratch->pixels);
    if (job->wants.pixels && !covered)
        render_pixels(place, scratch);
    if (job->wants.surface && !covered)
        render_surface(place, scratch);
    if (job->objects && !job->behind && !job->sums.add)
        refraction_compose(&scratch->objects, job->wants.pixels ? &scratch->pixels : NULL, job->wants.surface ? &scratch->surface : NULL);
}
