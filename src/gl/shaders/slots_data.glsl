/* SPDX-License-Identifier: MIT
 *
 * Data of scheme podee of method adaptive, which is that of src/cpu/adaptive_podee.c. Important pixels of the approximate picture are tasks, in the order of
 * tiles and of pixels within a tile. The picture's slots are distributed over the tasks by a prefix sum v of their importance.
 *
 * Slot k stands at (k + 1/2)/M · Σv in the prefix sum. So a task's first slot is the first one at or beyond the sum before the task, and its last slot is the
 * one before the next task's first. The first slots are computed once for each task in double precision. Everything after that compares whole numbers. A band's
 * slots are rendered in chunks. The CPU does not wait for their number, so it submits the largest possible number of chunks; superfluous ones have no
 * workgroups.
 */
layout(std140, binding = 3) uniform SlotsBlock { SlotsData slots_data; };

#ifndef PLAN_ACCESS
#define PLAN_ACCESS readonly
#endif
#ifndef TASK_ACCESS
#define TASK_ACCESS readonly
#endif
#ifndef SLOT_ACCESS
#define SLOT_ACCESS readonly
#endif

/* Each element of plan_tiles is a tile of the picture; one more follows the last tile. Its members are the sum of importance over the tasks before the tile (the
 * bits of a double), the tile's first slot, and its number of tasks. While sums are taken it holds the tile's own importance and water. */
layout(std430, binding = 4) PLAN_ACCESS buffer PlanBlock
{
    uint plan_slots; /* M; 0: there are no tasks */
    uint plan_padding;
    uvec2 plan_sum; /* of all importance, the bits of a double */
    uvec4 plan_tiles[];
};

/* TILE_PIXELS elements for each tile of the band: a task's first slot, and its pixel. */
layout(std430, binding = 5) TASK_ACCESS buffer TaskBlock { uvec2 tasks[]; };

/* Elements of SLOT_FLOATS each: for each pixel of the band the sum over a task's slots, then the results of a chunk's slots. */
layout(std430, binding = 8) SLOT_ACCESS buffer SlotBlock { float slot_values[]; };

int task_place(int band_tile, int task) { return band_tile * TILE_PIXELS + task; }
int result_place(int slot) { return slots_data.band_tiles * TILE_PIXELS + slot; }

/* The band's slots are those from band_first() to band_end() − 1. */
uint band_first() { return plan_tiles[slots_data.first_tile].z; }
uint band_end() { return plan_tiles[slots_data.first_tile + slots_data.band_tiles].z; }
uint chunk_first() { return band_first() + uint(slots_data.chunk) * uint(slots_data.chunk_slots); }

ivec2 tile_corner(int tile) { return ivec2(tile % slots_data.columns, tile / slots_data.columns) * ivec2(TILE_WIDTH, TILE_HEIGHT); }
ivec2 task_texel(int tile, int pixel) { return tile_corner(tile) + ivec2(pixel % TILE_WIDTH, pixel / TILE_WIDTH); }
bool is_inside(ivec2 texel) { return texel.x < slots_data.width && texel.y < slots_data.height; }
