/* SPDX-License-Identifier: MIT
 * What the cells of method adaptive look at: the shutter in straight pieces, rays of cells, and the frame's numbers for them. */
#ifndef MANGATA_FRAME_CELL_WAVES_H
#define MANGATA_FRAME_CELL_WAVES_H

#include "frame/frame_waves.h"

/* Pieces of the shutter, for pixels, cells and sharp cells: see leaf_class() of refinement.k. */
enum { CELL_CLASSES = 3 };

/* How many pieces keep the path in slope space straight enough for each. */
void cell_part_counts(const frame *f, int counts[CELL_CLASSES]);

/* An instant or a piece of the shutter. */
typedef struct cell_time {
    double share; /* where the camera is, from the shutter's opening (0) to its closing (1) */
    interval time;
} cell_time;

/* Piece i of `count`; where the camera moves, instant i of count + 1. */
cell_time cell_part(const mgt_scene *scene, int count, int i);

/* Instant i of those that points are spread over, in the middle of its stratum. */
cell_time cell_instant(const mgt_scene *scene, int i);

/* Rays of cells: every pixel is halved so many times each way. */
ViewData cell_view(const ViewData *view, int across, int down);

/* What kernels are told of the frame for them. */
FrameData cell_frame(const FrameData *data, int across, int down);

#endif
