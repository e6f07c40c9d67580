/* SPDX-License-Identifier: MIT
 *
 * First hits of a tile: the nodes of a lattice, from which pixels estimate their hits, or in a grazing tile the hit of every pixel.
 */
#include "gl_data.glsl"
#include "kernels/glitter/pixel.k"

#ifndef NODE_ACCESS
#define NODE_ACCESS readonly
#endif
/* TILE_FLOATS elements for each tile: its nodes, or in a grazing tile its hits. */
layout(std430, binding = 3) restrict NODE_ACCESS buffer NodeBlock { float node_data[]; };

/* Place of a tile's first element. */
int first_float() { return tile_slot * TILE_FLOATS(FRAME(0).hit_rows); }

int hit_place(int column, int row) { return first_float() + (row * TILE_WIDTH + column) * HIT_FLOATS; }

#ifdef FINDS_HITS
void HIT_FOUND(int cx, float column, float row, HitEstimate hit, bool where)
{
    if (!where)
        return;
    int at = hit_place(int(column), int(row));
    node_data[at] = hit.height;
    node_data[at + 1] = hit.slope.x;
    node_data[at + 2] = hit.slope.y;
    node_data[at + 3] = hit.shift.x;
    node_data[at + 4] = hit.shift.y;
}
#else
#define HIT_FOUND(cx, column, row, hit, where)
#endif

#include "kernels/glitter/lattice.k"

LatticeNode node_of(int column, int row)
{
    int at = first_float() + (row * NODE_COLUMNS + column) * NODE_FLOATS;
    LatticeNode node;
    node.ray = vec3(node_data[at], node_data[at + 1], node_data[at + 2]);
    node.along = node_data[at + 3];
    node.found = node_data[at + 4];
    node.plane.level = node_data[at + 5];
    node.plane.slope_x = node_data[at + 6];
    node.plane.slope_z = node_data[at + 7];
    node.plane.height = node_data[at + 8];
    node.shift = vec2(node_data[at + 9], node_data[at + 10]);
    return node;
}

bool tile_may_occlude()
{
    return corners_occlude(0, node_of(0, 0).ray, node_of(NODE_COLUMNS - 1, 0).ray, node_of(0, NODE_ROWS - 1).ray,
                           node_of(NODE_COLUMNS - 1, NODE_ROWS - 1).ray);
}

/* Row of a pixel's first hit. The hits of a pixel lie one above the other. */
int first_row(int row) { return row * int(TILE(0).hit_rows); }

/* The estimate of a hit. `pixel` is the pixel's column and the row of the hit. */
HitEstimate pixel_estimate(ivec2 pixel)
{
    HitEstimate estimate;
    estimate.slope = vec2(0.0f);
    estimate.shift = vec2(0.0f);
    if (TILE(0).grazing != 0) {
        int at = hit_place(pixel.x, pixel.y);
        estimate.height = node_data[at];
        estimate.from = 0.0f;
        estimate.search = 0.0f;
        estimate.slope = vec2(node_data[at + 1], node_data[at + 2]);
        estimate.shift = vec2(node_data[at + 3], node_data[at + 4]);
        return estimate;
    }
    if (TILE(0).search_pixels != 0)
        return own_search(0);
    ivec2 cell = pixel / ivec2(NODE_STEP_X, NODE_STEP_Y);
    vec2 part = vec2(pixel % ivec2(NODE_STEP_X, NODE_STEP_Y)) / vec2(float(NODE_STEP_X), float(NODE_STEP_Y));
    return cell_estimate(0, node_of(cell.x, cell.y), node_of(cell.x + 1, cell.y), node_of(cell.x, cell.y + 1), node_of(cell.x + 1, cell.y + 1),
                         pixel_ray_at(0, float(pixel.x), float(pixel.y)), part.x, part.y, tile_may_occlude());
}

const int GROUP_PIXELS = TILE_WIDTH * GROUP_ROWS;

/* The pixel of this invocation: a tile is GROUPS_A_TILE workgroups, one above the other. */
struct TilePixel {
    ivec2 at;    /* in the tile */
    ivec2 texel; /* of the layers */
    bool inside;
};

TilePixel tile_pixel()
{
    TilePixel p;
    ivec2 group = ivec2(gl_WorkGroupID.xy);
    ivec2 tile = group / ivec2(1, GROUPS_A_TILE);
    tile_slot = tile.y * pass_data.columns + tile.x;
    p.at = ivec2(0, group.y % GROUPS_A_TILE * GROUP_ROWS) + ivec2(gl_LocalInvocationID.xy);
    ivec2 image = (tile + ivec2(pass_data.tile_x, pass_data.tile_y)) * ivec2(TILE_WIDTH, TILE_HEIGHT) + p.at;
    p.texel = image - ivec2(pass_data.area_x, pass_data.area_y);
    layer_texel = p.texel;
    p.inside = all(greaterThanEqual(p.texel, ivec2(0))) && all(lessThan(p.texel, ivec2(pass_data.area_width, pass_data.area_height)));
    return p;
}

/* The sky behind the water, as kernels see it that are included after this file. It is black if it is not asked for. */
vec3 shown_background(vec3 ray) { return pass_data.show_background != 0 ? background(0, ray) : vec3(0.0f); }
#define background(cx, ray) shown_background(ray)
