/* SPDX-License-Identifier: MIT
 *
 * Sorts the waves for each job, which is the cells of one size in a tile, or for the points of each tile at an instant: one workgroup each.
 */
#define EXACT_FMA
#define TILE_ACCESS
#define CELLS_PASS
#include "gl_data.glsl"
#include "cells_state.glsl"

ViewData view_data;
#define VIEW(cx) view_data
#include "tiles.glsl"
#include "cells_job.glsl"

void sort_points(int place, int slot)
{
    int tile = int(state[cells_data.point_tiles_at + place]);
    turn_to_set(set_of_instant());
    view_data = set_view(0);
    tile_slot = slot;
    sort_tile(tile % cells_data.columns, tile / cells_data.columns, 0, 0);
}

void sort_cells(int place, int slot)
{
    Job job = job_at(place);
    if (cells_data.part >= parts_of_class(job.kind))
        return;
    frame_halvings = max(job.halvings.x, job.halvings.y);
    int parts = job.halvings.x + job.halvings.y > 0 && cells_data.sky_black == 0 ? 1 << job.halvings.y : 0;
    turn_to_set(set_of_part(job.kind));
    view_data = set_view(1 + cell_size(job.halvings.x, job.halvings.y));
    tile_slot = slot;
    sort_tile(job.tile % cells_data.columns, job.tile / cells_data.columns, 0, parts);
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        state[cells_data.jobs_at + JOB_WORDS * place + 2] = uint(tile_data[tile_slot].resolved_count + tile_data[tile_slot].mixed_count);
}

void main()
{
    int slot = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
    bool points = cells_data.instant >= 0;
    int place = slot + cells_data.batch * (points ? cells_data.point_slots : cells_data.slots);
    if (place >= int(state[points ? CELLS_POINT_TILES : CELLS_JOBS]))
        return;
    if (points)
        sort_points(place, slot);
    else
        sort_cells(place, slot);
}
