/* SPDX-License-Identifier: MIT
 * The tiled map of slope moments of methods lean and leadr, made from the waves of an instant. */
#ifndef MANGATA_CPU_LEAN_MAP_H
#define MANGATA_CPU_LEAN_MAP_H

#include "cpu/lanes.h"
#include "frame/sines.h"
#include "base/thread_pool.h"

struct frame; /* frame/frame.h */

/* 246 MiB once it is filled. */
struct lean_map {
    LeanData data;
    lean_waves waves; /* that fill it */
    bool filled;
    float *slope_x, *slope_z;   /* level 0: one slope a texel, its second moments are products */
    float *levels[LEAN_LEVELS]; /* from level 1: LEAN_MOMENTS a texel */
};

/* A wave's phase at the beginning of LEAN_ROWS rows. */
typedef struct lean_phase {
    float cosine[LEAN_ROWS], minus_sine[LEAN_ROWS];
} lean_phase;

/*
 * Fills the map for the scene at its time. The period is 1024 of the shortest wavelength, so that this has 4 texels, but at least 8 of
 * the longest. Waves with less than 2.5 texels go to the map's rest as variance. All others are snapped: their wave vectors become the
 * nearest with whole periods across the map, off by at most half a period of the map, while amplitude, slope and phase under the camera
 * are kept.
 * Allocates on first use; false where memory is short. A map that holds these waves already is kept.
 */
bool lean_map_build(lean_map *map, const struct frame *f, const lane_kernels *kernels, thread_pool *pool);
void lean_map_free(lean_map *map);

#endif
