/* SPDX-License-Identifier: MIT
 * A frame on the GPU: bands of tiles, and the passes over each band.
 *
 * A set of waves is the waves at an instant or over a shutter interval, as one camera sees them. The set is sorted for the tiles of a band. Then the tiles'
 * lattices of first hits are searched, and a method shades the band's pixels. The next set uses the same memory. */
#include <string.h>

#include "frame/frame_waves.h"
#include "frame/skyline.h"
#include "frame/targets.h"
#include "frame/whole_frame.h"
#include "gl/gl_frame.h"

/* Memory of a band's wave lists, bytes, unless a single row of tiles needs more. Bands are large because a GPU waits at the end of each one for its slowest
 * tile. */
static const size_t band_bytes = (size_t)256 << 20, software_band_bytes = (size_t)64 << 20;

/* Number of point samples up to which a dispatch takes more than one of each pixel, and largest number of pixels of a band if progress is reported. It keeps
 * progress and cancelling prompt. */
static const uint64_t prompt_samples = (uint64_t)1 << 20;

/* Whether each tile is needed for two cameras, those at both ends of the shutter. */
static bool needs_open(const frame *f)
{
    return f->scene->camera_moves && !frame_from_middle(f) && method_of(f->scene->quality.method)->properties.waves == MGT_WAVES_SHUTTER;
}

/* ---- memory ---- */

static uint32_t least(uint64_t a, uint64_t b) { return (uint32_t)(a < b ? a : b); }

/* Divides the picture into bands and reserves the lists of a band. */
static mgt_status reserve_tiles(gl_run *run, size_t sets)
{
    gl_renderer *g = run->g;
    const frame *f = run->job->frame;
    const region *a = &run->job->area;
    run->first_column = a->x / TILE_WIDTH;
    run->columns = (a->x + a->width - 1) / TILE_WIDTH - run->first_column + 1;
    run->first_row = a->y / TILE_HEIGHT;
    run->end_row = (a->y + a->height - 1) / TILE_HEIGHT + 1;
    const size_t waves = f->scene->water.wave_count;
    run->wave_stride = (int)(waves > 0 ? waves : 1);
    const size_t hit_bytes = TILE_FLOATS(f->data.hit_rows) * sizeof(float);
    const size_t tile_bytes = sizeof(TileData) + hit_bytes + (size_t)run->wave_stride * (sizeof(TileWave) + sizeof(SearchWave));
    const size_t row_bytes = run->columns * sets * tile_bytes;
    uint64_t rows = (g->limits.software ? software_band_bytes : band_bytes) / row_bytes;
    if (run->job->progress)
        rows = rows < prompt_samples / ((uint64_t)run->columns * TILE_PIXELS) ? rows : prompt_samples / ((uint64_t)run->columns * TILE_PIXELS);
    if (run->objects && rows > REFRACTION_PIXELS / ((uint64_t)run->columns * TILE_PIXELS))
        rows = REFRACTION_PIXELS / ((uint64_t)run->columns * TILE_PIXELS);
    run->band_rows = least(rows > 0 ? rows : 1, run->end_row - run->first_row);

    const size_t tiles = (size_t)run->columns * run->band_rows * sets;
    const gl_api *gl = &g->gl;
    mgt_status status = gl_buffer_reserve(gl, &g->tiles, tiles * sizeof(TileData), 0, run->r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(gl, &g->tile_waves, tiles * (size_t)run->wave_stride * sizeof(TileWave), 0, run->r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(gl, &g->search_waves, tiles * (size_t)run->wave_stride * sizeof(SearchWave), 0, run->r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(gl, &g->nodes, tiles * hit_bytes, 0, run->r);
    return status;
}

/* Whether pixels are shaded. That also finds the foam. */
static bool shades_pixels(const gl_job *job) { return job->wants_pixels || job->wants_foam; }

static mgt_status check_size(const gl_renderer *g, const region *area, const reporter *r)
{
    if (area->width <= g->limits.texture_side && area->height <= g->limits.texture_side)
        return MGT_OK;
    return report_error(r, MGT_ERROR_UNSUPPORTED, "render.size",
                        "%u x %u pixels are more than this OpenGL's textures hold: %u a side; render a crop or use the CPU", area->width, area->height,
                        g->limits.texture_side);
}

static mgt_status reserve_layers(gl_renderer *g, const gl_job *job, const reporter *r)
{
    gl_layers *l = &g->layers;
    const region *a = &job->area;
    mgt_status status = MGT_OK;
    const bool shades = shades_pixels(job);
    if (shades && job->frame->data.want_color)
        status = gl_image_reserve(&g->gl, &l->color, GL_RGBA32F, a->width, a->height, r);
    if (status == MGT_OK && shades)
        status = gl_image_reserve(&g->gl, &l->coverage, GL_R32F, a->width, a->height, r);
    if (status == MGT_OK && shades)
        status = gl_image_reserve(&g->gl, &l->water, GL_R32F, a->width, a->height, r);
    if (status == MGT_OK && job->wants_depth)
        status = gl_image_reserve(&g->gl, &l->depth, GL_R32F, a->width, a->height, r);
    if (status == MGT_OK && job->wants_normal)
        status = gl_image_reserve(&g->gl, &l->normal, GL_RGBA32F, a->width, a->height, r);
    if (status == MGT_OK && job->wants_foam)
        status = gl_image_reserve(&g->gl, &l->foam, GL_R32F, a->width, a->height, r);
    if (status == MGT_OK && job->wants_foam) /* programs for water without foam do not write the layer */
        g->gl.ClearTexImage(l->foam.name, 0, GL_RED, GL_FLOAT, NULL);
    return status;
}

/* ---- a set of waves ---- */

/* Finds the skyline of a camera and uploads it to a row of the texture. It is found once per run, because that takes the CPU long. */
static void find_skyline(gl_run *run, const camera_rays *camera, interval time, int row)
{
    gl_renderer *g = run->g;
    if (!skyline_may_stand(run->job->frame, camera))
        return;
    wave_set_build(run->job->frame, camera, time, true, g->waves);
    if (g->waves->view.skyline == SKYLINE_NONE)
        return;
    run->crests[row] = g->waves->view.skyline_top;
    g->gl.TextureSubImage2D(g->skyline_texture, 0, 0, row, SKYLINE_MOST, 1, GL_RG, GL_FLOAT, g->waves->skyline);
}

static void find_skylines(gl_run *run)
{
    const frame *f = run->job->frame;
    find_skyline(run, &f->close, frame_shutter(f), 0);
    if (needs_open(f))
        find_skyline(run, &f->open, (interval){f->scene->time - f->scene->shutter, 0}, 1);
}

static void set_skyline(const gl_run *run, bool opens)
{
    ViewData *view = &run->g->waves->view;
    view->skyline_top = run->crests[opens];
    view->skyline = view->skyline_top > 0 ? 1 + opens : SKYLINE_NONE;
}

void gl_place_waves(const gl_run *run, const camera_rays *camera, interval time, bool opens)
{
    wave_set_place(run->job->frame, camera, time, true, run->g->waves);
    set_skyline(run, opens);
}

static camera_rays camera_of(const gl_run *run, double share)
{
    const gl_job *job = run->job;
    return share >= 1 ? job->frame->close : share <= 0 ? job->frame->open : job->camera_at(job->camera_user, share);
}

void gl_place_sweep(const gl_run *run, double from, double to)
{
    const camera_rays open = camera_of(run, from), close = camera_of(run, to);
    wave_set_sweep(run->job->frame, &open, &close, from, to, run->g->waves);
    set_skyline(run, false);
}

/* Size of the uniform data of all passes over one set. They stay valid until the set after the next one. */
static size_t set_bytes(const gl_renderer *g)
{
    const size_t waves = gl_wave_room(g, (size_t)g->waves->view.wave_count);
    return sizeof(FrameData) + waves * (sizeof(WaveData) + sizeof(SortData)) + sizeof(ViewData) + 3 * sizeof(PassData) + sizeof(LeanData) + sizeof(foam_set);
}

enum { SET_PARTS = 9 }; /* number of allocations of these data */

void gl_bind_tiles(const gl_renderer *g)
{
    const GLuint buffers[] = {g->tiles.name, g->tile_waves.name, g->search_waves.name, g->nodes.name};
    for (GLuint i = 0; i < sizeof buffers / sizeof *buffers; i++)
        g->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_TILES + i, buffers[i]);
}

static void upload_waves(gl_renderer *g)
{
    const wave_set *set = g->waves;
    const size_t count = (size_t)set->view.wave_count;
    size_t offset;
    const size_t room = gl_wave_room(g, count);
    memcpy(gl_ring_allocate(&g->ring, room * sizeof(WaveData), &offset), set->data, count * sizeof(WaveData));
    const GLenum block = g->waves_in_block ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER;
    g->gl.BindBufferRange(block, g->waves_in_block ? BIND_UNIFORM_WAVES : BIND_WAVES, g->ring.buffer, (GLintptr)offset, (GLsizeiptr)(room * sizeof(WaveData)));
    SortData *sort = gl_ring_allocate(&g->ring, room * sizeof(SortData), &offset);
    sines_sort_data(set, sort);
    g->gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, BIND_SORT, g->ring.buffer, (GLintptr)offset, (GLsizeiptr)(room * sizeof(SortData)));
    gl_uniform(g, BIND_EXTRA, &set->view, sizeof set->view);
    if (!set->has_foam)
        return;
    const size_t foam = foam_set_bytes(&set->foam);
    memcpy(gl_ring_allocate(&g->ring, foam, &offset), &set->foam, foam);
    g->gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, BIND_FOAM, g->ring.buffer, (GLintptr)offset, (GLsizeiptr)foam);
}

mgt_status gl_sort_tiles(const FrameData *data, const gl_run *run, const gl_band *b, uint32_t first_slot, uint32_t open_slots)
{
    gl_renderer *g = run->g;
    mgt_status status = gl_ring_begin(&g->gl, &g->ring, set_bytes(g), SET_PARTS, run->r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "tiles");
    PassData pass = b->pass;
    pass.first_slot = (int)first_slot;
    pass.open_slots = (int)open_slots;
    gl_uniform(g, BIND_FRAME, data, sizeof *data);
    gl_uniform(g, BIND_PASS, &pass, sizeof pass);
    upload_waves(g);
    gl_bind_tiles(g);
    status = gl_use(g, PROGRAM_TILES, run->r);
    if (status == MGT_OK) {
        g->gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        g->gl.DispatchCompute((GLuint)pass.columns, (GLuint)pass.rows, 1);
        g->gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    const mgt_status ended = gl_pass_end(g, run->r);
    return status == MGT_OK ? ended : status;
}

static mgt_status sort_tiles(const gl_run *run, const gl_band *b, uint32_t first_slot, uint32_t open_slots)
{
    return gl_sort_tiles(&run->job->frame->data, run, b, first_slot, open_slots);
}

mgt_status gl_search_nodes(const gl_run *run, uint32_t tiles)
{
    gl_renderer *g = run->g;
    gl_pass_begin(g, "nodes");
    const mgt_status status = gl_use(g, PROGRAM_NODES, run->r);
    if (status == MGT_OK) {
        gl_bind_texture(g, UNIT_SKYLINE, g->skyline_texture);
        g->gl.DispatchCompute(tiles, WALK_PARTS, 1);
        g->gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    const mgt_status ended = gl_pass_end(g, run->r);
    return status == MGT_OK ? ended : status;
}

/* Sorts the waves of g->waves for the band's tiles and searches their lattices. */
static mgt_status prepare_set(const gl_run *run, const gl_band *b)
{
    const mgt_status status = sort_tiles(run, b, 0, 0);
    return status == MGT_OK ? gl_search_nodes(run, b->tiles) : status;
}

static void bind_layers(const gl_renderer *g)
{
    const gl_layers *l = &g->layers;
    const gl_image *const images[IMAGE_LAYERS] = {&l->color, &l->coverage, &l->water, &l->depth, &l->normal};
    for (GLuint i = 0; i < IMAGE_LAYERS; i++)
        gl_bind_image(g, i, images[i], GL_READ_WRITE);
    gl_bind_image(g, IMAGE_FOAM, &l->foam, GL_READ_WRITE);
    gl_bind_texture(g, UNIT_SKY, g->sky_texture);
    gl_bind_texture(g, UNIT_SKYLINE, g->skyline_texture);
}

/* Whether the pass is the variant of podee-* for circular kernels, not the closed form. */
static bool uses_podee_tables(const gl_run *run)
{
    return run->method->tables & METHOD_PODEE_TABLES && run->job->frame->scene->quality.kernels != MGT_MIXTURE_EXACT;
}

static void bind_tables(const gl_run *run)
{
    gl_refraction_bind_light(run->g);
    if (uses_podee_tables(run))
        gl_podee_bind(run->g);
    if (run->method->tables & METHOD_LEAN_MAP)
        gl_lean_bind(run->g);
}

/* Runs a program over the pixels of a band. */
static mgt_status run_pixels(const gl_run *run, const PassData *pass, const char *name, gl_program program)
{
    gl_renderer *g = run->g;
    gl_pass_begin(g, name);
    const mgt_status status = gl_use(g, program, run->r);
    if (status == MGT_OK) {
        gl_uniform(g, BIND_PASS, pass, sizeof *pass);
        bind_layers(g);
        if (program == run->program)
            bind_tables(run);
        else
            gl_refraction_bind_light(g);
        g->gl.DispatchCompute((GLuint)pass->columns, (GLuint)pass->rows * GROUPS_A_TILE, 1);
        g->gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    }
    const mgt_status ended = gl_pass_end(g, run->r);
    return status == MGT_OK ? ended : status;
}

/* ---- progress ---- */

mgt_status gl_step_done(gl_run *run, double steps)
{
    const gl_job *job = run->job;
    const gl_api *gl = &run->g->gl;
    run->done += steps;
    if (!job->progress)
        return MGT_OK;
    if (run->behind) {
        const GLuint64 tenth = 100000000;
        while (gl->ClientWaitSync(run->behind, GL_SYNC_FLUSH_COMMANDS_BIT, tenth) == GL_TIMEOUT_EXPIRED)
            if (gl->GetGraphicsResetStatus() != GL_NO_ERROR)
                break;
        gl->DeleteSync(run->behind);
    }
    run->behind = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    const double fraction = run->done / run->steps;
    if (!job->progress(job->progress_user, fraction < 1 ? fraction : 1))
        return report_error(run->r, MGT_CANCELLED, "render.cancelled", "rendering was cancelled");
    return MGT_OK;
}

/* ---- methods ---- */

/* Prepares the band's tiles for the part of the shutter between its fractions `from` and `to`. If the camera moves, it does so for the cameras at both ends, or
 * for that in the middle of its way. The part from 1 to 1 is the instant at which the shutter closes. */
static mgt_status prepare_part(const gl_run *run, const gl_band *b, double from, double to)
{
    const frame *f = run->job->frame;
    const bool both = needs_open(f);
    mgt_status status = MGT_OK;
    if (frame_from_middle(f)) {
        gl_place_sweep(run, from, to);
    } else {
        const camera_rays close = camera_of(run, to);
        if (both) {
            const camera_rays open = camera_of(run, from);
            gl_place_waves(run, &open, frame_part(f, from, from), true);
            status = sort_tiles(run, b, b->tiles, 0);
        }
        gl_place_waves(run, &close, both ? frame_part(f, to, to) : frame_part(f, from, to), false);
    }
    if (status == MGT_OK)
        status = sort_tiles(run, b, 0, both ? b->tiles : 0);
    return status == MGT_OK ? gl_search_nodes(run, both ? 2 * b->tiles : b->tiles) : status;
}

/* Number of parts of the shutter: podee-* may be asked for several, and a moving camera has CAMERA_PARTS for methods that see it from the middle of its way. */
static uint32_t parts_of(const frame *f)
{
    const mgt_quality *q = &f->scene->quality;
    return q->path_segments > 1 ? q->path_segments : frame_from_middle(f) ? CAMERA_PARTS : 1;
}

/* Shades a band by a filtered method: the mean over the parts of the shutter. */
static mgt_status render_filtered(gl_run *run, const gl_band *b)
{
    const uint32_t parts = parts_of(run->job->frame);
    mgt_status status = MGT_OK;
    for (uint32_t i = 0; i < parts && status == MGT_OK; i++) {
        const double from = run->waves == MGT_WAVES_INSTANT ? 1 : (double)i / parts;
        status = prepare_part(run, b, from, (double)(i + 1) / parts);
        PassData pass = b->pass;
        pass.clear = i == 0;
        pass.weight = 1.0f / (float)parts;
        pass.write_depth = run->job->shaded_depth && i + 1 == parts;
        pass.open_slots = needs_open(run->job->frame) ? (int)b->tiles : 0;
        if (status == MGT_OK)
            status = run_pixels(run, &pass, "shade", run->program);
        if (status == MGT_OK)
            status = gl_step_done(run, 1);
    }
    return status;
}

/* Shades a band at the centre of each pixel, at the instant at which the shutter closes. */
static mgt_status render_centre(gl_run *run, const gl_band *b)
{
    const frame *f = run->job->frame;
    wave_set_build(f, &f->close, (interval){f->scene->time, 0}, false, run->g->waves);
    mgt_status status = prepare_set(run, b);
    PassData pass = b->pass;
    pass.clear = 1;
    pass.weight = 1;
    pass.strata = 1;
    if (status == MGT_OK)
        status = run_pixels(run, &pass, "samples", run->program);
    return status == MGT_OK ? gl_step_done(run, 1) : status;
}

/* Dispatches after which a set's uniform data are uploaded again, before the ring overwrites them. */
enum { resend = 1000 };

/* Adds the samples [from, end) of one instant, in short dispatches: see prompt_samples. The instant's tiles must be ready. */
static mgt_status run_samples(gl_run *run, const gl_band *b, uint64_t from, uint64_t end)
{
    const mgt_quality *q = &run->job->frame->scene->quality;
    const uint64_t per_time = (uint64_t)q->spatial_samples * q->spatial_samples;
    const uint64_t all = q->sample_count ? q->sample_count : per_time * q->time_samples - q->sample_first;
    const uint64_t pixels = (uint64_t)b->tiles * TILE_PIXELS;
    /* llvmpipe ends the loops of an invocation after 65,535 iterations in all, which many samples would reach. */
    const uint64_t most = pixels < prompt_samples && !run->g->limits.software ? prompt_samples / pixels : 1;
    mgt_status status = MGT_OK;
    for (int sent = 1; from < end && status == MGT_OK; sent++) {
        if (sent % resend == 0)
            status = prepare_set(run, b);
        const uint64_t count = end - from < most ? end - from : most;
        PassData pass = b->pass;
        pass.sample_first_low = (int)(uint32_t)from;
        pass.sample_first_high = (int)(uint32_t)(from >> 32);
        pass.sample_count = (int)count;
        pass.stratum_first = (int)(from % per_time);
        pass.strata = (int)q->spatial_samples;
        pass.weight = 1.0f / (float)all;
        pass.seed_low = (int)(uint32_t)q->seed;
        pass.seed_high = (int)(uint32_t)(q->seed >> 32);
        pass.clear = from == q->sample_first;
        if (status == MGT_OK)
            status = gl_ring_begin(&run->g->gl, &run->g->ring, sizeof pass, 1, run->r);
        if (status == MGT_OK)
            status = run_pixels(run, &pass, "samples", run->program);
        from += count;
        if (status == MGT_OK)
            status = gl_step_done(run, (double)count);
    }
    return status;
}

/* Shades a band by point samples, one instant after another. */
static mgt_status render_samples(gl_run *run, const gl_band *b)
{
    const gl_job *job = run->job;
    const frame *f = job->frame;
    const mgt_quality *q = &f->scene->quality;
    const uint64_t per_time = (uint64_t)q->spatial_samples * q->spatial_samples;
    const uint64_t end = q->sample_count ? q->sample_first + q->sample_count : per_time * q->time_samples;
    mgt_status status = MGT_OK;
    for (uint64_t sample = q->sample_first; sample < end && status == MGT_OK;) {
        const uint64_t m = sample / per_time, next = (m + 1) * per_time < end ? (m + 1) * per_time : end;
        const double share = shutter_fraction(q, m);
        const camera_rays camera = job->camera_at(job->camera_user, share);
        wave_set_build(f, &camera, (interval){f->scene->time - (1 - share) * f->scene->shutter, 0}, false, run->g->waves);
        status = prepare_set(run, b);
        if (status == MGT_OK)
            status = run_samples(run, b, sample, next);
        sample = next;
    }
    return status;
}

/* Renders depth and normal at the instant at which the shutter closes. `ready`: the tiles hold the waves of that instant for point samples already. */
static mgt_status render_surface(gl_run *run, const gl_band *b, bool ready)
{
    const frame *f = run->job->frame;
    const interval now = {f->scene->time, 0};
    mgt_status status = MGT_OK;
    if (!ready) {
        wave_set_build(f, &f->close, now, false, run->g->waves);
        status = prepare_set(run, b);
    }
    if (status == MGT_OK)
        status = run_pixels(run, &b->pass, "surface", PROGRAM_SURFACE);
    if (status != MGT_OK || !run->job->wants_normal || run->waves == MGT_WAVES_POINT)
        return status;
    gl_place_waves(run, &f->close, now, false);
    status = prepare_set(run, b);
    if (status == MGT_OK)
        status = run_pixels(run, &b->pass, "surface", PROGRAM_NORMAL);
    return status;
}

/* Finds what the band's pixels see of objects from a camera, with the filtered waves over `time`. */
static mgt_status see_objects(const gl_run *run, const gl_band *b, const camera_rays *camera, interval time)
{
    wave_set_place(run->job->frame, camera, time, true, run->g->waves);
    mgt_status status = gl_sort_tiles(&run->job->frame->through, run, b, 0, 0);
    if (status == MGT_OK)
        status = gl_search_nodes(run, b->tiles);
    return status == MGT_OK ? gl_refraction_see(run->g, &b->pass, run->r) : status;
}

mgt_status gl_see_band(const gl_run *run, const gl_band *b)
{
    const frame *f = run->job->frame;
    mgt_status status = run->objects ? see_objects(run, b, &f->close, frame_shutter(f)) : MGT_OK;
    if (status == MGT_OK && run->objects && f->scene->camera_moves)
        status = gl_refraction_blend(run->g, &b->pass, run->r);
    return status;
}

mgt_status gl_put_objects_in_front(const gl_run *run, const gl_band *b)
{
    gl_renderer *g = run->g;
    mgt_status status = gl_ring_begin(&g->gl, &g->ring, sizeof b->pass, 1, run->r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "refraction");
    status = gl_use(g, PROGRAM_OBJECTS_COMPOSE, run->r);
    if (status == MGT_OK) {
        gl_uniform(g, BIND_PASS, &b->pass, sizeof b->pass);
        bind_layers(g);
        for (GLuint i = IMAGE_COLOR; i <= IMAGE_WATER && !shades_pixels(run->job); i++) /* another picture of the frame has finished these layers */
            g->gl.BindImageTexture(i, 0, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
        gl_refraction_bind_front(g);
        g->gl.DispatchCompute((GLuint)b->pass.columns, (GLuint)b->pass.rows * GROUPS_A_TILE, 1);
        g->gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    }
    const mgt_status ended = gl_pass_end(g, run->r);
    return status == MGT_OK ? ended : status;
}

gl_band gl_band_at(const gl_run *run, uint32_t row)
{
    const gl_job *job = run->job;
    const uint32_t rows = least(run->band_rows, run->end_row - row);
    return (gl_band){
        .pass =
            {
                .tile_x = (int)run->first_column,
                .tile_y = (int)row,
                .columns = (int)run->columns,
                .rows = (int)rows,
                .area_x = (int)job->area.x,
                .area_y = (int)job->area.y,
                .area_width = (int)job->area.width,
                .area_height = (int)job->area.height,
                .wave_count = (int)job->frame->scene->water.wave_count,
                .wave_stride = run->wave_stride,
                .show_background = job->background,
                .objects = run->objects,
                .front_shows = !job->background,
                .write_foam = job->wants_foam,
                .under = job->frame->under,
            },
        .tiles = run->columns * rows,
    };
}

static mgt_status render_band(gl_run *run, uint32_t row)
{
    const gl_job *job = run->job;
    const bool samples = run->method->way == METHOD_SAMPLES;
    const gl_band b = gl_band_at(run, row);
    mgt_status status = gl_see_band(run, &b);
    const bool points = run->waves == MGT_WAVES_POINT;
    if (status == MGT_OK && shades_pixels(job))
        status = !points ? render_filtered(run, &b) : samples ? render_samples(run, &b) : render_centre(run, &b);
    const bool depth = job->wants_depth && (points || !job->shaded_depth);
    if (status == MGT_OK && (depth || job->wants_normal))
        status = render_surface(run, &b, shades_pixels(job) && points && !samples);
    return status == MGT_OK && run->objects && !job->behind ? gl_put_objects_in_front(run, &b) : status;
}

mgt_status gl_prepare_objects(const gl_run *run)
{
    gl_renderer *g = run->g;
    const frame *f = run->job->frame;
    mgt_status status = MGT_OK;
    if (f->scene->camera_moves) {
        frame *const opened = &g->opened;
        *opened = *f;
        opened->close = f->open;
        status = gl_refraction_prepare(g, opened, &run->job->area, run->r);
        for (uint32_t row = run->first_row; row < run->end_row && status == MGT_OK; row += run->band_rows) {
            const gl_band b = gl_band_at(run, row);
            status = see_objects(run, &b, &f->open, (interval){f->scene->time - f->scene->shutter, 0});
        }
        gl_refraction_keep(g);
    }
    return status == MGT_OK ? gl_refraction_prepare(g, f, &run->job->area, run->r) : status;
}

/* Number of steps of a band: parts of the shutter, or point samples. */
static double count_steps(const frame *f)
{
    const mgt_quality *q = &f->scene->quality;
    const uint64_t all = quality_samples(q) - q->sample_first;
    if (method_of(q->method)->way == METHOD_SAMPLES)
        return (double)(q->sample_count ? q->sample_count : all);
    return parts_of(f);
}

static mgt_status prepare_tables(const gl_run *run)
{
    if (uses_podee_tables(run))
        return gl_podee_prepare(run->g, run->job->frame->scene, run->r);
    return run->method->tables & METHOD_LEAN_MAP ? gl_lean_prepare(run->g, run->job->frame, run->r) : MGT_OK;
}

mgt_status gl_run_begin(gl_run *run, gl_renderer *g, const gl_job *job, size_t sets, const reporter *r)
{
    const method_row *method = method_of(job->frame->scene->quality.method);
    *run = (gl_run){.g = g,
                    .job = job,
                    .r = r,
                    .method = method,
                    .waves = method->properties.waves,
                    .objects = job->frame->scene->object_count > 0 || job->frame->under};
    run->program = gl_method_program(job->frame->scene->quality.method, uses_podee_tables(run));
    find_skylines(run);
    return reserve_tiles(run, sets);
}

void gl_run_end(gl_run *run)
{
    if (run->behind)
        run->g->gl.DeleteSync(run->behind);
    run->behind = NULL;
}

mgt_status gl_frame_render(gl_renderer *g, const gl_job *job, const reporter *r)
{
    const mgt_quality *q = &job->frame->scene->quality;
    const method_row *method = method_of(q->method);
    mgt_status status = check_size(g, &job->area, r);
    if (status == MGT_OK && method->way == METHOD_PASS)
        return gl_whole_frame_render(g, job, r);
    gl_run run;
    if (status == MGT_OK)
        status = reserve_layers(g, job, r);
    if (status == MGT_OK)
        status = gl_run_begin(&run, g, job, needs_open(job->frame) ? 2 : 1, r);
    if (status == MGT_OK && shades_pixels(job))
        status = prepare_tables(&run);
    if (status == MGT_OK && run.objects)
        status = gl_prepare_objects(&run);
    if (status != MGT_OK)
        return status;
    const uint32_t bands = (run.end_row - run.first_row + run.band_rows - 1) / run.band_rows;
    run.steps = bands * count_steps(job->frame);
    for (uint32_t row = run.first_row; row < run.end_row && status == MGT_OK; row += run.band_rows)
        status = render_band(&run, row);
    gl_run_end(&run);
    return status;
}
