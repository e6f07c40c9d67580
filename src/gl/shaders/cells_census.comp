/* SPDX-License-Identifier: MIT
 *
 * Adds the cost of each open leaf of a tile to the bucket of the leaf's worth, and sums the squared errors of these leaves: one workgroup per tile.
 *
 * Costs are whole numbers, so that their sums do not depend on the order in which workgroups run.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
layout(std140, binding = 0) uniform FrameBlock { FrameData frame_of_halvings[LEAF_SIDES]; };
#define FRAME(cx) frame_of_halvings[0]
#include "kernels/adaptive/refinement.k"
#include "cells_data.glsl"

layout(local_size_x = CELLS_GROUP) in;
layout(std430, binding = 8) readonly buffer PixelBlock { vec2 pixel_data[]; };

shared double lane_variance[CELLS_GROUP], lane_shown[CELLS_GROUP];

/* Adds a cost to a bucket. A sum has two words. */
void count_cost(int bucket, bool points, uint cost)
{
    int at = CELLS_CENSUS + 4 * bucket + (points ? 2 : 0);
    uint before = atomicAdd(state[at], cost);
    if (before + cost < before)
        atomicAdd(state[at + 1], 1u);
}

void main()
{
    int tile = int(gl_WorkGroupID.y) * cells_data.columns + int(gl_WorkGroupID.x), words = tile_words(tile);
    int lane = int(gl_LocalInvocationIndex), first = int(state[words + TILE_FIRST]), count = int(state[words + TILE_LEAVES]);
    double variance = 0.0lf, shown = 0.0lf;
    for (int i = lane; i < count; i += CELLS_GROUP) {
        Leaf l = leaf_at(first + i);
        int level = leaf_level(l);
        ivec2 pixel = leaf_pixel(l);
        bool points = l.split == SPLIT_POINTS;
        float more = leaf_next_points(0, l.points, l.places, l.coverage) - l.points;
        count_cost(l.bucket, points, points ? uint(more) * uint(POINT_COST * COST_UNIT) : state[words + TILE_BELOW + level]);
        float area = leaf_area(level);
        variance += double(area * area * l.variance);
        shown += double(area * area * l.contrast * pixel_data[tile * TILE_PIXELS + pixel.y * TILE_WIDTH + pixel.x].x);
    }
    lane_variance[lane] = variance;
    lane_shown[lane] = shown;
    barrier();
    if (lane != 0)
        return;
    for (int i = 1; i < CELLS_GROUP; i++) {
        variance += lane_variance[i];
        shown += lane_shown[i];
    }
    set_state_double(words + TILE_OPEN_VARIANCE, variance);
    set_state_double(words + TILE_OPEN_SHOWN, shown);
}
