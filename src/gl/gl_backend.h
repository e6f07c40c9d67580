/* SPDX-License-Identifier: MIT
 * The state of the OpenGL backend, and how a call enters and leaves its context. */
#ifndef MANGATA_GL_GL_BACKEND_H
#define MANGATA_GL_GL_BACKEND_H

#include "gl/gl_egl.h"
#include "gl/gl_host_state.h"
#include "gl/gl_renderer.h"
#include "frame/targets.h"

typedef struct gl_backend_state {
    gl_egl *egl; /* our own context; NULL: the backend uses the host's */
    gl_renderer *renderer;
    gl_buffer transfer;
    mgt_context_desc desc;
    reporter report; /* where OpenGL's debug messages go */
} gl_backend_state;

/* State of the thread and of the host's context that a call saves when it begins and restores when it ends. */
typedef struct gl_scope {
    gl_egl_scope egl;
    gl_host_state host;
} gl_scope;

/* Makes the backend's context current, or saves the state of the host's. */
mgt_status gl_enter(gl_backend_state *s, gl_scope *scope, const reporter *r);

/* Restores what gl_enter() saved. Returns `status`; if that is MGT_OK, the error that OpenGL reports, if any. */
mgt_status gl_leave(gl_backend_state *s, const gl_scope *scope, mgt_status status, const reporter *r);

/* The layers that a call asks for. */
typedef struct layer_wants {
    bool color, pixels, depth, normal, foam, display;
    bool spent; /* samples, importance or detail is asked for */
} layer_wants;

void layer_wants_add(layer_wants *w, mgt_layer layer, bool display);

/* Renders the layers of a scene that has been checked. `area` returns the part of the image that they hold: the crop, or the whole image for glare and for
 * methods that work on whole pictures. */
mgt_status gl_layers_render(gl_backend_state *s, const reporter *r, const mgt_scene *scene, const layer_wants *wants, bool report_progress, region *area);

mgt_status gl_render_textures(void *state, const reporter *r, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count);
mgt_status gl_render_views(void *state, const reporter *r, const checked_view *views, size_t count);

#endif
