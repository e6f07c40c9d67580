/* SPDX-License-Identifier: MIT
 * Estimates of a tile's first hits: interpolated from a lattice of nodes, or searched in every pixel. A part of lanes.c, whose kernels it needs. */
#ifndef MANGATA_CPU_LATTICE_LANE_H
#define MANGATA_CPU_LATTICE_LANE_H

/* The members of a tile's LatticeNodes, one array per member. */
typedef struct tile_nodes {
    float ray_x[NODE_PADDED], ray_y[NODE_PADDED], ray_z[NODE_PADDED];
    float along[NODE_PADDED], found[NODE_PADDED];
    float level[NODE_PADDED], slope_x[NODE_PADDED], slope_z[NODE_PADDED], height[NODE_PADDED];
    float shift_x[NODE_PADDED], shift_z[NODE_PADDED];
} tile_nodes;

static void search_nodes(const struct kernel_context *cx, tile_nodes *nodes)
{
    float column[NODE_PADDED], row[NODE_PADDED];
    for (int i = 0; i < NODE_PADDED; i++) {
        const int node = i < NODE_COUNT ? i : NODE_COUNT - 1;
        column[i] = (float)(node % NODE_COLUMNS * NODE_STEP_X);
        row[i] = (float)(node / NODE_COLUMNS * NODE_STEP_Y);
    }
    for (int i = 0; i < NODE_PADDED; i += MGT_LANES) {
        const LatticeNode n = lattice_node(cx, pixel_ray_at(cx, load(column + i), load(row + i)));
        store(nodes->ray_x + i, n.ray.x);
        store(nodes->ray_y + i, n.ray.y);
        store(nodes->ray_z + i, n.ray.z);
        store(nodes->along + i, n.along);
        store(nodes->found + i, n.found);
        store(nodes->level + i, n.plane.level);
        store(nodes->slope_x + i, n.plane.slope_x);
        store(nodes->slope_z + i, n.plane.slope_z);
        store(nodes->height + i, n.plane.height);
        store(nodes->shift_x + i, n.shift.x);
        store(nodes->shift_z + i, n.shift.y);
    }
}

/* The ray of node i in every lane. */
static vec3 node_ray(const tile_nodes *n, int i) { return vec3(real(n->ray_x[i]), real(n->ray_y[i]), real(n->ray_z[i])); }

static bool tile_may_occlude(const struct kernel_context *cx, const tile_nodes *n)
{
    return any_lane(corners_occlude(cx, node_ray(n, 0), node_ray(n, NODE_COLUMNS - 1), node_ray(n, NODE_COUNT - NODE_COLUMNS), node_ray(n, NODE_COUNT - 1)));
}

/* ---- estimates of pixels ---- */

enum { CELLS = (NODE_COLUMNS - 1) * (NODE_ROWS - 1), CELL_COLUMNS = NODE_COLUMNS - 1 };
_Static_assert(CELLS % 16 == 0, "cells fill vectors");

static inline real gather(const float *plane, const uint16_t *list)
{
    float lanes[MGT_LANES];
    for (int i = 0; i < MGT_LANES; i++)
        lanes[i] = plane[list[i]];
    return load(lanes);
}

static LatticeNode gather_node(const tile_nodes *n, const uint16_t *list)
{
    LatticeNode node;
    node.ray = vec3(gather(n->ray_x, list), gather(n->ray_y, list), gather(n->ray_z, list));
    node.along = gather(n->along, list);
    node.found = gather(n->found, list);
    node.plane = (NodePlane){gather(n->level, list), gather(n->slope_x, list), gather(n->slope_z, list), gather(n->height, list)};
    return node;
}

/* Fills `doubt` and `from` of each lattice cell: whether its pixels must search on their own, and from where. One lane per cell. */
static void judge_cells(const struct kernel_context *cx, const tile_nodes *nodes, float *doubt, float *from)
{
    const bool occlude = tile_may_occlude(cx, nodes);
    for (int first = 0; first < CELLS; first += MGT_LANES) {
        uint16_t at[4][MGT_LANES];
        for (int i = 0; i < MGT_LANES; i++) {
            const int cell = first + i;
            at[0][i] = (uint16_t)(cell / CELL_COLUMNS * NODE_COLUMNS + cell % CELL_COLUMNS);
            at[1][i] = at[0][i] + 1;
            at[2][i] = at[0][i] + NODE_COLUMNS;
            at[3][i] = at[2][i] + 1;
        }
        const LatticeNode tl = gather_node(nodes, at[0]), tr = gather_node(nodes, at[1]), ll = gather_node(nodes, at[2]), lr = gather_node(nodes, at[3]);
        store(doubt + first, cell_doubt(cx, tl, tr, ll, lr, occlude));
        store(from + first, cell_from(cx, tl, tr, ll, lr));
    }
}

/* Planes of the nodes left and right of every pixel column, for one row of nodes. */
typedef struct node_planes {
    float level[2][TILE_WIDTH], slope_x[2][TILE_WIDTH], slope_z[2][TILE_WIDTH], height[2][TILE_WIDTH];
} node_planes;

static void spread_nodes(const tile_nodes *nodes, int row, node_planes *out)
{
    for (int side = 0; side < 2; side++)
        for (int x = 0; x < TILE_WIDTH; x++) {
            const int n = row * NODE_COLUMNS + x / NODE_STEP_X + side;
            out->slope_x[side][x] = nodes->slope_x[n];
            out->slope_z[side][x] = nodes->slope_z[n];
            out->level[side][x] = nodes->level[n];
            out->height[side][x] = nodes->height[n];
        }
}

static inline NodePlane load_plane(const node_planes *p, int side, int x)
{
    return (NodePlane){load(p->level[side] + x), load(p->slope_x[side] + x), load(p->slope_z[side] + x), load(p->height[side] + x)};
}

static void estimate_heights(const struct kernel_context *cx, const tile_nodes *nodes, tile_estimate *estimate)
{
    node_planes planes[2];
    float shares[TILE_WIDTH];
    for (int x = 0; x < TILE_WIDTH; x++)
        shares[x] = (float)(x % NODE_STEP_X) / NODE_STEP_X;
    spread_nodes(nodes, 0, &planes[0]);
    for (int y = 0; y < TILE_HEIGHT; y++) {
        const node_planes *above = &planes[y / NODE_STEP_Y & 1], *below = &planes[(y / NODE_STEP_Y & 1) ^ 1];
        if (y % NODE_STEP_Y == 0)
            spread_nodes(nodes, y / NODE_STEP_Y + 1, &planes[(y / NODE_STEP_Y & 1) ^ 1]);
        const real v = real((float)(y % NODE_STEP_Y) / NODE_STEP_Y);
        for (int x = 0; x < TILE_WIDTH; x += MGT_LANES) {
            const vec3 ray = pixel_ray_at(cx, lane_numbers() + (float)x, real((float)y));
            store(estimate->height + y * TILE_WIDTH + x, lattice_height(cx, load_plane(above, 0, x), load_plane(above, 1, x), load_plane(below, 0, x),
                                                                        load_plane(below, 1, x), ray, load(shares + x), v));
        }
    }
}

/* Interpolates one coordinate of the nodes' shifts, `from`, to pixels. For choppy water. */
static void spread_shifts(const struct kernel_context *cx, const float *from, float *to)
{
    for (int y = 0; y < TILE_HEIGHT; y++) {
        const real v = real((float)(y % NODE_STEP_Y) / NODE_STEP_Y);
        for (int x = 0; x < TILE_WIDTH; x += MGT_LANES) {
            float corner[4][MGT_LANES], u[MGT_LANES];
            for (int i = 0; i < MGT_LANES; i++) {
                const float *at = from + y / NODE_STEP_Y * NODE_COLUMNS + (x + i) / NODE_STEP_X;
                corner[0][i] = at[0];
                corner[1][i] = at[1];
                corner[2][i] = at[NODE_COLUMNS];
                corner[3][i] = at[NODE_COLUMNS + 1];
                u[i] = (float)((x + i) % NODE_STEP_X) / NODE_STEP_X;
            }
            store(to + y * TILE_WIDTH + x, lattice_shift(cx, load(corner[0]), load(corner[1]), load(corner[2]), load(corner[3]), load(u), v));
        }
    }
}

/* Searches every hit of every pixel, from the lowest row up, because a hit bounds the search of the one above it. */
static void search_columns(const struct kernel_context *cx, tile_estimate *estimate)
{
    struct kernel_context columns = *cx;
    columns.found = estimate;
    for (int x = 0; x < TILE_WIDTH; x += MGT_LANES)
        for (int part = 0; part < walk_parts(cx); part++)
            walk_column(&columns, lane_numbers() + (float)x, part);
}

static void store_own_searches(const struct kernel_context *cx, tile_estimate *estimate)
{
    const HitEstimate own = own_search(cx);
    for (int i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        store(estimate->height + i, own.height);
        store(estimate->from + i, own.from);
        store(estimate->search + i, own.search);
        store(estimate->slope_x + i, own.slope.x);
        store(estimate->slope_z + i, own.slope.y);
        store(estimate->shift_x + i, own.shift.x);
        store(estimate->shift_z + i, own.shift.y);
    }
}

static void lanes_estimate(const FrameData *frame, const tile_waves *tile, tile_estimate *estimate)
{
    const struct kernel_context cx = context_for(frame, tile);
    if (tile->data.grazing) {
        memset(estimate, 0, (size_t)tile->data.hit_rows * sizeof *estimate);
        search_columns(&cx, estimate);
        return;
    }
    if (tile->data.search_pixels) {
        store_own_searches(&cx, estimate);
        return;
    }
    tile_nodes nodes;
    float doubt[CELLS], from[CELLS];
    search_nodes(&cx, &nodes);
    judge_cells(&cx, &nodes, doubt, from);
    for (int i = 0; i < TILE_PIXELS; i++) {
        const int cell = i / TILE_WIDTH / NODE_STEP_Y * CELL_COLUMNS + i % TILE_WIDTH / NODE_STEP_X;
        estimate->search[i] = doubt[cell];
        estimate->from[i] = from[cell];
        estimate->shift_x[i] = estimate->shift_z[i] = 0;
    }
    estimate_heights(&cx, &nodes, estimate);
    if (tile->data.pressed > 0) {
        spread_shifts(&cx, nodes.shift_x, estimate->shift_x);
        spread_shifts(&cx, nodes.shift_z, estimate->shift_z);
    }
}

#endif
