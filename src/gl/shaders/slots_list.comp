/* SPDX-License-Identifier: MIT
 *
 * Lists the tasks of a band's tiles, each with its first slot (Eq. 2): one workgroup per tile, four pixels per invocation. One more workgroup finds the first
 * slot of the tile behind the band.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/adaptive/slot_order.k"

#define PLAN_ACCESS
#define TASK_ACCESS writeonly
#include "slots_data.glsl"

layout(local_size_x = TASK_LANES) in;
layout(binding = 4, r32f) readonly uniform image2D importance_image;

const int LANE_PIXELS = TILE_PIXELS / TASK_LANES;
shared double sums[TASK_LANES];
shared int counts[TASK_LANES + 1];

/* The first slot at or beyond `place` in the prefix sum. */
uint first_at(double place) { return plan_slots == 0u ? 0u : uint(first_slot(0, place, double(plan_slots), packDouble2x32(plan_sum))); }

void main()
{
    int lane = int(gl_LocalInvocationID.x);
    int band_tile = int(gl_WorkGroupID.x);
    int tile = slots_data.first_tile + band_tile;
    float own[LANE_PIXELS];
    double sum = 0.0LF;
    int count = 0;
    for (int i = 0; i < LANE_PIXELS; i++) {
        ivec2 texel = task_texel(tile, lane * LANE_PIXELS + i);
        own[i] = band_tile < slots_data.band_tiles && is_inside(texel) ? imageLoad(importance_image, texel).r : 0.0f;
        sum += double(own[i]);
        count += own[i] > 0.0f ? 1 : 0;
    }
    sums[lane] = sum;
    counts[lane] = count;
    barrier();
    if (lane == 0) {
        double before = packDouble2x32(plan_tiles[tile].xy);
        int tasks_before = 0;
        plan_tiles[tile].z = first_at(before);
        for (int i = 0; i < TASK_LANES; i++) {
            double importance = sums[i];
            int here = counts[i];
            sums[i] = before;
            counts[i] = tasks_before;
            before += importance;
            tasks_before += here;
        }
        plan_tiles[tile].w = uint(tasks_before);
    }
    barrier();
    double before = sums[lane];
    int place = task_place(band_tile, counts[lane]);
    for (int i = 0; i < LANE_PIXELS; i++)
        if (own[i] > 0.0f) {
            tasks[place] = uvec2(first_at(before), uint(lane * LANE_PIXELS + i));
            before += double(own[i]);
            place++;
        }
}
