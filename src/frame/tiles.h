/* SPDX-License-Identifier: MIT
 * The lattice of tiles that a picture is drawn by, and the waves as they are before they are sorted for a tile. */
#ifndef MANGATA_FRAME_TILES_H
#define MANGATA_FRAME_TILES_H

#include "frame/kernel_data.h"
#include "mangata/mangata.h"

/* Nodes of a tile, filled up to whole vectors of any width. */
enum { NODE_PADDED = (NODE_COUNT + 15) / 16 * 16 };

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
