/* SPDX-License-Identifier: MIT
 *
 * Scheme podee of method adaptive, as src/cpu/adaptive_podee.c has it: pixels of the approximate picture that matter are tasks, in the order of tiles
 * and of pixels within a tile, and the picture's slots are shared out among them by a prefix sum of their importance.
 *
 * Slot k looks at (k + 1/2)/M · Σv in the prefix sum. A task therefore owns the slots from the first one that looks at its sum or beyond up to the next
 * task's first. These firsts are found once a task in double precision; all that follows searches and compares whole numbers. Slots of a band are
 * rendered in chunks, since nobody waits to hear how many there are: dispatches that turn out to be too many have no workgroups.
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

/* Of each tile of the picture, and at the end of all: the bits of a double, the sum of importance over the tasks before it; its first slot; how many tasks
 * it has. While sums are taken: those of its own importance and water. */
layout(std430, binding = 4) PLAN_ACCESS buffer PlanBlock
{
    uint plan_slots; /* M; 0: there are no tasks */
    uint plan_padding;
    uvec2 plan_sum; /* of all importance, the bits of a double */
    uvec4 plan_tiles[];
};

/* TILE_PIXELS places a tile of the band: a task's first slot, and its pixel. */
layout(std430, binding = 5) TASK_ACCESS buffer TaskBlock { uvec2 tasks[]; };

/* SLOT_FLOATS each: the sum over a task's slots, a place a pixel of the band, and behind them the results of a chunk. */
layout(std430, binding = 8) SLOT_ACCESS buffer SlotBlock { float slot_values[]; };

int task_place(int band_tile, int task) { return band_tile * TILE_PIXELS + task; }
int result_place(int slot) { return slots_data.band_tiles * TILE_PIXELS + slot; }

/* Slots of the band. */
uint band_first() { return plan_tiles[slots_data.first_tile].z; }
uint band_end() { return plan_tiles[slots_data.first_tile + slots_data.band_tiles].z; }
uint chunk_first() { return band_first() + uint(slots_data.chunk) * uint(slots_data.chunk_slots); }

ivec2 tile_corner(int tile) { return ivec2(tile % slots_data.columns, tile / slots_data.columns) * ivec2(TILE_WIDTH, TILE_HEIGHT); }
ivec2 task_texel(int tile, int pixel) { return tile_corner(tile) + ivec2(pixel % TILE_WIDTH, pixel / TILE_WIDTH); }
bool is_inside(ivec2 texel) { return texel.x < slots_data.width && texel.y < slots_data.height; }
