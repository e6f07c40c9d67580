/* SPDX-License-Identifier: MIT
 *
 * Computes the prefix sum of importance over the tiles, and the number M of slots: one workgroup. Each invocation sums over a range of tiles.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/adaptive/slot_order.k"

#define PLAN_ACCESS
#include "slots_data.glsl"

const int LANES = 256;
layout(local_size_x = 256) in;
shared double importances[LANES + 1];
shared double waters[LANES];

/* Number of slots of a picture that shows `water` pixels of water. */
uint slots_of(double water)
{
    if (slots_data.slots != 0)
        return uint(slots_data.slots);
    return uint(slots_of_water(0, packDouble2x32(uvec2(uint(slots_data.samples_low), uint(slots_data.samples_high))), water));
}

void main()
{
    int lane = int(gl_LocalInvocationID.x);
    int each = (slots_data.tiles + LANES - 1) / LANES;
    int first = min(lane * each, slots_data.tiles), end = min(first + each, slots_data.tiles);
    double importance = 0.0LF, water = 0.0LF;
    for (int tile = first; tile < end; tile++) {
        uvec4 sums = plan_tiles[tile];
        importance += packDouble2x32(sums.xy);
        water += packDouble2x32(sums.zw);
    }
    importances[lane] = importance;
    waters[lane] = water;
    barrier();
    if (lane == 0) {
        double sum = 0.0LF;
        water = 0.0LF;
        for (int i = 0; i < LANES; i++) {
            double own = importances[i];
            importances[i] = sum;
            sum += own;
            water += waters[i];
        }
        importances[LANES] = sum;
        plan_slots = sum > 0.0LF ? slots_of(water) : 0u;
        plan_sum = unpackDouble2x32(sum);
        plan_tiles[slots_data.tiles] = uvec4(unpackDouble2x32(sum), 0u, 0u);
    }
    barrier();
    double before = importances[lane];
    for (int tile = first; tile < end; tile++) {
        double own = packDouble2x32(plan_tiles[tile].xy);
        plan_tiles[tile] = uvec4(unpackDouble2x32(before), 0u, 0u);
        before += own;
    }
}
