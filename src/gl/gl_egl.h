/* SPDX-License-Identifier: MIT
 * An OpenGL context of our own without a window, through libEGL opened at run time. */
#ifndef MANGATA_GL_GL_EGL_H
#define MANGATA_GL_GL_EGL_H

#include "frame/backend.h"

typedef struct gl_egl gl_egl;

/* Creates an OpenGL 4.5 core context on EGL device number `device`, which the caller destroys. It is not made current. */
mgt_status gl_egl_create(gl_egl **egl, uint32_t device, const reporter *r);
void gl_egl_destroy(gl_egl *egl);

mgt_gl_function gl_egl_get_proc(const char *name);

/* The context and surfaces that were current on the thread before ours. */
typedef struct gl_egl_scope {
    void *display, *draw, *read, *context;
    unsigned api;
} gl_egl_scope;

/* Makes our context current on this thread and saves the previous one in `scope`. gl_egl_leave() makes the previous one current again. */
mgt_status gl_egl_enter(const gl_egl *egl, gl_egl_scope *scope, const reporter *r);
void gl_egl_leave(const gl_egl *egl, const gl_egl_scope *scope);

#endif
