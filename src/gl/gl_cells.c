/* SPDX-License-Identifier: MIT
 * The refinement tree of method adaptive on the GPU. It begins with one leaf per pixel. Each round splits the leaves whose split saves the most error per
 * evaluation.
 *
 * The GPU decides what a round renders: indirect dispatches take their sizes from the state buffer, and are empty in rounds that are not needed. The CPU reads
 * nothing back. The shaders cells_*.comp describe the steps of a round, which are those of src/cpu/adaptive.c. */
#include "gl/gl_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame/cell_waves.h"
#include "frame/lights.h"
#include "gl/gl_frame.h"

enum {
    SAMPLE_ROUNDS = 10, /* rounds that spend a given number of samples, see round_per_cent() */
    MOST_ROUNDS = 40,   /* largest number of rounds towards a given error */
    JOBS_A_TILE = 6,    /* room for jobs of a tile in a round, on average; in pictures of sea a tile had two to three */
    LEAST_JOBS = 4 * CELL_SIZES,
    MOST_SLOTS = 32768, /* largest number of jobs of a batch: one row of a dispatch */
};

/* Memory of the wave lists of a batch of jobs, bytes. */
static const size_t batch_bytes = (size_t)64 << 20;

/* Memory of one side of the pool of leaves, bytes, unless the pixels need more: see pool_of(). */
static const size_t pool_bytes = (size_t)256 << 20;

/* The refinement of one frame. */
typedef struct cells_run {
    gl_run *run;
    gl_renderer *g;
    const frame *frame;
    CellsData data;
    gl_band whole;                          /* the whole picture as one band */
    int parts[CELL_CLASSES];                /* pieces of the shutter for each class of leaves */
    int batches, point_batches, most_parts; /* most_parts: largest number of pieces of cells */
    size_t set_vectors;                     /* size of a set of waves, in vectors of 16 bytes */
} cells_run;

/* ---- memory ---- */

static int least(int64_t a, int64_t b) { return (int)(a < b ? a : b); }

/* Number of batches of `slots` entries that hold `count` entries, at most CELLS_BATCHES. */
static int batches_of(int count, int slots) { return least(((int64_t)count + slots - 1) / slots, CELLS_BATCHES); }

/* Sets the sizes and places of the lists, and how many of their entries a batch has. data.pool must be set. */
static void plan_lists(cells_run *c)
{
    CellsData *d = &c->data;
    const int64_t tiles = d->tiles, pixels = tiles * TILE_PIXELS;
    const size_t slot = sizeof(TileData) + (size_t)c->run->wave_stride * (sizeof(TileWave) + sizeof(SearchWave));
    const int64_t most = batch_bytes / slot > 64 ? (int64_t)(batch_bytes / slot) : 64;
    const int64_t point_most = (int64_t)(batch_bytes / (TILE_FLOATS(c->frame->data.hit_rows) * sizeof(float)));
    d->most_jobs = least(JOBS_A_TILE * tiles + LEAST_JOBS, (int64_t)1 << 24);
    d->slots = least(least(most, d->most_jobs), MOST_SLOTS);
    c->batches = batches_of(d->most_jobs, d->slots);
    d->most_jobs = least(d->most_jobs, (int64_t)d->slots * c->batches);
    d->point_slots = least(least(least(most, point_most), tiles), d->slots);
    c->point_batches = batches_of(d->tiles, d->point_slots);
    d->most_groups = d->pool / CELLS_GROUP * 4 / 3 + d->most_jobs; /* four new cells take three more places */
    d->most_point_groups = least(pixels / 16 + 4096, (int64_t)1 << 24);
    d->jobs_at = CELLS_TILES + d->tiles * CELLS_TILE_WORDS;
    d->groups_at = d->jobs_at + d->most_jobs * JOB_WORDS;
    d->point_tiles_at = d->groups_at + d->most_groups * GROUP_WORDS;
    d->point_groups_at = d->point_tiles_at + d->tiles;
}

/* Size of the state buffer, in words of four bytes. */
static size_t state_words(const CellsData *d) { return (size_t)d->point_groups_at + (size_t)d->most_point_groups * POINT_GROUP_WORDS; }

/* Number of leaves that one side of the pool has room for. Pictures of sea with eight samples have up to three leaves per pixel. Large pictures get less room,
 * but at least for 1.5 leaves per pixel. The largest buffer of this OpenGL limits the pool, too. If it cannot even hold the pixels, reserve() reports that. */
static int pool_of(const cells_run *c)
{
    const int64_t pixels = (int64_t)c->data.tiles * TILE_PIXELS, leaf = LEAF_VECTORS * 16, least_pool = pixels + pixels / 2;
    const double a_pixel = c->data.target_rmse > 0 || c->data.target_displayed > 0 ? 16 : fmax(4, (double)c->data.samples / 6);
    const int64_t wanted = (int64_t)((double)pixels * a_pixel), held = (int64_t)pool_bytes / leaf;
    const int64_t pool = wanted < held ? wanted : held > least_pool ? held : least_pool, allowed = (int64_t)(c->g->limits.storage_bytes / 2) / leaf;
    return least(pool < allowed || allowed < pixels ? pool : allowed, 1 << 28);
}

/* Number of sets of waves: see upload_sets(). */
static size_t sets_of(const cells_run *c) { return LEAF_INSTANTS + (size_t)(c->parts[CELLS_WHOLE] + c->parts[CELLS_PARTS] + c->parts[CELLS_SHARP]); }

/* Reserves all buffers. MGT_ERROR_UNSUPPORTED: one is larger than this OpenGL allows. */
static mgt_status reserve(cells_run *c)
{
    gl_renderer *g = c->g;
    gl_cells *cells = &g->cells;
    const gl_api *gl = &g->gl;
    const reporter *r = c->run->r;
    const CellsData *d = &c->data;
    const size_t leaf = LEAF_VECTORS * 16, slots = (size_t)d->slots;
    const struct {
        gl_buffer *buffer;
        size_t size;
    } all[] = {
        {&cells->leaves, 2 * (size_t)d->pool * leaf},
        {&cells->state, state_words(d) * sizeof(uint32_t)},
        {&cells->pixels, (size_t)d->tiles * TILE_PIXELS * 2 * sizeof(float)},
        {&cells->sets, c->set_vectors * 16 * sets_of(c)},
        {&cells->foam, c->frame->foam.some ? sizeof(foam_set) * sets_of(c) : 0},
        {&cells->frames, LEAF_SIDES * sizeof(FrameData)},
        {&g->tiles, slots * sizeof(TileData)},
        {&g->tile_waves, slots * (size_t)c->run->wave_stride * sizeof(TileWave)},
        {&g->search_waves, slots * (size_t)c->run->wave_stride * sizeof(SearchWave)},
        {&g->nodes, (size_t)d->point_slots * TILE_FLOATS(c->frame->data.hit_rows) * sizeof(float)},
    };
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < sizeof all / sizeof *all && status == MGT_OK; i++)
        status = all[i].size > g->limits.storage_bytes
                     ? report_error(r, MGT_ERROR_UNSUPPORTED, "render.size",
                                    "adaptive needs a buffer of %zu bytes for this picture, this OpenGL takes %zu: use the CPU", all[i].size,
                                    g->limits.storage_bytes)
                     : gl_buffer_reserve(gl, all[i].buffer, all[i].size, 0, r);
    return status;
}

void gl_cells_free(const gl_api *gl, gl_cells *c)
{
    gl_buffer *const buffers[] = {&c->leaves, &c->state, &c->pixels, &c->sets, &c->foam, &c->frames};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        gl_buffer_free(gl, buffers[i]);
}

/* ---- waves ---- */

/* Returns memory in the ring, `offset` bytes from its begin, for data that a command of the GPU then copies to their buffer. So earlier commands may still read
 * what that buffer holds. NULL: failed, see `status`. */
static void *begin_upload(cells_run *c, size_t size, size_t *offset, mgt_status *status)
{
    gl_renderer *g = c->g;
    *status = gl_ring_begin(&g->gl, &g->ring, size, 1, c->run->r);
    return *status == MGT_OK ? gl_ring_allocate(&g->ring, size, offset) : NULL;
}

static mgt_status upload_frames(cells_run *c)
{
    size_t offset;
    mgt_status status;
    const size_t size = LEAF_SIDES * sizeof(FrameData);
    FrameData *frames = begin_upload(c, size, &offset, &status);
    for (int i = 0; frames && i < LEAF_SIDES; i++)
        frames[i] = cell_frame(&c->frame->data, i, 0);
    if (frames)
        c->g->gl.CopyNamedBufferSubData(c->g->ring.buffer, c->g->cells.frames.name, (GLintptr)offset, 0, (GLsizeiptr)size);
    return status;
}

/* Writes the views of a set: that of pixels, then those of each size of cells in the order of cell_size(). */
static void write_views(const ViewData *view, ViewData *out)
{
    *out++ = *view;
    for (int level = 1; level < LEAF_LEVELS; level++)
        for (int across = 0; across <= 2 * level; across++)
            *out++ = cell_view(view, across, 2 * level - across);
}

/* Uploads the foam of the set in g->waves as number `index`, if it has any. */
static mgt_status upload_foam(cells_run *c, size_t index)
{
    gl_renderer *g = c->g;
    const foam_set *foam = &g->waves->foam;
    size_t offset;
    mgt_status status;
    const size_t size = foam_set_bytes(foam);
    void *at = g->waves->has_foam ? begin_upload(c, size, &offset, &status) : NULL;
    if (!g->waves->has_foam)
        return MGT_OK;
    if (!at)
        return status;
    memcpy(at, foam, size);
    g->gl.CopyNamedBufferSubData(g->ring.buffer, g->cells.foam.name, (GLintptr)offset, (GLintptr)(index * sizeof *foam), (GLsizeiptr)size);
    return MGT_OK;
}

/* Uploads the set of waves in g->waves as number `index`. */
static mgt_status upload_set(cells_run *c, size_t index)
{
    gl_renderer *g = c->g;
    const wave_set *set = g->waves;
    const size_t waves = (size_t)set->view.wave_count, size = c->set_vectors * 16;
    size_t offset;
    mgt_status status;
    char *at = begin_upload(c, size, &offset, &status);
    if (!at)
        return status;
    memcpy(at, set->data, waves * sizeof(WaveData));
    at += waves * sizeof(WaveData);
    sines_sort_data(set, (SortData *)(void *)at);
    at += waves * sizeof(SortData);
    write_views(&set->view, (ViewData *)(void *)at);
    g->gl.CopyNamedBufferSubData(g->ring.buffer, g->cells.sets.name, (GLintptr)offset, (GLintptr)(index * size), (GLsizeiptr)size);
    return upload_foam(c, index);
}

/* Computes and uploads all sets of waves, in the order of set_of_part() and set_of_instant() in cells_job.glsl. */
static mgt_status upload_sets(cells_run *c)
{
    const gl_job *job = c->run->job;
    size_t index = 0;
    mgt_status status = MGT_OK;
    for (int k = 0; k < CELL_CLASSES; k++)
        for (int i = 0; i < c->parts[k] && status == MGT_OK; i++) {
            gl_place_sweep(c->run, (double)i / c->parts[k], (i + 1.0) / c->parts[k]);
            status = upload_set(c, index++);
        }
    for (int i = 0; i < LEAF_INSTANTS && status == MGT_OK; i++) {
        const double instant = cell_instant(i);
        const camera_rays camera = job->camera_at(job->camera_user, instant);
        wave_set_build(c->frame, &camera, frame_part(c->frame, instant, instant), false, c->g->waves);
        status = upload_set(c, index++);
    }
    return status;
}

/* ---- dispatches ---- */

/* Binds the tiles, the leaves, the state and the layers. */
static void bind(const cells_run *c)
{
    const gl_renderer *g = c->g;
    const gl_api *gl = &g->gl;
    const gl_layers *l = &g->layers;
    const gl_image *const images[] = {&l->color, &l->coverage, &l->water, &l->samples, &l->importance, &l->detail};
    gl_bind_tiles(g);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_LEAVES, g->cells.leaves.name);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_CELLS, g->cells.state.name);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_PIXELS, g->cells.pixels.name);
    for (GLuint i = 0; i < sizeof images / sizeof *images; i++)
        gl_bind_image(g, i, images[i], GL_READ_WRITE);
    gl_bind_texture(g, UNIT_SKY, g->sky_texture);
    gl_bind_texture(g, UNIT_SKYLINE, g->skyline_texture);
    gl_refraction_bind_light(g);
}

/* Binds what rounds need besides: the sets of waves, the frame's uniform data and the sizes of indirect dispatches. */
static void bind_sets(const cells_run *c)
{
    const gl_renderer *g = c->g;
    g->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_WAVES, g->cells.sets.name);
    if (c->frame->foam.some)
        g->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_FOAM, g->cells.foam.name);
    g->gl.BindBufferRange(GL_UNIFORM_BUFFER, BIND_FRAME, g->cells.frames.name, 0, (GLsizeiptr)(LEAF_SIDES * sizeof(FrameData)));
    g->gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, g->cells.state.name);
}

static void barrier_after(const gl_api *gl) { gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_COMMAND_BARRIER_BIT); }

/* Makes a program current and uploads its uniform data. `pass` is that of a band or of the whole picture. */
static mgt_status use(cells_run *c, gl_program program, const PassData *pass)
{
    gl_renderer *g = c->g;
    mgt_status status = gl_ring_begin(&g->gl, &g->ring, sizeof *pass + sizeof c->data, 2, c->run->r);
    if (status == MGT_OK)
        status = gl_use(g, program, c->run->r);
    if (status != MGT_OK)
        return status;
    gl_uniform(g, BIND_PASS, pass, sizeof *pass);
    gl_uniform(g, BIND_EXTRA, &c->data, sizeof c->data);
    return MGT_OK;
}

/* Runs a program over the number of workgroups that stands at word `size` of the state. */
static mgt_status run_counted(cells_run *c, gl_program program, int size)
{
    const mgt_status status = use(c, program, &c->whole.pass);
    if (status != MGT_OK)
        return status;
    c->g->gl.DispatchComputeIndirect((GLintptr)size * 4);
    barrier_after(&c->g->gl);
    return MGT_OK;
}

static mgt_status run_groups(cells_run *c, gl_program program, GLuint columns, GLuint rows)
{
    const mgt_status status = use(c, program, &c->whole.pass);
    if (status != MGT_OK)
        return status;
    c->g->gl.DispatchCompute(columns, rows, 1);
    barrier_after(&c->g->gl);
    return MGT_OK;
}

/* Runs a program with one workgroup for each tile of the picture. */
static mgt_status run_tiles(cells_run *c, gl_program program) { return run_groups(c, program, (GLuint)c->data.columns, (GLuint)c->data.rows); }

/* ---- the picture of pixels ---- */

/* Sorts the waves of the whole shutter for the band's tiles and searches first hits. */
static mgt_status sort_band(cells_run *c, const gl_band *b)
{
    gl_place_sweep(c->run, 0, 1);
    const mgt_status status = gl_sort_tiles(&c->frame->data, c->run, b, 0, 0);
    return status == MGT_OK ? gl_search_nodes(c->run, b->tiles) : status;
}

/* Makes the first leaves of a band, one per pixel. */
static mgt_status plant_band(cells_run *c, uint32_t row)
{
    gl_renderer *g = c->g;
    const gl_band b = gl_band_at(c->run, row);
    mgt_status status = gl_see_band(c->run, &b);
    if (status == MGT_OK)
        status = sort_band(c, &b);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "shade");
    bind(c);
    status = use(c, PROGRAM_CELLS_PLANT, &b.pass);
    if (status == MGT_OK) {
        g->gl.DispatchCompute((GLuint)b.pass.columns, (GLuint)b.pass.rows * GROUPS_A_TILE, 1);
        barrier_after(&g->gl);
    }
    const mgt_status ended = gl_pass_end(g, c->run->r);
    return status == MGT_OK ? ended : status;
}

/* Settles or keeps the leaves that have been rendered. Then it counts the cost of the open leaves, except at the end. `mode` is GROW_… */
static mgt_status grow(cells_run *c, int mode)
{
    c->data.mode = mode;
    mgt_status status = mode == GROW_ROUND ? run_counted(c, PROGRAM_CELLS_GROW, CELLS_TILES_SIZE) : run_tiles(c, PROGRAM_CELLS_GROW);
    if (status == MGT_OK && mode == GROW_PIXELS)
        status = run_tiles(c, PROGRAM_CELLS_CENSUS);
    if (status == MGT_OK && mode == GROW_ROUND)
        status = run_counted(c, PROGRAM_CELLS_CENSUS, CELLS_TILES_SIZE);
    return status;
}

/* Makes the first leaves of the picture, band by band. */
static mgt_status plant(cells_run *c)
{
    gl_run *run = c->run;
    const uint32_t zero = 0;
    c->g->gl.ClearNamedBufferSubData(c->g->cells.state.name, GL_R32UI, 0, CELLS_TILES * 4, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    mgt_status status = MGT_OK;
    for (uint32_t row = run->first_row; row < run->end_row && status == MGT_OK; row += run->band_rows) {
        status = plant_band(c, row);
        if (status == MGT_OK)
            status = gl_step_done(run, 1);
    }
    return status;
}

/* ---- rounds ---- */

/* Chooses the leaves that the round splits or samples, and assigns places to the results. */
static mgt_status plan_round(cells_run *c)
{
    mgt_status status = run_groups(c, PROGRAM_CELLS_PLAN, 1, 1);
    if (status == MGT_OK)
        status = run_counted(c, PROGRAM_CELLS_CHOOSE, CELLS_TILES_SIZE);
    if (status == MGT_OK)
        status = run_groups(c, PROGRAM_CELLS_ALLOCATE, 1, 1);
    return status == MGT_OK ? run_counted(c, PROGRAM_CELLS_LIST, CELLS_TILES_SIZE) : status;
}

/* Shades the round's new cells, for one piece of the shutter after another. */
static mgt_status shade_cells(cells_run *c)
{
    mgt_status status = MGT_OK;
    c->data.instant = -1;
    for (int batch = 0; batch < c->batches && status == MGT_OK; batch++)
        for (int part = 0; part < c->most_parts && status == MGT_OK; part++) {
            c->data.batch = batch;
            c->data.part = part;
            status = run_counted(c, PROGRAM_CELLS_SORT, CELLS_SORT_SIZE + 4 * batch);
            if (status == MGT_OK)
                status = run_counted(c, PROGRAM_CELLS_SHADE, CELLS_SHADE_SIZE + 4 * batch);
        }
    return status;
}

/* Samples the round's points, one instant after another. */
static mgt_status sample_points(cells_run *c)
{
    mgt_status status = MGT_OK;
    for (int batch = 0; batch < c->point_batches && status == MGT_OK; batch++)
        for (int instant = 0; instant < LEAF_INSTANTS && status == MGT_OK; instant++) {
            c->data.batch = batch;
            c->data.instant = instant;
            status = run_counted(c, PROGRAM_CELLS_SORT, CELLS_POINT_SORT_SIZE + 4 * batch);
            if (status == MGT_OK)
                status = run_counted(c, PROGRAM_NODES, CELLS_POINT_SORT_SIZE + 4 * batch);
            if (status == MGT_OK)
                status = run_counted(c, PROGRAM_CELLS_POINTS, CELLS_POINT_SIZE + 4 * batch);
        }
    return status;
}

/* Runs a stage of a round as a pass with a name of its own. */
static mgt_status run_stage(cells_run *c, const char *name, mgt_status (*stage)(cells_run *))
{
    gl_pass_begin(c->g, name);
    const mgt_status status = stage(c), ended = gl_pass_end(c->g, c->run->r);
    return status == MGT_OK ? ended : status;
}

static mgt_status grow_pixels(cells_run *c) { return grow(c, GROW_PIXELS); }
static mgt_status grow_round(cells_run *c) { return grow(c, GROW_ROUND); }
static mgt_status grow_end(cells_run *c) { return grow(c, GROW_END); }

static mgt_status run_round(cells_run *c)
{
    mgt_status status = run_stage(c, "plan", plan_round);
    if (status == MGT_OK)
        status = run_stage(c, "cells", shade_cells);
    if (status == MGT_OK)
        status = run_stage(c, "points", sample_points);
    return status == MGT_OK ? run_stage(c, "grow", grow_round) : status;
}

/* Runs the rounds, then settles the leaves that remain. */
static mgt_status refine(cells_run *c, int rounds)
{
    bind(c);
    bind_sets(c);
    mgt_status status = run_stage(c, "grow", grow_pixels);
    for (int round = 0; round < rounds && status == MGT_OK; round++) {
        status = run_round(c);
        if (status == MGT_OK)
            status = gl_step_done(c->run, 1);
    }
    return status == MGT_OK ? run_stage(c, "grow", grow_end) : status;
}

/* ---- a frame ---- */

/* Draws the objects in front of the water over all bands. */
static mgt_status put_objects_in_front(const gl_run *run)
{
    mgt_status status = MGT_OK;
    for (uint32_t row = run->first_row; row < run->end_row && status == MGT_OK && run->objects; row += run->band_rows) {
        const gl_band b = gl_band_at(run, row);
        status = gl_put_objects_in_front(run, &b);
    }
    return status;
}

/* Uniform data of the refinement, without those of the pool and of the lists. */
static CellsData data_of(const gl_job *job, const frame *f, const int parts[CELL_CLASSES])
{
    const mgt_quality *q = &f->scene->quality;
    const int width = (int)job->area.width, height = (int)job->area.height;
    const int columns = (width + TILE_WIDTH - 1) / TILE_WIDTH, rows = (height + TILE_HEIGHT - 1) / TILE_HEIGHT;
    return (CellsData){
        .tiles = columns * rows,
        .columns = columns,
        .rows = rows,
        .waves = (int)f->scene->water.wave_count,
        .width = width,
        .height = height,
        .instant = -1,
        .parts_1 = parts[1],
        .parts_2 = parts[2],
        .sky_black = f->data.sky_black,
        .by_coverage = q->target_rmse > 0,
        .by_display = !f->data.sky_black && !(q->target_rmse > 0),
        .lights_dark = lights_dark(&f->data),
        .samples = q->samples > 0 ? (float)q->samples : 8,
        .target_rmse = (float)q->target_rmse,
        .target_displayed = (float)q->target_displayed,
        .seed_low = (int)(uint32_t)q->seed,
        .seed_high = (int)(uint32_t)(q->seed >> 32),
        .moves = f->scene->camera_moves,
    };
}

static mgt_status reserve_pictures(gl_renderer *g, const region *area, const reporter *r)
{
    gl_layers *l = &g->layers;
    mgt_status status = gl_image_reserve(&g->gl, &l->color, GL_RGBA32F, area->width, area->height, r);
    if (status == MGT_OK)
        status = gl_image_reserve(&g->gl, &l->coverage, GL_R32F, area->width, area->height, r);
    return status == MGT_OK ? gl_image_reserve(&g->gl, &l->water, GL_R32F, area->width, area->height, r) : status;
}

static mgt_status prepare(cells_run *c)
{
    const CellsData *d = &c->data;
    const size_t waves = c->frame->scene->water.wave_count;
    c->set_vectors = waves * (SET_WAVE_VECTORS + SET_SORT_VECTORS) + SET_VIEWS * SET_VIEW_VECTORS;
    c->most_parts = c->parts[1] > c->parts[2] ? c->parts[1] : c->parts[2];
    c->data.pool = pool_of(c);
    plan_lists(c);
    c->whole = gl_band_at(c->run, c->run->first_row);
    c->whole.pass.rows = d->rows;
    mgt_status status = reserve(c);
    if (status == MGT_OK)
        status = upload_frames(c);
    return status == MGT_OK ? upload_sets(c) : status;
}

mgt_status gl_cells_render(gl_renderer *g, const gl_job *job, const reporter *r)
{
    frame *const colored = &g->colored;
    *colored = *job->frame; /* errors are weighed by colour, even if no colour is asked for */
    colored->data.want_color = colored->through.want_color = 1;
    gl_job own = *job;
    own.frame = colored;
    gl_run run;
    cells_run c = {.run = &run, .g = g, .frame = colored};
    cell_part_counts(colored, c.parts);
    c.data = data_of(job, colored, c.parts);
    mgt_status status = reserve_pictures(g, &job->area, r);
    if (status == MGT_OK)
        status = gl_run_begin(&run, g, &own, 1, r);
    if (status != MGT_OK)
        return status;
    const int rounds = colored->scene->quality.target_rmse > 0 || colored->scene->quality.target_displayed > 0 ? MOST_ROUNDS : SAMPLE_ROUNDS;
    run.steps = (run.end_row - run.first_row + run.band_rows - 1) / run.band_rows + (double)rounds;
    status = prepare(&c);
    if (status == MGT_OK && run.objects)
        status = gl_prepare_objects(&run);
    if (status == MGT_OK)
        status = plant(&c);
    if (status == MGT_OK)
        status = refine(&c, rounds);
    if (status == MGT_OK)
        status = put_objects_in_front(&run);
    gl_run_end(&run);
    return status;
}
