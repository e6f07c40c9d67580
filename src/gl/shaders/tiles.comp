/* SPDX-License-Identifier: MIT
 *
 * Sorts the frame's waves for each tile of a band.
 */
#define EXACT_FMA
#define TILE_ACCESS
#include "gl_data.glsl"

layout(std140, binding = 3) uniform ViewBlock { ViewData view_data; };
layout(std430, binding = 5) readonly buffer SortBlock { SortData sort_data[]; };
#define VIEW(cx) view_data
#define SET_SORT(i) sort_data[i]
#include "tiles.glsl"

void main()
{
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    tile_slot = pass_data.first_slot + tile.y * pass_data.columns + tile.x;
    sort_tile(pass_data.tile_x + tile.x, pass_data.tile_y + tile.y, pass_data.open_slots, 0);
}
