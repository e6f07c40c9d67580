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

/* Binding points; those in the shaders are equal. Names that no program uses together share numbers. */
enum {
    BIND_FRAME = 0,   /* uniform blocks */
    BIND_PICTURE = 1, /* uniform data of a pass over objects or of a map of slopes */
    BIND_PASS = 2,
    BIND_EXTRA = 3,         /* the view that sorts tiles, a map of slopes, glare, a blend, or window */
    BIND_UNIFORM_WAVES = 4, /* the frame's waves if gl_renderer.waves_in_block is true */
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
    BIND_WAVES = 6,   /* the frame's waves if they are in no uniform block, the waves of the map of slopes, or all sets of waves of cells */
    BIND_FOAM = 7,    /* the foam of programs that shade; for cells the foam of each set of waves */
    BIND_SLOTS = 8,   /* method adaptive, scheme podee */
    BIND_PIXELS = 8,  /* method adaptive, cells */
    STORAGE_BINDINGS, /* number of storage bindings that the context must have */

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
    UNIT_HIDDEN = 11, /* images of the passes over objects that methods read */
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
    IMAGE_FOAM = 7,              /* written where pass_data.write_foam is 1 */
    IMAGE_SAMPLES = IMAGE_DEPTH, /* of method adaptive, instead of depth */
    IMAGE_IMPORTANCE,
    IMAGE_DETAIL,
    IMAGE_UNITS = 8 /* objects.comp has names of its own for them */
};

#endif
