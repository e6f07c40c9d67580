/* SPDX-License-Identifier: MIT
 * The programs of the passes. They are built when they are first needed, or all of them again from replaced texts. */
#ifndef MANGATA_GL_GL_PROGRAMS_H
#define MANGATA_GL_GL_PROGRAMS_H

#include "frame/backend.h"
#include "gl/gl_api.h"
#include "gl/gl_sources.h"
#include "params/methods.h"

typedef enum gl_program {
    PROGRAM_SAMPLERS = 0, /* reads textures of all units, for llvmpipe */
    PROGRAM_TILES,        /* sorts the waves of each tile */
    PROGRAM_NODES,        /* first hits of the tiles' lattices */
    PROGRAM_SURFACE,      /* depth and normal at an instant */
    PROGRAM_NORMAL,       /* the filtered methods' mean shading normal */
    PROGRAM_LEAN_FILL,    /* the map of slope moments, level 0 */
    PROGRAM_LEAN_SHRINK,  /* that map's next coarser level */
    PROGRAM_LUMA,         /* luma of the displayed picture, for fxaa */
    PROGRAM_FXAA,
    PROGRAM_TAA, /* blends one frame into the history */
    PROGRAM_GLARE_DOWN,
    PROGRAM_GLARE_UP,
    PROGRAM_DISPLAY,
    PROGRAM_COPY,             /* a layer into a texture of the host */
    PROGRAM_VIEW,             /* layers into a framebuffer of the host */
    PROGRAM_GBUFFER,          /* objects as they are */
    PROGRAM_GBUFFER_BENT,     /* objects where refraction by the flat mean surface shows them */
    PROGRAM_OBJECTS,          /* water in each pixel, and the pixels that see objects */
    PROGRAM_OBJECTS_FRONT,    /* objects in front of the water */
    PROGRAM_OBJECTS_THROUGH,  /* objects through its surface */
    PROGRAM_OBJECTS_TRACED,   /* objects through the surface, by traced rays */
    PROGRAM_OBJECTS_PLACES,   /* objects through several places of each pixel */
    PROGRAM_OBJECTS_MIRRORED, /* objects that the surface mirrors */
    PROGRAM_OBJECTS_DEEP,     /* light of the water for pixels under it that see no surface */
    PROGRAM_OBJECTS_BLEND,    /* mean of both ends of the shutter */
    PROGRAM_OBJECTS_COMPOSE,  /* draws objects in front over the layers */
    PROGRAM_SLOTS_WEIGH,      /* scheme podee of method adaptive: importance of pixels */
    PROGRAM_SLOTS_SCAN,       /* prefix sum of importance over tiles */
    PROGRAM_SLOTS_LIST,       /* the tasks of a band */
    PROGRAM_SLOTS_CHUNKS,     /* workgroups that each chunk of slots needs */
    PROGRAM_SLOTS_TRACE,      /* a ray for each slot */
    PROGRAM_SLOTS_SUM,        /* sums of the slots of a pixel */
    PROGRAM_SLOTS_BLEND,      /* sums into the picture */
    PROGRAM_CELLS_PLANT,      /* method adaptive: each pixel's first cell */
    PROGRAM_CELLS_PLAN,       /* evaluations that a round may spend */
    PROGRAM_CELLS_CHOOSE,     /* cells that the round splits or gives points */
    PROGRAM_CELLS_ALLOCATE,   /* places of each tile's cells, jobs and groups */
    PROGRAM_CELLS_LIST,       /* list of the cells to render */
    PROGRAM_CELLS_SORT,       /* sorts the waves for each tile's cells */
    PROGRAM_CELLS_SHADE,      /* shades cells */
    PROGRAM_CELLS_POINTS,     /* point samples of cells */
    PROGRAM_CELLS_GROW,       /* cells take what shading found */
    PROGRAM_CELLS_CENSUS,     /* cost and worth of a tile's open cells */
    PROGRAM_METHODS,          /* first of the programs that shade by a method */
    PROGRAM_COUNT = PROGRAM_METHODS + 2 * METHOD_SLOTS
} gl_program;

/* The program that shades pixels by a method. `tables`: the variant that reads tables. Methods whose rows name the same shader share a program. */
gl_program gl_method_program(mgt_method method, bool tables);

/* Kinds of water. Each has programs of its own. WATER_MANY_WAVES is added to the first three on software OpenGL if there are more waves than a uniform block
 * holds. */
typedef enum gl_water { WATER_SINES = 0, WATER_CHOPPY, WATER_FOAM, WATER_MANY_WAVES, WATER_KINDS = 2 * WATER_MANY_WAVES } gl_water;

typedef struct gl_programs {
    const gl_api *gl;
    const char *defines; /* #define lines of this context, which precede those of a program; a string literal */
    gl_replacements replaced;
    gl_water water; /* kind of water of the next programs that are asked for */
    struct {
        GLuint names[PROGRAM_COUNT]; /* 0: not built yet */
        uint64_t hashes[PROGRAM_COUNT];
    } of[WATER_KINDS]; /* indexed by gl_water */
} gl_programs;

/* The OpenGL name of program `which`. Builds the program if it has not been built. Returns 0 after a failure, which it reports and puts in `status`. */
GLuint gl_program_get(gl_programs *p, gl_program which, const reporter *r, mgt_status *status);

/* Builds every program from new texts, for the kind of water that was asked for last. Programs for other kinds are built when they are needed. After a failure
 * all old programs stay. */
mgt_status gl_programs_replace(gl_programs *p, const mgt_gl_source *sources, size_t count, const reporter *r);

void gl_programs_free(gl_programs *p);

#endif
