/* SPDX-License-Identifier: MIT
 * A scene's objects on the GPU, as tables that shaders fetch when they draw triangles and shade hits. */
#include "gl/gl_objects.h"

#include <string.h>

#include "frame/refraction_data.h"
#include "gl/gl_bvh.h"

/* ---- tables ---- */

/* Size of a table's buffer, at least `size` bytes. It is an odd multiple of 256 and no power of two. llvmpipe would compile a program again where the size
 * changes between a power of two and another number. Version 22.3 would also do so where bits 8 to 15 of the size change between zero and another value. */
static size_t table_bytes(size_t size)
{
    const size_t block = 256, blocks = (size + block - 1) / block;
    return (blocks < 3 ? 3 : blocks | 1) * block;
}

mgt_status gl_table_reserve(const gl_api *gl, gl_table *t, GLenum format, size_t count, size_t size, const reporter *r)
{
    const size_t bytes = table_bytes((count > 0 ? count : 1) * size);
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

void gl_table_unmap(const gl_api *gl, const gl_table *t) { gl->UnmapNamedBuffer(t->buffer.name); }

/* ---- triangles ---- */

enum { VERTEX_FLOATS = 8, PLANE_FLOATS = 4, BLOCK = 65536 };

/* A table that threads fill in blocks of elements. `fill` writes element i to `out`. */
typedef struct fill_job {
    const world *world;
    float *out;
    size_t count;
    void (*fill)(const world *w, size_t i, float *out);
    size_t floats; /* floats of an element */
} fill_job;

static void fill_vertex(const world *w, size_t i, float *out)
{
    const float *p = w->positions + 3 * i, *n = w->normals + 3 * i, *t = w->texcoords + 2 * i;
    const float vertex[VERTEX_FLOATS] = {p[0], p[1], p[2], t[0], n[0], n[1], n[2], t[1]};
    memcpy(out, vertex, sizeof vertex);
}

static void fill_block(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const fill_job *job = argument;
    const size_t end = (index + 1) * BLOCK < job->count ? (index + 1) * BLOCK : job->count;
    for (size_t i = index * BLOCK; i < end; i++)
        job->fill(job->world, i, job->out + job->floats * i);
}

/* Element i of the table of planes. The planes of all triangles come first, then the dry levels of the two sides of each triangle. */
static void fill_plane(const world *w, size_t i, float *out)
{
    if (i < w->triangle_count) {
        refraction_plane(w, i, out);
        return;
    }
    const float *level = w->dry + 2 * (i - w->triangle_count);
    const float levels[PLANE_FLOATS] = {level[0], level[1], 0, 0};
    memcpy(out, levels, sizeof levels);
}

/* Fills a table of RGBA32F texels from the world, on all threads. */
static mgt_status upload_floats(const gl_api *gl, gl_objects *o, gl_table *t, fill_job job, const reporter *r)
{
    const size_t size = job.floats * sizeof(float);
    const mgt_status status = gl_table_reserve(gl, t, GL_RGBA32F, job.count, size, r);
    if (status != MGT_OK || job.count == 0)
        return status;
    job.world = o->world;
    job.out = gl_table_map(gl, t, job.count * size, r);
    if (!job.out)
        return MGT_ERROR_MEMORY;
    thread_pool_run(o->pool, &(thread_loop){.count = (job.count + BLOCK - 1) / BLOCK, .body = fill_block, .argument = &job});
    gl_table_unmap(gl, t);
    return MGT_OK;
}

/* Fills a table with `count` numbers of 32 bits. */
static mgt_status upload_numbers(const gl_api *gl, gl_table *t, GLenum format, const void *numbers, size_t count, const reporter *r)
{
    const mgt_status status = gl_table_reserve(gl, t, format, count, sizeof(uint32_t), r);
    if (status != MGT_OK || count == 0)
        return status;
    void *map = gl_table_map(gl, t, count * sizeof(uint32_t), r);
    if (!map)
        return MGT_ERROR_MEMORY;
    memcpy(map, numbers, count * sizeof(uint32_t));
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
    status = upload_floats(gl, o, &o->vertices, (fill_job){.count = w->vertex_count, .fill = fill_vertex, .floats = VERTEX_FLOATS}, r);
    if (status == MGT_OK)
        status = upload_floats(gl, o, &o->planes, (fill_job){.count = (w->dry ? 2 : 1) * w->triangle_count, .fill = fill_plane, .floats = PLANE_FLOATS}, r);
    if (status == MGT_OK)
        status = upload_numbers(gl, &o->indices, GL_R32UI, w->indices, 3 * w->triangle_count, r);
    if (status == MGT_OK)
        status = upload_numbers(gl, &o->neighbours, GL_R32I, w->neighbours, 3 * w->triangle_count, r);
    if (status == MGT_OK)
        status = upload_numbers(gl, &o->owners, GL_R32UI, w->object, w->triangle_count, r);
    if (status != MGT_OK)
        return status;
    o->version = w->version;
    return gl_check(gl, "objects", r);
}

static mgt_status upload_tree(const gl_api *gl, gl_table *t, const gl_bvh *b, size_t most_texels, const reporter *r)
{
    if (b->texel_count > most_texels)
        return report_error(r, MGT_ERROR_UNSUPPORTED, "render.size",
                            "a tree of %zu elements to trace rays through is more than this OpenGL's tables hold (%zu)", b->texel_count, most_texels);
    const size_t size = b->texel_count * sizeof *b->texels;
    const mgt_status status = gl_table_reserve(gl, t, GL_RGBA32UI, b->texel_count, sizeof *b->texels, r);
    void *map = status == MGT_OK ? gl_table_map(gl, t, size, r) : NULL;
    if (!map)
        return status == MGT_OK ? MGT_ERROR_MEMORY : status;
    memcpy(map, b->texels, size);
    gl_table_unmap(gl, t);
    return gl_check(gl, "objects", r);
}

mgt_status gl_objects_update_tree(const gl_api *gl, gl_objects *o, size_t most_texels, const reporter *r)
{
    if (o->tree_version == o->world->version)
        return MGT_OK;
    o->tree_version = 0;
    gl_bvh tree;
    mgt_status status = gl_bvh_build(&tree, o->world, o->pool);
    if (status != MGT_OK)
        return report_error(r, status, "render.memory", "out of memory for the tree of triangles that rays are traced through");
    status = upload_tree(gl, &o->tree, &tree, most_texels, r);
    gl_bvh_free(&tree);
    if (status == MGT_OK)
        o->tree_version = o->world->version;
    return status;
}

void gl_objects_free(const gl_api *gl, gl_objects *o)
{
    gl_table_free(gl, &o->tree);
    gl_table_free(gl, &o->vertices);
    gl_table_free(gl, &o->indices);
    gl_table_free(gl, &o->neighbours);
    gl_table_free(gl, &o->owners);
    gl_table_free(gl, &o->planes);
    world_free(o->world);
    thread_pool_destroy(o->pool);
    *o = (gl_objects){0};
}
