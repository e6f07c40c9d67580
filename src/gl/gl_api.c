/* SPDX-License-Identifier: MIT
 * The OpenGL functions that the backend calls, as a table filled at run time. */
#include "gl/gl_api.h"

const char *gl_api_load(gl_api *gl, mgt_gl_get_proc get_proc)
{
#define GL_LOAD(TYPE, name)                             \
    gl->name = (PFNGL##TYPE##PROC)get_proc("gl" #name); \
    if (!gl->name)                                      \
        return "gl" #name;
    GL_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    return NULL;
}
