/* SPDX-License-Identifier: MIT
 * Layers of the objects that a camera sees, drawn by the GPU. They are those of cpu/gbuffer.h. */
#ifndef MANGATA_GL_GL_GBUFFER_H
#define MANGATA_GL_GL_GBUFFER_H

#include "frame/gbuffer_job.h"
#include "gl/gl_memory.h"
#include "gl/gl_objects.h"

struct gl_renderer;

typedef struct gl_gbuffer {
    gl_image depth;    /* DEPTH_COMPONENT32F: least_depth divided by the depth along the view, metres; 0: nothing */
    gl_image triangle; /* R32I: index of the world's triangle; −1: nothing */
    GLuint framebuffer;
} gl_gbuffer;

/* All layers of a frame. Texel (0, 0) is the top left pixel of the guard band. The textures may be larger than the layers. */
typedef struct gl_gbuffers {
    gl_gbuffer front, refracted, mirrored;
    uint32_t width, height; /* guard band included */
    uint32_t left, top;
    float least_depth;
} gl_gbuffers;

/* Draws the layers of the objects. `mirrored` is the job of the mirrored camera, whose refracted layer shows what the surface mirrors. NULL: it is not drawn. */
mgt_status gl_gbuffers_draw(struct gl_renderer *g, const gbuffer_job *job, const gbuffer_job *mirrored, const reporter *r);
void gl_gbuffers_free(const gl_api *gl, gl_gbuffers *b);

#endif
