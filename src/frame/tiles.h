/* SPDX-License-Identifier: MIT
 * The lattice of tiles that a picture is drawn by, and the waves as they are before they are sorted for a tile. */
#ifndef MANGATA_FRAME_TILES_H
#define MANGATA_FRAME_TILES_H

#include "frame/kernel_data.h"
#include "mangata/mangata.h"

/* Tiles of one fixed lattice of the whole image, whatever the crop; nodes of the hit lattice lie on their edges too. */
enum {
    TILE_WIDTH = 32,
    TILE_HEIGHT = 16,
    TILE_PIXELS = TILE_WIDTH * TILE_HEIGHT,
    NODE_STEP_X = 8, /* the water is foreshortened down the screen, seldom across */
    NODE_STEP_Y = 4,
    NODE_COLUMNS = TILE_WIDTH / NODE_STEP_X + 1,
    NODE_ROWS = TILE_HEIGHT / NODE_STEP_Y + 1,
    NODE_COUNT = NODE_COLUMNS * NODE_ROWS,
    NODE_PADDED = (NODE_COUNT + 15) / 16 * 16,
};

/* The waves over an interval as a camera meets them: what is the same for every tile. Sorted by amplitude, the largest first. */
typedef struct wave_set {
    ViewData view;
    WaveData data[MGT_MAX_WAVES]; /* phase left open */
    /* What sorting needs, see tile.k; room for the widest lanes, and zero there. */
    float turns_x[MGT_MAX_WAVES], turns_z[MGT_MAX_WAVES];
    float turns_low_x[MGT_MAX_WAVES], turns_low_z[MGT_MAX_WAVES]; /* what rounding to float took away */
    float phase[MGT_MAX_WAVES];                                   /* turns under the camera at the interval's middle, in [-1/2, 1/2] */
    float lesser_variance[MGT_MAX_WAVES];                         /* metres², of the heights of a wave and of all smaller ones */
} wave_set;

#endif
