/* SPDX-License-Identifier: MIT
 * The tiled map of slope moments of methods lean and leadr, made from the waves of an instant. */
#include "cpu/lean_map.h"

#include <stdlib.h>
#include <string.h>

#include "frame/frame.h"
#include "cpu/baseline_lanes.h"
#include "cpu/lean_rows.h"

/* ---- level 0 ---- */

typedef struct map_job {
    lean_map *map;
    const lane_kernels *kernels;
    float *cosines; /* cosines of LEAN_SIZE equal parts of a turn */
    float *columns; /* lean_waves.columns */
    int level;      /* level that the next coarser one is made from */
} map_job;

static void fill_columns(void *argument, size_t block, uint32_t worker)
{
    (void)worker;
    const map_job *job = argument;
    lean_fill_block(&job->map->waves, job->cosines, block, job->columns);
}

static void fill_rows(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const map_job *job = argument;
    const lean_waves *waves = &job->map->waves;
    lean_phase phases[MGT_MAX_WAVES];
    lean_fill_phases(waves, index * LEAN_ROWS, phases);
    const size_t first = index * LEAN_ROWS * LEAN_SIZE;
    job->kernels->baselines->lean_rows(waves, phases, job->map->slope_x + first, job->map->slope_z + first);
}

/* ---- mip levels ---- */

static void shrink_slopes(const map_job *job, size_t row, float *out)
{
    const float *x = job->map->slope_x + 2 * row * LEAN_SIZE, *z = job->map->slope_z + 2 * row * LEAN_SIZE;
    for (size_t column = 0; column < LEAN_SIZE / 2; column++, out += LEAN_MOMENTS) {
        const size_t at[4] = {2 * column, 2 * column + 1, LEAN_SIZE + 2 * column, LEAN_SIZE + 2 * column + 1};
        LeanMoments finer[4];
        for (int i = 0; i < 4; i++)
            finer[i] = point_moments(NULL, vec2(x[at[i]], z[at[i]]));
        const LeanMoments m = coarser_moments(NULL, finer[0], finer[1], finer[2], finer[3]);
        out[0] = m.mean.x, out[1] = m.mean.y, out[2] = m.square.x, out[3] = m.square.y, out[4] = m.square.z;
    }
}

static void shrink_row(void *argument, size_t row, uint32_t worker)
{
    (void)worker;
    const map_job *job = argument;
    const size_t width = LEAN_SIZE >> (job->level + 1), stride = 2 * width * LEAN_MOMENTS;
    float *out = job->map->levels[job->level + 1] + row * width * LEAN_MOMENTS;
    if (job->level == 0) {
        shrink_slopes(job, row, out);
        return;
    }
    const float *in = job->map->levels[job->level] + 2 * row * stride;
    for (size_t column = 0; column < width; column++, in += 2 * LEAN_MOMENTS, out += LEAN_MOMENTS)
        for (int m = 0; m < LEAN_MOMENTS; m++)
            out[m] = coarser_moment(NULL, in[m], in[m + LEAN_MOMENTS], in[m + stride], in[m + LEAN_MOMENTS + stride]);
}

/* ---- the whole ---- */

static bool allocate(lean_map *map)
{
    const size_t texels = (size_t)LEAN_SIZE * LEAN_SIZE;
    if (!map->slope_x)
        map->slope_x = malloc(texels * sizeof *map->slope_x);
    if (!map->slope_z)
        map->slope_z = malloc(texels * sizeof *map->slope_z);
    bool all = map->slope_x && map->slope_z;
    for (int level = 1; level < LEAN_LEVELS; level++) {
        if (!map->levels[level])
            map->levels[level] = malloc((texels >> 2 * level) * LEAN_MOMENTS * sizeof *map->levels[level]);
        all = all && map->levels[level];
    }
    return all;
}

static bool fill(lean_map *map, const lane_kernels *kernels, thread_pool *pool)
{
    map_job job = {.map = map, .kernels = kernels};
    job.cosines = malloc(LEAN_SIZE * sizeof *job.cosines);
    map->waves.columns = job.columns = malloc((map->waves.count + 1) * LEAN_SIZE * 2 * sizeof *job.columns);
    const bool enough = allocate(map) && job.cosines && job.columns;
    if (enough) {
        lean_fill_cosines(job.cosines);
        thread_pool_run(pool, &(thread_loop){.count = LEAN_SIZE / LEAN_BLOCK, .body = fill_columns, .argument = &job});
        thread_pool_run(pool, &(thread_loop){.count = LEAN_SIZE / LEAN_ROWS, .body = fill_rows, .argument = &job});
        for (; job.level < LEAN_LEVELS - 1; job.level++)
            thread_pool_run(pool, &(thread_loop){.count = (size_t)LEAN_SIZE >> (job.level + 1), .body = shrink_row, .argument = &job});
    }
    free(job.cosines);
    free(job.columns);
    map->waves.columns = NULL;
    return enough;
}

bool lean_map_build(lean_map *map, const frame *f, const lane_kernels *kernels, thread_pool *pool)
{
    lean_waves waves;
    map->data = sines_snap(&f->scene->water, frame_meeting(f, &f->close, (interval){f->scene->time, 0}), &waves);
    if (map->filled && memcmp(&waves, &map->waves, sizeof waves) == 0)
        return true;
    map->waves = waves;
    map->filled = fill(map, kernels, pool);
    return map->filled;
}

void lean_map_free(lean_map *map)
{
    if (!map)
        return;
    free(map->slope_x);
    free(map->slope_z);
    for (int level = 1; level < LEAN_LEVELS; level++)
        free(map->levels[level]);
    free(map);
}
