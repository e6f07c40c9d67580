/* SPDX-License-Identifier: MIT
 * The programs of the passes: built when first needed, or all of them anew from replaced texts. */
#ifndef MANGATA_GL_GL_PROGRAMS_H
#define MANGATA_GL_GL_PROGRAMS_H

#include "frame/backend.h"
#include "gl/gl_api.h"
#include "gl/gl_sources.h"

typedef enum gl_program {
    PROGRAM_TILES = 0, /* waves of each tile, sorted */
    PROGRAM_NODES,     /* first hits of the tiles' lattices */
    PROGRAM_SHADE_MANGATA,
    PROGRAM_SHADE_PODEE,
    PROGRAM_SHADE_KERNELS, /* podee-* with kernels from tables */
    PROGRAM_SHADE_LEAN,
    PROGRAM_SHADE_LEADR,
    PROGRAM_SHADE_BRUNETON,
    PROGRAM_SHADE_TNDF,
    PROGRAM_SAMPLES, /* point samples: none, ssaa */
    PROGRAM_MSAA,
    PROGRAM_TOKUYOSHI,
    PROGRAM_SURFACE,     /* depth and normal at an instant */
    PROGRAM_NORMAL,      /* the filtered methods' mean shading normal */
    PROGRAM_LEAN_FILL,   /* the map of slope moments, level 0 … */
    PROGRAM_LEAN_SHRINK, /* … and the next coarser level */
    PROGRAM_LUMA,        /* of the displayed picture, for the next */
    PROGRAM_FXAA,
    PROGRAM_TAA, /* one frame into the history */
    PROGRAM_GLARE_DOWN,
    PROGRAM_GLARE_UP,
    PROGRAM_DISPLAY,
    PROGRAM_COPY,             /* a layer into a texture of the host */
    PROGRAM_VIEW,             /* layers into a framebuffer of the host */
    PROGRAM_GBUFFER,          /* objects as they are */
    PROGRAM_GBUFFER_BENT,     /* … and where refraction by the flat mean surface shows them */
    PROGRAM_OBJECTS,          /* water in the pixels, and which of these see objects: */
    PROGRAM_OBJECTS_NEAR,     /* in front of the water, */
    PROGRAM_OBJECTS_THROUGH,  /* through its surface, */
    PROGRAM_OBJECTS_TRACED,   /* there, where rays are traced, */
    PROGRAM_OBJECTS_PLACES,   /* through several places of each pixel, */
    PROGRAM_OBJECTS_MIRRORED, /* in the mirror that it is, */
    PROGRAM_OBJECTS_DEEP,     /* or only water */
    PROGRAM_OBJECTS_BLEND,    /* both ends of the shutter */
    PROGRAM_OBJECTS_COMPOSE,  /* what is in front over the layers */
    PROGRAM_COUNT
} gl_program;

typedef struct gl_programs {
    const gl_api *gl;
    const char *defines; /* of this context, before those of a program; static */
    gl_replacements replaced;
    GLuint names[PROGRAM_COUNT]; /* 0: not built yet */
    uint64_t hashes[PROGRAM_COUNT];
} gl_programs;

/* The program's name, built now if it has not been; 0 on failure, which is reported. */
GLuint gl_program_get(gl_programs *p, gl_program which, const reporter *r, mgt_status *status);

/* Builds every program from new texts; keeps all old ones on a failure. */
mgt_status gl_programs_replace(gl_programs *p, const mgt_gl_source *sources, size_t count, const reporter *r);

void gl_programs_free(gl_programs *p);

#endif
