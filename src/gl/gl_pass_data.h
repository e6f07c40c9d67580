/* SPDX-License-Identifier: MIT
 * The uniform structs of kernels and passes, seen from ordinary C. */
#ifndef MANGATA_GL_GL_PASS_DATA_H
#define MANGATA_GL_GL_PASS_DATA_H

#include "frame/kernel_data.h"

#define STRUCT(name)          \
    typedef struct name name; \
    struct name
#include "gl/shaders/pass_data.k"
#undef STRUCT

_Static_assert(sizeof(PassData) % 16 == 0 && sizeof(GlareData) % 16 == 0 && sizeof(WindowData) % 16 == 0 && sizeof(SlotsData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(LeanWave) == 32 && sizeof(LeanData) % 16 == 0 && sizeof(LeanPass) % 16 == 0 && sizeof(BlendData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(GbufferData) % 16 == 0 && sizeof(ObjectsData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(CellsData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(SortData) == 32 && sizeof(TileWave) == 16, "std430 layout");

/* Binding points, as in the shaders. */
enum {
    BIND_FRAME = 0,   /* uniform blocks */
    BIND_PICTURE = 1, /* what a pass over objects or a map of slopes reads */
    BIND_PASS = 2,
    BIND_EXTRA = 3,         /* the view that sorts tiles, a map of slopes, glare, a blend, or window */
    BIND_UNIFORM_WAVES = 4, /* the frame's waves, where waves_in_block of gl_renderer.h */
    UNIFORM_BINDINGS,

    BIND_TILES = 0, /* storage blocks */
    BIND_TILE_WAVES = 1,
    BIND_SEARCH = 2,
    BIND_NODES = 3,
    BIND_GLARE_WEIGHTS = 4,
    BIND_SORT = 5,
    BIND_OBJECT_WATER = 4, /* objects: see objects_pixel.glsl */
    BIND_OBJECT_LISTS = 5,
    BIND_PLAN = 4, /* method adaptive, scheme podee: see slots_data.glsl */
    BIND_TASKS = 5,
    BIND_LEAVES = 4, /* method adaptive, cells: see cells_data.glsl */
    BIND_CELLS = 5,
    BIND_WAVES = 6, /* the frame's waves, or those of the map of slopes, else; for cells: all sets of waves */
    BIND_FOAM = 7,  /* programs of shading; for cells: one for each set of waves */
    BIND_SLOTS = 8, /* method adaptive, beside foam */
    BIND_PIXELS = 8,
    STORAGE_BINDINGS, /* so many must be there */

    UNIT_SKY = 0, /* textures; those that no program reads together share units */
    UNIT_FINE = 1,
    UNIT_COARSE = 2,
    UNIT_SKYLINE = 3,
    UNIT_SWEEP = 1, /* tables of podee-* */
    UNIT_FRACTION = 2,
    UNIT_LEAN_MEAN = 1,
    UNIT_LEAN_SQUARE = 2,
    UNIT_CURRENT = 1,  /* color, coverage and mask of the picture that is blended */
    UNIT_LUMA = 4,     /* fxaa: that picture's luma */
    UNIT_HISTORY = 4,  /* taa: color, coverage and mask of the history */
    UNIT_DEPTH = 7,    /* taa: depth of that picture, where the camera moves */
    UNIT_VERTICES = 1, /* objects: see objects_data.glsl */
    UNIT_INDICES,
    UNIT_OWNERS,
    UNIT_PLANES,
    UNIT_MATERIALS,
    UNIT_TEXELS,
    UNIT_SHADOWS,
    UNIT_REFRACTED_LAYER, /* depth and triangle */
    UNIT_MIRRORED = UNIT_REFRACTED_LAYER + 2,
    UNIT_FRONT_LAYER = UNIT_MIRRORED + 2,
    UNIT_TREE = UNIT_FRONT_LAYER + 2,
    UNIT_NEIGHBOURS,
    UNIT_FRONT = 1,
    UNIT_HIDDEN = 11, /* what methods see of objects */
    UNIT_CLEAR,
    UNIT_DEEP,
    UNIT_BODY,
    UNIT_REFLECTION,
    TEXTURE_UNITS = 16,

    IMAGE_COLOR = 0, /* images */
    IMAGE_COVERAGE,
    IMAGE_WATER,
    IMAGE_DEPTH,
    IMAGE_NORMAL,
    IMAGE_LAYERS,
    IMAGE_SAMPLES = IMAGE_DEPTH, /* method adaptive's instead */
    IMAGE_IMPORTANCE,
    IMAGE_DETAIL,
    IMAGE_UNITS = 7 /* objects.comp has names of its own for them */
};

#endif
