/* SPDX-License-Identifier: MIT
 * Scheme podee of method adaptive on the GPU, as published: Podee et al., Adaptive Supersampling for Rendering Reflections on Water Surfaces
 * (docs/adaptive.md). slots_data.glsl describes the data of its passes.
 *
 * Only the GPU knows how many slots a band has. So the CPU submits the largest number of chunks of slots that the picture could need. The GPU writes the sizes
 * of these indirect dispatches, and chunks beyond the last slot are empty. */
#include <math.h>
#include <string.h>

#include "frame/podee_rules.h"
#include "gl/gl_frame.h"
#include "gl/gl_whole_frame.h"

/* Slots of a chunk, whose results fill 20 MiB. llvmpipe ends the loops of an invocation after 65,535 iterations, and all slots of a chunk may belong to one
 * task. */
enum { CHUNK_SLOTS = 1 << 20, CHUNK_SLOTS_SOFTWARE = 1 << 15 };

/* Chunks after which a band's uniform data are uploaded again, before the ring overwrites them. */
enum { RESEND = 500 };

/* Fraction of a picture's progress that the approximate picture makes. */
static const double approximate_fraction = 0.3;

typedef struct slots_run {
    gl_run run;
    SlotsData data;
    GLuint tile_columns, tile_rows;
} slots_run;

/* ---- uniform data of the passes ---- */

/* The largest float that is not above `value`. Every float that is above it is above `value`, too. */
static float float_below(double value)
{
    const float f = (float)value;
    return (double)f > value ? nextafterf(f, -1) : f;
}

/* Largest number of slots that a picture may have. */
static uint64_t most_slots(const mgt_quality *q, const region *area)
{
    return q->sample_slots ? q->sample_slots : (uint64_t)(podee_samples_of(q) * area->width * area->height) + 1;
}

static SlotsData slots_data_of(const gl_renderer *g, const gl_job *job, uint32_t columns, uint32_t rows)
{
    const mgt_scene *s = job->frame->scene;
    const podee_rules rules = podee_rules_of(&s->quality);
    const double samples = podee_samples_of(&s->quality);
    const int chunk = g->limits.software ? CHUNK_SLOTS_SOFTWARE : CHUNK_SLOTS;
    uint64_t bits;
    memcpy(&bits, &samples, sizeof bits);
    return (SlotsData){
        .width = (int)job->area.width,
        .height = (int)job->area.height,
        .columns = (int)columns,
        .tiles = (int)(columns * rows),
        .chunks = (int)((most_slots(&s->quality, &job->area) + (uint64_t)chunk - 1) / (uint64_t)chunk),
        .chunk_slots = chunk,
        .center = (float)rules.center,
        .center_low = (float)(rules.center - (double)(float)rules.center),
        .center_width = (float)rules.width,
        .threshold = float_below(rules.threshold),
        .samples_low = (int)(uint32_t)bits,
        .samples_high = (int)(uint32_t)(bits >> 32),
        .slots = (int)s->quality.sample_slots,
        .two_ends = s->shutter > 0 || s->camera_moves,
        .seed_low = (int)(uint32_t)s->quality.seed,
        .seed_high = (int)(uint32_t)(s->quality.seed >> 32),
    };
}

static mgt_status reserve(const slots_run *s)
{
    const gl_run *run = &s->run;
    gl_slots *b = &run->g->slots;
    const gl_api *gl = &run->g->gl;
    const size_t places = (size_t)run->columns * run->band_rows * TILE_PIXELS;
    mgt_status status = gl_buffer_reserve(gl, &b->plan, 16 * ((size_t)s->data.tiles + 2), 0, run->r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(gl, &b->tasks, 8 * places, 0, run->r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(gl, &b->values, SLOT_FLOATS * sizeof(float) * (places + (size_t)s->data.chunk_slots), 0, run->r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(gl, &b->commands, 16 * (size_t)s->data.chunks, 0, run->r);
    return status;
}

/* ---- passes ---- */

static void bind_layers(const gl_renderer *g)
{
    const gl_layers *l = &g->layers;
    const gl_image *const images[] = {&l->color, &l->coverage, &l->water, &l->samples, &l->importance, &l->detail};
    for (GLuint i = 0; i < sizeof images / sizeof *images; i++)
        gl_bind_image(g, IMAGE_COLOR + i, images[i], GL_READ_WRITE);
    gl_bind_texture(g, UNIT_SKY, g->sky_texture);
    gl_bind_texture(g, UNIT_SKYLINE, g->skyline_texture);
    gl_refraction_bind_light(g);
}

static void bind_storage(const gl_renderer *g)
{
    gl_bind_tiles(g);
    g->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_PLAN, g->slots.plan.name);
    g->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_TASKS, g->slots.tasks.name);
    g->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_SLOTS, g->slots.values.name);
    g->gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, g->slots.commands.name);
}

/* Makes a program current and uploads its uniform data. `pass` is that of a band, or NULL. */
static mgt_status use(const slots_run *s, gl_program program, const PassData *pass)
{
    gl_renderer *g = s->run.g;
    mgt_status status = gl_ring_begin(&g->gl, &g->ring, sizeof s->data + sizeof *pass, 2, s->run.r);
    if (status == MGT_OK)
        status = gl_use(g, program, s->run.r);
    if (status != MGT_OK)
        return status;
    gl_uniform(g, BIND_EXTRA, &s->data, sizeof s->data);
    if (pass)
        gl_uniform(g, BIND_PASS, pass, sizeof *pass);
    return MGT_OK;
}

static void wait_for_storage(const gl_renderer *g)
{
    g->gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

static mgt_status dispatch(const slots_run *s, gl_program program, const PassData *pass, GLuint columns, GLuint rows)
{
    const mgt_status status = use(s, program, pass);
    if (status == MGT_OK) {
        s->run.g->gl.DispatchCompute(columns, rows, 1);
        wait_for_storage(s->run.g);
    }
    return status;
}

/* Computes the importance of all pixels of the picture, and its prefix sum over the tiles. */
static mgt_status plan(const slots_run *s)
{
    gl_renderer *g = s->run.g;
    gl_pass_begin(g, "importance");
    bind_layers(g);
    bind_storage(g);
    mgt_status status = dispatch(s, PROGRAM_SLOTS_WEIGH, NULL, s->tile_columns, s->tile_rows);
    if (status == MGT_OK)
        status = dispatch(s, PROGRAM_SLOTS_SCAN, NULL, 1, 1);
    const mgt_status ended = gl_pass_end(g, s->run.r);
    return status == MGT_OK ? ended : status;
}

/* Sorts all waves for the band's tiles at both ends of the shutter, and searches first hits. The tiles of the opening are stored behind those of the
 * closing. */
static mgt_status prepare_ends(slots_run *s, const gl_band *b)
{
    const gl_run *run = &s->run;
    const frame *f = run->job->frame;
    mgt_status status = MGT_OK;
    if (s->data.two_ends) {
        wave_set_build(f, &f->open, (interval){f->scene->time - f->scene->shutter, 0}, false, run->g->waves);
        status = gl_sort_tiles(&f->data, run, b, b->tiles, 0);
    }
    wave_set_build(f, &f->close, (interval){f->scene->time, 0}, false, run->g->waves);
    s->data.moving_waves = sines_moving(run->g->waves);
    if (status == MGT_OK)
        status = gl_sort_tiles(&f->data, run, b, 0, 0);
    return status == MGT_OK ? gl_search_nodes(run, s->data.two_ends ? 2 * b->tiles : b->tiles) : status;
}

/* Lists the tasks of the band's tiles and writes the sizes of its chunks. */
static mgt_status list_tasks(const slots_run *s, const gl_band *b)
{
    gl_renderer *g = s->run.g;
    gl_pass_begin(g, "importance");
    bind_layers(g);
    bind_storage(g);
    mgt_status status = dispatch(s, PROGRAM_SLOTS_LIST, NULL, b->tiles + 1, 1);
    g->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_TILES, g->slots.commands.name);
    if (status == MGT_OK)
        status = dispatch(s, PROGRAM_SLOTS_CHUNKS, NULL, 1, 1);
    const mgt_status ended = gl_pass_end(g, s->run.r);
    return status == MGT_OK ? ended : status;
}

/* Traces the slots of a chunk and adds their results to their tasks. */
static mgt_status render_chunk(const slots_run *s, const gl_band *b)
{
    gl_renderer *g = s->run.g;
    gl_pass_begin(g, "slots");
    bind_layers(g);
    bind_storage(g);
    mgt_status status = use(s, PROGRAM_SLOTS_TRACE, &b->pass);
    if (status == MGT_OK) {
        g->gl.DispatchComputeIndirect(16 * (GLintptr)s->data.chunk);
        wait_for_storage(g);
        status = dispatch(s, PROGRAM_SLOTS_SUM, NULL, b->tiles, 1);
    }
    const mgt_status ended = gl_pass_end(g, s->run.r);
    return status == MGT_OK ? ended : status;
}

/* Blends the means of the band's tasks into the layers. */
static mgt_status blend_tasks(const slots_run *s, const gl_band *b)
{
    gl_renderer *g = s->run.g;
    gl_pass_begin(g, "blend");
    bind_layers(g);
    bind_storage(g);
    const mgt_status status = dispatch(s, PROGRAM_SLOTS_BLEND, &b->pass, b->tiles, 1);
    g->gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    const mgt_status ended = gl_pass_end(g, s->run.r);
    return status == MGT_OK ? ended : status;
}

/* ---- a picture ---- */

static mgt_status render_band(slots_run *s, const gl_band *b)
{
    s->data.first_tile = b->pass.tile_y * b->pass.columns;
    s->data.band_tiles = (int)b->tiles;
    mgt_status status = prepare_ends(s, b);
    if (status == MGT_OK)
        status = list_tasks(s, b);
    for (s->data.chunk = 0; s->data.chunk < s->data.chunks && status == MGT_OK; s->data.chunk++) {
        if (s->data.chunk > 0 && s->data.chunk % RESEND == 0)
            status = prepare_ends(s, b);
        if (status == MGT_OK)
            status = render_chunk(s, b);
        if (status == MGT_OK)
            status = gl_step_done(&s->run, 1);
    }
    if (status == MGT_OK)
        status = blend_tasks(s, b);
    return status == MGT_OK && s->run.objects ? gl_put_objects_in_front(&s->run, b) : status;
}

/* Renders the approximate picture by method podee-uniform into the layers. */
static mgt_status render_approximate(gl_renderer *g, const gl_job *job, const reporter *r)
{
    gl_plain_frame *const plain = &g->plain;
    gl_plain_frame_of(job->frame, MGT_METHOD_PODEE_UNIFORM, plain);
    gl_progress_part part = gl_progress_part_of(job, 0, approximate_fraction);
    gl_job own = gl_job_of_part(job, &plain->frame, &part);
    own.wants_depth = own.wants_normal = false;
    own.behind = true;
    return gl_frame_render(g, &own, r);
}

mgt_status gl_adaptive_podee_render(gl_renderer *g, const gl_job *job, const reporter *r)
{
    mgt_status status = render_approximate(g, job, r);
    if (status != MGT_OK)
        return status;
    gl_progress_part part = gl_progress_part_of(job, approximate_fraction, 1 - approximate_fraction);
    const gl_job own = gl_job_of_part(job, job->frame, &part);
    slots_run s = {.tile_columns = (job->area.width + TILE_WIDTH - 1) / TILE_WIDTH, .tile_rows = (job->area.height + TILE_HEIGHT - 1) / TILE_HEIGHT};
    s.data = slots_data_of(g, job, s.tile_columns, s.tile_rows);
    status = gl_run_begin(&s.run, g, &own, s.data.two_ends ? 2 : 1, r);
    if (status == MGT_OK)
        status = reserve(&s);
    if (status == MGT_OK)
        status = plan(&s);
    if (status != MGT_OK)
        return status;
    const uint32_t bands = (s.run.end_row - s.run.first_row + s.run.band_rows - 1) / s.run.band_rows;
    s.run.steps = (double)bands * s.data.chunks;
    for (uint32_t row = s.run.first_row; row < s.run.end_row && status == MGT_OK; row += s.run.band_rows) {
        const gl_band b = gl_band_at(&s.run, row);
        status = render_band(&s, &b);
    }
    gl_run_end(&s.run);
    return status;
}

void gl_adaptive_podee_free(gl_renderer *g)
{
    gl_buffer *const buffers[] = {&g->slots.plan, &g->slots.tasks, &g->slots.values, &g->slots.commands};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        gl_buffer_free(&g->gl, buffers[i]);
}
