/* SPDX-License-Identifier: MIT
 * Contexts of OpenGL for tests, and a host: an OpenGL context that is current on this thread, as another program would have it. */
#ifndef MANGATA_TESTS_GL_HOST_H
#define MANGATA_TESTS_GL_HOST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "gl/gl_api.h"
#include "gl/gl_egl.h"
#include "mangata/mangata.h"

/* `get_proc`: functions of the host's context; NULL for a context of its own. */
static inline mgt_status gl_context_create(mgt_context **context, mgt_gl_get_proc get_proc)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.gl_get_proc = get_proc;
    *context = NULL;
    return mgt_context_create(context, &desc);
}

static inline mgt_context *gl_context_of(mgt_gl_get_proc get_proc)
{
    mgt_context *context;
    if (gl_context_create(&context, get_proc) != MGT_OK)
        fail_msg("%s", mgt_last_error(NULL));
    return context;
}

/* Says why there is no OpenGL here. A test ends with 77 then, which ctest counts as skipped. */
static inline bool gl_is_missing(void)
{
    mgt_context *context;
    const mgt_status status = gl_context_create(&context, NULL);
    mgt_context_destroy(context);
    if (status == MGT_ERROR_UNAVAILABLE)
        printf("SKIPPED: %s\n", mgt_last_error(NULL));
    return status == MGT_ERROR_UNAVAILABLE;
}

typedef struct gl_host {
    gl_egl *egl;
    gl_egl_scope scope;
    gl_api gl;
} gl_host;

static inline void gl_host_start(gl_host *h)
{
    char error[REPORTER_TEXT] = "";
    const reporter r = {.error = error};
    *h = (gl_host){0};
    if (gl_egl_create(&h->egl, 0, &r) != MGT_OK || gl_egl_enter(h->egl, &h->scope, &r) != MGT_OK)
        fail_msg("%s", error);
    assert_null(gl_api_load(&h->gl, gl_egl_get_proc));
}

static inline void gl_host_stop(gl_host *h)
{
    gl_egl_leave(h->egl, &h->scope);
    gl_egl_destroy(h->egl);
}

#endif
