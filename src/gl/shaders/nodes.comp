/* SPDX-License-Identifier: MIT
 *
 * First hits of each tile: one workgroup per tile, one invocation per node. In a grazing tile they are searched for every pixel: one invocation per column or
 * part of a column.
 */
#define NODE_ACCESS
#define FINDS_HITS
#include "lattice_data.glsl"

layout(local_size_x = 32) in; /* TILE_WIDTH; not less than NODE_COUNT */

void main()
{
    tile_slot = int(gl_WorkGroupID.x);
    int index = int(gl_LocalInvocationID.x);
    if (TILE(0).grazing != 0) {
        for (int part = int(gl_WorkGroupID.y); part < walk_parts(0); part += int(gl_NumWorkGroups.y))
            walk_column(0, float(index), part);
        return;
    }
    if (gl_WorkGroupID.y > 0u || index >= NODE_COUNT || TILE(0).search_pixels != 0)
        return;
    LatticeNode node = lattice_node(0, pixel_ray_at(0, float(index % NODE_COLUMNS * NODE_STEP_X), float(index / NODE_COLUMNS * NODE_STEP_Y)));
    int at = first_float() + index * NODE_FLOATS;
    node_data[at] = node.ray.x;
    node_data[at + 1] = node.ray.y;
    node_data[at + 2] = node.ray.z;
    node_data[at + 3] = node.along;
    node_data[at + 4] = node.found;
    node_data[at + 5] = node.plane.level;
    node_data[at + 6] = node.plane.slope_x;
    node_data[at + 7] = node.plane.slope_z;
    node_data[at + 8] = node.plane.height;
    node_data[at + 9] = node.shift.x;
    node_data[at + 10] = node.shift.y;
}
