/* SPDX-License-Identifier: MIT
 * Method adaptive, scheme podee: Podee et al., Adaptive Supersampling for Rendering Reflections on Water Surfaces, as published
 * (docs/adaptive.md).
 *
 * Each pixel of the approximate picture has an importance (Eq. 1). Pixels whose importance is above a threshold are tasks. Sample slots are distributed among
 * tasks in proportion to their importance (Eq. 2). Tasks are ordered by tile, and within a tile by pixel. So the slots of a tile are consecutive, one worker
 * takes them all, and samples are added in a fixed order, where the paper adds atomically. Prefix sums are taken in parallel within tiles and serially over
 * tiles. */
#include "cpu/adaptive_podee.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "cpu/baseline_lanes.h"

#include "kernels/common/prelude_double.h"

#include "kernels/adaptive/slot_order.k"
#include "kernels/adaptive/slots.k"

/* ---- the paper's equations ---- */

uint64_t podee_slots_of(const mgt_quality *q, double water)
{
    return q->sample_slots ? q->sample_slots : (uint64_t)slots_of_water(NULL, podee_samples_of(q), water);
}

float podee_importance(const podee_rules *rules, float coverage) { return (float)slot_importance(NULL, (double)coverage, rules->center, 0, rules->width); }

double podee_slot_place(uint64_t k, uint64_t slots, double sum) { return slot_place(NULL, (double)k, (double)slots, sum); }

uint64_t podee_first_slot(double place, uint64_t slots, double sum) { return (uint64_t)first_slot(NULL, place, (double)slots, sum); }

size_t podee_task_at(const double *prefix, size_t count, double place)
{
    size_t low = 0;
    while (count > 1) {
        const size_t half = count / 2;
        low = prefix[low + half] <= place ? low + half : low;
        count -= half;
    }
    return low;
}

double podee_detail_weight(double samples, double frequency) { return slot_weight(NULL, samples, frequency); }

/* ---- one picture ---- */

typedef struct detail_job {
    const adaptive_frame *a;
    const picture_planes *out;
    podee_rules rules;
    wave_set *close, *open; /* all waves, unfiltered, when the shutter closes and opens; `open` NULL: both are the same */
    uint32_t columns;
    size_t tiles;
    double *before;      /* tiles + 1 sums of the tasks' importance: of each tile at first; after add_tiles() of all tiles before it */
    double *water;       /* number of pixels of water in each tile */
    uint64_t slots;      /* number of slots of the picture */
    uint64_t first, end; /* range of slots whose samples are taken */
    double most;         /* samples' values are clamped to this, so that sums do not overflow */
    double fraction;     /* fraction at the last report of progress; only the caller's thread uses it */
    atomic_bool cancelled;
} detail_job;

/* The tasks of a tile. */
typedef struct tile_tasks {
    size_t count;
    uint16_t pixel[TILE_PIXELS];     /* each task's pixel in the tile */
    double before[TILE_PIXELS];      /* exclusive prefix sum of importance over the whole picture */
    uint64_t first[TILE_PIXELS + 1]; /* first slot of each task, and one past the last slot of the last task */
} tile_tasks;

typedef struct tile_corner {
    uint32_t left, top, width, height; /* the part of the tile that lies in the picture */
} tile_corner;

static tile_corner corner_of(const detail_job *job, size_t tile)
{
    const picture_planes *p = job->out;
    const uint32_t left = (uint32_t)(tile % job->columns) * TILE_WIDTH, top = (uint32_t)(tile / job->columns) * TILE_HEIGHT;
    const uint32_t right = p->width - left, below = p->height - top;
    return (tile_corner){left, top, right < TILE_WIDTH ? right : TILE_WIDTH, below < TILE_HEIGHT ? below : TILE_HEIGHT};
}

static void weigh_tile(void *argument, size_t tile, uint32_t worker)
{
    (void)worker;
    const detail_job *job = argument;
    const picture_planes *p = job->out;
    const tile_corner c = corner_of(job, tile);
    double sum = 0, water = 0;
    for (uint32_t y = 0; y < c.height; y++)
        for (uint32_t x = 0; x < c.width; x++) {
            const size_t i = (size_t)(c.top + y) * p->width + c.left + x;
            const double importance = (double)podee_importance(&job->rules, p->coverage[i]);
            p->importance[i] = (float)task_importance(NULL, importance, (double)p->water[i], job->rules.threshold);
            sum += (double)p->importance[i];
            water += (double)p->water[i];
        }
    job->before[tile] = sum;
    job->water[tile] = water;
}

/* Replaces sums of tiles by prefix sums, with the sum over all tiles in before[tiles], and sets the members that depend on it. */
static void add_tiles(detail_job *job)
{
    double sum = 0, water = 0;
    for (size_t tile = 0; tile < job->tiles; tile++) {
        const double own = job->before[tile];
        job->before[tile] = sum;
        sum += own;
        water += job->water[tile];
    }
    job->before[job->tiles] = sum;
    const mgt_quality *q = &job->a->frame->scene->quality;
    job->slots = podee_slots_of(q, water);
    job->first = q->sample_first;
    job->end = q->sample_count ? q->sample_first + q->sample_count : job->slots;
    job->most = EXACT_SUM_MOST / (double)job->slots;
}

static void list_tasks(const detail_job *job, size_t tile, tile_tasks *tasks)
{
    const tile_corner c = corner_of(job, tile);
    double sum = job->before[tile];
    tasks->count = 0;
    for (uint32_t y = 0; y < c.height; y++)
        for (uint32_t x = 0; x < c.width; x++) {
            const size_t i = (size_t)(c.top + y) * job->out->width + c.left + x;
            if (job->out->importance[i] <= 0)
                continue;
            tasks->pixel[tasks->count] = (uint16_t)(y * TILE_WIDTH + x);
            tasks->before[tasks->count++] = sum;
            sum += (double)job->out->importance[i];
        }
    const double all = job->before[job->tiles];
    for (size_t task = 0; task < tasks->count; task++)
        tasks->first[task] = podee_first_slot(tasks->before[task], job->slots, all);
    tasks->first[tasks->count] = podee_first_slot(job->before[tile + 1], job->slots, all);
}

/* Number of samples that are taken for a task. */
static uint64_t samples_of_task(const detail_job *job, const tile_tasks *tasks, size_t task)
{
    const uint64_t first = tasks->first[task] > job->first ? tasks->first[task] : job->first;
    const uint64_t end = tasks->first[task + 1] < job->end ? tasks->first[task + 1] : job->end;
    return end > first ? end - first : 0;
}

/* ---- samples ---- */

static void see_tile(const detail_job *job, size_t tile, const wave_set *set, tile_waves *waves, tile_estimate *estimate)
{
    const adaptive_frame *a = job->a;
    const uint32_t x = (uint32_t)(tile % job->columns), y = (uint32_t)(tile / job->columns);
    a->kernels->sort(&a->frame->data, set, &set->view, x, y, waves);
    tile_find_estimates(a->kernels, &a->frame->data, waves, estimate);
}

/* Appends a ray through a random place of the pixel, which depends on the sample's number. */
static void add_ray(const detail_job *job, const tile_corner *c, uint16_t pixel, uint64_t number, temporal_rays *rays)
{
    const uint32_t column = pixel % TILE_WIDTH, row = pixel / TILE_WIDTH;
    const uint64_t key = hash_of_sample(job->a->frame->scene->quality.seed, number);
    const uint64_t bits = hash_of_pixel(key, c->left + column, c->top + row);
    const size_t i = rays->count++;
    rays->pixel[i] = pixel;
    rays->column[i] = (float)column + (hash_unit(bits) - 0.5f);
    rays->row[i] = (float)row + (hash_unit(hash_of(bits)) - 0.5f);
}

static void add_results(const temporal_rays *rays, double most, sample_sums *sums)
{
    const tile_pixels *p = &rays->pixels;
    const float *const values[] = {p->red, p->green, p->blue, p->coverage, p->water};
    for (size_t i = 0; i < rays->count; i++) {
        uint64_t *words = sums->words + (size_t)rays->pixel[i] * SAMPLE_SUM_WORDS;
        for (size_t plane = 0; plane <= EXACT_WATER; plane++)
            exact_add(words + 2 * plane, exact_term((double)values[plane][i], most));
    }
}

static bool told(void *argument, double fraction)
{
    detail_job *job = argument;
    const double approximate = 0.3; /* the approximate picture counts as this fraction of the work */
    job->fraction = fraction;
    if (!atomic_load(&job->cancelled) && !job->a->keep_going(job->a->keep_going_argument, approximate + (1 - approximate) * fraction))
        atomic_store(&job->cancelled, true);
    return !atomic_load(&job->cancelled);
}

enum { BATCHES_BETWEEN_WORDS = 256 };

/* Takes the samples of the slots [first, end). False: cancelled. */
static bool take_samples(detail_job *job, size_t tile, const tile_tasks *tasks, uint64_t first, uint64_t end, uint32_t worker)
{
    const adaptive_frame *a = job->a;
    tile_scratch *s = a->scratch[worker];
    const method_tile t = {.frame = &a->frame->data,
                           .sky = a->sky,
                           .light = a->objects ? &s->objects.light : NULL,
                           .close = &s->close,
                           .close_estimate = s->close_estimate,
                           .open = job->open ? &s->open : NULL,
                           .open_estimate = job->open ? s->open_estimate : NULL};
    const tile_corner corner = corner_of(job, tile);
    temporal_rays rays;
    uint64_t batches = 0;
    for (uint64_t k = first; k < end;) {
        for (rays.count = 0; k < end && rays.count < TILE_PIXELS; k++) {
            const double place = podee_slot_place(k, job->slots, job->before[job->tiles]);
            const size_t task = podee_task_at(tasks->before, tasks->count, place);
            add_ray(job, &corner, tasks->pixel[task], k - tasks->first[task], &rays);
        }
        if (a->objects)
            light_of_pixels(&a->objects[tile].light, rays.pixel, rays.count, &s->objects.light);
        a->kernels->baselines->temporal(&t, &rays);
        add_results(&rays, job->most, &s->sums);
        if (++batches % BATCHES_BETWEEN_WORDS == 0 && worker == 0 && a->keep_going)
            told(job, job->fraction);
        if (atomic_load_explicit(&job->cancelled, memory_order_relaxed))
            return false;
    }
    return true;
}

/* Blends the samples' means into every layer, Eq. 4. A task without samples keeps its values. */
static void blend_pixel(const picture_planes *p, size_t i, const uint64_t *words, uint64_t samples, double weight)
{
    const double n = (double)samples;
    p->samples[i] = (float)n;
    if (samples == 0)
        return;
    double mean[EXACT_COUNT];
    for (size_t plane = 0; plane < EXACT_COUNT; plane++)
        mean[plane] = exact_mean(exact_load(words + 2 * plane), n);
    for (size_t c = 0; c < 3; c++)
        p->color[3 * i + c] = (float)((1 - weight) * (double)p->color[3 * i + c] + weight * mean[EXACT_RED + c]);
    p->detail[i] = (float)mean[EXACT_COVERAGE];
    p->coverage[i] = (float)((1 - weight) * (double)p->coverage[i] + weight * mean[EXACT_COVERAGE]);
    p->water[i] = (float)((1 - weight) * (double)p->water[i] + weight * mean[EXACT_WATER]);
}

static void blend_tile(const detail_job *job, size_t tile, const tile_tasks *tasks, const sample_sums *sums, const float *frequencies)
{
    const tile_corner c = corner_of(job, tile);
    const double per_importance = (double)job->slots / job->before[job->tiles];
    for (size_t task = 0; task < tasks->count; task++) {
        const uint16_t pixel = tasks->pixel[task];
        const size_t i = (size_t)(c.top + pixel / TILE_WIDTH) * job->out->width + c.left + pixel % TILE_WIDTH;
        const double weight = podee_detail_weight(per_importance * (double)job->out->importance[i], (double)frequencies[pixel]);
        blend_pixel(job->out, i, sums->words + (size_t)pixel * SAMPLE_SUM_WORDS, samples_of_task(job, tasks, task), weight);
    }
}

/* Whether the tile has pixels in the crop of the picture's sums; true if there are no sums. */
static bool is_summed(const detail_job *job, size_t tile)
{
    const picture_sums *sums = &job->a->sums;
    const tile_corner c = corner_of(job, tile);
    return (!sums->add && !sums->show) || (c.left < sums->crop.x + sums->crop.width && c.left + c.width > sums->crop.x &&
                                           c.top < sums->crop.y + sums->crop.height && c.top + c.height > sums->crop.y);
}

static void sample_tile(void *argument, size_t tile, uint32_t worker)
{
    detail_job *job = argument;
    const adaptive_frame *a = job->a;
    const double sum = job->before[job->tiles];
    const uint64_t own = podee_first_slot(job->before[tile], job->slots, sum), next = podee_first_slot(job->before[tile + 1], job->slots, sum);
    const uint64_t first = own > job->first ? own : job->first, end = next < job->end ? next : job->end;
    if (first >= end || !is_summed(job, tile))
        return;
    tile_scratch *s = a->scratch[worker];
    tile_tasks tasks;
    float frequencies[TILE_PIXELS];
    sample_sums_clear(&s->sums);
    list_tasks(job, tile, &tasks);
    see_tile(job, tile, job->close, &s->close, s->close_estimate);
    if (job->open && !a->sums.show)
        see_tile(job, tile, job->open, &s->open, s->open_estimate);
    if (!a->sums.show && !take_samples(job, tile, &tasks, first, end, worker))
        return;
    sample_sums_exchange(&s->sums, &a->sums, (uint32_t)(tile % job->columns), (uint32_t)(tile / job->columns));
    const method_tile t = {.frame = &a->frame->data, .close = &s->close};
    a->kernels->baselines->frequencies(&t, job->close, frequencies);
    blend_tile(job, tile, &tasks, &s->sums, frequencies);
}

static void place_waves(const detail_job *job)
{
    const frame *f = job->a->frame;
    const mgt_scene *s = f->scene;
    wave_set_build(f, &f->close, (interval){s->time, 0}, false, job->close);
    if (job->open)
        wave_set_build(f, &f->open, (interval){s->time - s->shutter, 0}, false, job->open);
}

mgt_status adaptive_podee_render(const adaptive_frame *a, const picture_planes *out)
{
    const mgt_scene *scene = a->frame->scene;
    const uint32_t columns = (out->width + TILE_WIDTH - 1) / TILE_WIDTH, rows = (out->height + TILE_HEIGHT - 1) / TILE_HEIGHT;
    const bool two_ends = scene->shutter > 0 || scene->camera_moves;
    detail_job job = {.a = a, .out = out, .rules = podee_rules_of(&scene->quality), .columns = columns, .tiles = (size_t)columns * rows};
    job.close = calloc(two_ends ? 2 : 1, sizeof *job.close);
    job.open = two_ends && job.close ? job.close + 1 : NULL;
    job.before = calloc(2 * job.tiles + 1, sizeof *job.before);
    mgt_status status = MGT_ERROR_MEMORY;
    if (!job.close || !job.before)
        goto done;
    job.water = job.before + job.tiles + 1;
    place_waves(&job);
    const thread_loop weigh = {job.tiles, weigh_tile, &job, NULL}, sample = {job.tiles, sample_tile, &job, a->keep_going ? told : NULL};
    thread_pool_run(a->pool, &weigh);
    add_tiles(&job);
    const bool finished = job.before[job.tiles] <= 0 || thread_pool_run(a->pool, &sample);
    status = finished && !atomic_load(&job.cancelled) ? MGT_OK : MGT_CANCELLED;
done:
    free(job.before);
    free(job.close);
    return status;
}
