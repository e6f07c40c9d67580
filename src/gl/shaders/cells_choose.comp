/* SPDX-License-Identifier: MIT
 *
 * Chooses the leaves of a tile that the round splits or gives points, and counts the new cells and groups of points: one workgroup per tile.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
layout(std140, binding = 0) uniform FrameBlock { FrameData frame_of_halvings[LEAF_SIDES]; };
#define FRAME(cx) frame_of_halvings[0]
#include "kernels/adaptive/refinement.k"
#include "word64.glsl"
#include "kernels/adaptive/rounds.k"
#include "cells_data.glsl"

layout(local_size_x = CELLS_GROUP) in;

shared uint size_counts[CELL_SIZES];
shared uint chosen_cells, chosen_points, point_groups;

LeafPlace place_of(Leaf l) { return LeafPlace(l.place.x, l.place.y, l.halvings.x, l.halvings.y); }

bool is_chosen(int tile, Leaf l)
{
    RoundPlan p = plan_begun(0, 0.0lf);
    p.bucket = int(state[CELLS_BUCKET]);
    p.points = int(state[CELLS_POINTS]);
    p.share = state_double(CELLS_SHARE);
    bool on_edge = l.bucket == p.bucket && l.split != SPLIT_POINTS;
    return plan_takes(0, p, l.bucket, l.split == SPLIT_POINTS, on_edge ? leaf_lot(0, tile, place_of(l), uvec2(0u)) : 0.0lf);
}

/* Marks and counts leaf i if the round takes it. */
void choose(int tile, int i)
{
    Leaf l = leaf_at(i);
    if (!is_chosen(tile, l))
        return;
    leaves[LEAF_VECTORS * i].z |= CHOSEN;
    if (l.split == SPLIT_POINTS) {
        float more = leaf_next_points(0, l.points, l.places, l.coverage) - l.points;
        atomicAdd(chosen_points, 1u);
        atomicAdd(point_groups, uint(more) / uint(POINT_GROUP * LEAF_INSTANTS));
    } else {
        atomicAdd(chosen_cells, 1u);
        atomicAdd(size_counts[cell_size(l.halvings.x + halvings_across(l.split), l.halvings.y + halvings_down(l.split))], 1u);
    }
}

void main()
{
    int tile = int(gl_WorkGroupID.y) * cells_data.columns + int(gl_WorkGroupID.x), words = tile_words(tile);
    int lane = int(gl_LocalInvocationIndex), first = int(state[words + TILE_FIRST]), count = int(state[words + TILE_LEAVES]);
    for (int i = lane; i < CELL_SIZES; i += CELLS_GROUP)
        size_counts[i] = 0u;
    if (lane == 0) {
        chosen_cells = 0u;
        chosen_points = 0u;
        point_groups = 0u;
    }
    barrier();
    for (int i = lane; i < count; i += CELLS_GROUP)
        choose(tile, first + i);
    barrier();
    for (int i = lane; i < CELL_SIZES; i += CELLS_GROUP)
        state[words + TILE_SIZES + i] = size_counts[i];
    if (lane != 0)
        return;
    uint jobs = 0u, groups = 0u;
    for (int i = 0; i < CELL_SIZES; i++) {
        jobs += size_counts[i] > 0u ? 1u : 0u;
        groups += (4u * size_counts[i] + uint(CELLS_GROUP - 1)) / uint(CELLS_GROUP);
    }
    state[words + TILE_KEPT] = uint(count) - chosen_cells - chosen_points;
    state[words + TILE_CHILDREN] = 4u * chosen_cells;
    state[words + TILE_POINT_LEAVES] = chosen_points;
    state[words + TILE_JOBS] = jobs;
    state[words + TILE_GROUPS] = groups;
    state[words + TILE_POINT_GROUPS] = point_groups;
}
