/* SPDX-License-Identifier: MIT
 * One tile of a frame by any method, into the worker's own planes. */
#ifndef MANGATA_CPU_TILE_JOB_H
#define MANGATA_CPU_TILE_JOB_H

#include "cpu/refraction.h"
#include "cpu/sample_sums.h"
#include "frame/frame_waves.h"

/* What a worker needs while it renders a tile; about 1.4 MiB, of which waves touch what the scene has. */
typedef struct tile_scratch {
    uint32_t worker; /* whose it is */
    tile_waves close, open;
    tile_estimate close_estimate[HIT_ROWS], open_estimate[HIT_ROWS];
    float jitter_x[TILE_PIXELS], jitter_y[TILE_PIXELS];
    tile_pixels pixels, sample;
    sample_sums sums; /* of ssaa */
    tile_surface surface;
    wave_set sample_waves;
    tile_objects objects; /* where there are some */
    tile_opened opened;   /* where there are objects and the camera moves */
} tile_scratch;

typedef struct tile_wants {
    bool pixels;  /* color, coverage or mask */
    bool surface; /* depth or normal */
} tile_wants;

/* One frame's tiles. */
typedef struct tile_job {
    const frame *frame;
    const frame_waves *waves;
    const lane_kernels *kernels;
    const float *sky;          /* the table of a sky_state */
    const podee_tables *podee; /* where podee-* with kernels needs them */
    tile_wants wants;
    /* Asked between the samples of a tile, on any worker; false: leave the tile unfinished. NULL: never asked. */
    bool (*keep_going)(void *argument, uint32_t worker);
    void *keep_going_argument;
    const struct lean_map *lean; /* filled, for methods lean and leadr; else NULL */
    refraction *objects;         /* prepared for the frame; NULL: the scene has none */
    bool behind;                 /* objects in front of the water are left out */
    picture_sums sums;           /* of methods that take samples */
} tile_job;

/* Whether any pixel of the tile can see water. */
bool tile_sees_water(const tile_waves *tile);

/* The estimates of its pixels; zero where none does. */
void tile_find_estimates(const lane_kernels *kernels, const FrameData *data, const tile_waves *tile, tile_estimate *estimate);

/* Where the camera moves: joins what close and open know of the light. */
void tile_join_reach(tile_scratch *scratch);

/* Fills scratch->pixels and scratch->surface for the tile (tile_x, tile_y) of the lattice. Not for the reference. */
void tile_render(const tile_job *job, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch);

/* Fills scratch->objects alone. */
void tile_see_objects(const tile_job *job, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch);

#endif
