/* SPDX-License-Identifier: MIT
 *
 * Moves a tile's leaves to the other side of the pool, and lists the cells and points that the round renders: one workgroup per tile.
 *
 * Leaves keep their order, because their places come from counting bits.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
layout(std140, binding = 0) uniform FrameBlock { FrameData frame_of_halvings[LEAF_SIDES]; };
#define FRAME(cx) frame_of_halvings[0]
#include "kernels/adaptive/refinement.k"
#include "cells_data.glsl"

layout(local_size_x = CELLS_GROUP) in;

/* Kinds of leaves. A leaf that is split into cells has the number of their size: see cell_size(). The others have these kinds. */
const int KEPT = CELL_SIZES;
const int POINTS = CELL_SIZES + 1;
const int KINDS = CELL_SIZES + 2;

shared uint kind_bits[2 * KINDS]; /* for each kind the bits of the group's leaves */
shared int kind_place[KINDS];     /* for each kind the place in the pool of its next leaf or cell */
shared int group_chunks[CELLS_GROUP]; /* groups of points of each leaf */
shared int next_group; /* number of the next group of points */

int tile, words, lane;
bool refused; /* there was no room: all leaves stay */

int kind_of(Leaf l, bool chosen)
{
    if (!chosen || refused)
        return KEPT;
    if (l.split == SPLIT_POINTS)
        return POINTS;
    return cell_size(l.halvings.x + halvings_across(l.split), l.halvings.y + halvings_down(l.split));
}

/* ---- jobs ---- */

/* Lists a job and the groups of its cells. */
void list_job(int job, int across, int down, int count, int group)
{
    int at = cells_data.jobs_at + JOB_WORDS * job;
    int kind = leaf_class(0, (across + down) / 2, state[words + TILE_DARK] != 0u, cells_data.moves != 0);
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

/* Lists the tile's jobs, in the order in which cells_grow.comp takes their cells. One invocation calls it. */
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

/* Makes the four parts of a leaf. Each begins with the height of the leaf, and with what it keeps of its values. */
void make_cells(int to, Leaf l)
{
    float kept = leaf_kept(0, state[words + TILE_DARK] != 0u, l.variance);
    ivec2 more = ivec2(halvings_across(l.split), halvings_down(l.split));
    for (int k = 0; k < 4; k++) {
        int wide = 1 << more.x;
        ivec2 place = ivec2(l.place.x * wide + k % wide, (l.place.y << more.y) + k / wide);
        leaves[LEAF_VECTORS * (to + k)] = uvec4(packed_place(place, l.halvings + more) | uvec2(kept > 0.0f ? KEEPS : 0u, 0u), 0u, 0u);
        leaves[LEAF_VECTORS * (to + k) + 1] = floatBitsToUint(kept * vec4(l.color, l.coverage));
        leaves[LEAF_VECTORS * (to + k) + 2] = floatBitsToUint(vec4(kept * l.water, l.height, 0.0f, 0.0f));
    }
}

/* Moves a leaf that gets points and lists its groups of points. The number of the first group replaces the leaf's height. */
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

/* Number of the kind's leaves before this invocation's leaf in the group. */
int earlier(int kind)
{
    uint low = kind_bits[2 * kind], high = kind_bits[2 * kind + 1];
    return lane < 32 ? bitCount(low & ((1u << lane) - 1u)) : bitCount(low) + bitCount(high & ((1u << (lane - 32)) - 1u));
}

/* Number of groups of points that the leaf gets. */
int chunks_of(Leaf l) { return int(leaf_next_points(0, l.points, l.places, l.coverage) - l.points) / (POINT_GROUP * LEAF_INSTANTS); }

/* Moves or splits one leaf for each invocation. `there`: the invocation has a leaf, which is leaf i. */
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
