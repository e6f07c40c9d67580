/* SPDX-License-Identifier: MIT
 * Memory of the GPU: buffers and textures that only grow, and a ring of uniform data. */
#ifndef MANGATA_GL_GL_MEMORY_H
#define MANGATA_GL_GL_MEMORY_H

#include "frame/backend.h"
#include "gl/gl_api.h"

typedef struct gl_buffer {
    GLuint name;
    size_t size;
} gl_buffer;

/* At least `size` bytes; the old contents are lost when it grows. `flags` are those of glNamedBufferStorage. */
mgt_status gl_buffer_reserve(const gl_api *gl, gl_buffer *b, size_t size, GLbitfield flags, const reporter *r);
void gl_buffer_free(const gl_api *gl, gl_buffer *b);

typedef struct gl_image {
    GLuint name;
    GLenum format;
    uint32_t width, height;
} gl_image;

/* At least width × height texels of `format`; the old contents are lost when it grows. */
mgt_status gl_image_reserve(const gl_api *gl, gl_image *image, GLenum format, uint32_t width, uint32_t height, const reporter *r);
void gl_image_free(const gl_api *gl, gl_image *image);

/* Uniform data on their way: one mapped buffer in segments. A segment is written again when the GPU has read it, which it has long done by the
 * time the others are full. */
enum { RING_SEGMENTS = 3 };

typedef struct gl_ring {
    GLuint buffer;
    char *map;
    size_t segment_size, alignment;
    int segment;
    size_t used;                  /* of the segment */
    GLsync fences[RING_SEGMENTS]; /* behind the last commands that read a segment; NULL: none */
} gl_ring;

mgt_status gl_ring_create(const gl_api *gl, gl_ring *ring, size_t segment_size, const reporter *r);
void gl_ring_free(const gl_api *gl, gl_ring *ring);

/* What the next `parts` allocations, `size` bytes in all, need together in one segment: their data stay until the commands issued before the next but
 * one call have run. */
mgt_status gl_ring_begin(const gl_api *gl, gl_ring *ring, size_t size, size_t parts, const reporter *r);

/* A place to write `size` bytes, as `offset` in ring->buffer. */
void *gl_ring_allocate(gl_ring *ring, size_t size, size_t *offset);

/* Reports errors of OpenGL since the last check, with the name of the pass. */
mgt_status gl_check(const gl_api *gl, const char *pass, const reporter *r);

#endif
