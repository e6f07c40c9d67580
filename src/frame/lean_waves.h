/* SPDX-License-Identifier: MIT
 * The waves on the grid of the tiled map of slope moments of methods lean and leadr. */
#ifndef MANGATA_FRAME_LEAN_WAVES_H
#define MANGATA_FRAME_LEAN_WAVES_H

#include "frame/tiles.h"
#include "kernels/common/constants.h"

struct frame; /* frame/frame.h */

enum {
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

/* Places the scene's waves on the map's grid; `columns` stays NULL. */
LeanData lean_snap_waves(const struct frame *f, lean_waves *out);

#endif
