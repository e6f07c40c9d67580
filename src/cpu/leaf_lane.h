/* SPDX-License-Identifier: MIT
 * Decisions of refinement.k, of one leaf at a time. */
#ifndef MANGATA_CPU_LEAF_LANE_H
#define MANGATA_CPU_LEAF_LANE_H

#include <stdbool.h>
#include <stdint.h>

#include "frame/kernel_data.h"

/* SPLIT_… for an aspect of CellResult. */
uint8_t lane_split(float aspect);

/* What a squared error of a pixel of this colour is worth; `display_slope_squared` as in CellResult. */
float lane_weight(const FrameData *frame, const float color[3], float display_slope_squared);

/* What one of a leaf's four parts, of its own contrast, counts with under a sky, from the contrasts of all. */
float lane_parts_contrast(float own, const float parts[4]);

/* Whether a tile with this TileData.light_reach mirrors no light; the rest as tile_dark() has it. */
bool lane_dark(const FrameData *frame, int light_reach, bool by_display, bool lights_dark);

/* Fraction of a leaf's values that its parts keep: leaf_kept(). */
float lane_kept(bool dark, float variance);

/* Class of the cells of a level, which decides how many pieces of the shutter they see: leaf_class(). */
int lane_class(int level, bool dark);

/* The leaf's numbers that its points depend on. */
typedef struct lane_leaf {
    int points; /* 0: it is a cell */
    float places, coverage;
} lane_leaf;

/* How many points it has after its next turn. */
int lane_next_points(lane_leaf l);
bool lane_takes_points(const FrameData *frame, lane_leaf l, int level);

/* How much of its squared error a split or points save for each evaluation. `split_worth`: of a split, for each unit of squared error. */
float lane_split_worth(bool by_display, float places, float split_worth);
float lane_points_worth(lane_leaf l, float area, float cost);
uint16_t lane_bucket(float worth);

#endif
