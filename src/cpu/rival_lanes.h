/* SPDX-License-Identifier: MIT
 * The rival methods' functions that are compiled once per lane width. */
#ifndef MANGATA_CPU_RIVAL_LANES_H
#define MANGATA_CPU_RIVAL_LANES_H

#include "cpu/lean_map.h"

/* What the pixels of a tile are rendered from. */
typedef struct rival_tile {
    const FrameData *frame;
    const float *sky;
    const lean_map *lean; /* NULL unless the method is lean or leadr */
    mgt_method method;
    const tile_waves *close;
    const tile_guess *close_guess;
    const tile_waves *open; /* NULL unless the camera moves and the method counts the shutter */
    const tile_guess *open_guess;
} rival_tile;

struct rival_kernels {
    void (*pixels)(const rival_tile *tile, tile_pixels *out);
    /* LEAN_ROWS rows of the map's level 0; a phase per wave. */
    void (*lean_rows)(const lean_waves *waves, const lean_phase *phases, float *slope_x, float *slope_z);
};

extern const rival_kernels rival_kernels_1;
extern const rival_kernels rival_kernels_4;
#if defined(__x86_64__)
extern const rival_kernels rival_kernels_8;
extern const rival_kernels rival_kernels_16;
#endif

#endif
