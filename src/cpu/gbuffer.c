/* SPDX-License-Identifier: MIT
 * Draws the layers of the objects that a camera sees. */
#include "cpu/gbuffer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/broad.h"
#include "base/triples.h"

enum {
    IMAGE_BLOCK = 1024 /* vertices that a worker maps at a time */
};

/* The inputs of the last drawing, and memory for the next one. */
struct gbuffer_store {
    bool drawn;
    uint64_t version;
    gbuffer_job job;
    float *images;
    size_t image_room;
    raster_bins *bins; /* one per chunk of the world */
    size_t bin_count;
    broad_scratch **scratch; /* one per worker */
    raster_tile **tiles;
    uint32_t workers;
    uint8_t *empty;       /* one per tile of both layers: 1: the tile's memory already shows nothing */
    broad_counts *counts; /* one per worker */
};

/* A drawing of both layers. */
typedef struct draw_job {
    broad_view view;
    gbuffers *out;
    struct gbuffer_store *store;
    size_t chunks;
} draw_job;

static raster_grid grid_of(const gbuffer_job *job, const gbuffer *layer)
{
    return (raster_grid){
        .width = (int32_t)layer->width,
        .height = (int32_t)layer->height,
        .middle_x = (int32_t)(layer->left + job->width / 2),
        .middle_y = (int32_t)(layer->top + job->height / 2),
        .columns = (int32_t)((layer->width + RASTER_TILE - 1) / RASTER_TILE),
        .rows = (int32_t)((layer->height + RASTER_TILE - 1) / RASTER_TILE),
        .least_depth = GBUFFER_LEAST_DEPTH,
    };
}

/* ---- memory ---- */

static void free_layer(gbuffer *layer)
{
    free(layer->depth);
    free(layer->triangle);
    *layer = (gbuffer){0};
}

static uint32_t blocks_of(uint32_t pixels) { return (pixels + GBUFFER_BLOCK - 1) / GBUFFER_BLOCK; }

static bool shape_layers(gbuffers *g, const gbuffer_job *job)
{
    struct gbuffer_store *s = g->store;
    const gbuffer shape = gbuffer_shape(job);
    if (s->empty && g->front.width == shape.width && g->front.height == shape.height)
        return true;
    const size_t count = (size_t)shape.width * shape.height;
    const size_t tiles = (size_t)((shape.width + RASTER_TILE - 1) / RASTER_TILE) * ((shape.height + RASTER_TILE - 1) / RASTER_TILE);
    free_layer(&g->front);
    free_layer(&g->refracted);
    free(g->nearest);
    free(s->empty);
    s->empty = calloc(LAYERS * tiles, sizeof *s->empty);
    g->front = g->refracted = shape;
    g->columns = blocks_of(shape.width), g->rows = blocks_of(shape.height);
    g->nearest = malloc((size_t)g->columns * g->rows * sizeof *g->nearest);
    g->front.depth = malloc(count * sizeof(float)), g->front.triangle = malloc(count * sizeof(int32_t));
    g->refracted.depth = malloc(count * sizeof(float)), g->refracted.triangle = malloc(count * sizeof(int32_t));
    return s->empty && g->nearest && g->front.depth && g->front.triangle && g->refracted.depth && g->refracted.triangle;
}

static void free_store(struct gbuffer_store *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < s->bin_count; i++)
        raster_bins_free(&s->bins[i]);
    for (uint32_t i = 0; i < s->workers; i++) {
        broad_scratch_free(s->scratch[i]);
        free(s->tiles[i]);
    }
    free(s->bins);
    free(s->images);
    free(s->scratch);
    free(s->tiles);
    free(s->empty);
    free(s->counts);
    free(s);
}

void gbuffers_free(gbuffers *g)
{
    free_layer(&g->front);
    free_layer(&g->refracted);
    free(g->nearest);
    free_store(g->store);
    *g = (gbuffers){0};
}

static struct gbuffer_store *new_store(uint32_t workers)
{
    struct gbuffer_store *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->scratch = calloc(workers, sizeof *s->scratch);
    s->tiles = calloc(workers, sizeof *s->tiles);
    s->counts = calloc(workers, sizeof *s->counts);
    bool good = s->scratch && s->tiles && s->counts;
    for (; good && s->workers < workers; s->workers++) {
        s->scratch[s->workers] = calloc(1, sizeof **s->scratch);
        s->tiles[s->workers] = calloc(1, sizeof **s->tiles);
        good = s->scratch[s->workers] && s->tiles[s->workers];
    }
    if (good)
        return s;
    free_store(s);
    return NULL;
}

/* Fits memory to the world's vertices and chunks, and frees what a larger world needed. False: out of memory. */
static bool fit_store(struct gbuffer_store *s, const world *w, size_t chunks)
{
    if (!s->images || w->vertex_count > s->image_room || w->vertex_count < s->image_room / 4) {
        free(s->images);
        s->images = malloc((w->vertex_count + 1) * 4 * sizeof *s->images);
        s->image_room = s->images ? w->vertex_count : 0;
    }
    if (!s->images)
        return false;
    for (size_t i = chunks; i < s->bin_count; i++)
        raster_bins_free(&s->bins[i]);
    if (chunks != s->bin_count) {
        raster_bins *bins = realloc(s->bins, (chunks + 1) * sizeof *bins);
        if (!bins)
            return false;
        for (size_t i = s->bin_count; i < chunks; i++)
            bins[i] = (raster_bins){0};
        s->bins = bins;
        s->bin_count = chunks;
    }
    return true;
}

/* ---- the three loops ---- */

static void place_vertices(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const draw_job *job = argument;
    const broad_view *view = &job->view;
    const size_t first = index * IMAGE_BLOCK, left = view->world->vertex_count - first;
    view->kernels->images(&view->refract, &view->picture, view->foot, left < IMAGE_BLOCK ? left : IMAGE_BLOCK, view->world->positions + 3 * first,
                          job->store->images + 4 * first);
}

static void bin_chunk(void *argument, size_t index, uint32_t worker)
{
    const draw_job *job = argument;
    raster_bins_clear(&job->store->bins[index]);
    broad_chunk(&job->view, index, job->store->scratch[worker], &job->store->bins[index], &job->store->counts[worker]);
}

/* Sets `nearest` of the blocks in the refracted layer's tile whose first pixel is (x, y). */
static void find_nearest(gbuffers *g, uint32_t x, uint32_t y)
{
    _Static_assert(RASTER_TILE % GBUFFER_BLOCK == 0, "whole blocks");
    const gbuffer *layer = &g->refracted;
    const uint32_t right = x + RASTER_TILE < layer->width ? x + RASTER_TILE : layer->width,
                   bottom = y + RASTER_TILE < layer->height ? y + RASTER_TILE : layer->height;
    for (uint32_t row = y; row < bottom; row++) {
        const float *depth = layer->depth + (size_t)row * layer->width;
        float *nearest = g->nearest + (size_t)(row / GBUFFER_BLOCK) * g->columns;
        for (uint32_t column = x; column < right; column++) {
            float *least = &nearest[column / GBUFFER_BLOCK];
            const bool first = row % GBUFFER_BLOCK == 0 && column % GBUFFER_BLOCK == 0;
            *least = first || depth[column] < *least ? depth[column] : *least;
        }
    }
}

static void draw_tile(void *argument, size_t index, uint32_t worker)
{
    const draw_job *job = argument;
    const raster_grid *grid = &job->view.grid;
    const raster_kernels *kernels = job->view.kernels;
    raster_tile *tile = job->store->tiles[worker];
    const size_t tiles = (size_t)grid->columns * (size_t)grid->rows;
    const int32_t x = (int32_t)(index % tiles) % grid->columns * RASTER_TILE, y = (int32_t)(index % tiles) / grid->columns * RASTER_TILE;
    tile->x = x - grid->middle_x;
    tile->y = y - grid->middle_y;
    tile->width = grid->width - x < RASTER_TILE ? grid->width - x : RASTER_TILE;
    tile->height = grid->height - y < RASTER_TILE ? grid->height - y : RASTER_TILE;
    bool drawn = false;
    for (size_t i = 0; i < job->chunks; i++) {
        const raster_bins *bins = &job->store->bins[i];
        const uint32_t first = bins->starts[index], end = bins->starts[index + 1];
        if (end == first)
            continue;
        if (!drawn)
            kernels->tile_clear(tile);
        drawn = true;
        kernels->tile_draw(tile, bins->triangles, bins->list + first, end - first);
    }
    if (!drawn && job->store->empty[index])
        return;
    if (!drawn)
        kernels->tile_clear(tile);
    job->store->empty[index] = !drawn;
    const gbuffer *layer = index < tiles ? &job->out->front : &job->out->refracted;
    for (int32_t row = 0; row < tile->height; row++) {
        const size_t at = (size_t)(y + row) * layer->width + (size_t)x;
        kernels->tile_row(tile, row, layer->depth + at, layer->triangle + at);
    }
    if (layer == &job->out->refracted)
        find_nearest(job->out, (uint32_t)x, (uint32_t)y);
}

/* Counts the blocks of the refracted layer that show nothing, and finds the rectangle that holds the others. */
static void bound_layer(gbuffers *g)
{
    float *within = g->within;
    g->empties = 0;
    within[0] = (float)g->refracted.width, within[1] = -1, within[2] = (float)g->refracted.height, within[3] = -1;
    for (uint32_t i = 0; i < g->columns * g->rows; i++) {
        if (!(g->nearest[i] < INFINITY)) {
            g->empties++;
            continue;
        }
        const float x = (float)(i % g->columns * GBUFFER_BLOCK), y = (float)(i / g->columns * GBUFFER_BLOCK);
        within[0] = fminf(within[0], x), within[1] = fmaxf(within[1], x + GBUFFER_BLOCK - 1);
        within[2] = fminf(within[2], y), within[3] = fmaxf(within[3], y + GBUFFER_BLOCK - 1);
    }
}

/* ---- drawing ---- */

static bool same_camera(const camera_rays *a, const camera_rays *b) { return memcmp(a, b, sizeof *a) == 0; }

static bool is_drawn(const struct gbuffer_store *s, const world *w, const gbuffer_job *job)
{
    return s && s->drawn && s->version == w->version && same_camera(&s->job.camera, &job->camera) && s->job.width == job->width &&
           s->job.height == job->height && s->job.index == job->index && s->job.map == job->map && s->job.error == job->error && s->job.crest == job->crest &&
           s->job.trough == job->trough && s->job.mirrored == job->mirrored;
}

static broad_view view_of(const gbuffers *g, const world *w, const gbuffer_job *job, const raster_kernels *kernels)
{
    broad_view view = {.world = w, .kernels = kernels, .refract = g->refract, .images = g->store->images};
    view.grid = grid_of(job, &g->front);
    view.picture = gbuffer_picture(job);
    view.foot[0] = (float)(job->camera.position[0] - w->origin[0]);
    view.foot[1] = (float)(job->camera.position[2] - w->origin[1]);
    view.crest = job->map == MAP_PATH ? 0 : (float)job->crest;
    view.trough = (float)job->trough;
    view.mirrored = job->mirrored;
    return view;
}

static bool draw_layers(draw_job *job, thread_pool *pool)
{
    struct gbuffer_store *s = job->store;
    const raster_grid *grid = &job->view.grid;
    memset(s->counts, 0, s->workers * sizeof *s->counts);
    for (uint32_t i = 0; i < s->workers; i++)
        s->scratch[i]->failed = false;
    const thread_loop vertices = {(job->view.world->vertex_count + IMAGE_BLOCK - 1) / IMAGE_BLOCK, place_vertices, job, NULL};
    thread_pool_run(pool, &vertices);
    const thread_loop chunks = {job->chunks, bin_chunk, job, NULL};
    thread_pool_run(pool, &chunks);
    for (size_t i = 0; i < job->chunks; i++)
        if (s->bins[i].failed)
            return false;
    const thread_loop tiles = {(size_t)LAYERS * (size_t)grid->columns * (size_t)grid->rows, draw_tile, job, NULL};
    thread_pool_run(pool, &tiles);
    bound_layer(job->out);
    job->out->counts = (gbuffer_counts){0, 0, 0};
    for (uint32_t i = 0; i < s->workers; i++) {
        job->out->counts.front_triangles += s->counts[i].drawn[FRONT_LAYER];
        job->out->counts.far_triangles += s->counts[i].drawn[REFRACTED_LAYER];
        job->out->counts.splits += s->counts[i].splits;
    }
    return true;
}

mgt_status gbuffers_draw(gbuffers *g, const world *w, const gbuffer_job *job, const raster_kernels *kernels, thread_pool *pool)
{
    if (is_drawn(g->store, w, job))
        return MGT_OK;
    if (g->store && g->store->workers != thread_pool_size(pool)) {
        free_store(g->store);
        g->store = NULL;
    }
    if (!g->store)
        g->store = new_store(thread_pool_size(pool));
    const size_t chunks = (w->triangle_count + BROAD_CHUNK - 1) / BROAD_CHUNK;
    if (!g->store || !fit_store(g->store, w, chunks) || !shape_layers(g, job))
        goto fail;
    g->store->drawn = false;
    g->refract = refract_data_of(job->camera.position[1], job->index, job->map);
    draw_job d = {.view = view_of(g, w, job, kernels), .out = g, .store = g->store, .chunks = chunks};
    if (!draw_layers(&d, pool))
        goto fail;
    g->store->version = w->version;
    g->store->job = *job;
    g->store->drawn = true;
    g->drawn++;
    return MGT_OK;
fail:
    gbuffers_free(g);
    return MGT_ERROR_MEMORY;
}
