/* SPDX-License-Identifier: MIT
 * The tiled map of slope moments of methods lean and leadr, made from the waves of an instant. */
#ifndef MANGATA_CPU_LEAN_MAP_H
#define MANGATA_CPU_LEAN_MAP_H

#include "cpu/lanes.h"
#include "base/thread_pool.h"

struct frame; /* cpu/frame.h */

enum {
    LEAN_SIZE = 4096,
    LEAN_LEVELS = 13,
    LEAN_MOMENTS = 5, /* mean x, z; second moments xx, xz, zz */
    LEAN_BLOCK = 16,  /* columns side by side in lean_waves.columns */
    LEAN_ROWS = 4,    /* rows filled at a time */
};

/* The waves on the map's grid: wave i has columns and rows whole periods across the map. */
typedef struct lean_waves {
    size_t count;
    double turns[MGT_MAX_WAVES];                          /* phase under the camera */
    int across[MGT_MAX_WAVES], down[MGT_MAX_WAVES];       /* periods along x and z */
    float slope_x[MGT_MAX_WAVES], slope_z[MGT_MAX_WAVES]; /* A a, A b */
    const float *columns; /* while the map is filled: by blocks of columns: for every wave LEAN_BLOCK cosines, then as many sines */
} lean_waves;

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

/* Places the scene's waves on the map's grid; `columns` stays NULL. */
LeanData lean_snap_waves(const struct frame *f, lean_waves *out);

#endif
