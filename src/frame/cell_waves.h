/* SPDX-License-Identifier: MIT
 * Times, rays and uniform numbers for the refinement cells of method adaptive. */
#ifndef MANGATA_FRAME_CELL_WAVES_H
#define MANGATA_FRAME_CELL_WAVES_H

#include "frame/frame_waves.h"

/* For each class of leaves, CELLS_…, the number of equal pieces of the shutter, a power of two up to LEAF_PARTS, in each of which a point's path in slope space
 * is nearly straight, and of a moving camera at least four but for CELLS_WHOLE. */
void cell_part_counts(const frame *f, int counts[CELL_CLASSES]);

/* The middle of stratum i of LEAF_INSTANTS equal strata of the shutter, as a fraction of the shutter from its opening (0) to its closing (1). */
double cell_instant(int i);

/* A view whose pixels are the cells that a pixel becomes when it is halved `across` times horizontally and `down` times vertically. */
ViewData cell_view(const ViewData *view, int across, int down);

/* The frame's uniform numbers for such cells. */
FrameData cell_frame(const FrameData *data, int across, int down);

#endif
