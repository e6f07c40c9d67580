/* SPDX-License-Identifier: MIT
 *
 * Computes how many evaluations the next round may spend, and which leaves it splits for them: one workgroup.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
layout(std140, binding = 0) uniform FrameBlock { FrameData frame_of_halvings[LEAF_SIDES]; };
#define FRAME(cx) frame_of_halvings[0]
#include "word64.glsl"
#include "kernels/adaptive/rounds.k"
#include "cells_state.glsl"

layout(local_size_x = CELLS_LANES) in;

shared double lane_sums[CELLS_LANES];
shared uint running;

int lane;

/* The sum over all tiles of the double at `word` and, if it is another word, of that at `other`. The order is fixed. Every invocation returns the sum. */
double sum_of_tiles(int word, int other)
{
    double sum = 0.0lf;
    for (int tile = lane; tile < cells_data.tiles; tile += CELLS_LANES) {
        sum += state_double(tile_words(tile) + word);
        if (other != word)
            sum += state_double(tile_words(tile) + other);
    }
    lane_sums[lane] = sum;
    for (int half_way = CELLS_LANES / 2; half_way > 0; half_way /= 2) {
        barrier();
        if (lane < half_way)
            lane_sums[lane] += lane_sums[lane + half_way];
    }
    barrier();
    double all = lane_sums[0];
    barrier();
    return all;
}

void count_leaves()
{
    double sum = 0.0lf;
    for (int tile = lane; tile < cells_data.tiles; tile += CELLS_LANES)
        sum += double(state[tile_words(tile) + TILE_LEAVES]);
    lane_sums[lane] = sum;
    barrier();
    if (lane != 0)
        return;
    for (int i = 1; i < CELLS_LANES; i++)
        sum += lane_sums[i];
    state[CELLS_LEAVES] = uint(sum);
}

/* The error that a target is compared with, and the target; 0: there is none. */
double predicted, target;

void find_goal()
{
    double variance = sum_of_tiles(TILE_VARIANCE, TILE_OPEN_VARIANCE), shown = sum_of_tiles(TILE_SHOWN, TILE_OPEN_SHOWN);
    double pixels = double(cells_data.width) * double(cells_data.height);
    bool by_coverage = cells_data.target_rmse > 0.0f;
    predicted = by_coverage || cells_data.sky_black != 0 ? predicted_rmse(0, variance, pixels) : predicted_displayed(0, shown, pixels);
    target = double(by_coverage ? cells_data.target_rmse : cells_data.target_displayed);
}

/* Evaluations that the round may spend; not above 0: the refinement ends. */
double next_share(int round, double used)
{
    double budget = sum_of_tiles(TILE_WATER, TILE_WATER) * double(cells_data.samples);
    return target > 0.0lf ? share_towards(0, predicted, target, used) : share_of_samples(0, round, budget, used);
}

/* ---- the census ---- */

const int CHUNK = 256; /* buckets that are read together */
shared uvec4 bucket_costs[CHUNK];

double whole(uvec2 words) { return double(words.y) * 4294967296.0lf + double(words.x); }

/* Plans a round: takes the buckets from the highest one down until `share` is spent. */
RoundPlan plan_for(double share)
{
    RoundPlan p = plan_begun(0, share);
    for (int end = WORTH_BUCKETS; end > 0; end -= CHUNK) {
        int at = CELLS_CENSUS + 4 * (end - CHUNK + lane);
        bucket_costs[lane] = uvec4(state[at], state[at + 1], state[at + 2], state[at + 3]);
        barrier();
        if (lane == 0)
            for (int b = end - 1; b >= end - CHUNK && p.ended == 0; b--) {
                uvec4 costs = bucket_costs[b - end + CHUNK];
                p = plan_with_bucket(0, p, b, whole(costs.xy), whole(costs.zw));
            }
        barrier();
    }
    return plan_ended(0, p);
}

void clear_census()
{
    for (int i = lane; i < 4 * WORTH_BUCKETS; i += CELLS_LANES)
        state[CELLS_CENSUS + i] = 0u;
}

void set_size(int at, bool runs)
{
    state[at] = runs ? uint(cells_data.columns) : 0u;
    state[at + 1] = runs ? uint(cells_data.rows) : 0u;
    state[at + 2] = runs ? 1u : 0u;
}

/* Stores the plan. If the pool is more than 5/8 full, leaves are settled from the first round on. */
void store_plan(int round, RoundPlan p)
{
    state[CELLS_BUCKET] = uint(p.bucket);
    state[CELLS_POINTS] = uint(p.points);
    set_state_double(CELLS_SHARE, p.share);
    bool crowded = double(state[CELLS_LEAVES]) > 0.625lf * double(cells_data.pool);
    state[CELLS_LEAST] = uint(settled_bucket(0, p, round, kept_octaves(0, predicted, target), crowded, int(state[CELLS_LEAST])));
}

void main()
{
    lane = int(gl_LocalInvocationIndex);
    int round = int(state[CELLS_ROUND]);
    if (lane == 0)
        running = round == 0 ? 1u : state[CELLS_RUNNING];
    barrier();
    if (running == 0u)
        return;
    double used = sum_of_tiles(TILE_SPENT, TILE_SPENT);
    find_goal();
    double share = next_share(round, used);
    count_leaves();
    RoundPlan p = plan_for(max(share, 0.0lf));
    barrier();
    clear_census();
    if (lane != 0)
        return;
    bool runs = share > 0.0lf && p.any != 0;
    store_plan(round, p);
    state[CELLS_ROUND] = uint(round + 1);
    state[CELLS_RUNNING] = runs ? 1u : 0u;
    set_state_double(CELLS_USED, used);
    for (int at = CELLS_SIZES; at < CELLS_SIZES_END; at++)
        state[at] = 0u;
    set_size(CELLS_TILES_SIZE, runs);
}
