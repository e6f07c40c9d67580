/* SPDX-License-Identifier: MIT
 * Stands in for the OpenGL backend in builds that lack the headers of EGL or OpenGL. */
#include "frame/backend.h"
#include "mangata/gl.h"

static mgt_status missing_create(void **state, const mgt_context_desc *desc, const reporter *r, mgt_context_info *info)
{
    (void)state, (void)desc, (void)info;
    return report_error(r, MGT_ERROR_UNAVAILABLE, "context.backend",
                        "this build has no OpenGL backend (libegl-dev or libgl-dev was missing); use the CPU backend");
}

static void missing_destroy(void *state) { (void)state; }

const backend_functions gl_backend = {.create = missing_create, .destroy = missing_destroy};

const char *mgt_gl_source_name(size_t index)
{
    (void)index;
    return NULL;
}
