/* SPDX-License-Identifier: MIT
 * A scene's objects on the GPU, as tables that shaders fetch when they draw triangles and shade hits. */
#ifndef MANGATA_GL_GL_OBJECTS_H
#define MANGATA_GL_GL_OBJECTS_H

#include "frame/world.h"
#include "gl/gl_memory.h"

/* A buffer whose elements shaders fetch. */
typedef struct gl_table {
    gl_buffer buffer;
    GLuint texture;
} gl_table;

/* The triangles of a world. */
typedef struct gl_objects {
    thread_pool *pool;     /* created when it is first needed */
    world *world;          /* world of the last frame */
    uint64_t version;      /* version of the world that the tables hold; 0: none */
    gl_table vertices;     /* RGBA32F, two elements per vertex: x, y, z, u; normal x, y, z, v */
    gl_table indices;      /* R32UI, three elements per triangle: world.indices */
    gl_table neighbours;   /* R32I, three elements per triangle: world.neighbours */
    gl_table owners;       /* R32UI, one element per triangle: index of its object */
    gl_table planes;       /* RGBA32F, one element per triangle: unit normal, and the normal's product with a point of the triangle */
    gl_table tree;         /* RGBA32UI: see gl_bvh.h */
    uint64_t tree_version; /* version of the world that the tree holds; 0: none */
} gl_objects;

/* Updates the world and its tables from the scene. `threads` is the number of threads for the world, 0: as many as this process may use. `most_texels` is the
 * largest number of elements of a table. */
mgt_status gl_objects_update(const gl_api *gl, gl_objects *o, const mgt_scene *scene, uint32_t threads, size_t most_texels, const reporter *r);

/* The same for the tree that rays are traced through. */
mgt_status gl_objects_update_tree(const gl_api *gl, gl_objects *o, size_t most_texels, const reporter *r);

void gl_objects_free(const gl_api *gl, gl_objects *o);

/* Makes the table at least `count` elements of `size` bytes large, which shaders fetch as `format`. If it grows, its contents are lost. */
mgt_status gl_table_reserve(const gl_api *gl, gl_table *t, GLenum format, size_t count, size_t size, const reporter *r);
void gl_table_free(const gl_api *gl, gl_table *t);

/* Maps the first `size` bytes for writing. Returns NULL, after a report, if OpenGL cannot map them. */
void *gl_table_map(const gl_api *gl, const gl_table *t, size_t size, const reporter *r);
void gl_table_unmap(const gl_api *gl, const gl_table *t);

#endif
