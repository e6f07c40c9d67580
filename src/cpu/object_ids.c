/* SPDX-License-Identifier: MIT
 * Sums the labels that the rays of every pixel show, tile by tile. */
#include "cpu/object_ids.h"

#include <stdlib.h>

#include "cpu/path_traced.h"
#include "frame/targets.h"

enum { LABELS_MAX = OBJECT_SIDE_MAX * OBJECT_SIDE_MAX + 1 }; /* one per ray, and water */

/* Labels that a pixel has shown so far, and their weights in rays. */
typedef struct pixel_labels {
    uint32_t count;
    uint32_t label[LABELS_MAX];
    float weight[LABELS_MAX];
} pixel_labels;

typedef struct drawing {
    const object_ids_job *job;
    const mgt_image *image;
    path_traced *truth;
    uint32_t first_x, first_y, columns; /* first tile of the crop, and number of tiles in a row */
    pixel_labels **scratch;             /* TILE_PIXELS elements per worker */
    object_shares *pixels;
} drawing;

static void add(pixel_labels *p, uint32_t label, float weight)
{
    uint32_t i = 0;
    while (i < p->count && p->label[i] != label)
        i++;
    if (i == p->count) {
        p->label[p->count++] = label;
        p->weight[i] = 0;
    }
    p->weight[i] += weight;
}

static void add_sample(const drawing *d, pixel_labels *tile, const path_traced_seen *seen)
{
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        const int32_t object = seen->object[i];
        const uint32_t label = object >= 0 ? d->job->labels[object] : object == SEEN_WATER ? d->job->water : d->job->sky;
        if (seen->mirrored[i] > 0)
            add(&tile[i], d->job->water, seen->mirrored[i]);
        if (seen->mirrored[i] < 1)
            add(&tile[i], label, 1 - seen->mirrored[i]);
    }
}

static bool comes_before(const pixel_labels *p, uint32_t a, uint32_t b)
{
    return p->weight[a] > p->weight[b] || (p->weight[a] == p->weight[b] && p->label[a] < p->label[b]);
}

static object_shares rank(pixel_labels *p, float whole)
{
    object_shares shares = {{0}, {0}};
    for (uint32_t r = 0; r < OBJECT_RANKS && r < p->count; r++) {
        uint32_t best = r;
        for (uint32_t i = r + 1; i < p->count; i++)
            if (comes_before(p, i, best))
                best = i;
        shares.label[r] = p->label[best];
        shares.share[r] = p->weight[best] / whole;
        p->label[best] = p->label[r];
        p->weight[best] = p->weight[r];
    }
    return shares;
}

static void draw_tile(void *argument, size_t index, uint32_t worker)
{
    const drawing *d = argument;
    const mgt_image *image = d->image;
    const uint32_t tile_x = d->first_x + (uint32_t)index % d->columns, tile_y = d->first_y + (uint32_t)index / d->columns,
                   samples = d->job->side * d->job->side;
    pixel_labels *tile = d->scratch[worker];
    path_traced_seen seen;
    for (size_t i = 0; i < TILE_PIXELS; i++)
        tile[i].count = 0;
    for (uint32_t sample = 0; sample < samples; sample++) {
        path_traced_see(d->truth, tile_x, tile_y, worker, sample, &seen);
        add_sample(d, tile, &seen);
    }
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint32_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH - image->crop_x, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH - image->crop_y;
        if (x < image->crop_width && y < image->crop_height) /* x and y wrap around left of and above the crop */
            d->pixels[(size_t)y * image->crop_width + x] = rank(&tile[i], (float)samples);
    }
}

static bool on_progress(void *argument, double fraction)
{
    const drawing *d = argument;
    return !d->job->progress || d->job->progress(d->job->user, fraction);
}

static mgt_status draw_tiles(drawing *d, thread_pool *pool)
{
    const mgt_image *image = d->image;
    const uint32_t workers = thread_pool_size(pool);
    mgt_status status = MGT_ERROR_MEMORY;
    d->first_x = image->crop_x / TILE_WIDTH;
    d->first_y = image->crop_y / TILE_HEIGHT;
    d->columns = (image->crop_x + image->crop_width - 1) / TILE_WIDTH - d->first_x + 1;
    const uint32_t rows = (image->crop_y + image->crop_height - 1) / TILE_HEIGHT - d->first_y + 1;
    const thread_loop loop = {(size_t)d->columns * rows, draw_tile, d, on_progress};
    d->scratch = calloc(workers, sizeof *d->scratch);
    for (uint32_t i = 0; d->scratch && i < workers; i++)
        if (!(d->scratch[i] = malloc(TILE_PIXELS * sizeof **d->scratch)))
            goto done;
    if (d->scratch)
        status = thread_pool_run(pool, &loop) ? MGT_OK : MGT_CANCELLED;
done:
    for (uint32_t i = 0; d->scratch && i < workers; i++)
        free(d->scratch[i]);
    free(d->scratch);
    return status;
}

typedef struct traced_world {
    world *world;
    trace_scene *trace;
    path_dry *dry;
} traced_world;

static mgt_status build_world(traced_world *w, const mgt_scene *scene, thread_pool *pool, const reporter *report)
{
    mgt_status status = world_update(&w->world, scene, pool);
    if (status != MGT_OK)
        return status;
    const trace_triangles triangles = {w->world->triangle_count, w->world->vertex_count, w->world->positions, w->world->indices, w->world->version};
    status = trace_scene_update(&w->trace, &triangles, thread_pool_size(pool), report);
    return status == MGT_OK ? path_dry_update(&w->dry, w->world, thread_pool_size(pool), report) : status;
}

mgt_status object_ids_draw(const object_ids_job *job, const reporter *report, object_shares *pixels)
{
    if (!trace_available())
        return report_error(report, MGT_ERROR_UNAVAILABLE, "ids.trace", "this build traces no rays: it was made without Embree");
    thread_pool *pool = thread_pool_create(job->threads ? job->threads : thread_pool_usable_cpus());
    if (!pool)
        return report_error(report, MGT_ERROR_THREAD, "ids.threads", "no thread could be started");
    mgt_scene scene = *job->scene;
    scene_to_sea_level(&scene);
    scene.quality.refraction_samples = job->side;
    traced_world w = {0};
    drawing d = {.job = job, .image = &job->scene->image, .pixels = pixels};
    mgt_status status = build_world(&w, &scene, pool, report);
    if (status == MGT_OK) {
        const path_traced_job traced = {
            .scene = &scene,
            .camera = camera_rays_of(&scene.camera, scene.image.width, scene.image.height),
            .world = w.world,
            .trace = w.trace,
            .dry = w.dry,
            .isa = job->isa,
            .workers = thread_pool_size(pool),
        };
        status = path_traced_create(&d.truth, &traced);
    }
    if (status == MGT_OK)
        status = draw_tiles(&d, pool);
    if (status == MGT_ERROR_MEMORY)
        report_error(report, status, "ids.memory", "out of memory for what the pixels show");
    path_traced_free(d.truth);
    path_dry_free(w.dry);
    trace_scene_free(w.trace);
    world_free(w.world);
    thread_pool_destroy(pool);
    return status;
}
