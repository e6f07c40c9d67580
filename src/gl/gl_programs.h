/* SPDX-License-Identifier: MIT
 * The programs of the passes: built when first needed, or all of them anew from replaced texts. */
#ifndef MANGATA_GL_GL_PROGRAMS_H
#define MANGATA_GL_GL_PROGRAMS_H

#include "frame/backend.h"
#include "gl/gl_api.h"
#include "gl/gl_sources.h"
#include "params/methods.h"

typedef enum gl_program {
    PROGRAM_SAMPLERS = 0, /* a sampler in every place, for llvmpipe */
    PROGRAM_TILES,        /* waves of each tile, sorted */
    PROGRAM_NODES,        /* first hits of the tiles' lattices */
    PROGRAM_SURFACE,      /* depth and normal at an instant */
    PROGRAM_NORMAL,       /* the filtered methods' mean shading normal */
    PROGRAM_LEAN_FILL,    /* the map of slope moments, level 0 … */
    PROGRAM_LEAN_SHRINK,  /* … and the next coarser level */
    PROGRAM_LUMA,         /* of the displayed picture, for the next */
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
    PROGRAM_OBJECTS_FRONT,    /* in front of the water, */
    PROGRAM_OBJECTS_THROUGH,  /* through its surface, */
    PROGRAM_OBJECTS_TRACED,   /* there, where rays are traced, */
    PROGRAM_OBJECTS_PLACES,   /* through several places of each pixel, */
    PROGRAM_OBJECTS_MIRRORED, /* in the mirror that it is, */
    PROGRAM_OBJECTS_DEEP,     /* or only water */
    PROGRAM_OBJECTS_BLEND,    /* both ends of the shutter */
    PROGRAM_OBJECTS_COMPOSE,  /* what is in front over the layers */
    PROGRAM_SLOTS_WEIGH,      /* scheme podee of method adaptive: importance of pixels, */
    PROGRAM_SLOTS_SCAN,       /* its prefix sum over tiles, */
    PROGRAM_SLOTS_LIST,       /* the tasks of a band */
    PROGRAM_SLOTS_CHUNKS,     /* and the number of their slots; */
    PROGRAM_SLOTS_TRACE,      /* a ray each, */
    PROGRAM_SLOTS_SUM,        /* their sums, */
    PROGRAM_SLOTS_BLEND,      /* which become part of the picture */
    PROGRAM_CELLS_PLANT,      /* method adaptive: pixels, the first leaves, */
    PROGRAM_CELLS_PLAN,       /* what a round may spend, … */
    PROGRAM_CELLS_CHOOSE,     /* … on which leaves, … */
    PROGRAM_CELLS_ALLOCATE,   /* … where they go, … */
    PROGRAM_CELLS_LIST,       /* … and a list of what is to be rendered: */
    PROGRAM_CELLS_SORT,       /* waves of each tile's cells, */
    PROGRAM_CELLS_SHADE,      /* cells, */
    PROGRAM_CELLS_POINTS,     /* points; */
    PROGRAM_CELLS_GROW,       /* what came of them, */
    PROGRAM_CELLS_CENSUS,     /* and what is left */
    PROGRAM_METHODS,          /* first of the methods' own */
    PROGRAM_COUNT = PROGRAM_METHODS + 2 * METHOD_SLOTS
} gl_program;

/* That shades pixels by a method, from tables or without. Methods whose rows name the same shader share it. */
gl_program gl_method_program(mgt_method method, bool tables);

/* Kinds of water, for which programs are built apart: the three, and on software OpenGL the three of more waves than a uniform block holds. */
typedef enum gl_water { WATER_SINES = 0, WATER_CHOPPY, WATER_FOAM, WATER_MANY_WAVES, WATER_KINDS = 2 * WATER_MANY_WAVES } gl_water;

typedef struct gl_programs {
    const gl_api *gl;
    const char *defines; /* of this context, before those of a program; static */
    gl_replacements replaced;
    gl_water water; /* which programs are asked for */
    struct {
        GLuint names[PROGRAM_COUNT]; /* 0: not built yet */
        uint64_t hashes[PROGRAM_COUNT];
    } of[WATER_KINDS]; /* by `water` */
} gl_programs;

/* The program's name, built now if it has not been; 0 on failure, which is reported. */
GLuint gl_program_get(gl_programs *p, gl_program which, const reporter *r, mgt_status *status);

/* Builds every program from new texts, for the kind of water that was asked for last, those for the other one when they are needed; keeps all old ones on a
 * failure. */
mgt_status gl_programs_replace(gl_programs *p, const mgt_gl_source *sources, size_t count, const reporter *r);

void gl_programs_free(gl_programs *p);

#endif
