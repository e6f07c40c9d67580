/* SPDX-License-Identifier: MIT
 * The state of a host's OpenGL context that the backend touches: saved before a call and put back after it. */
#ifndef MANGATA_GL_GL_HOST_STATE_H
#define MANGATA_GL_GL_HOST_STATE_H

#include "gl/gl_api.h"
#include "gl/gl_pass_data.h"

enum { DRAW_BUFFERS = 8, CAPABILITIES = 22, PIXEL_STORES = 16, VIEWPORTS = 16 };

typedef struct buffer_range {
    GLint name;
    GLint64 start, size;
} buffer_range;

typedef struct image_binding {
    GLint name, level, layered, layer, access, format;
} image_binding;

/* The saved state: program, buffers, textures, images, pixel store, and the state that drawing a view changes. */
typedef struct gl_host_state {
    GLint program;
    GLint uniform_buffer, storage_buffer, pack_buffer, unpack_buffer, indirect_buffer, query_buffer;
    bool group_fits; /* the stack of debug groups has room for one more; OpenGL has no way to put one of the host's back */
    buffer_range uniform[UNIFORM_BINDINGS], storage[STORAGE_BINDINGS];
    GLint active_texture, texture[TEXTURE_UNITS], table[TEXTURE_UNITS], sampler[TEXTURE_UNITS];
    image_binding images[IMAGE_UNITS];
    GLint pixel_store[PIXEL_STORES];

    GLint vertex_array, draw_framebuffer;
    GLfloat viewport[4], depth_range[2];
    GLint clip_origin, clip_depth, patch_vertices;
    GLboolean capabilities[CAPABILITIES];
    GLboolean blend, scissor[VIEWPORTS], depth_mask;
    GLboolean color_mask[DRAW_BUFFERS][4];
    GLint draw_buffers, viewports;
    GLint depth_func, polygon_mode[2];
    GLint blend_source_rgb, blend_destination_rgb, blend_source_alpha, blend_destination_alpha, blend_equation_rgb, blend_equation_alpha;
} gl_host_state;

/* Saves the state of the current context, then sets the pixel store and unbinds the buffers that transfers and queries of the backend would use. */
void gl_host_state_save(const gl_api *gl, gl_host_state *s);
void gl_host_state_restore(const gl_api *gl, const gl_host_state *s);

/* Restores only the part of the state that drawing triangles uses. */
void gl_host_state_restore_drawing(const gl_api *gl, const gl_host_state *s);

/* Switches off everything that would change what a full-screen triangle writes, except depth test and blending. */
void gl_host_state_neutral(const gl_api *gl, const gl_host_state *s);

#endif
