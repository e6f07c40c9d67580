/* SPDX-License-Identifier: MIT
 *
 * Adds the results of a chunk's slots to their tasks, in the order of slots: one workgroup per tile of the band, one invocation per task.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"

#define SLOT_ACCESS
#include "slots_data.glsl"

layout(local_size_x = TASK_LANES) in;

/* A compensated sum (Kahan): the next term makes up for the rounding error `lost` of each addition. */
struct TaskSum {
    float value[SLOT_FLOATS], lost[SLOT_FLOATS];
};

TaskSum sum_before(int place)
{
    TaskSum sum;
    for (int c = 0; c < SLOT_FLOATS; c++) {
        sum.value[c] = slots_data.chunk > 0 ? slot_values[SLOT_FLOATS * place + c] : 0.0f;
        sum.lost[c] = 0.0f;
    }
    return sum;
}

TaskSum sum_with(TaskSum sum, int from)
{
    for (int c = 0; c < SLOT_FLOATS; c++) {
        precise float term = slot_values[SLOT_FLOATS * from + c] - sum.lost[c];
        precise float total = sum.value[c] + term;
        precise float lost = (total - sum.value[c]) - term;
        sum.value[c] = total;
        sum.lost[c] = lost;
    }
    return sum;
}

void main()
{
    int band_tile = int(gl_WorkGroupID.x), tile = slots_data.first_tile + band_tile;
    int count = int(plan_tiles[tile].w);
    uint tile_end = plan_tiles[tile + 1].z;
    uint slots_from = chunk_first(), slots_to = slots_from + uint(slots_data.chunk_slots);
    bool starts = slots_data.chunk == 0; /* this chunk is the first one of every sum of the band */
    if (!starts && (tile_end <= slots_from || plan_tiles[tile].z >= slots_to))
        return;
    for (int i = int(gl_LocalInvocationID.x); i < count; i += TASK_LANES) {
        int place = task_place(band_tile, i);
        uint first = tasks[place].x, end = i + 1 < count ? tasks[place + 1].x : tile_end;
        uint from = max(first, slots_from), to = min(end, slots_to);
        if (from >= to && !starts)
            continue;
        TaskSum sum = sum_before(place);
        for (uint slot = from; slot < to; slot++)
            sum = sum_with(sum, result_place(int(slot - slots_from)));
        for (int c = 0; c < SLOT_FLOATS; c++)
            slot_values[SLOT_FLOATS * place + c] = sum.value[c];
    }
}
