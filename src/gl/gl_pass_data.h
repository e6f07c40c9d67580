/* SPDX-License-Identifier: MIT
 * The uniform structs of kernels and passes, seen from ordinary C. */
#ifndef MANGATA_GL_GL_PASS_DATA_H
#define MANGATA_GL_GL_PASS_DATA_H

#include "cpu/kernel_data.h"

#define STRUCT(name)          \
    typedef struct name name; \
    struct name
#include "gl/shaders/pass_data.k"
#undef STRUCT

_Static_assert(sizeof(PassData) % 16 == 0 && sizeof(GlareData) % 16 == 0 && sizeof(WindowData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(SortData) == 32 && sizeof(TileWave) == 16 && sizeof(NodeData) == 48, "std430 layout");

/* Binding points, as in the shaders. */
enum {
    BIND_FRAME = 0, /* uniform blocks */
    BIND_WAVES = 1,
    BIND_PASS = 2,
    BIND_EXTRA = 3, /* the view that sorts tiles, glare, or window */
    UNIFORM_BINDINGS,

    BIND_TILES = 0, /* storage blocks */
    BIND_TILE_WAVES = 1,
    BIND_MARCH = 2,
    BIND_NODES = 3,
    BIND_GLARE_WEIGHTS = 4,
    BIND_SORT = 5,
    BIND_WAVE_STORAGE = 6, /* where a uniform block cannot hold the waves */
    STORAGE_BINDINGS,

    UNIT_SKY = 0, /* textures */
    UNIT_FINE = 1,
    UNIT_COARSE = 2,
    UNIT_DEPTH = 3,
    TEXTURE_UNITS,

    IMAGE_COLOR = 0, /* images */
    IMAGE_COVERAGE,
    IMAGE_WATER,
    IMAGE_DEPTH,
    IMAGE_NORMAL,
    IMAGE_UNITS
};

#endif
