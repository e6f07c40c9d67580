/* SPDX-License-Identifier: MIT
 * The kernels of src/cpu/lanes.c rebuilt so that a frame's calls of the disk-path integral are kept, and stages can be timed.
 * Compiled once per lane width, with lane_kernels_N renamed. */
#include "cpu/kernel_context.h"
#include "frame_cases.h"

#include <math.h>

#include "frame/atmosphere.h"

#define CASES_NAME_(n) frame_cases_##n
#define CASES_NAME(n) CASES_NAME_(n)

static disk_path_cases *kept;
static size_t evaluations;
#define TALLY(live) ((void)evaluations++)

#include "kernels/common/prelude_c.h"

#include "kernels/common/disk_path.k"

static real keeping_disk_path(CTX cx, vec2 p0, vec2 p1, Symmetric covariance, real radius)
{
    const size_t before = evaluations;
    const real share = gaussian_disk_path(cx, p0, p1, covariance, radius);
    disk_path_cases *k = kept;
    if (!k)
        return share;
    k->calls++;
    k->evaluations += evaluations - before;
    if (evaluations == before)
        return share;
    k->in_reach++;
    if (k->count < k->capacity) {
        const real values[DISK_PATH_INPUTS] = {p0.x, p0.y, p1.x, p1.y, covariance.xx, covariance.xz, covariance.zz, radius};
        __builtin_memcpy(k->values + k->count++ * DISK_PATH_INPUTS * MGT_LANES, values, sizeof values);
    }
    return share;
}

#define gaussian_disk_path(...) keeping_disk_path(__VA_ARGS__)
#include "cpu/lanes.c"
#undef gaussian_disk_path

static void keep(disk_path_cases *cases) { kept = cases; }

static float replay(const disk_path_cases *cases, size_t first, size_t count)
{
    const struct kernel_context context = {.frame = NULL};
    real sum = real(0.0f);
    for (size_t i = first; i < first + count; i++) {
        const float *v = cases->values + i * DISK_PATH_INPUTS * MGT_LANES;
        real in[DISK_PATH_INPUTS];
        __builtin_memcpy(in, v, sizeof in);
        sum = sum + gaussian_disk_path(&context, (vec2){in[0], in[1]}, (vec2){in[2], in[3]}, (Symmetric){in[4], in[5], in[6]}, in[7]);
    }
    float lanes[MGT_LANES];
    __builtin_memcpy(lanes, &sum, sizeof lanes);
    return lanes[0];
}

static void run_rows(frame_stage stage, const struct kernel_context *cx, int first, const tile_estimate *estimate, tile_pixels *out)
{
    const struct kernel_context context = *cx;
    row_grid grid;
    tile_looks looks = {.places = rows_from(first, &grid)};
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES)
        store(out->water + i, pixel_rays(&context, &looks.places, i).water);
    look_at_tile(&context, estimate, out->water, &looks);
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const PixelRay p = pixel_rays(&context, &looks.places, i);
        if (!any_lane(p.water > real(0.0f)))
            continue;
        const SlopeState state = looked_slopes(&context, &looks, i, p.ray);
        /* All of the state has to come out, else compilers leave out sums. */
        store(out->red + i, state.open.x + state.open.y + state.variance_xx + state.variance_xz + state.variance_zz);
        store(out->green + i, state.close.x + state.close.y + state.bend_xx + state.bend_xz + state.bend_zz);
        store(out->blue + i, state.octave + state.octave_sq + state.mirror.j.ex + state.mirror.j.ez + state.mirror.j.fx + state.mirror.j.fz);
        if (stage == STAGE_COVERAGE)
            store(out->coverage + i, glitter_coverage(&context, state));
    }
}

static void run_stage(frame_stage stage, const FrameData *frame, const float *sky, const tile_waves *tile, const tile_estimate *estimate, tile_pixels *out)
{
    const struct kernel_context context = {.frame = frame, .tile = &tile->data, .waves = tile->waves, .search = tile->search, .sky = sky};
    for (int part = 0; part < (int)tile->data.hit_rows; part++)
        run_rows(stage, &context, part * TILE_HEIGHT, estimate + part, out);
}

const frame_cases_kernels CASES_NAME(MGT_LANES) = {&LANES_NAME(MGT_LANES), keep, replay, run_stage};
