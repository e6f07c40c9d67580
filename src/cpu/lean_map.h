/* SPDX-License-Identifier: MIT
 * The tiled map of slope moments of methods lean and leadr, made from the waves of an instant. */
#ifndef MANGATA_CPU_LEAN_MAP_H
#define MANGATA_CPU_LEAN_MAP_H

#include "cpu/lanes.h"
#include "frame/sines.h"
#include "base/thread_pool.h"

struct frame; /* frame/frame.h */

/* The map. It takes 246 MiB once it is filled. */
struct lean_map {
    LeanData data;
    lean_waves waves; /* waves of the map */
    bool filled;
    float *slope_x, *slope_z;   /* level 0: one slope per texel, whose second moments are products */
    float *levels[LEAN_LEVELS]; /* levels 1 and above: LEAN_MOMENTS values per texel; levels[0] is not used */
};

/* Phase of a wave at the beginning of LEAN_ROWS rows. */
typedef struct lean_phase {
    float cosine[LEAN_ROWS], minus_sine[LEAN_ROWS];
} lean_phase;

/*
 * Fills the map for the scene at its time, unless it holds these waves already. The map's period is 1024 times the shortest wavelength, which so has 4 texels,
 * but at least 8 times the longest one. Waves shorter than 2.5 texels are left to the map's rest as variance. All others are snapped: their wave vectors become
 * the nearest ones with whole numbers of periods across the map, which moves them by at most half a period. Amplitude, slope and phase under the camera are
 * kept. Memory is allocated on first use. False: out of memory.
 */
bool lean_map_build(lean_map *map, const struct frame *f, const lane_kernels *kernels, thread_pool *pool);
void lean_map_free(lean_map *map);

#endif
