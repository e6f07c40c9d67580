/* SPDX-License-Identifier: MIT
 * Memory of the GPU: buffers and textures that only grow, and a ring of uniform data. */
#include "gl/gl_memory.h"

#include <string.h>

/* ---- errors ---- */

static const char *error_text(GLenum error)
{
    switch (error) {
    case GL_INVALID_ENUM:
        return "invalid enum";
    case GL_INVALID_VALUE:
        return "invalid value";
    case GL_INVALID_OPERATION:
        return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "invalid framebuffer operation";
    case GL_STACK_OVERFLOW:
        return "stack overflow";
    case GL_STACK_UNDERFLOW:
        return "stack underflow";
    case GL_OUT_OF_MEMORY:
        return "out of memory";
    case GL_CONTEXT_LOST:
        return "the context is lost";
    default:
        return "unknown error";
    }
}

mgt_status gl_check(const gl_api *gl, const char *pass, const reporter *r)
{
    GLenum first = GL_NO_ERROR;
    for (int i = 0; i < 32; i++) { /* a lost context may never run out of errors */
        const GLenum error = gl->GetError();
        if (error == GL_NO_ERROR)
            break;
        first = first == GL_NO_ERROR ? error : first;
    }
    if (first == GL_NO_ERROR)
        return MGT_OK;
    const mgt_status status = first == GL_OUT_OF_MEMORY ? MGT_ERROR_MEMORY : MGT_ERROR_UNAVAILABLE;
    return report_error(r, status, "gl.error", "OpenGL error 0x%04x (%s) in pass \"%s\"", first, error_text(first), pass);
}

bool gl_clear_errors(const gl_api *gl, const reporter *r)
{
    bool lost = false;
    for (int i = 0; i < 32; i++) {
        const GLenum error = gl->GetError();
        if (error == GL_NO_ERROR)
            break;
        if (error == GL_CONTEXT_LOST)
            lost = true;
        else
            report(r, MGT_LOG_WARNING, "gl.host", "the host left OpenGL error 0x%04x (%s) behind; it has been cleared", error, error_text(error));
    }
    return lost;
}

mgt_status gl_report_lost(const reporter *r)
{
    return report_error(r, MGT_ERROR_LOST, "gl.lost", "the OpenGL context was lost (the GPU was reset); create a new context");
}

/* ---- buffers and textures ---- */

mgt_status gl_buffer_reserve(const gl_api *gl, gl_buffer *b, size_t size, GLbitfield flags, const reporter *r)
{
    if (b->size >= size)
        return MGT_OK;
    gl_buffer_free(gl, b);
    GLuint name = 0;
    gl->CreateBuffers(1, &name);
    gl->NamedBufferStorage(name, (GLsizeiptr)size, NULL, flags);
    if (gl->GetError() != GL_NO_ERROR) {
        gl->DeleteBuffers(1, &name);
        return report_error(r, MGT_ERROR_MEMORY, "gl.memory", "OpenGL has no memory for a buffer of %zu bytes", size);
    }
    *b = (gl_buffer){name, size};
    return MGT_OK;
}

void gl_buffer_free(const gl_api *gl, gl_buffer *b)
{
    if (b->name)
        gl->DeleteBuffers(1, &b->name);
    *b = (gl_buffer){0};
}

/* Side of an image for at least `pixels` pixels. Sides of up to 4096 are never powers of two, because llvmpipe compiles a program again for each combination of
 * images whose sides are powers of two or not. */
static uint32_t side_of(uint32_t pixels)
{
    const uint32_t largest = 4096; /* a larger side is not changed, because it may be the limit of OpenGL, a power of two */
    uint32_t side = pixels;
    while (side <= largest && (side & (side - 1)) == 0)
        side++;
    return side;
}

mgt_status gl_image_reserve(const gl_api *gl, gl_image *image, GLenum format, uint32_t width, uint32_t height, const reporter *r)
{
    if (image->name && image->format == format && image->width >= width && image->height >= height)
        return MGT_OK;
    uint32_t w = image->format == format && image->width > width ? image->width : width;
    uint32_t h = image->format == format && image->height > height ? image->height : height;
    if ((uint64_t)w * h > 2 * (uint64_t)width * height) { /* an image for a tall picture does not keep its height for a wide one */
        w = width;
        h = height;
    }
    w = side_of(w);
    h = side_of(h);
    gl_image_free(gl, image);
    GLuint name = 0;
    gl->CreateTextures(GL_TEXTURE_2D, 1, &name);
    gl->TextureStorage2D(name, 1, format, (GLsizei)w, (GLsizei)h);
    if (gl->GetError() != GL_NO_ERROR) {
        gl->DeleteTextures(1, &name);
        return report_error(r, MGT_ERROR_MEMORY, "gl.memory", "OpenGL has no memory for a layer of %u x %u pixels", w, h);
    }
    *image = (gl_image){name, format, w, h};
    return MGT_OK;
}

void gl_image_free(const gl_api *gl, gl_image *image)
{
    if (image->name)
        gl->DeleteTextures(1, &image->name);
    *image = (gl_image){0};
}

/* ---- ring ---- */

mgt_status gl_ring_create(const gl_api *gl, gl_ring *ring, size_t segment_size, const reporter *r)
{
    GLint uniform = 0, storage = 0;
    gl->GetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &uniform);
    gl->GetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &storage);
    const size_t alignment = uniform > storage ? (size_t)uniform : (size_t)storage;
    *ring = (gl_ring){.segment_size = segment_size, .alignment = alignment > 16 ? alignment : 16};
    const GLbitfield flags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const GLsizeiptr size = (GLsizeiptr)(segment_size * RING_SEGMENTS);
    gl->CreateBuffers(1, &ring->buffer);
    gl->NamedBufferStorage(ring->buffer, size, NULL, flags);
    ring->map = gl->MapNamedBufferRange(ring->buffer, 0, size, flags);
    if (gl->GetError() == GL_NO_ERROR && ring->map)
        return MGT_OK;
    gl_ring_free(gl, ring);
    return report_error(r, MGT_ERROR_MEMORY, "gl.memory", "OpenGL has no memory for a mapped buffer of %zu bytes", segment_size * RING_SEGMENTS);
}

void gl_ring_free(const gl_api *gl, gl_ring *ring)
{
    for (int i = 0; i < RING_SEGMENTS; i++)
        if (ring->fences[i])
            gl->DeleteSync(ring->fences[i]);
    if (ring->map)
        gl->UnmapNamedBuffer(ring->buffer);
    if (ring->buffer)
        gl->DeleteBuffers(1, &ring->buffer);
    *ring = (gl_ring){0};
}

/* Waits until the GPU has reached the fence or the context is lost. Then it deletes the fence. */
static void wait_for(const gl_api *gl, GLsync *fence)
{
    if (!*fence)
        return;
    const GLuint64 second = 1000000000;
    if (gl->ClientWaitSync(*fence, 0, 0) == GL_TIMEOUT_EXPIRED)
        while (gl->ClientWaitSync(*fence, GL_SYNC_FLUSH_COMMANDS_BIT, second) == GL_TIMEOUT_EXPIRED)
            if (gl->GetGraphicsResetStatus() != GL_NO_ERROR)
                break;
    gl->DeleteSync(*fence);
    *fence = NULL;
}

static size_t aligned(const gl_ring *ring, size_t size) { return (size + ring->alignment - 1) / ring->alignment * ring->alignment; }

mgt_status gl_ring_begin(const gl_api *gl, gl_ring *ring, size_t size, size_t parts, const reporter *r)
{
    const size_t needed = size + parts * ring->alignment;
    if (ring->used + needed <= ring->segment_size)
        return MGT_OK;
    if (needed > ring->segment_size) {
        gl_ring grown;
        const mgt_status status = gl_ring_create(gl, &grown, needed + needed / 2, r);
        if (status == MGT_OK) {
            gl_ring_free(gl, ring); /* OpenGL keeps the buffer until the commands that use it have run */
            *ring = grown;
        }
        return status;
    }
    ring->fences[ring->segment] = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl->Flush(); /* so that the GPU reaches the fence while the other segments are filled */
    ring->segment = (ring->segment + 1) % RING_SEGMENTS;
    ring->used = 0;
    wait_for(gl, &ring->fences[ring->segment]);
    return MGT_OK;
}

void *gl_ring_allocate(gl_ring *ring, size_t size, size_t *offset)
{
    *offset = (size_t)ring->segment * ring->segment_size + ring->used;
    ring->used += aligned(ring, size);
    return ring->map + *offset;
}
