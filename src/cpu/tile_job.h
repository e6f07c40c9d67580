/* SPDX-License-Identifier: MIT
 * One tile of a frame by any method, into the worker's own planes. */
#ifndef MANGATA_CPU_TILE_JOB_H
#define MANGATA_CPU_TILE_JOB_H

#include "cpu/frame.h"

/* What a worker needs while it renders a tile; about 200 KiB. */
typedef struct tile_scratch {
    tile_waves close, open;
    tile_guess close_guess, open_guess;
    float jitter_x[TILE_PIXELS], jitter_y[TILE_PIXELS];
    tile_pixels pixels;
    tile_surface surface;
} tile_scratch;

typedef struct tile_wants {
    bool pixels;  /* color, coverage or mask */
    bool surface; /* depth or normal */
} tile_wants;

/* Fills scratch->pixels and scratch->surface for the tile (tile_x, tile_y) of the lattice. Not for the reference. */
void tile_render(const frame *f, const lane_kernels *kernels, const float *sky, tile_wants wants, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch);

#endif
