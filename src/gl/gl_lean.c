/* SPDX-License-Identifier: MIT
 * The map of slope moments of methods lean and leadr, computed on the GPU from the waves at an instant. It equals that of src/cpu/lean_map.c. Level 0 holds
 * mean slopes alone. A second texture holds the second moments of levels 1 and up. */
#include <math.h>
#include <string.h>

#include "gl/gl_renderer.h"

enum { FILL_COLUMNS = 64, FILL_ROWS = 16 }; /* texels of a workgroup of lean_fill.comp */

static mgt_status create_texture(const gl_api *gl, GLuint *texture, GLenum format, GLsizei levels, GLsizei size, const reporter *r)
{
    if (*texture)
        return MGT_OK;
    GLuint name = 0;
    gl->CreateTextures(GL_TEXTURE_2D, 1, &name);
    gl->TextureStorage2D(name, levels, format, size, size);
    if (gl->GetError() != GL_NO_ERROR) {
        gl->DeleteTextures(1, &name);
        return report_error(r, MGT_ERROR_MEMORY, "gl.memory", "OpenGL has no memory for the 255 MiB of slope moments of methods lean and leadr");
    }
    *texture = name;
    return MGT_OK;
}

static mgt_status create_textures(gl_renderer *g, const reporter *r)
{
    gl_lean *l = &g->lean;
    const mgt_status status = create_texture(&g->gl, &l->mean, GL_RG32F, LEAN_LEVELS, LEAN_SIZE, r);
    return status == MGT_OK ? create_texture(&g->gl, &l->square, GL_RGBA32F, LEAN_LEVELS - 1, LEAN_SIZE / 2, r) : status;
}

static void bind_textures(const gl_renderer *g)
{
    gl_bind_texture(g, UNIT_LEAN_MEAN, g->lean.mean);
    gl_bind_texture(g, UNIT_LEAN_SQUARE, g->lean.square);
}

static void upload_waves(gl_renderer *g)
{
    const lean_waves *waves = &g->lean.waves;
    size_t offset;
    const size_t room = gl_wave_room(g, waves->count) * sizeof *waves->waves;
    memcpy(gl_ring_allocate(&g->ring, room, &offset), waves->waves, waves->count * sizeof *waves->waves);
    const GLenum block = g->waves_in_block ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER;
    g->gl.BindBufferRange(block, g->waves_in_block ? BIND_PICTURE : BIND_WAVES, g->ring.buffer, (GLintptr)offset, (GLsizeiptr)room);
}

/* Computes one level of the map: level 0 from the waves, the others from the next finer level. */
static mgt_status run_level(gl_renderer *g, int level, const reporter *r)
{
    const gl_api *gl = &g->gl;
    const LeanPass pass = {.level = level, .wave_count = (int)g->lean.waves.count};
    const mgt_status status = gl_use(g, level == 0 ? PROGRAM_LEAN_FILL : PROGRAM_LEAN_SHRINK, r);
    if (status != MGT_OK)
        return status;
    gl_uniform(g, BIND_EXTRA, &pass, sizeof pass);
    gl->BindImageTexture(0, g->lean.mean, level, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
    if (level == 0) {
        gl->DispatchCompute(LEAN_SIZE / FILL_COLUMNS, LEAN_SIZE / FILL_ROWS, 1);
    } else {
        gl->BindImageTexture(1, g->lean.square, level - 1, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
        const GLuint groups = (GLuint)((LEAN_SIZE >> level) + GROUP_SIDE - 1) / GROUP_SIDE;
        gl->DispatchCompute(groups, groups, 1);
    }
    gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return MGT_OK;
}

static mgt_status fill(gl_renderer *g, const reporter *r)
{
    mgt_status status = create_textures(g, r);
    if (status == MGT_OK)
        status = gl_ring_begin(&g->gl, &g->ring, LEAN_LEVELS * sizeof(LeanPass) + gl_wave_room(g, g->lean.waves.count) * sizeof(LeanWave), LEAN_LEVELS + 1, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "lean");
    upload_waves(g);
    bind_textures(g);
    for (int level = 0; level < LEAN_LEVELS && status == MGT_OK; level++)
        status = run_level(g, level, r);
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

mgt_status gl_lean_prepare(gl_renderer *g, const frame *f, const reporter *r)
{
    gl_lean *l = &g->lean;
    lean_waves waves;
    l->data = sines_snap(&f->scene->water, frame_meeting(f, &f->close, (interval){f->scene->time, 0}), &waves);
    if (l->filled && memcmp(&waves, &l->waves, sizeof waves) == 0)
        return MGT_OK;
    l->waves = waves;
    const mgt_status status = fill(g, r);
    l->filled = status == MGT_OK;
    return status;
}

void gl_lean_bind(gl_renderer *g)
{
    bind_textures(g);
    gl_uniform(g, BIND_EXTRA, &g->lean.data, sizeof g->lean.data);
}

void gl_lean_free(gl_renderer *g)
{
    if (g->lean.mean)
        g->gl.DeleteTextures(1, &g->lean.mean);
    if (g->lean.square)
        g->gl.DeleteTextures(1, &g->lean.square);
    g->lean = (gl_lean){0};
}
