/* SPDX-License-Identifier: MIT
 *
 * First hits of a batch of rays with the displaced surface, in lanes. Compiled once per lane count.
 *
 * The search for a ray's hit looks for the first zero of f(s) = (height of the ray) − (height of the water below it). f, its derivative and bounds of the
 * water's slope and curvature along the ray give a step that cannot pass the first zero. Near the zero, where the bounds prove that it is the only one, Newton's
 * steps are taken. A lane that is done takes the next ray, so that a long search does not hold up the other lanes. With many waves the search begins where
 * approach.h ends.
 */
#include "reference/double_lanes.h"
#include "reference/reference_frame.h"

#define PASTE(name, lanes) name##lanes
#define NAME(name, lanes) PASTE(name, lanes)
#define TRACE NAME(reference_trace_, REFERENCE_LANES)
#define MARCH NAME(reference_search_, REFERENCE_LANES)
#define BEND NAME(reference_bend_, REFERENCE_LANES)

static const double relative_tolerance = 1e-9;
static const double least_distance = 1e-3;     /* metres; added to the distance that the tolerance is relative to */
static const double far_away = 1e9;            /* metres; rays see no water beyond it */
static const int64_t most_evaluations = 50000; /* only rays within 1e-5 of the horizontal need as many */

typedef struct lane_vector {
    reals x, y, z;
} lane_vector;

static inline lane_vector interpolate(const double from[3], const double to[3], reals weight)
{
    const lane_vector result = {fused(weight, splat(to[0] - from[0]), splat(from[0])), fused(weight, splat(to[1] - from[1]), splat(from[1])),
                                fused(weight, splat(to[2] - from[2]), splat(from[2]))};
    return result;
}

static inline lane_vector subtract(lane_vector a, lane_vector b)
{
    const lane_vector result = {a.x - b.x, a.y - b.y, a.z - b.z};
    return result;
}

static inline lane_vector cross_product(lane_vector a, lane_vector b)
{
    const lane_vector result = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return result;
}

static inline lane_vector normalize(lane_vector a)
{
    const reals length = square_root(a.x * a.x + a.y * a.y + a.z * a.z);
    const lane_vector result = {a.x / length, a.y / length, a.z / length};
    return result;
}

/* Camera rays of REFERENCE_LANES samples from index `at` on. */
static void aim_rays(const reference_frame *frame, reference_batch *batch, uint32_t at)
{
    reals weight = splat(0);
    if (frame->scene.camera_moves && frame->scene.shutter > 0)
        weight = load(&batch->time_offset[at]) / -frame->scene.shutter;
    const reference_view *close = &frame->view, *open = &frame->view_open;
    const lane_vector position = interpolate(close->position, open->position, weight);
    const lane_vector target = interpolate(close->target, open->target, weight);
    const lane_vector up_hint = interpolate(close->up, open->up, weight);
    const sine_cosine fov = sine_cosine_half_turns(fused(weight, splat(open->fov_half_turns - close->fov_half_turns), splat(close->fov_half_turns)));
    const reals extent = fov.sine / fov.cosine;

    const lane_vector forward = normalize(subtract(target, position));
    const lane_vector right = normalize(cross_product(forward, up_hint));
    const lane_vector up = cross_product(right, forward);
    const reals x = (load(&batch->pixel_x[at]) * (2.0 / frame->scene.image.width) - 1.0) * (extent * frame->view_scale_x);
    const reals y = (1.0 - load(&batch->pixel_y[at]) * (2.0 / frame->scene.image.height)) * extent;
    const lane_vector through = {fused(x, right.x, fused(y, up.x, forward.x)), fused(x, right.y, fused(y, up.y, forward.y)),
                                 fused(x, right.z, fused(y, up.z, forward.z))};
    const lane_vector direction = normalize(through);
    store(&batch->origin_x[at], position.x);
    store(&batch->origin_y[at], position.y);
    store(&batch->origin_z[at], position.z);
    store(&batch->direction_x[at], direction.x);
    store(&batch->direction_y[at], direction.y);
    store(&batch->direction_z[at], direction.z);
}

/* Bounds of a curve's slope and curvature. */
typedef struct lane_curve {
    reals slope, curvature;
} lane_curve;

/* Adds waves to sums that bound the slope and curvature of the water along rays. */
static inline lane_curve bound_waves(const reference_frame *frame, uint32_t from, uint32_t to, reals dx, reals dz, lane_bounds *sum)
{
    waves_bounds(frame->waves + from, to - from, dx, dz, sum);
    lane_curve bound = {sum->slope, sum->curvature};
    if (frame->bound_deviations < HUGE_VAL) {
        bound.slope = lesser(sum->slope, frame->bound_deviations * square_root(0.5 * sum->slope_square));
        bound.curvature = lesser(sum->curvature, frame->bound_deviations * square_root(0.5 * sum->curvature_square));
    }
    bound.curvature = greater(bound.curvature, splat(1e-200));
    return bound;
}

/* Bounds of the water's slope and curvature along the rays, and the part of each ray that can meet water. */
static void bound_rays(const reference_frame *frame, reference_batch *batch, uint32_t at)
{
    lane_bounds sum = {splat(0), splat(0), splat(0), splat(0)};
    const lane_curve bound = bound_waves(frame, 0, frame->wave_count, load(&batch->direction_x[at]), load(&batch->direction_z[at]), &sum);
    store(&batch->slope_bound[at], bound.slope);
    store(&batch->curvature_bound[at], bound.curvature);

    const reals infinite = splat(HUGE_VAL);
    const reals dy = load(&batch->direction_y[at]);
    const reals clearance = load(&batch->origin_y[at]) - frame->height_bound; /* above the highest crest when > 0 */
    const masks descending = (masks)(dy < 0.0), outside = (masks)(clearance >= 0.0);
    reals start = select_lanes(outside, select_lanes(descending, clearance / -dy, infinite), splat(0));
    start = select_lanes((masks)(start < far_away), start, infinite);
    const reals end = select_lanes((masks)(dy > 0.0), -clearance / dy, infinite);
    store(&batch->start[at], start);
    store(&batch->end[at], end);
}

/* The longest step that cannot pass a zero of f: f' falls by at most `curvature` per metre, and never below `least` (< 0 where
 * the ray can meet the water at all). */
static inline reals safe_step(reals f, reals derivative, reals least, reals curvature)
{
    const reals fall = greater(derivative - least, splat(0));
    const reals until_least = fall / curvature;
    const reals f_there = fused(until_least, 0.5 * (derivative + least), f);
    const reals straight = until_least + f_there / -least;

    const reals root = square_root(fused(derivative, derivative, 2.0 * f * curvature));
    const reals parabola = select_lanes((masks)(derivative < 0.0), 2.0 * f / (root - derivative), (root + derivative) / curvature);
    const reals step = select_lanes((masks)(f_there > 0.0), straight, parabola);
    return select_lanes((masks)(least < 0.0), step, splat(HUGE_VAL));
}

#include "reference/approach.h"
#include "reference/choppy.h"

/* What a lane carries from one evaluation to the next. */
typedef struct search_state {
    _Alignas(64) double origin_x[REFERENCE_LANES], origin_y[REFERENCE_LANES], origin_z[REFERENCE_LANES];
    _Alignas(64) double direction_x[REFERENCE_LANES], direction_y[REFERENCE_LANES], direction_z[REFERENCE_LANES];
    _Alignas(64) double time_offset[REFERENCE_LANES], slope_bound[REFERENCE_LANES], curvature_bound[REFERENCE_LANES];
    _Alignas(64) double end[REFERENCE_LANES];
    _Alignas(64) double distance[REFERENCE_LANES]; /* distance at which f is evaluated next */
    _Alignas(64) double above[REFERENCE_LANES];    /* greatest known distance with f > 0 before the zero */
    _Alignas(64) double below[REFERENCE_LANES];    /* least known distance with f ≤ 0; +inf: none is known */
    _Alignas(64) int64_t last[REFERENCE_LANES];    /* −1: the next evaluation is at the hit */
    _Alignas(64) int64_t evaluations[REFERENCE_LANES];
    uint32_t ray[REFERENCE_LANES];
    uint32_t active; /* bit i is set while lane i has a ray */
} search_state;

/* Gives a lane the next ray that can meet water, or idles it. Returns the index of the ray to look at next. */
static uint32_t take_ray(search_state *state, int lane, reference_batch *batch, uint32_t next, uint32_t count)
{
    while (next < count && !(batch->start[next] < HUGE_VAL)) {
        batch->distance[next] = HUGE_VAL;
        batch->slope_x[next] = batch->slope_z[next] = 0;
        next++;
    }
    if (next >= count) {
        state->active &= ~(1u << lane);
        return next;
    }
    state->origin_x[lane] = batch->origin_x[next];
    state->origin_y[lane] = batch->origin_y[next];
    state->origin_z[lane] = batch->origin_z[next];
    state->direction_x[lane] = batch->direction_x[next];
    state->direction_y[lane] = batch->direction_y[next];
    state->direction_z[lane] = batch->direction_z[next];
    state->time_offset[lane] = batch->time_offset[next];
    state->slope_bound[lane] = batch->slope_bound[next];
    state->curvature_bound[lane] = batch->curvature_bound[next];
    state->end[lane] = batch->end[next];
    state->distance[lane] = batch->start[next];
    state->above[lane] = batch->above[next];
    state->below[lane] = HUGE_VAL;
    state->last[lane] = 0;
    state->evaluations[lane] = 0;
    state->ray[lane] = next;
    state->active |= 1u << lane;
    return next + 1;
}

typedef struct search_outcome {
    masks hit, miss;
    lane_surface water;
} search_outcome;

/* One evaluation: updates the state and says which lanes are done. */
static inline search_outcome search_step(const reference_frame *frame, search_state *state)
{
    const reals s = load(state->distance);
    const reals dx = load(state->direction_x), dy = load(state->direction_y), dz = load(state->direction_z);
    search_outcome outcome;
    outcome.water =
        waves_at(frame->waves, frame->wave_count, fused(dx, s, load(state->origin_x)), fused(dz, s, load(state->origin_z)), load(state->time_offset));

    const reals f = fused(dy, s, load(state->origin_y)) - outcome.water.height;
    const reals derivative = dy - fused(dx, outcome.water.slope_x, dz * outcome.water.slope_z);
    const reals tolerance = relative_tolerance * (s + least_distance);
    const masks is_above = (masks)(f > 0.0);
    const reals above = select_lanes(is_above, s, load(state->above));
    const reals below = select_lanes(is_above, load(state->below), s);
    const masks bracketed = (masks)(below < HUGE_VAL);
    const masks last = load_mask(state->last);
    const masks evaluations = load_mask(state->evaluations) + 1;

    const reals step = safe_step(f, derivative, dy - load(state->slope_bound), load(state->curvature_bound));
    const reals newton = s - f / derivative;
    const reals middle = 0.5 * (above + below);

    /* Above the water: the safe step, and Newton's for the very last one. */
    const masks nearly = is_above & (masks)(derivative < 0.0) & (masks)(step * step * load(state->curvature_bound) <= tolerance * -derivative);
    /* One root is ahead. Where waves are few the safe step is as fast, and never ends below. */
    const masks single = (frame->level_count > 1 ? is_above : (masks){0}) & (masks)(derivative < 0.0) &
                         (masks)(derivative * derivative > 2.0 * f * load(state->curvature_bound));
    reals next = select_lanes(nearly | single, newton, s + step);
    /* Below it (a bound was exceeded or rounding overshot): Newton's within the bracket, halved now and then. */
    const masks inside = (masks)(newton > above) & (masks)(newton < below) & (masks)((evaluations & 3) != 0);
    next = select_lanes(is_above, next, select_lanes(inside, newton, middle));
    next = select_lanes(bracketed & ~(masks)(next < below), middle, next);

    const masks exhausted = (masks)(evaluations >= most_evaluations);
    outcome.hit = last | (is_above & (masks)(step <= tolerance)) | (bracketed & (masks)(below - above <= tolerance)) |
                  (~is_above & (masks)(-f <= tolerance * absolute(derivative))) | (~is_above & (masks)(s == 0.0)) |
                  (exhausted & (bracketed | (masks)(dy < 0.0)));
    outcome.miss = ~outcome.hit & (exhausted | (is_above & ~bracketed & ((masks)(next > load(state->end)) | ~(masks)(next < far_away))));

    store(state->distance, select_lanes(outcome.hit, s, next));
    store(state->above, above);
    store(state->below, below);
    store_mask(state->last, nearly);
    store_mask(state->evaluations, evaluations);
    return outcome;
}

static void search_rays(const reference_frame *frame, reference_batch *batch, uint32_t count)
{
    search_state state = {0};
    uint32_t next = 0;
    for (int lane = 0; lane < REFERENCE_LANES; lane++)
        next = take_ray(&state, lane, batch, next, count);
    while (state.active) {
        const search_outcome outcome = search_step(frame, &state);
        batch->evaluations += (uint64_t)__builtin_popcount(state.active);
        const uint32_t hits = lane_bits(outcome.hit);
        uint32_t done = (hits | lane_bits(outcome.miss)) & state.active;
        if (!done)
            continue;
        _Alignas(64) double slope_x[REFERENCE_LANES], slope_z[REFERENCE_LANES];
        store(slope_x, outcome.water.slope_x);
        store(slope_z, outcome.water.slope_z);
        for (; done; done &= done - 1) {
            const int lane = __builtin_ctz(done);
            const uint32_t ray = state.ray[lane];
            batch->distance[ray] = hits >> lane & 1 ? state.distance[lane] : HUGE_VAL;
            batch->slope_x[ray] = slope_x[lane];
            batch->slope_z[ray] = slope_z[lane];
            next = take_ray(&state, lane, batch, next, count);
        }
    }
}

void MARCH(const reference_frame *frame, reference_batch *batch, uint32_t count)
{
    for (uint32_t i = count; i % REFERENCE_LANES != 0; i++) { /* whole vectors: repeat the last ray */
        batch->origin_y[i] = batch->origin_y[count - 1];
        batch->direction_x[i] = batch->direction_x[count - 1];
        batch->direction_y[i] = batch->direction_y[count - 1];
        batch->direction_z[i] = batch->direction_z[count - 1];
    }
    for (uint32_t i = 0; i < count; i += REFERENCE_LANES)
        bound_rays(frame, batch, i);
    for (uint32_t i = 0; i < count; i++)
        batch->above[i] = 0;
    if (frame->choppiness != 0) {
        for (uint32_t i = 0; i < count; i++)
            choppy_search(frame, batch, i);
        return;
    }
    if (frame->level_count > 1)
        for (uint32_t i = 0; i < count; i += APPROACH_RAYS)
            approach_rays(frame, batch, i, count - i < APPROACH_RAYS ? count : i + APPROACH_RAYS);
    search_rays(frame, batch, count);
}

void BEND(const reference_frame *frame, reference_batch *batch, uint32_t count)
{
    if (frame->choppiness != 0) {
        for (uint32_t i = 0; i < count; i++)
            choppy_bend(frame, batch, i);
        return;
    }
    for (uint32_t at = 0; at < count; at += REFERENCE_LANES) {
        const reals distance = load(&batch->distance[at]), s = select_lanes((masks)(distance < HUGE_VAL), distance, splat(0));
        const reals x = fused(load(&batch->direction_x[at]), s, load(&batch->origin_x[at]));
        const reals z = fused(load(&batch->direction_z[at]), s, load(&batch->origin_z[at]));
        const lane_hessian h = waves_hessian(frame->waves, frame->wave_count, x, z, load(&batch->time_offset[at]));
        store(&batch->bend_xx[at], h.xx);
        store(&batch->bend_xz[at], h.xz);
        store(&batch->bend_zz[at], h.zz);
    }
}

void TRACE(const reference_frame *frame, reference_batch *batch, uint32_t count)
{
    for (uint32_t i = count; i % REFERENCE_LANES != 0; i++) { /* whole vectors: repeat the last ray */
        batch->pixel_x[i] = batch->pixel_x[count - 1];
        batch->pixel_y[i] = batch->pixel_y[count - 1];
        batch->time_offset[i] = batch->time_offset[count - 1];
    }
    for (uint32_t i = 0; i < count; i += REFERENCE_LANES)
        aim_rays(frame, batch, i);
    MARCH(frame, batch, count);
}
