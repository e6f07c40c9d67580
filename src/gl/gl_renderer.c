/* SPDX-License-Identifier: MIT
 * The state of the OpenGL backend between frames. */
#include "gl/gl_renderer.h"

#include <stdlib.h>
#include <string.h>

#include "params/foam.h"

enum { RING_SEGMENT = 1 << 20 }; /* bytes of a segment of the ring of uniform data, at first */

static mgt_status check_version(const gl_api *gl, const reporter *r)
{
    GLint major = 0, minor = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major > 4 || (major == 4 && minor >= 5))
        return MGT_OK;
    if (major == 0) /* without a current context the calls had no effect */
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.gl", "no OpenGL context is current on this thread; one of 4.5 core or later is needed");
    return report_error(r, MGT_ERROR_UNAVAILABLE, "context.gl", "the OpenGL context has version %d.%d; 4.5 core or later is needed", major, minor);
}

static bool is_software(const gl_api *gl)
{
    const char *renderer = (const char *)gl->GetString(GL_RENDERER);
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software Rasterizer", "lavapipe"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (renderer && strstr(renderer, names[i]))
            return true;
    return false;
}

static mgt_status read_limits(gl_renderer *g, const reporter *r)
{
    GLint texture = 0, storage = 0, shared = 0, table = 0;
    GLint64 bytes = 0;
    g->gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    g->gl.GetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &storage);
    g->gl.GetIntegerv(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, &shared);
    g->gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &table);
    g->gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    if (storage < STORAGE_BINDINGS || shared < 32768)
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.gl",
                            "the OpenGL context has %d storage blocks and %d bytes of shared memory for compute shaders; "
                            "%d and 32768 are needed",
                            storage, shared, STORAGE_BINDINGS);
    g->limits = (gl_limits){
        .texture_side = (uint32_t)texture,
        .software = is_software(&g->gl),
        .table_texels = (size_t)table,
        .storage_bytes = (size_t)bytes,
    };
    g->programs.defines = g->limits.software ? "#define SOFTWARE_GL\n" : "";
    return MGT_OK;
}

static void create_textures(gl_renderer *g)
{
    g->gl.CreateSamplers(1, &g->sampler);
    g->gl.SamplerParameteri(g->sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    g->gl.SamplerParameteri(g->sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    g->gl.CreateTextures(GL_TEXTURE_2D, 1, &g->sky_texture);
    g->gl.TextureStorage2D(g->sky_texture, 1, GL_RGBA32F, SKY_COLUMNS, SKY_TABLE_ROWS);
    g->gl.CreateTextures(GL_TEXTURE_2D, 1, &g->skyline_texture);
    g->gl.TextureStorage2D(g->skyline_texture, 1, GL_RG32F, SKYLINE_MOST, 2);
}

mgt_status gl_renderer_create(gl_renderer **out, mgt_gl_get_proc get_proc, const reporter *r)
{
    gl_renderer *g = calloc(1, sizeof *g);
    if (!g)
        return report_error(r, MGT_ERROR_MEMORY, "context.create", "out of memory");
    g->programs.gl = &g->gl;
    g->sky = sky_state_create();
    g->waves = calloc(1, sizeof *g->waves);
    mgt_status status = g->sky && g->waves ? MGT_OK : report_error(r, MGT_ERROR_MEMORY, "context.create", "out of memory");
    const char *missing = status == MGT_OK ? gl_api_load(&g->gl, get_proc) : NULL;
    if (missing)
        status =
            report_error(r, MGT_ERROR_UNAVAILABLE, "context.gl", "the OpenGL context lacks %s; a 4.5 core context is needed, current on this thread", missing);
    const bool loaded = status == MGT_OK;
    if (status == MGT_OK)
        status = check_version(&g->gl, r);
    if (status == MGT_OK && gl_clear_errors(&g->gl, r))
        status = gl_report_lost(r);
    if (status == MGT_OK)
        status = read_limits(g, r);
    if (status == MGT_OK)
        status = gl_ring_create(&g->gl, &g->ring, RING_SEGMENT, r);
    if (status == MGT_OK) {
        gl_timers_create(&g->gl, &g->timers);
        create_textures(g);
        g->gl.CreateVertexArrays(1, &g->vertex_array);
        status = gl_check(&g->gl, "create", r);
    }
    if (status == MGT_OK) {
        *out = g;
        return MGT_OK;
    }
    if (loaded) {
        gl_renderer_destroy(g);
    } else {
        sky_state_destroy(g->sky);
        free(g->waves);
        free(g);
    }
    return status;
}

static void free_layers(const gl_api *gl, gl_layers *l)
{
    gl_image *const images[] = {&l->color, &l->coverage, &l->water, &l->depth, &l->normal, &l->foam, &l->display, &l->samples, &l->importance, &l->detail};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++)
        gl_image_free(gl, images[i]);
}

void gl_renderer_destroy(gl_renderer *g)
{
    if (!g)
        return;
    const gl_api *gl = &g->gl;
    gl_programs_free(&g->programs);
    gl_ring_free(gl, &g->ring);
    gl_timers_free(gl, &g->timers);
    gl_buffer *const buffers[] = {&g->tiles, &g->tile_waves, &g->search_waves, &g->nodes};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        gl_buffer_free(gl, buffers[i]);
    gl_layers *const layers[] = {&g->layers, &g->history[0], &g->history[1]};
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        free_layers(gl, layers[i]);
    gl_image_free(gl, &g->luma);
    gl_glare_free(g);
    gl_podee_free(g);
    gl_lean_free(g);
    gl_adaptive_podee_free(g);
    gl_cells_free(gl, &g->cells);
    gl_refraction_free(gl, &g->refraction);
    gl_gbuffers_free(gl, &g->gbuffers);
    gl_objects_free(gl, &g->objects);
    if (g->vertex_array)
        gl->DeleteVertexArrays(1, &g->vertex_array);
    if (g->sky_texture)
        gl->DeleteTextures(1, &g->sky_texture);
    if (g->skyline_texture)
        gl->DeleteTextures(1, &g->skyline_texture);
    if (g->sampler)
        gl->DeleteSamplers(1, &g->sampler);
    sky_state_destroy(g->sky);
    free(g->waves);
    free(g);
}

/* ---- passes ---- */

/* Whether passes have debug groups: not where the host's own fill the stack. */
static bool grouped(const gl_renderer *g) { return !g->host || g->host->group_fits; }

void gl_pass_begin(gl_renderer *g, const char *name)
{
    g->pass = name;
    if (grouped(g))
        g->gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
    gl_timers_begin(&g->gl, &g->timers, name);
}

mgt_status gl_pass_end(gl_renderer *g, const reporter *r)
{
    gl_timers_end(&g->gl, &g->timers);
    if (grouped(g))
        g->gl.PopDebugGroup();
    return gl_check(&g->gl, g->pass, r);
}

mgt_status gl_use(gl_renderer *g, gl_program which, const reporter *r)
{
    mgt_status status = MGT_OK;
    const GLuint program = gl_program_get(&g->programs, which, r, &status);
    if (status == MGT_OK)
        g->gl.UseProgram(program);
    return status;
}

void gl_uniform(gl_renderer *g, GLuint binding, const void *data, size_t size)
{
    size_t offset;
    memcpy(gl_ring_allocate(&g->ring, size, &offset), data, size);
    g->gl.BindBufferRange(GL_UNIFORM_BUFFER, binding, g->ring.buffer, (GLintptr)offset, (GLsizeiptr)size);
}

void gl_bind_texture(const gl_renderer *g, GLuint unit, GLuint texture)
{
    g->gl.BindTextureUnit(unit, texture ? texture : g->sky_texture); /* 0 would unbind the host's textures of all targets */
    g->gl.BindSampler(unit, g->sampler);
}

void gl_bind_image(const gl_renderer *g, GLuint unit, const gl_image *image, GLenum access)
{
    g->gl.BindImageTexture(unit, image->name, 0, GL_FALSE, 0, access, image->name ? image->format : GL_R32F);
}

/* ---- begin of a frame ---- */

/* Reserves at least one texel of each layer, so that there is always something to bind. llvmpipe compiles a program again if a bound image or texture has
 * another format, or if nothing is bound. */
static mgt_status reserve_least(gl_renderer *g, const reporter *r)
{
    gl_layers *l = &g->layers;
    gl_image *const colors[] = {&l->color, &l->normal}, *const numbers[] = {&l->coverage, &l->water, &l->depth, &l->foam};
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < sizeof colors / sizeof *colors && status == MGT_OK; i++)
        status = gl_image_reserve(&g->gl, colors[i], GL_RGBA32F, 1, 1, r);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers && status == MGT_OK; i++)
        status = gl_image_reserve(&g->gl, numbers[i], GL_R32F, 1, 1, r);
    return status == MGT_OK ? gl_refraction_reserve_least(g, r) : status;
}

/* Runs a program that reads all units with the sampler of all textures, once and on software OpenGL alone. llvmpipe compiles a program again if a sampler
 * differs. A buffer texture has no sampler, and llvmpipe takes the one that an earlier program had in its place. After this program that is always the same
 * one. */
static mgt_status set_samplers(gl_renderer *g, const reporter *r)
{
    if (g->samplers_set || !g->limits.software)
        return MGT_OK;
    mgt_status status = gl_image_reserve(&g->gl, &g->luma, GL_R32F, 1, 1, r);
    if (status == MGT_OK)
        status = gl_use(g, PROGRAM_SAMPLERS, r);
    if (status != MGT_OK)
        return status;
    for (GLuint i = 0; i < TEXTURE_UNITS; i++)
        gl_bind_texture(g, i, g->sky_texture);
    g->gl.BindImageTexture(0, g->luma.name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    g->gl.DispatchCompute(1, 1, 1);
    g->samplers_set = true;
    return gl_check(&g->gl, "samplers", r);
}

/* Computes and uploads the tables of the sky and of the air if their inputs have changed. */
static mgt_status update_sky(gl_renderer *g, const mgt_scene *scene, const reporter *r)
{
    const bool same = sky_state_same_inputs(g->sky, &scene->sky, &scene->light);
    const mgt_status status = same ? MGT_OK : sky_state_build(g->sky, &scene->sky, &scene->light);
    if (status != MGT_OK)
        return report_error(r, status, "render.memory", "out of memory for the sky's tables");
    if (!sky_state_see_air(g->sky, scene) && same)
        return MGT_OK;
    g->gl.TextureSubImage2D(g->sky_texture, 0, 0, 0, SKY_COLUMNS, SKY_TABLE_ROWS, GL_RGB, GL_FLOAT, g->sky->table);
    return gl_check(&g->gl, "sky", r);
}

size_t gl_wave_room(const gl_renderer *g, size_t count) { return g->waves_in_block ? BLOCK_WAVES : count > 0 ? count : 1; }

mgt_status gl_frame_begin(gl_renderer *g, const mgt_scene *scene, const reporter *r)
{
    const gl_water water = !(scene->water.choppiness > 0) ? WATER_SINES : foam_draws(scene) ? WATER_FOAM : WATER_CHOPPY;
    g->waves_in_block = g->limits.software && scene->water.wave_count <= BLOCK_WAVES;
    g->programs.water = g->limits.software && !g->waves_in_block ? water + WATER_MANY_WAVES : water;
    mgt_status status = update_sky(g, scene, r);
    if (status == MGT_OK)
        status = reserve_least(g, r);
    return status == MGT_OK ? set_samplers(g, r) : status;
}
