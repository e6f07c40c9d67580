/* SPDX-License-Identifier: MIT
 * What a camera sees of the objects, drawn by the GPU: the layers of cpu/gbuffer.h. */
#ifndef MANGATA_GL_GL_GBUFFER_H
#define MANGATA_GL_GL_GBUFFER_H

#include "frame/gbuffer_job.h"
#include "gl/gl_memory.h"
#include "gl/gl_objects.h"

struct gl_renderer;

typedef struct gl_gbuffer {
    gl_image depth;    /* DEPTH_COMPONENT32F: least_depth over metres along the view; 0: nothing */
    gl_image triangle; /* R32I; −1: nothing */
    GLuint framebuffer;
} gl_gbuffer;

/* Texel (0, 0) is the guard band's top left pixel; the textures may be larger. */
typedef struct gl_gbuffers {
    gl_gbuffer front, refracted, mirrored;
    uint32_t width, height; /* guard band included */
    uint32_t left, top;
    float least_depth;
} gl_gbuffers;

/* Draws the layers of the objects; `mirrored`, whose refracted layer is what the surface mirrors, may be NULL. */
mgt_status gl_gbuffers_draw(struct gl_renderer *g, const gbuffer_job *job, const gbuffer_job *mirrored, const reporter *r);
void gl_gbuffers_free(const gl_api *gl, gl_gbuffers *b);

#endif
