/* SPDX-License-Identifier: MIT
 * See gl_calls.h. */
#include "gl_calls.h"

#include <EGL/egl.h>
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <string.h>

/* X(result, name, parameters, arguments): waiting and reading back, building shaders, making storage. */
#define COUNTED_CALLS(X)                                                                                                                                   \
    X(void, glFinish, (void), ())                                                                                                                          \
    X(void, glReadPixels, (GLint x, GLint y, GLsizei w, GLsizei h, GLenum f, GLenum t, void *p), (x, y, w, h, f, t, p))                                    \
    X(void, glReadnPixels, (GLint x, GLint y, GLsizei w, GLsizei h, GLenum f, GLenum t, GLsizei s, void *p), (x, y, w, h, f, t, s, p))                     \
    X(void, glGetTexImage, (GLenum target, GLint l, GLenum f, GLenum t, void *p), (target, l, f, t, p))                                                    \
    X(void, glGetTextureImage, (GLuint n, GLint l, GLenum f, GLenum t, GLsizei s, void *p), (n, l, f, t, s, p))                                            \
    X(void, glGetTextureSubImage, (GLuint n, GLint l, GLint x, GLint y, GLint z, GLsizei w, GLsizei h, GLsizei d, GLenum f, GLenum t, GLsizei s, void *p), \
      (n, l, x, y, z, w, h, d, f, t, s, p))                                                                                                                \
    X(void, glGetBufferSubData, (GLenum target, GLintptr o, GLsizeiptr s, void *p), (target, o, s, p))                                                     \
    X(void, glGetNamedBufferSubData, (GLuint n, GLintptr o, GLsizeiptr s, void *p), (n, o, s, p))                                                          \
    X(void *, glMapBuffer, (GLenum target, GLenum access), (target, access))                                                                               \
    X(void *, glMapBufferRange, (GLenum target, GLintptr o, GLsizeiptr s, GLbitfield access), (target, o, s, access))                                      \
    X(void *, glMapNamedBuffer, (GLuint n, GLenum access), (n, access))                                                                                    \
    X(void *, glMapNamedBufferRange, (GLuint n, GLintptr o, GLsizeiptr s, GLbitfield access), (n, o, s, access))                                           \
    X(GLuint, glCreateShader, (GLenum type), (type))                                                                                                       \
    X(void, glCompileShader, (GLuint n), (n))                                                                                                              \
    X(GLuint, glCreateProgram, (void), ())                                                                                                                 \
    X(void, glLinkProgram, (GLuint n), (n))                                                                                                                \
    X(GLuint, glCreateShaderProgramv, (GLenum type, GLsizei c, const GLchar *const *s), (type, c, s))                                                      \
    X(void, glGenBuffers, (GLsizei c, GLuint * n), (c, n))                                                                                                 \
    X(void, glCreateBuffers, (GLsizei c, GLuint * n), (c, n))                                                                                              \
    X(void, glBufferData, (GLenum target, GLsizeiptr s, const void *p, GLenum usage), (target, s, p, usage))                                               \
    X(void, glNamedBufferData, (GLuint n, GLsizeiptr s, const void *p, GLenum usage), (n, s, p, usage))                                                    \
    X(void, glNamedBufferStorage, (GLuint n, GLsizeiptr s, const void *p, GLbitfield flags), (n, s, p, flags))                                             \
    X(void, glGenTextures, (GLsizei c, GLuint * n), (c, n))                                                                                                \
    X(void, glCreateTextures, (GLenum target, GLsizei c, GLuint * n), (target, c, n))                                                                      \
    X(void, glTextureStorage2D, (GLuint n, GLsizei l, GLenum f, GLsizei w, GLsizei h), (n, l, f, w, h))                                                    \
    X(void, glCreateFramebuffers, (GLsizei c, GLuint * n), (c, n))                                                                                         \
    X(void, glCreateVertexArrays, (GLsizei c, GLuint * n), (c, n))

enum {
#define X(result, name, parameters, arguments) CALL_##name,
    COUNTED_CALLS(X)
#undef X
        CALL_glClientWaitSync,
    CALL_COUNT
};
_Static_assert((int)CALL_COUNT <= (int)CALL_KINDS, "room for every kind");

static long counts[CALL_COUNT];

#define X(result, name, parameters, arguments) \
    static result counted_##name parameters    \
    {                                          \
        counts[CALL_##name]++;                 \
        return name arguments;                 \
    }
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
COUNTED_CALLS(X)
#pragma GCC diagnostic pop
#undef X

static GLenum counted_glClientWaitSync(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    counts[CALL_glClientWaitSync] += timeout > 0 && glClientWaitSync(sync, 0, 0) == GL_TIMEOUT_EXPIRED;
    return glClientWaitSync(sync, flags, timeout);
}

static const struct {
    const char *name;
    mgt_gl_function function;
} counted[CALL_COUNT] = {
#define X(result, name, parameters, arguments) {#name, (mgt_gl_function)counted_##name},
    COUNTED_CALLS(X)
#undef X
        {"glClientWaitSync", (mgt_gl_function)counted_glClientWaitSync},
};

mgt_gl_function gl_calls_get_proc(const char *name)
{
    for (int i = 0; i < CALL_COUNT; i++)
        if (strcmp(counted[i].name, name) == 0)
            return counted[i].function;
    return eglGetProcAddress(name);
}

gl_calls gl_calls_read(void)
{
    gl_calls calls = {.kinds = CALL_COUNT};
    for (int i = 0; i < CALL_COUNT; i++) {
        calls.names[i] = counted[i].name;
        calls.counts[i] = counts[i];
    }
    return calls;
}

/* ---- allocations ----------------------------------------------------------------------------------------- */

static long allocations;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);

void *__wrap_malloc(size_t size)
{
    allocations++;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    allocations++;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    allocations++;
    return __real_realloc(memory, size);
}

long allocations_read(void) { return allocations; }
