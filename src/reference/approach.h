/* SPDX-License-Identifier: MIT
 *
 * Moves rays close to their first hits at a low cost. A part of reference_lanes.c.
 *
 * The search for the hit sums all waves in double precision at every step. Here steps use the longest waves alone if the ray is so far above them that the
 * others cannot reach it. Sums are in single precision, with phases relative to an anchor on the ray. Bounds include both errors, so a ray ends above the
 * water, before its first hit. A lane is a wave within the sum of a ray, and a ray within a step.
 */
#ifndef MANGATA_REFERENCE_APPROACH_H
#define MANGATA_REFERENCE_APPROACH_H

#include <stddef.h>
#include <string.h>

/* ---- steps ---- */

/* Bounds of one level of waves, for one ray in each lane. f is the ray's height above the waves of the level. */
typedef struct level_bounds {
    _Alignas(64) double rest[REFERENCE_LANES]; /* bound of the other waves' height */
    double random_rest[REFERENCE_LANES];       /* `rest` if both it and the bound of the curvature are numbers of standard deviations, else 0 */
    double height_error[REFERENCE_LANES];      /* bound of the rounding errors of sums in single precision, within reach of the anchor */
    double slope_error[REFERENCE_LANES];
    double least[REFERENCE_LANES], inverse_least[REFERENCE_LANES]; /* lower bound of the derivative of f, and 1/−least */
    double curvature[REFERENCE_LANES], inverse_curvature[REFERENCE_LANES];
    double reach[REFERENCE_LANES];   /* greatest distance from the anchor, metres */
    double ascend[REFERENCE_LANES];  /* above this f the ray goes on with fewer waves; chosen by measurements */
    double descend[REFERENCE_LANES]; /* below this f the ray goes on with more waves; chosen by measurements */
} level_bounds;

enum { APPROACH_RAYS = 128 }; /* number of rays whose bounds are kept at a time */

/* The members of level_bounds that depend on the ray, for each of these rays and each level. */
typedef struct approach_bounds {
    uint32_t first; /* index of the first of the rays in the batch */
    _Alignas(64) double slope_error[REFERENCE_LEVELS][APPROACH_RAYS], reach[REFERENCE_LEVELS][APPROACH_RAYS];
    double least[REFERENCE_LEVELS][APPROACH_RAYS], inverse_least[REFERENCE_LEVELS][APPROACH_RAYS];
    double random_rest[REFERENCE_LEVELS][APPROACH_RAYS];
    double curvature[REFERENCE_LEVELS][APPROACH_RAYS], inverse_curvature[REFERENCE_LEVELS][APPROACH_RAYS];
} approach_bounds;

typedef struct approach_state {
    ray_waves waves[REFERENCE_LANES];
    _Alignas(64) double origin_y[REFERENCE_LANES], direction_y[REFERENCE_LANES], end[REFERENCE_LANES];
    _Alignas(64) double distance[REFERENCE_LANES], above[REFERENCE_LANES];
    _Alignas(64) int64_t evaluations[REFERENCE_LANES];
    level_bounds own;
    _Alignas(64) double height[REFERENCE_LANES], slope[REFERENCE_LANES];
    double anchor[REFERENCE_LANES];   /* distance along the ray from which phases in single precision count, metres */
    uint32_t placed[REFERENCE_LANES]; /* number of waves whose phases count from the anchor */
    uint32_t level[REFERENCE_LANES], ray[REFERENCE_LANES];
    uint32_t active; /* bit i is set while lane i has a ray */
} approach_state;

static uint32_t whole_blocks(uint32_t waves)
{
    return waves > REFERENCE_MOST_WAVES ? REFERENCE_MOST_WAVES : (waves + REFERENCE_BLOCK - 1) / REFERENCE_BLOCK * REFERENCE_BLOCK;
}

static inline void set_bounds(const reference_frame *frame, const approach_bounds *bounds, uint32_t ray, uint32_t level, int lane, level_bounds *to)
{
    to->rest[lane] = frame->levels[level].rest;
    to->random_rest[lane] = bounds->random_rest[level][ray];
    to->height_error[lane] = 4e-6 * frame->levels[level].amplitudes;
    to->slope_error[lane] = bounds->slope_error[level][ray];
    to->least[lane] = bounds->least[level][ray];
    to->inverse_least[lane] = bounds->inverse_least[level][ray];
    to->curvature[lane] = bounds->curvature[level][ray];
    to->inverse_curvature[lane] = bounds->inverse_curvature[level][ray];
    to->reach[lane] = bounds->reach[level][ray];
    to->descend[lane] = 0.7 * frame->levels[level].rest;
    to->ascend[lane] = level > 0 ? 1.9 * frame->levels[level - 1].rest - frame->levels[level].rest : HUGE_VAL;
}

static void bound_approach(const reference_frame *frame, const reference_batch *batch, uint32_t at, approach_bounds *to)
{
    const reals dx = load(&batch->direction_x[at]), dy = load(&batch->direction_y[at]), dz = load(&batch->direction_z[at]);
    const uint32_t i = at - to->first;
    lane_bounds sum = {splat(0), splat(0), splat(0), splat(0)};
    for (uint32_t level = 0; level < frame->level_count; level++) {
        const lane_curve bound = bound_waves(frame, level > 0 ? frame->levels[level - 1].waves : 0, frame->levels[level].waves, dx, dz, &sum);
        const reals least = dy - bound.slope;
        const masks slopes = (masks)(sum.slope > 0.0);
        const reals length = select_lanes(slopes, frame->levels[level].amplitudes / sum.slope, splat(0));
        store(&to->least[level][i], least);
        store(&to->inverse_least[level][i], 1.0 / -least);
        const double random_rest = frame->levels[level].random ? frame->levels[level].rest : 0;
        store(&to->random_rest[level][i], select_lanes((masks)(bound.curvature < sum.curvature), splat(random_rest), splat(0)));
        store(&to->curvature[level][i], bound.curvature);
        store(&to->inverse_curvature[level][i], 1.0 / bound.curvature);
        store(&to->slope_error[level][i], 2e-6 * fused(length, sum.curvature, sum.slope));
        store(&to->reach[level][i], select_lanes(slopes, 10.0 * length, splat(HUGE_VAL)));
    }
}

static uint32_t finest_level(const reference_frame *frame) { return frame->level_count - (frame->wave_count > REFERENCE_MOST_WAVES ? 2 : 1); }

static void set_level(const reference_frame *frame, const approach_bounds *bounds, approach_state *state, int lane, uint32_t level)
{
    const uint32_t ray = state->ray[lane] - bounds->first;
    state->level[lane] = level;
    set_bounds(frame, bounds, ray, level, lane, &state->own);
}

/* Gives a lane the next ray that can meet water, or idles it. Returns the index of the ray to look at next. */
static uint32_t take_approach(const reference_frame *frame, const reference_batch *batch, const approach_bounds *bounds, approach_state *state, int lane,
                              uint32_t next, uint32_t end)
{
    while (next < end && !(batch->start[next] < HUGE_VAL))
        next++;
    if (next >= end) {
        state->active &= ~(1u << lane);
        return next;
    }
    state->ray[lane] = next;
    state->origin_y[lane] = batch->origin_y[next];
    state->direction_y[lane] = batch->direction_y[next];
    state->end[lane] = batch->end[next];
    state->distance[lane] = batch->start[next];
    state->above[lane] = 0;
    state->evaluations[lane] = 0;
    state->anchor[lane] = batch->start[next];
    state->placed[lane] = 0;
    state->active |= 1u << lane;
    set_level(frame, bounds, state, lane, 0);
    return next + 1;
}

static void sum_ray(const reference_frame *frame, const reference_batch *batch, approach_state *state, int lane)
{
    const uint32_t ray = state->ray[lane], count = whole_blocks(frame->levels[state->level[lane]].waves);
    const double s = state->distance[lane];
    ray_waves *waves = &state->waves[lane];
    if (s - state->anchor[lane] > state->own.reach[lane]) {
        state->anchor[lane] = s;
        state->placed[lane] = 0;
    }
    if (state->placed[lane] < count) {
        const double at = state->anchor[lane], direction[2] = {batch->direction_x[ray], batch->direction_z[ray]};
        const double place[3] = {fma(direction[0], at, batch->origin_x[ray]), fma(direction[1], at, batch->origin_z[ray]), batch->time_offset[ray]};
        place_waves(&frame->columns, state->placed[lane], count, place, direction, waves);
        state->placed[lane] = count;
    }
    const float distance = (float)(s - state->anchor[lane]);
    partial_sums sums = {0};
    add_waves(waves, &frame->columns, 0, count, distance, &sums);
    state->height[lane] = add_up(sums.height);
    state->slope[lane] = add_up(sums.slope);
}

/* A lower bound f of the ray's height above the water by the waves of a level, a lower bound of its derivative, and the step that both allow. */
typedef struct level_step {
    reals f, derivative, step;
} level_step;

/* safe_step() for a level whose other waves are at most `rest` high. If both bounds are numbers of standard deviations, they belong to independent sums of
 * sines, so their squares add: √(rest² + (curvature s²/2)²) ≤ rest + share · curvature s²/2 up to the root of f, if the derivative is negative. */
static inline level_step step_over(const level_bounds *bounds, reals ray_height, reals direction_y, reals water, reals slope)
{
    level_step result;
    const reals least = load(bounds->least), inverse = load(bounds->inverse_curvature);
    const reals f = ray_height - water - load(bounds->rest) - load(bounds->height_error);
    const reals derivative = direction_y - slope - load(bounds->slope_error);
    const masks falls = (masks)(derivative < 0.0);
    const reals share = select_lanes(falls, square_root(f / fused(splat(2), load(bounds->random_rest), f)), splat(1));
    const reals curvature = share * load(bounds->curvature);
    const reals until_least = greater(derivative - least, splat(0)) * inverse;
    const reals f_there = fused(until_least, fused(until_least, -0.5 * curvature, derivative), f);
    const reals straight = fused(f_there, load(bounds->inverse_least), until_least);
    const reals root = square_root(fused(derivative, derivative, 2.0 * f * curvature));
    const reals parabola = select_lanes(falls, 2.0 * f / (root - derivative), (root + derivative) * inverse);
    const reals step = select_lanes((masks)(f_there > 0.0), straight, parabola);
    result.f = f;
    result.derivative = derivative;
    result.step = select_lanes((masks)(least < 0.0), step, splat(HUGE_VAL));
    return result;
}

typedef struct approach_outcome {
    masks miss, done, coarser, finer;
} approach_outcome;

static inline approach_outcome approach_step(approach_state *state, masks finest)
{
    const reals s = load(state->distance), dy = load(state->direction_y), ray_height = fused(dy, s, load(state->origin_y));
    const level_step own = step_over(&state->own, ray_height, dy, load(state->height), load(state->slope));
    const masks is_above = (masks)(own.f > 0.0);
    const masks evaluations = load_mask(state->evaluations) + 1, exhausted = (masks)(evaluations >= most_evaluations);
    const reals next = select_lanes(is_above, s + own.step, s);
    /* f has one root ahead, which Newton's steps reach fast. */
    const masks near = (masks)(own.derivative < 0.0) & (masks)(own.derivative * own.derivative > 2.0 * own.f * load(state->own.curvature));

    approach_outcome outcome;
    outcome.coarser = (masks)(own.f > load(state->own.ascend));
    outcome.finer = ~finest & (~is_above | (masks)(own.f < load(state->own.descend)));
    outcome.done = exhausted | (finest & (~is_above | (near & ~outcome.coarser)));
    outcome.miss = is_above & ~exhausted & ((masks)(next > load(state->end)) | ~(masks)(next < far_away));
    store(state->distance, next);
    store(state->above, select_lanes(is_above, s, load(state->above)));
    store_mask(state->evaluations, evaluations);
    return outcome;
}

/* Moves the starts of the rays [first, end) towards the water. */
static void approach_rays(const reference_frame *frame, reference_batch *batch, uint32_t first, uint32_t end)
{
    approach_bounds bounds;
    bounds.first = first;
    for (uint32_t i = first; i < end; i += REFERENCE_LANES)
        bound_approach(frame, batch, i, &bounds);
    approach_state state;
    memset(&state.origin_y, 0, sizeof state - offsetof(approach_state, origin_y));
    const uint32_t finest = finest_level(frame);
    uint32_t next = first;
    for (int lane = 0; lane < REFERENCE_LANES; lane++)
        next = take_approach(frame, batch, &bounds, &state, lane, next, end);
    while (state.active) {
        masks at_finest = (masks){0};
        for (uint32_t bits = state.active; bits; bits &= bits - 1) {
            const int lane = __builtin_ctz(bits);
            sum_ray(frame, batch, &state, lane);
            at_finest[lane] = state.level[lane] == finest ? -1 : 0;
        }
        batch->evaluations += (uint64_t)__builtin_popcount(state.active);
        const approach_outcome outcome = approach_step(&state, at_finest);
        const uint32_t misses = lane_bits(outcome.miss), leaving = misses | lane_bits(outcome.done), coarser = lane_bits(outcome.coarser);
        for (uint32_t moving = (leaving | coarser | lane_bits(outcome.finer)) & state.active; moving; moving &= moving - 1) {
            const int lane = __builtin_ctz(moving);
            const uint32_t ray = state.ray[lane], bit = 1u << lane;
            if (leaving & bit) {
                batch->start[ray] = misses & bit ? HUGE_VAL : state.distance[lane];
                batch->above[ray] = state.above[lane];
                next = take_approach(frame, batch, &bounds, &state, lane, next, end);
            } else
                set_level(frame, &bounds, &state, lane, coarser & bit ? state.level[lane] - 1 : state.level[lane] + 1);
        }
    }
}

#endif
