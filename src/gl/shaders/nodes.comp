/* SPDX-License-Identifier: MIT
 *
 * First hits at the nodes of each tile: one workgroup a tile, one invocation a node.
 */
#define NODE_ACCESS
#include "lattice_data.glsl"

layout(local_size_x = 32) in;

void main()
{
    tile_slot = int(gl_WorkGroupID.x);
    int index = int(gl_LocalInvocationID.x);
    if (index >= NODE_COUNT || TILE(0).search_pixels != 0)
        return;
    LatticeNode node = lattice_node(0, pixel_ray_at(0, float(index % NODE_COLUMNS * NODE_STEP_X), float(index / NODE_COLUMNS * NODE_STEP_Y)));
    NodeData n;
    n.ray_x = node.ray.x;
    n.ray_y = node.ray.y;
    n.ray_z = node.ray.z;
    n.along = node.along;
    n.height = node.plane.height;
    n.slope_x = node.plane.slope_x;
    n.slope_z = node.plane.slope_z;
    n.found = node.found;
    n.level = node.plane.level;
    n.node_padding_0 = 0.0f;
    n.node_padding_1 = 0.0f;
    n.node_padding_2 = 0.0f;
    node_data[tile_slot * NODE_COUNT + index] = n;
}
