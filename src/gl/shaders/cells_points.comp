/* SPDX-License-Identifier: MIT
 *
 * Point samples of leaves at one instant. A workgroup takes one group of points of a leaf.
 */
#define EXACT_FMA
#define CELLS_PASS
#include "lattice_data.glsl"
#include "kernels/glitter/sample.k"
#include "cells_data.glsl"
#include "cells_job.glsl"
#include "word64.glsl"
#include "kernels/adaptive/rounds.k"

layout(local_size_x = POINT_GROUP) in;

shared double lane_sums[POINT_SUMS][POINT_GROUP];

/* Place of point `index` of the leaf's sequence, in pixels from the centre of the tile's first pixel. It is rounded as an offset from the pixel `about`,
 * because the CPU samples the point as an offset from that pixel. */
vec2 place_of_point(int tile, Leaf l, int index, ivec2 about)
{
    LeafPlace place = LeafPlace(l.place.x, l.place.y, l.halvings.x, l.halvings.y);
    double lot = leaf_lot(0, tile, place, ~uvec2(uint(cells_data.seed_low), uint(cells_data.seed_high)));
    precise vec2 jittered = vec2(about) + vec2(point_place(0, place.column, place.across, point_across(0, lot, index), about.x),
                                               point_place(0, place.row, place.down, point_down(0, lot, index), about.y));
    return jittered;
}

/* Adds the points of the workgroup to the sums of the group, in a fixed order. */
void keep(int group, int lane, PixelResult p)
{
    double luminance = point_luminance(0, double(p.color.r), double(p.color.g), double(p.color.b));
    double values[POINT_SUMS] =
        double[POINT_SUMS](double(p.color.r), double(p.color.g), double(p.color.b), double(p.coverage), double(p.water), luminance * luminance);
    for (int k = 0; k < POINT_SUMS; k++)
        lane_sums[k][lane] = values[k];
    barrier();
    if (lane >= POINT_SUMS)
        return;
    int at = cells_data.point_groups_at + POINT_GROUP_WORDS * group + POINT_SUMS_AT + 2 * lane;
    double sum = cells_data.instant == 0 ? 0.0lf : state_double(at);
    for (int i = 0; i < POINT_GROUP; i++)
        sum += lane_sums[lane][i];
    set_state_double(at, sum);
}

void main()
{
    int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x), lane = int(gl_LocalInvocationIndex);
    if (group >= int(state[CELLS_POINT_GROUPS]))
        return;
    int at = cells_data.point_groups_at + POINT_GROUP_WORDS * group, place = int(state[at + 1]), slot = place - cells_data.batch * cells_data.point_slots;
    if (slot < 0 || slot >= cells_data.point_slots)
        return;
    int tile = int(state[cells_data.point_tiles_at + place]);
    Leaf l = leaf_at(int(state[at]));
    ivec2 pixel = leaf_pixel(l);
    tile_slot = slot;
    turn_to_set(set_of_instant());
    layer_texel = ivec2(tile % cells_data.columns, tile / cells_data.columns) * ivec2(TILE_WIDTH, TILE_HEIGHT) + pixel;
    int index = int(l.points) + cells_data.instant + LEAF_INSTANTS * (POINT_GROUP * int(state[at + 2]) + lane);
    int before = group - int(state[tile_words(tile) + TILE_POINT_FIRST]);
    vec2 where = place_of_point(tile, l, index, ivec2(lane, before % TILE_HEIGHT));
    keep(group, lane, sample_pixel(0, where.x, where.y, pixel_estimate(pixel)));
}
