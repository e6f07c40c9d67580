/* SPDX-License-Identifier: MIT
 * A scene's objects on the GPU: fetched where they are drawn and where a ray meets them. */
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
    thread_pool *pool;     /* made when first needed */
    world *world;          /* of the last frame */
    uint64_t version;      /* of the one that the tables hold; 0: none */
    gl_table vertices;     /* RGBA32F, two a vertex: x, y, z, u; normal x, y, z, v */
    gl_table indices;      /* R32UI, three a triangle */
    gl_table neighbours;   /* R32I, three a triangle: world.neighbours */
    gl_table owners;       /* R32UI: the object of a triangle */
    gl_table planes;       /* RGBA32F, one a triangle: unit normal, and its product with a point of it */
    gl_table tree;         /* RGBA32UI: see gl_bvh.h */
    uint64_t tree_version; /* as `version` */
} gl_objects;

/* Brings world and tables up to date; `threads` may make the world, 0: as many as this process may use. `most_texels` is what a table may hold. */
mgt_status gl_objects_update(const gl_api *gl, gl_objects *o, const mgt_scene *scene, uint32_t threads, size_t most_texels, const reporter *r);

/* The same for the tree that rays are traced through. */
mgt_status gl_objects_update_tree(const gl_api *gl, gl_objects *o, size_t most_texels, const reporter *r);

void gl_objects_free(const gl_api *gl, gl_objects *o);

/* At least `count` elements of `size` bytes, fetched as `format`. The old contents are lost when it grows. */
mgt_status gl_table_reserve(const gl_api *gl, gl_table *t, GLenum format, size_t count, size_t size, const reporter *r);
void gl_table_free(const gl_api *gl, gl_table *t);

/* The first `size` bytes to write, NULL with a report where OpenGL cannot map them. */
void *gl_table_map(const gl_api *gl, const gl_table *t, size_t size, const reporter *r);
void gl_table_unmap(const gl_api *gl, const gl_table *t);

#endif
