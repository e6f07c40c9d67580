/* SPDX-License-Identifier: MIT
 * The decisions of refinement.k for one leaf at a time. */
#include "cpu/leaf_lane.h"

#include "cpu/kernel_context.h"

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#define FRAME(cx) (*(cx)->frame)

#include "kernels/adaptive/refinement.k"

uint8_t lane_split(float aspect) { return (uint8_t)leaf_split(NULL, aspect); }

float lane_weight(const FrameData *frame, const float color[3], float display_slope_squared)
{
    const struct kernel_context cx = {.frame = frame};
    return leaf_weight(&cx, vec3(color[0], color[1], color[2]), display_slope_squared);
}

float lane_parts_contrast(float own, const float parts[4]) { return parts_contrast(NULL, own, parts[0], parts[1], parts[2], parts[3]); }

bool lane_dark(const FrameData *frame, int light_reach, bool by_display, bool lights_dark)
{
    const struct kernel_context cx = {.frame = frame};
    return tile_dark(&cx, light_reach, by_display, lights_dark);
}

float lane_kept(bool dark, float variance) { return leaf_kept(NULL, dark, variance); }

int lane_class(int level, bool dark, bool moves) { return leaf_class(NULL, level, dark, moves); }

int lane_next_points(lane_leaf l) { return (int)leaf_next_points(NULL, (float)l.points, l.places, l.coverage); }

bool lane_takes_points(const FrameData *frame, lane_leaf l, int level)
{
    const struct kernel_context cx = {.frame = frame};
    return leaf_takes_points(&cx, (float)l.points, l.places, level) > 0;
}

float lane_split_worth(bool by_display, float places, float split_worth) { return leaf_split_worth(NULL, by_display, places, split_worth); }

float lane_points_worth(lane_leaf l, float area, float cost) { return leaf_points_worth(NULL, (float)l.points, l.places, l.coverage, area, cost); }

uint16_t lane_bucket(float worth) { return (uint16_t)leaf_bucket(NULL, worth); }
