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

/* Makes the buffer at least `size` bytes large. If it grows, its contents are lost. `flags` are those of glNamedBufferStorage. */
mgt_status gl_buffer_reserve(const gl_api *gl, gl_buffer *b, size_t size, GLbitfield flags, const reporter *r);
void gl_buffer_free(const gl_api *gl, gl_buffer *b);

typedef struct gl_image {
    GLuint name;
    GLenum format;
    uint32_t width, height;
} gl_image;

/* Makes the image at least width × height texels of `format` large. If it grows, its contents are lost. */
mgt_status gl_image_reserve(const gl_api *gl, gl_image *image, GLenum format, uint32_t width, uint32_t height, const reporter *r);
void gl_image_free(const gl_api *gl, gl_image *image);

/* A ring of uniform data that the CPU writes and the GPU reads: one mapped buffer in segments. A segment is written again after the GPU has read it, which it
 * usually has by the time that the other segments are full. */
enum { RING_SEGMENTS = 3 };

typedef struct gl_ring {
    GLuint buffer;
    char *map;
    size_t segment_size, alignment;
    int segment;
    size_t used;                  /* bytes of the current segment that are in use */
    GLsync fences[RING_SEGMENTS]; /* fence behind the last commands that read each segment; NULL: none */
} gl_ring;

mgt_status gl_ring_create(const gl_api *gl, gl_ring *ring, size_t segment_size, const reporter *r);
void gl_ring_free(const gl_api *gl, gl_ring *ring);

/* Reserves room in one segment for the next `parts` allocations, which are `size` bytes together. Their data stay until the commands have run that are issued
 * before the call after the next one. */
mgt_status gl_ring_begin(const gl_api *gl, gl_ring *ring, size_t size, size_t parts, const reporter *r);

/* Allocates `size` bytes of the reserved room. Returns their address; `offset` returns their place in ring->buffer. */
void *gl_ring_allocate(gl_ring *ring, size_t size, size_t *offset);

/* Reports the errors of OpenGL since the last check, with the name of the pass. Returns MGT_OK if there was none. */
mgt_status gl_check(const gl_api *gl, const char *pass, const reporter *r);

/* Clears the errors that the host has left pending, and logs each. Returns whether one says that the context is lost. */
bool gl_clear_errors(const gl_api *gl, const reporter *r);

/* Reports that the context is lost. Returns MGT_ERROR_LOST. */
mgt_status gl_report_lost(const reporter *r);

#endif
