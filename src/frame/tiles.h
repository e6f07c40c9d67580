/* SPDX-License-Identifier: MIT
 * The lattice of tiles that a picture is drawn by. */
#ifndef MANGATA_FRAME_TILES_H
#define MANGATA_FRAME_TILES_H

#include "frame/sines.h"

/* Number of a tile's nodes, rounded up to whole vectors of any width. */
enum { NODE_PADDED = (NODE_COUNT + 15) / 16 * 16 };

#endif
