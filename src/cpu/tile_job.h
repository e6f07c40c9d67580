/* SPDX-License-Identifier: MIT
 * Renders one tile of a frame by any method into the worker's planes. */
#ifndef MANGATA_CPU_TILE_JOB_H
#define MANGATA_CPU_TILE_JOB_H

#include "cpu/refraction.h"
#include "cpu/sample_sums.h"
#include "frame/frame_waves.h"

/* A worker's memory for a tile. */
typedef struct tile_scratch {
    uint32_t worker; /* index of the worker that owns this memory */
    tile_waves close, open;
    tile_estimate close_estimate[HIT_ROWS], open_estimate[HIT_ROWS];
    float jitter_x[TILE_PIXELS], jitter_y[TILE_PIXELS];
    tile_pixels pixels, sample;
    sample_sums sums; /* of methods that take point samples */
    tile_surface surface;
    wave_set sample_waves;
    tile_objects objects; /* used in scenes with objects */
    tile_opened opened;   /* used in scenes with objects if the camera moves */
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
    const float *sky;          /* sky_state.table */
    const podee_tables *podee; /* filled if podee-* replaces its Gaussian by kernels */
    tile_wants wants;
    /* Called between the samples of a tile on any worker. False: the tile is left unfinished. NULL: no calls. */
    bool (*keep_going)(void *argument, uint32_t worker);
    void *keep_going_argument;
    const struct lean_map *lean; /* filled for methods lean and leadr */
    refraction *objects;         /* prepared for the frame; NULL: the scene has no objects */
    bool behind;                 /* objects in front of the water are left out */
    picture_sums sums;           /* read by methods that take samples */
} tile_job;

/* Whether any pixel of the tile can see water. */
bool tile_sees_water(const tile_waves *tile);

/* Estimates the first hits of the tile's pixels. If no pixel can see water, all values are 0. */
void tile_find_estimates(const lane_kernels *kernels, const FrameData *data, const tile_waves *tile, tile_estimate *estimate);

/* Gives the tiles of both shutter ends the light_reach of reach_of_both(). For moving cameras. */
void tile_join_reach(tile_scratch *scratch);

/* Fills what job->wants asks for of scratch->pixels and scratch->surface for the tile (tile_x, tile_y) of the lattice. Method reference is excluded. */
void tile_render(const tile_job *job, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch);

/* Fills scratch->objects for the tile, and nothing else. */
void tile_see_objects(const tile_job *job, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch);

#endif
