/* SPDX-License-Identifier: MIT
 *
 * Moves a tile's leaves to their place of the round, and lists the cells and points to be rendered: a workgroup a tile.
 *
 * Leaves keep their order: their places come from counting bits.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
layout(std140, binding = 0) uniform FrameBlock { FrameData frame_of_halvings[LEAF_SIDES]; };
#define FRAME(cx) frame_of_halvings[0]
#include "kernels/adaptive/refinement.k"
#include "cells_data.glsl"

layout(local_size_x = CELLS_GROUP) in;

/* What becomes of a leaf: cells of a size, or these. */
const int KEPT = CELL_SIZES;
const int POINTS = CELL_SIZES + 1;
const int KINDS = CELL_SIZES + 2;

shared uint kind_bits[2 * KINDS]; /* which leaves of a group are of the kind */
shared int kind_place[KINDS];     /* where the kind's next leaf goes in the pool, or its cells */
shared int group_chunks[CELLS_GROUP];
shared int next_group; /* of points */

int tile, words, lane;
bool refused; /* there was no room: all stay */

int kind_of(Leaf l, bool chosen)
{
    if (!chosen || refused)
        return KEPT;
    if (l.split == SPLIT_POINTS)
        return POINTS;
    return cell_size(l.halvings.x + halvings_across(l.split), l.halvings.y + halvings_down(l.split));
}

/* ---- jobs ---- */

void list_job(int job, int across, int down, int count, int group)
{
    int at = cells_data.jobs_at + JOB_WORDS * job;
    int kind = leaf_class(0, (across + down) / 2, state[words + TILE_DARK] != 0u);
    state[at] = uint(tile);
    state[at + 1] = uint(across | down << 8 | kind << 16);
    state[at + 2] = 0u;
    for (int i = 0; i < count; i += CELLS_GROUP) {
        int entry = cells_data.groups_at + GROUP_WORDS * (group + i / CELLS_GROUP);
        state[entry] = uint(job);
        state[entry + 1] = uint(kind_place[cell_size(across, down)] + i);
        state[entry + 2] = uint(min(count - i, CELLS_GROUP));
    }
}

/* By one invocation; in the order in which cells are taken later. */
void list_jobs(int place)
{
    int job = int(state[words + TILE_JOB_FIRST]), group = int(state[words + TILE_GROUP_FIRST]);
    for (int across = 0; across < LEAF_SIDES; across++)
        for (int down = across & 1; down < LEAF_SIDES - across; down += 2) {
            if (across + down == 0)
                continue;
            int size = cell_size(across, down), count = 4 * int(state[words + TILE_SIZES + size]);
            kind_place[size] = place;
            if (count == 0)
                continue;
            list_job(job++, across, down, count, group);
            group += (count + CELLS_GROUP - 1) / CELLS_GROUP;
            place += count;
        }
}

void list_points()
{
    if (lane == 0 && state[words + TILE_POINT_LEAVES] > 0u)
        state[cells_data.point_tiles_at + int(state[words + TILE_POINT_TILE])] = uint(tile);
}

/* ---- leaves ---- */

void move_leaf(int to, uvec4 first, int i)
{
    leaves[LEAF_VECTORS * to] = uvec4(first.xy, first.z & ~CHOSEN, first.w);
    leaves[LEAF_VECTORS * to + 1] = leaves[LEAF_VECTORS * i + 1];
    leaves[LEAF_VECTORS * to + 2] = leaves[LEAF_VECTORS * i + 2];
}

/* Cells begin with the height of what they are a part of. */
void make_cells(int to, Leaf l)
{
    ivec2 more = ivec2(halvings_across(l.split), halvings_down(l.split));
    for (int k = 0; k < 4; k++) {
        int wide = 1 << more.x;
        ivec2 place = ivec2(l.place.x * wide + k % wide, (l.place.y << more.y) + k / wide);
        leaves[LEAF_VECTORS * (to + k)] = uvec4(packed_place(place, l.halvings + more), 0u, 0u);
        leaves[LEAF_VECTORS * (to + k) + 1] = uvec4(0u);
        leaves[LEAF_VECTORS * (to + k) + 2] = uvec4(0u, floatBitsToUint(l.height), 0u, 0u);
    }
}

/* The leaf keeps where its groups of points begin in place of its height. */
void list_point_leaf(int to, uvec4 first, int i, int group, int groups, int tile_place)
{
    move_leaf(to, first, i);
    leaves[LEAF_VECTORS * to + 2].y = uint(group);
    for (int k = 0; k < groups; k++) {
        int at = cells_data.point_groups_at + POINT_GROUP_WORDS * (group + k);
        state[at] = uint(to);
        state[at + 1] = uint(tile_place);
        state[at + 2] = uint(k);
    }
}

/* Before this invocation's, in its group. */
int earlier(int kind)
{
    uint low = kind_bits[2 * kind], high = kind_bits[2 * kind + 1];
    return lane < 32 ? bitCount(low & ((1u << lane) - 1u)) : bitCount(low) + bitCount(high & ((1u << (lane - 32)) - 1u));
}

int chunks_of(Leaf l) { return int(leaf_next_points(0, l.points, l.places, l.coverage) - l.points) / (POINT_GROUP * LEAF_INSTANTS); }

void take_group(bool there, int i)
{
    uvec4 first = uvec4(0u);
    Leaf l = leaf_from(uvec4(0u), uvec4(0u), uvec4(0u));
    if (there) {
        first = leaves[LEAF_VECTORS * i];
        l = leaf_from(first, leaves[LEAF_VECTORS * i + 1], leaves[LEAF_VECTORS * i + 2]);
    }
    int kind = kind_of(l, (first.z & CHOSEN) != 0u);
    if (there)
        atomicOr(kind_bits[2 * kind + (lane >> 5)], 1u << (lane & 31));
    group_chunks[lane] = there && kind == POINTS ? chunks_of(l) : 0;
    barrier();
    if (there && kind == KEPT) {
        move_leaf(kind_place[KEPT] + earlier(KEPT), first, i);
    } else if (there && kind == POINTS) {
        int group = next_group;
        for (int k = 0; k < lane; k++)
            group += group_chunks[k];
        list_point_leaf(kind_place[POINTS] + earlier(POINTS), first, i, group, group_chunks[lane], int(state[words + TILE_POINT_TILE]));
    } else if (there) {
        make_cells(kind_place[kind] + 4 * earlier(kind), l);
    }
    barrier();
    for (int k = lane; k < KINDS; k += CELLS_GROUP) {
        kind_place[k] += (k < CELL_SIZES ? 4 : 1) * (bitCount(kind_bits[2 * k]) + bitCount(kind_bits[2 * k + 1]));
        kind_bits[2 * k] = 0u;
        kind_bits[2 * k + 1] = 0u;
    }
    if (lane == 0)
        for (int k = 0; k < CELLS_GROUP; k++)
            next_group += group_chunks[k];
    barrier();
}

void main()
{
    tile = int(gl_WorkGroupID.y) * cells_data.columns + int(gl_WorkGroupID.x);
    words = tile_words(tile);
    lane = int(gl_LocalInvocationIndex);
    refused = state[words + TILE_KEPT] == state[words + TILE_LEAVES];
    for (int k = lane; k < 2 * KINDS; k += CELLS_GROUP)
        kind_bits[k] = 0u;
    if (lane == 0) {
        int place = int(state[words + TILE_NEXT]), cells = place + int(state[words + TILE_KEPT]);
        kind_place[KEPT] = place;
        kind_place[POINTS] = cells + int(state[words + TILE_CHILDREN]);
        next_group = int(state[words + TILE_POINT_FIRST]);
        list_jobs(cells);
    }
    list_points();
    barrier();
    int from = int(state[words + TILE_FIRST]), count = int(state[words + TILE_LEAVES]);
    for (int i = 0; i < count; i += CELLS_GROUP)
        take_group(i + lane < count, from + i + lane);
}
