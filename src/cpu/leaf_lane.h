/* SPDX-License-Identifier: MIT
 * The decisions of refinement.k for one leaf at a time. */
#ifndef MANGATA_CPU_LEAF_LANE_H
#define MANGATA_CPU_LEAF_LANE_H

#include <stdbool.h>
#include <stdint.h>

#include "frame/kernel_data.h"

/* leaf_split(), as SPLIT_…. `aspect`: CellResult.aspect. */
uint8_t lane_split(float aspect);

/* leaf_weight(): worth of a squared error of a pixel of this colour. `display_slope_squared`: as in CellResult. */
float lane_weight(const FrameData *frame, const float color[3], float display_slope_squared);

/* parts_contrast(): contrast under a sky of one of a leaf's four parts. `own`: the contrast that the part was rendered with. `parts`: those of all four. */
float lane_parts_contrast(float own, const float parts[4]);

/* tile_dark(): whether a tile with this TileData.light_reach mirrors no light. */
bool lane_dark(const FrameData *frame, int light_reach, bool by_display, bool lights_dark);

/* leaf_kept(): fraction of a leaf's values that its parts keep. */
float lane_kept(bool dark, float variance);
/* leaf_class(): class of the cells of a level, which decides how many pieces of the shutter they see. */
int lane_class(int level, bool dark, bool moves);

/* The values of a leaf that its points depend on. */
typedef struct lane_leaf {
    int points; /* 0: the leaf is a cell */
    float places, coverage;
} lane_leaf;

/* leaf_next_points(): number of points after the leaf's next turn. */
int lane_next_points(lane_leaf l);
/* leaf_takes_points(): whether the leaf takes points, not a split. */
bool lane_takes_points(const FrameData *frame, lane_leaf l, int level);

/* leaf_split_worth(): fraction of the squared error that a split saves per evaluation. `split_worth`: split_worth_of() of rounds.k. */
float lane_split_worth(bool by_display, float places, float split_worth);
/* leaf_points_worth(): the same fraction for the next turn of points. */
float lane_points_worth(lane_leaf l, float area, float cost);
/* leaf_bucket(): bucket of a worth in the histogram. */
uint16_t lane_bucket(float worth);

#endif
