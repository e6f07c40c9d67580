/* SPDX-License-Identifier: MIT
 *
 * Assigns places to each tile's leaves, jobs and groups of the round by prefix sums over the tiles: one workgroup. The first tile that finds no room waits for
 * the next round, and so do all tiles after it.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
#include "cells_state.glsl"

layout(local_size_x = CELLS_LANES) in;

/* What a tile asks for. */
struct Demand {
    uint jobs, groups, point_tiles, point_groups, more; /* more: leaves that are added to the tile's */
};

const int KINDS = 6; /* kinds of sums: the members of Demand, then the leaves that a tile will have */
shared uint lane_sums[KINDS][CELLS_LANES];
shared uint before[KINDS];  /* sums over the tiles before those that are processed */
shared uint granted[KINDS]; /* sums over the tiles that have found room */

int lane;

Demand demand_of(int words)
{
    Demand d;
    d.jobs = state[words + TILE_JOBS];
    d.groups = state[words + TILE_GROUPS];
    d.point_groups = state[words + TILE_POINT_GROUPS];
    d.point_tiles = d.point_groups > 0u ? 1u : 0u;
    d.more = state[words + TILE_CHILDREN] / 4u * 3u;
    return d;
}

/* Turns lane_sums of the kinds [first, end) into prefix sums, which include the invocation's own value. */
void add_up(int first, int end)
{
    for (int reach = 1; reach < CELLS_LANES; reach *= 2) {
        uint sums[KINDS];
        barrier();
        for (int k = first; k < end; k++)
            sums[k] = lane >= reach ? lane_sums[k][lane - reach] : 0u;
        barrier();
        for (int k = first; k < end; k++)
            lane_sums[k][lane] += sums[k];
    }
    barrier();
}

bool has_room()
{
    return before[0] + lane_sums[0][lane] <= uint(cells_data.most_jobs) && before[1] + lane_sums[1][lane] <= uint(cells_data.most_groups) &&
           before[3] + lane_sums[3][lane] <= uint(cells_data.most_point_groups) &&
           state[CELLS_LEAVES] + before[4] + lane_sums[4][lane] <= uint(cells_data.pool);
}

/* Gives a tile no room: all its leaves stay as they are. */
void refuse(int words)
{
    state[words + TILE_KEPT] = state[words + TILE_LEAVES];
    state[words + TILE_CHILDREN] = 0u;
    state[words + TILE_POINT_LEAVES] = 0u;
    state[words + TILE_JOBS] = 0u;
    state[words + TILE_GROUPS] = 0u;
    state[words + TILE_POINT_GROUPS] = 0u;
    for (int i = 0; i < CELL_SIZES; i++)
        state[words + TILE_SIZES + i] = 0u;
}

/* Assigns places to the tiles from `from` on, one for each invocation. */
void take_tiles(int from)
{
    int tile = from + lane, words = tile_words(tile);
    bool there = tile < cells_data.tiles;
    Demand d = Demand(0u, 0u, 0u, 0u, 0u);
    if (there)
        d = demand_of(words);
    lane_sums[0][lane] = d.jobs;
    lane_sums[1][lane] = d.groups;
    lane_sums[2][lane] = d.point_tiles;
    lane_sums[3][lane] = d.point_groups;
    lane_sums[4][lane] = d.more;
    add_up(0, 5);
    bool fits = has_room();
    uint leaves = there ? state[words + TILE_LEAVES] + (fits ? d.more : 0u) : 0u;
    lane_sums[5][lane] = leaves;
    add_up(5, 6);
    if (there) {
        state[words + TILE_JOB_FIRST] = before[0] + lane_sums[0][lane] - d.jobs;
        state[words + TILE_GROUP_FIRST] = before[1] + lane_sums[1][lane] - d.groups;
        state[words + TILE_POINT_TILE] = before[2] + lane_sums[2][lane] - d.point_tiles;
        state[words + TILE_POINT_FIRST] = before[3] + lane_sums[3][lane] - d.point_groups;
        state[words + TILE_NEXT] = before[5] + lane_sums[5][lane] - leaves;
        if (!fits)
            refuse(words);
    }
    if (fits)
        for (int k = 0; k < 4; k++)
            atomicMax(granted[k], before[k] + lane_sums[k][lane]);
    barrier();
    if (lane < KINDS)
        before[lane] += lane_sums[lane][CELLS_LANES - 1];
    barrier();
}

/* Sets the size of an indirect dispatch over `count` entries of a list. It has several rows if they are many. */
void set_size(int at, uint count)
{
    const uint row = 32768u;
    state[at] = min(count, row);
    state[at + 1] = (count + row - 1u) / row;
    state[at + 2] = count > 0u ? 1u : 0u;
}

void set_sizes()
{
    for (int b = 0; b < CELLS_BATCHES; b++) {
        uint jobs = uint(clamp(int(granted[0]) - b * cells_data.slots, 0, cells_data.slots));
        uint tiles = uint(clamp(int(granted[2]) - b * cells_data.point_slots, 0, cells_data.point_slots));
        set_size(CELLS_SORT_SIZE + 4 * b, jobs);
        set_size(CELLS_SHADE_SIZE + 4 * b, jobs > 0u ? granted[1] : 0u);
        set_size(CELLS_POINT_SORT_SIZE + 4 * b, tiles);
        set_size(CELLS_POINT_SIZE + 4 * b, tiles > 0u ? granted[3] : 0u);
    }
}

void main()
{
    lane = int(gl_LocalInvocationIndex);
    if (state[CELLS_RUNNING] == 0u)
        return;
    if (lane < KINDS) {
        /* The pool has two sides, which rounds take in turns. */
        before[lane] = lane == KINDS - 1 ? (state[CELLS_ROUND] & 1u) * uint(cells_data.pool) : 0u;
        granted[lane] = 0u;
    }
    barrier();
    for (int from = 0; from < cells_data.tiles; from += CELLS_LANES)
        take_tiles(from);
    if (lane != 0)
        return;
    state[CELLS_JOBS] = granted[0];
    state[CELLS_GROUPS] = granted[1];
    state[CELLS_POINT_TILES] = granted[2];
    state[CELLS_POINT_GROUPS] = granted[3];
    set_sizes();
}
