/* SPDX-License-Identifier: MIT
 * The CPU backend: renders tiles in a thread pool, chooses the lanes that this processor runs, and writes targets and displayed colours. */
#define _POSIX_C_SOURCE 199309L
#include <errno.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cpu/cpu_state.h"
#include "frame/stars.h"
#include "cpu/glare.h"
#include "cpu/inspect.h"
#include "cpu/query_lanes.h"
#include "cpu/baseline_lanes.h"
#include "reference/reference.h"
#include "frame/targets.h"

/* ---- instruction sets ---- */

bool mgt_isa_available(mgt_isa isa)
{
    switch (isa) {
    case MGT_ISA_AUTO:
    case MGT_ISA_SCALAR:
        return true;
#if defined(__x86_64__)
    case MGT_ISA_SSE2:
        return true;
    case MGT_ISA_AVX2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case MGT_ISA_AVX512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
#elif defined(__aarch64__)
    case MGT_ISA_NEON:
        return true;
#endif
    default:
        return false;
    }
}

static const lane_kernels *kernels_of(mgt_isa isa)
{
    switch (isa) {
#if defined(__x86_64__)
    case MGT_ISA_AVX512:
        return &lane_kernels_16;
    case MGT_ISA_AVX2:
        return &lane_kernels_8;
#endif
    case MGT_ISA_SSE2:
    case MGT_ISA_NEON:
        return &lane_kernels_4;
    default:
        return &lane_kernels_1;
    }
}

static mgt_isa best_isa(void)
{
    static const mgt_isa order[] = {MGT_ISA_AVX512, MGT_ISA_AVX2, MGT_ISA_NEON, MGT_ISA_SSE2};
    for (size_t i = 0; i < sizeof order / sizeof *order; i++)
        if (mgt_isa_available(order[i]))
            return order[i];
    return MGT_ISA_SCALAR;
}

query_functions query_lanes(void)
{
    switch (best_isa()) {
#if defined(__x86_64__)
    case MGT_ISA_AVX512:
        return (query_functions){query_lanes_16, trace_lanes_16};
    case MGT_ISA_AVX2:
        return (query_functions){query_lanes_8, trace_lanes_8};
#endif
    case MGT_ISA_SSE2:
    case MGT_ISA_NEON:
        return (query_functions){query_lanes_4, trace_lanes_4};
    default:
        return (query_functions){query_lanes_1, trace_lanes_1};
    }
}

/* ---- context ---- */

static void cpu_destroy(void *state)
{
    cpu_state *s = state;
    if (!s)
        return;
    if (s->scratch)
        for (uint32_t i = 0; i < thread_pool_size(s->pool); i++)
            free(s->scratch[i]);
    free(s->scratch);
    thread_pool_destroy(s->pool);
    podee_tables_free(&s->podee);
    lean_map_free(s->lean);
    refinement_free(s->adaptive);
    refraction_free(s->objects);
    free(s->waves);
    sky_state_destroy(s->sky);
    free(s);
}

static bool allocate_scratch(cpu_state *s)
{
    const uint32_t workers = thread_pool_size(s->pool);
    s->scratch = calloc(workers, sizeof *s->scratch);
    for (uint32_t i = 0; s->scratch && i < workers; i++) {
        if (!(s->scratch[i] = calloc(1, sizeof *s->scratch[i])))
            return false;
        s->scratch[i]->worker = i;
    }
    return s->scratch != NULL;
}

static mgt_status cpu_create(void **state, const mgt_context_desc *desc, const reporter *r, mgt_context_info *info)
{
    if (!mgt_isa_available(desc->isa))
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.isa", "this processor or build does not run the instruction set asked for");
    cpu_state *s = calloc(1, sizeof *s);
    if (!s)
        return report_error(r, MGT_ERROR_MEMORY, "context.create", "out of memory");
    s->isa = desc->isa == MGT_ISA_AUTO ? best_isa() : desc->isa;
    s->kernels = kernels_of(s->isa);
    s->progress = desc->progress;
    s->progress_user = desc->progress_user;
    s->sky = sky_state_create();
    s->waves = calloc(1, sizeof *s->waves);
    s->pool = s->sky && s->waves ? thread_pool_create(desc->threads ? desc->threads : thread_pool_usable_cpus()) : NULL;
    if (!s->pool || !allocate_scratch(s)) {
        const mgt_status status = s->sky && s->waves && !s->pool && errno == EAGAIN ? MGT_ERROR_THREAD : MGT_ERROR_MEMORY;
        cpu_destroy(s);
        return report_error(r, status, "context.create", "%s", mgt_status_text(status));
    }
    info->backend = MGT_BACKEND_CPU;
    info->isa = s->isa;
    info->lanes = s->kernels->lanes;
    info->threads = thread_pool_size(s->pool);
    *state = s;
    return MGT_OK;
}

/* ---- one frame ---- */

typedef struct render_job {
    cpu_state *state;
    const mgt_scene *scene;
    frame *frame; /* the state's */
    tile_job tiles;
    tile_wants wants;
    region area; /* region that is rendered: the crop, or the whole image if there is glare */
    region crop; /* region that the targets hold */
    const mgt_target *targets;
    size_t target_count;
    float *radiance;                    /* area.width × area.height × 3 floats for glare; NULL: there is none */
    uint32_t first_x, first_y, columns; /* first block of the loop, and number of blocks in a row */
    uint32_t block_width, block_height;
    reference_frame *reference;
    atomic_bool cancelled;
    const frame_pass *pass; /* NULL: the picture is the whole frame */
    picture_sums sums;
    double fraction;  /* fraction done at the last report of progress; only the caller's thread uses it */
    double last_told; /* time of that report, seconds */
} render_job;

/* A rectangle of finished pixels in planes. */
typedef struct pixel_planes {
    const float *color[3]; /* red, green and blue */
    size_t color_step;     /* floats from pixel to pixel of `color` */
    const float *coverage, *water, *foam, *depth;
    const float *refraction[3], *error; /* NULL: zeros */
    const float *normal[3];
    size_t normal_step; /* floats from pixel to pixel of `normal` */
    size_t stride;      /* pixels from row to row */
} pixel_planes;

/* Writes up to TILE_WIDTH pixels of planes to a row of a target. They are packed first and copied together, because single floats written to distant rows would
 * each wait for memory. */
static void write_pixels(const float *const source[3], size_t step, size_t first, uint32_t count, size_t channels, float *out)
{
    float packed[4 * TILE_WIDTH];
    for (uint32_t x = 0; x < count; x++) {
        const size_t i = (first + x) * step;
        packed[channels * x] = source[0][i];
        packed[channels * x + 1] = source[1][i];
        packed[channels * x + 2] = source[2][i];
        if (channels == 4)
            packed[4 * x + 3] = 1;
    }
    memcpy(out, packed, channels * count * sizeof *out);
}

static void fill_row(float *out, uint32_t count, float value)
{
    for (uint32_t x = 0; x < count; x++)
        out[x] = value;
}

static void write_row(const render_job *job, const mgt_target *t, const pixel_planes *p, size_t first, uint32_t count, float *out)
{
    const size_t channels = t->format == MGT_FORMAT_RGBA32F ? 4 : 3;
    switch (t->layer) {
    case MGT_LAYER_COVERAGE:
        memcpy(out, p->coverage + first, count * sizeof *out);
        return;
    case MGT_LAYER_FOAM:
        memcpy(out, p->foam + first, count * sizeof *out);
        return;
    case MGT_LAYER_MASK:
        memcpy(out, p->water + first, count * sizeof *out);
        return;
    case MGT_LAYER_DEPTH:
        memcpy(out, p->depth + first, count * sizeof *out);
        return;
    case MGT_LAYER_COLOR:
        write_pixels(p->color, p->color_step, first, count, channels, out);
        return;
    case MGT_LAYER_NORMAL:
        write_pixels(p->normal, p->normal_step, first, count, channels, out);
        return;
    case MGT_LAYER_SAMPLES:
        fill_row(out, count, samples_per_pixel(&job->scene->quality));
        return;
    case MGT_LAYER_IMPORTANCE:
    case MGT_LAYER_DETAIL:
        fill_row(out, count, 0);
        return;
    case MGT_LAYER_REFRACTION_ERROR:
        if (p->error)
            memcpy(out, p->error + first, count * sizeof *out);
        else
            fill_row(out, count, 0);
        return;
    case MGT_LAYER_REFRACTION:
        if (p->error)
            write_pixels(p->refraction, 1, first, count, channels, out);
        else
            fill_row(out, (uint32_t)channels * count, 0);
        return;
    }
}

/* Writes the part of `block` that lies in the crop to every float target, and to displayed targets unless glare is still to be added. */
static void write_block(const render_job *job, const region *block, const pixel_planes *p)
{
    const region *crop = &job->crop;
    const uint32_t x0 = block->x > crop->x ? block->x : crop->x, y0 = block->y > crop->y ? block->y : crop->y;
    const uint32_t x1 = block->x + block->width < crop->x + crop->width ? block->x + block->width : crop->x + crop->width;
    const uint32_t y1 = block->y + block->height < crop->y + crop->height ? block->y + block->height : crop->y + crop->height;
    for (uint32_t y = y0; y < y1; y++)
        for (size_t k = 0; k < job->target_count && x0 < x1; k++) {
            const mgt_target *t = &job->targets[k];
            const size_t size = format_size(t->format), first = (y - block->y) * p->stride + x0 - block->x;
            char *row = (char *)target_row(t, crop, y - crop->y) + size * (x0 - crop->x);
            if (t->format != MGT_FORMAT_RGBA8_SRGB) {
                write_row(job, t, p, first, x1 - x0, (float *)(void *)row);
            } else if (!job->radiance) {
                float rgb[3 * TILE_WIDTH];
                write_pixels(p->color, p->color_step, first, x1 - x0, 3, rgb);
                job->state->kernels->display(&job->frame->data, rgb, (uint8_t *)row, x1 - x0);
            }
        }
}

static void keep_radiance(const render_job *job, const region *block, const pixel_planes *p)
{
    for (uint32_t y = 0; y < block->height; y++) {
        float *row = job->radiance + ((size_t)(block->y + y - job->area.y) * job->area.width + block->x - job->area.x) * 3;
        write_pixels(p->color, p->color_step, y * p->stride, block->width, 3, row);
    }
}

/* The block with this index, cut to the area. `offset` receives the place of the cut block within the whole one. */
static region block_of(const render_job *job, size_t index, uint32_t offset[2])
{
    const uint32_t left = (job->first_x + (uint32_t)(index % job->columns)) * job->block_width;
    const uint32_t top = (job->first_y + (uint32_t)(index / job->columns)) * job->block_height;
    const region *a = &job->area;
    region b = {left > a->x ? left : a->x, top > a->y ? top : a->y, 0, 0};
    const uint32_t right = left + job->block_width < a->x + a->width ? left + job->block_width : a->x + a->width;
    const uint32_t bottom = top + job->block_height < a->y + a->height ? top + job->block_height : a->y + a->height;
    b.width = right - b.x;
    b.height = bottom - b.y;
    offset[0] = b.x - left;
    offset[1] = b.y - top;
    return b;
}

static void render_tile(void *argument, size_t index, uint32_t worker)
{
    const render_job *job = argument;
    tile_scratch *s = job->state->scratch[worker];
    uint32_t offset[2];
    const region block = block_of(job, index, offset);
    tile_render(&job->tiles, job->first_x + (uint32_t)(index % job->columns), job->first_y + (uint32_t)(index / job->columns), s);
    const size_t at = (size_t)offset[1] * TILE_WIDTH + offset[0];
    const pixel_planes planes = {
        .color = {s->pixels.red + at, s->pixels.green + at, s->pixels.blue + at},
        .color_step = 1,
        .coverage = s->pixels.coverage + at,
        .water = s->pixels.water + at,
        .foam = s->pixels.foam + at,
        .depth = s->surface.along + at,
        .normal = {s->surface.normal_x + at, s->surface.normal_y + at, s->surface.normal_z + at},
        .normal_step = 1,
        .refraction = {s->objects.refraction[0] + at, s->objects.refraction[1] + at, s->objects.refraction[2] + at},
        .error = job->tiles.objects ? s->objects.error + at : NULL,
        .stride = TILE_WIDTH,
    };
    write_block(job, &block, &planes);
    if (job->radiance)
        keep_radiance(job, &block, &planes);
}

static void sum_tile(void *argument, size_t index, uint32_t worker)
{
    const render_job *job = argument;
    tile_render(&job->tiles, job->first_x + (uint32_t)(index % job->columns), job->first_y + (uint32_t)(index / job->columns), job->state->scratch[worker]);
}

/* Blocks are narrower if a pixel has many samples, see reference_block_width(), so that progress and cancelling stay prompt. */
enum { REFERENCE_WIDTH = 16, REFERENCE_HEIGHT = 4, REFERENCE_PIXELS = 1024 };

/* Blocks of quality.light_cells. Waves lift cells of the mean surface into other rows of the picture, so tall blocks evaluate few cells that lie outside of
 * them. */
enum { CELLS_WIDTH = 8, CELLS_HEIGHT = 128 };
_Static_assert(CELLS_WIDTH *CELLS_HEIGHT <= REFERENCE_PIXELS && REFERENCE_WIDTH * REFERENCE_HEIGHT <= REFERENCE_PIXELS, "blocks have room");

static uint32_t reference_block_width(const mgt_quality *q)
{
    const uint64_t samples = q->sample_count ? q->sample_count : quality_samples(q) - q->sample_first;
    return samples > 16384 ? 1 : samples > 2048 ? 4 : REFERENCE_WIDTH;
}

/* Index of the first word of the block's top left pixel in the sums of the crop. */
static size_t sums_place(const render_job *job, const region *block)
{
    return ((size_t)(block->y - job->crop.y) * job->crop.width + block->x - job->crop.x) * MGT_SUM_WORDS;
}

static void sum_reference_block(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const render_job *job = argument;
    uint32_t offset[2];
    const region b = block_of(job, index, offset);
    reference_sum_block(job->reference, b.x, b.y, b.width, b.height, job->sums.add + sums_place(job, &b), job->crop.width);
}

static void render_reference_block(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const render_job *job = argument;
    uint32_t offset[2];
    const region block = block_of(job, index, offset);
    float color[REFERENCE_PIXELS * 3], coverage[REFERENCE_PIXELS], mask[REFERENCE_PIXELS], foam[REFERENCE_PIXELS], depth[REFERENCE_PIXELS],
        normal[REFERENCE_PIXELS * 3];
    const bool pixels = job->wants.pixels, surface = job->wants.surface;
    const reference_result result = {.color = pixels && job->frame->data.want_color ? color : NULL,
                                     .coverage = pixels ? coverage : NULL,
                                     .mask = pixels ? mask : NULL,
                                     .foam = pixels ? foam : NULL,
                                     .depth = surface ? depth : NULL,
                                     .normal = surface ? normal : NULL,
                                     .sums = job->sums.show ? job->sums.show + sums_place(job, &block) : NULL,
                                     .sums_stride = job->crop.width};
    reference_render_block(job->reference, block.x, block.y, block.width, block.height, &result);
    const pixel_planes planes = {
        .color = {color, color + 1, color + 2},
        .color_step = 3,
        .coverage = coverage,
        .water = mask,
        .foam = foam,
        .depth = depth,
        .normal = {normal, normal + 1, normal + 2},
        .normal_step = 3,
        .stride = block.width,
    };
    write_block(job, &block, &planes);
    if (job->radiance)
        keep_radiance(job, &block, &planes);
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool forward_progress(void *argument, double fraction)
{
    render_job *job = argument;
    job->fraction = fraction;
    job->last_told = seconds();
    const double whole = job->pass ? job->pass->first + job->pass->share * fraction : fraction;
    if (!atomic_load(&job->cancelled) && !job->state->progress(job->state->progress_user, whole))
        atomic_store(&job->cancelled, true);
    return !atomic_load(&job->cancelled);
}

/* Called within a long tile. Worker 0 is the caller's thread, so it may call back. */
static bool keep_going(void *argument, uint32_t worker)
{
    render_job *job = argument;
    if (worker == 0 && seconds() - job->last_told >= 0.1)
        return forward_progress(job, job->fraction);
    return !atomic_load_explicit(&job->cancelled, memory_order_relaxed);
}

static bool run_loop(render_job *job, uint32_t block_width, uint32_t block_height, void (*body)(void *, size_t, uint32_t))
{
    const region *a = &job->area;
    job->block_width = block_width;
    job->block_height = block_height;
    job->first_x = a->x / block_width;
    job->first_y = a->y / block_height;
    job->columns = (a->x + a->width - 1) / block_width - job->first_x + 1;
    const uint32_t rows = (a->y + a->height - 1) / block_height - job->first_y + 1;
    const thread_loop loop = {(size_t)job->columns * rows, body, job, job->state->progress ? forward_progress : NULL};
    return thread_pool_run(job->state->pool, &loop);
}

/* ---- the reference ---- */

static void reference_lookup(const void *user, const double direction[3], double rgb[3]) { sky_lookup(user, direction, rgb); }

static void reference_air(const void *user, const double direction[3], double distance, double leaves[3], double light[3])
{
    sky_air_lookup(user, direction, distance, leaves, light);
}

_Static_assert((int)MGT_SUM_WORDS == (int)REFERENCE_SUM_WORDS, "sums are the reference's");

static void reference_stars(const void *user, const double direction[3], double pixel_angle, double rgb[3])
{
    const sky_state *sky = user;
    stars_lookup(sky->table, direction, pixel_angle, rgb);
}

_Static_assert((int)MAX_LIGHTS == (int)REFERENCE_LIGHTS, "the oracle has every light");

static mgt_status make_reference(render_job *job, const reporter *r)
{
    const sky_state *sky = job->state->sky;
    reference_sky rs = {.lookup = job->scene->sky.model == MGT_SKY_BLACK ? NULL : reference_lookup,
                        .air = sky_state_has_air(job->scene) ? reference_air : NULL,
                        .stars = job->frame->data.stars ? reference_stars : NULL,
                        .user = sky};
    sky_upwelling_radiance(sky, &job->scene->water, rs.body_radiance);
    for (int i = 0; i < lights_count(sky->lights); i++) {
        light_mean_radiance(lights_get(sky->lights, i), rs.disks[i]);
        rs.hidden[i] = 1 - light_visible_part(lights_get(sky->lights, i));
    }
    frame_foam_light(job->scene, sky, rs.foam_sky, rs.foam_beams);
    const reference_options options = {.isa = job->state->isa};
    const mgt_status status = reference_frame_create(&job->reference, job->scene, &rs, &options);
    return status == MGT_OK ? MGT_OK : report_error(r, status, "render.reference", "the reference frame: %s", mgt_status_text(status));
}

/* ---- display ---- */

static void display_row(void *argument, size_t row, uint32_t worker)
{
    (void)worker;
    const render_job *job = argument;
    const size_t y = row + job->crop.y - job->area.y;
    const float *rgb = job->radiance + (y * job->area.width + job->crop.x - job->area.x) * 3;
    for (size_t k = 0; k < job->target_count; k++)
        if (job->targets[k].format == MGT_FORMAT_RGBA8_SRGB)
            job->state->kernels->display(&job->frame->data, rgb, target_row(&job->targets[k], &job->crop, (uint32_t)row), job->crop.width);
}

static mgt_status display(render_job *job, const reporter *r)
{
    const mgt_status status =
        glare_apply(job->radiance, job->area.width, job->area.height, (size_t)job->area.width * 3, job->scene->post.glare, thread_pool_each, job->state->pool);
    if (status != MGT_OK)
        return report_error(r, status, "render.memory", "out of memory for the glare of %u x %u pixels", job->area.width, job->area.height);
    const thread_loop loop = {job->crop.height, display_row, job, NULL};
    thread_pool_run(job->state->pool, &loop);
    return MGT_OK;
}

/* ---- mgt_render ---- */

mgt_status cpu_prepare_sky(cpu_state *s, const reporter *r, const mgt_scene *scene)
{
    const bool same = sky_state_same_inputs(s->sky, &scene->sky, &scene->light);
    const mgt_status status = same ? MGT_OK : sky_state_build(s->sky, &scene->sky, &scene->light);
    if (status != MGT_OK)
        return report_error(r, status, "render.memory", "out of memory for the sky's tables");
    sky_state_see_air(s->sky, scene);
    return MGT_OK;
}

/* Builds the tables of podee-* once per context. They depend on neither lights nor frames. */
static mgt_status prepare_podee(cpu_state *s, const reporter *r, const mgt_scene *scene)
{
    const mgt_mixture k = scene->quality.kernels;
    if (!(method_of(scene->quality.method)->tables & METHOD_PODEE_TABLES) || k == MGT_MIXTURE_EXACT || k == MGT_MIXTURE_RIEMANN || s->podee.sweep ||
        podee_tables_build(&s->podee, thread_pool_each, s->pool))
        return MGT_OK;
    return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the 64 MiB of tables that quality.kernels needs");
}

/* Builds the map of slope moments of the frame's waves. */
static mgt_status prepare_lean(cpu_state *s, const reporter *r, const frame *f)
{
    if (!(method_of(f->scene->quality.method)->tables & METHOD_LEAN_MAP))
        return MGT_OK;
    if (!s->lean)
        s->lean = calloc(1, sizeof *s->lean);
    if (s->lean && lean_map_build(s->lean, f, s->kernels, s->pool))
        return MGT_OK;
    return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the 246 MiB of slope moments of methods lean and leadr");
}

static bool wants_layer(const mgt_target *targets, size_t count, mgt_layer first, mgt_layer last)
{
    for (size_t i = 0; i < count; i++)
        if (targets[i].layer >= first && targets[i].layer <= last)
            return true;
    return false;
}

static bool wants_glare(const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (targets[i].format == MGT_FORMAT_RGBA8_SRGB && scene->post.glare > 0)
            return true;
    return false;
}

mgt_status cpu_render_picture(cpu_state *s, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count, const frame_pass *pass,
                              picture_sums sums)
{
    mgt_status status = cpu_prepare_sky(s, r, scene);
    if (status != MGT_OK)
        return status;
    status = prepare_podee(s, r, scene);
    if (status != MGT_OK)
        return status;
    render_job job = {.state = s, .scene = scene, .targets = targets, .target_count = count, .pass = pass, .sums = sums, .frame = &s->frame};
    frame_make(scene, s->sky, sums.add || wants_layer(targets, count, MGT_LAYER_COLOR, MGT_LAYER_COLOR), job.frame);
    if (pass)
        job.frame->close = rays_above(job.frame, &pass->camera);
    status = prepare_lean(s, r, job.frame);
    if (status != MGT_OK)
        return status;
    job.wants.pixels = sums.add || wants_layer(targets, count, MGT_LAYER_COLOR, MGT_LAYER_MASK) || wants_layer(targets, count, MGT_LAYER_FOAM, MGT_LAYER_FOAM);
    job.wants.surface = wants_layer(targets, count, MGT_LAYER_DEPTH, MGT_LAYER_NORMAL);
    job.crop = job.area = image_region(&scene->image);
    if (wants_glare(scene, targets, count)) {
        job.area = (region){0, 0, scene->image.width, scene->image.height};
        job.radiance = malloc((size_t)job.area.width * job.area.height * 3 * sizeof *job.radiance);
        if (!job.radiance)
            return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for %u x %u pixels", job.area.width, job.area.height);
    }
    bool finished = false;
    if (method_of(scene->quality.method)->way == METHOD_REFERENCE) {
        status = make_reference(&job, r);
        if (status == MGT_OK) {
            const uint32_t width = reference_block_width(&scene->quality);
            if (scene->quality.light_cells > 0 && !sums.add)
                finished = run_loop(&job, CELLS_WIDTH, CELLS_HEIGHT, render_reference_block);
            else
                finished = run_loop(&job, width, width == REFERENCE_WIDTH ? REFERENCE_HEIGHT : 1, sums.add ? sum_reference_block : render_reference_block);
        }
        reference_frame_destroy(job.reference);
    } else {
        const bool objects = cpu_shows_objects(job.frame);
        frame_waves_build(job.frame, s->waves);
        if (objects)
            status = refraction_prepare(&s->objects, r, job.frame, s->sky, s->kernels, s->isa, s->pool);
        job.tiles = (tile_job){.frame = job.frame,
                               .waves = s->waves,
                               .kernels = s->kernels,
                               .sky = s->sky->table,
                               .podee = &s->podee,
                               .wants = job.wants,
                               .keep_going = s->progress ? keep_going : NULL,
                               .keep_going_argument = &job,
                               .lean = s->lean,
                               .objects = objects ? s->objects : NULL,
                               .behind = pass && pass->behind,
                               .sums = sums};
        if (status == MGT_OK)
            finished = run_loop(&job, TILE_WIDTH, TILE_HEIGHT, sums.add ? sum_tile : render_tile);
        if (objects && finished && !sums.add)
            refraction_report(s->objects, r);
    }
    if (status == MGT_OK && (!finished || atomic_load(&job.cancelled)))
        status = report_error(r, MGT_CANCELLED, "render.cancelled", "rendering was cancelled");
    if (status == MGT_OK && job.radiance)
        status = display(&job, r);
    free(job.radiance);
    return status;
}

/* ---- calls that only the CPU serves ---- */

mgt_status cpu_sum(void *state, const reporter *r, const mgt_scene *scene, uint64_t *sums)
{
    return cpu_render_summed(state, r, scene, NULL, 0, (picture_sums){.add = sums, .crop = image_region(&scene->image)});
}

mgt_status cpu_render_sums(void *state, const reporter *r, const mgt_scene *scene, const uint64_t *sums, const mgt_target *targets, size_t count)
{
    const region crop = image_region(&scene->image);
    if (wants_glare(scene, targets, count) && (crop.width != scene->image.width || crop.height != scene->image.height))
        return report_error(r, MGT_ERROR_UNSUPPORTED, "render.glare",
                            "the glare of displayed colour needs the sums of the whole picture, and these are of a crop");
    return cpu_render_summed(state, r, scene, targets, count, (picture_sums){.show = sums, .crop = crop});
}

mgt_status cpu_display(void *state, const reporter *r, const mgt_scene *scene, const float *radiance, const mgt_target *target)
{
    cpu_state *s = state;
    mgt_status status = cpu_prepare_sky(s, r, scene);
    if (status != MGT_OK)
        return status;
    render_job job = {.state = s, .scene = scene, .targets = target, .target_count = 1, .frame = &s->frame};
    frame_make(scene, s->sky, true, job.frame);
    job.crop = image_region(&scene->image);
    job.area = (region){0, 0, scene->image.width, scene->image.height};
    const size_t size = (size_t)job.area.width * job.area.height * 3 * sizeof *job.radiance;
    job.radiance = malloc(size);
    if (!job.radiance)
        return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for %u x %u pixels", job.area.width, job.area.height);
    memcpy(job.radiance, radiance, size);
    status = display(&job, r);
    free(job.radiance);
    return status;
}

mgt_status cpu_exposure(void *state, const reporter *r, const mgt_scene *scene, double *stops)
{
    const cpu_state *s = state;
    const mgt_status status = cpu_prepare_sky(state, r, scene);
    if (status == MGT_OK)
        *stops = frame_exposure(&scene->post, s->sky);
    return status;
}

mgt_status cpu_inspect(void *state, const reporter *r, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info)
{
    cpu_state *s = state;
    const mgt_status status = cpu_prepare_sky(s, r, scene);
    if (status != MGT_OK)
        return status;
    mgt_scene ours = *scene;
    ours.quality.method = MGT_METHOD_MANGATA;
    frame_make(&ours, s->sky, true, &s->frame);
    frame_waves_build(&s->frame, s->waves);
    inspect_pixel(&s->frame, s->waves, s->sky->table, x, y, s->scratch[0], info);
    return MGT_OK;
}

const backend_functions cpu_backend = {.create = cpu_create, .destroy = cpu_destroy, .render = cpu_render};
