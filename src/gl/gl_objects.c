/* SPDX-License-Identifier: MIT
 * A scene's objects on the GPU: fetched where they are drawn and where a ray meets them. */
#include "gl/gl_objects.h"

#include <string.h>

/* ---- tables ---- */

mgt_status gl_table_reserve(const gl_api *gl, gl_table *t, GLenum format, size_t count, size_t size, const reporter *r)
{
    const size_t bytes = (count > 0 ? count : 1) * size;
    if (t->texture && t->buffer.size >= bytes)
        return MGT_OK;
    gl_table_free(gl, t);
    mgt_status status = gl_buffer_reserve(gl, &t->buffer, bytes, GL_MAP_WRITE_BIT, r);
    if (status != MGT_OK)
        return status;
    gl->CreateTextures(GL_TEXTURE_BUFFER, 1, &t->texture);
    gl->TextureBufferRange(t->texture, format, t->buffer.name, 0, (GLsizeiptr)bytes);
    status = gl_check(gl, "tables", r);
    if (status != MGT_OK)
        gl_table_free(gl, t);
    return status;
}

void gl_table_free(const gl_api *gl, gl_table *t)
{
    if (t->texture)
        gl->DeleteTextures(1, &t->texture);
    t->texture = 0;
    gl_buffer_free(gl, &t->buffer);
}

void *gl_table_map(const gl_api *gl, const gl_table *t, size_t size, const reporter *r)
{
    void *map = gl->MapNamedBufferRange(t->buffer.name, 0, (GLsizeiptr)size, GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!map && gl_check(gl, "tables", r) == MGT_OK)
        report_error(r, MGT_ERROR_MEMORY, "gl.memory", "OpenGL cannot map %zu bytes", size);
    return map;
}

void gl_table_unmap(const gl_api *gl, const gl_table *t)
{
    gl->UnmapNamedBuffer(t->buffer.name);
}

/* ---- triangles ---- */

enum { VERTEX_FLOATS = 8 };

typedef struct vertex_job {
    const world *world;
    float *out;
} vertex_job;

enum { VERTEX_BLOCK = 65536 };

static void fill_vertices(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const vertex_job *job = argument;
    const world *w = job->world;
    const size_t end = (index + 1) * VERTEX_BLOCK < w->vertex_count ? (index + 1) * VERTEX_BLOCK : w->vertex_count;
    for (size_t i = index * VERTEX_BLOCK; i < end; i++) {
        const float *p = w->positions + 3 * i, *n = w->normals + 3 * i, *t = w->texcoords + 2 * i;
        const float vertex[VERTEX_FLOATS] = {p[0], p[1], p[2], t[0], n[0], n[1], n[2], t[1]};
        memcpy(job->out + VERTEX_FLOATS * i, vertex, sizeof vertex);
    }
}

static mgt_status upload_vertices(const gl_api *gl, gl_objects *o, const reporter *r)
{
    const world *w = o->world;
    const size_t size = VERTEX_FLOATS * sizeof(float) * w->vertex_count;
    const mgt_status status = gl_table_reserve(gl, &o->vertices, GL_RGBA32F, w->vertex_count, VERTEX_FLOATS * sizeof(float), r);
    vertex_job job = {w, status == MGT_OK && size > 0 ? gl_table_map(gl, &o->vertices, size, r) : NULL};
    if (!job.out)
        return status == MGT_OK && size > 0 ? MGT_ERROR_MEMORY : status;
    thread_pool_run(o->pool, &(thread_loop){.count = (w->vertex_count + VERTEX_BLOCK - 1) / VERTEX_BLOCK, .body = fill_vertices, .argument = &job});
    gl_table_unmap(gl, &o->vertices);
    return MGT_OK;
}

static mgt_status upload_numbers(const gl_api *gl, gl_table *t, const uint32_t *numbers, size_t count, const reporter *r)
{
    const mgt_status status = gl_table_reserve(gl, t, GL_R32UI, count, sizeof *numbers, r);
    if (status != MGT_OK || count == 0)
        return status;
    void *map = gl_table_map(gl, t, count * sizeof *numbers, r);
    if (!map)
        return MGT_ERROR_MEMORY;
    memcpy(map, numbers, count * sizeof *numbers);
    gl_table_unmap(gl, t);
    return MGT_OK;
}

mgt_status gl_objects_update(const gl_api *gl, gl_objects *o, const mgt_scene *scene, uint32_t threads, size_t most_texels, const reporter *r)
{
    if (!o->pool)
        o->pool = thread_pool_create(threads ? threads : thread_pool_usable_cpus());
    if (!o->pool)
        return report_error(r, MGT_ERROR_THREAD, "render.thread", "no threads to place the scene's objects");
    mgt_status status = world_update(&o->world, scene, o->pool);
    if (status != MGT_OK)
        return report_error(r, status, "render.memory", "out of memory for the scene's objects");
    const world *w = o->world;
    if (o->version == w->version)
        return MGT_OK;
    o->version = 0;
    if (2 * w->vertex_count > most_texels || 3 * w->triangle_count > most_texels)
        return report_error(r, MGT_ERROR_UNSUPPORTED, "render.size", "%zu vertices and %zu triangles are more than this OpenGL's tables hold (%zu elements)",
                            w->vertex_count, w->triangle_count, most_texels);
    status = upload_vertices(gl, o, r);
    if (status == MGT_OK)
        status = upload_numbers(gl, &o->indices, w->indices, 3 * w->triangle_count, r);
    if (status == MGT_OK)
        status = upload_numbers(gl, &o->owners, w->object, w->triangle_count, r);
    if (status != MGT_OK)
        return status;
    o->version = w->version;
    return gl_check(gl, "objects", r);
}

void gl_objects_free(const gl_api *gl, gl_objects *o)
{
    gl_table_free(gl, &o->vertices);
    gl_table_free(gl, &o->indices);
    gl_table_free(gl, &o->owners);
    world_free(o->world);
    thread_pool_destroy(o->pool);
    *o = (gl_objects){0};
}
