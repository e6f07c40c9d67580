/* SPDX-License-Identifier: MIT
 *
 * The kernels at one lane inside a test, with the tiles and waves that the CPU backend prepares for them. Include it once, before
 * any other header; afterwards sqrt, abs, … mean those of <math.h> again.
 */
#ifndef MANGATA_TESTS_KERNEL_LANE_H
#define MANGATA_TESTS_KERNEL_LANE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/kernel_context.h"
#include "frame/frame.h"
#include "cpu/lean_map.h"
#include "frame/atmosphere.h"
#include "reference/equations.h"
#include "reference/light.h"
#include "unit/random_numbers.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* the dialect hands cx to every function */
#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#define FRAME(cx) (*(cx)->frame)
#define TILE(cx) (*(cx)->tile)
#define CHOPPY(cx) (TILE(cx).pressed > 0.0f ? 1 : 0)
#define PARTS(cx) TILE(cx).parts
#define FOAMY(cx) ((cx)->foam != NULL)
#define FOAM(cx) (*(cx)->foam)
#define FOAM_WAVE(cx, i) ((cx)->foam_waves[i])
#define FOAM_SINE(cx, i) ((cx)->foam_sines[i])
#define WAVE(cx, i) ((cx)->waves[i])
#define SEARCH_WAVE(cx, i) ((cx)->search[i])
#define UPWELLING(cx) vec3(FRAME(cx).body_r, FRAME(cx).body_g, FRAME(cx).body_b)
#define MIRRORS_OBJECTS(cx) 0
#define OBJECTS_COVERAGE(cx) 0.0f
#define OBJECTS_COLOR(cx) vec3(0.0f, 0.0f, 0.0f)
#define CLEAR_TO_LIGHT(cx) vec3(1.0f, 1.0f, 1.0f)
#define DEEP_WATER(cx) vec3(0.0f, 0.0f, 0.0f)
#define SKYLINE(cx, i) vec2(0.0f, 0.0f)
#define FRONT_COVERAGE(cx) 0.0f

KERNEL vec3 SKY_TEXEL(CTX cx, real column, real row)
{
    const float *t = cx->sky + ((size_t)row * SKY_COLUMNS + (size_t)column) * 3;
    return vec3(t[0], t[1], t[2]);
}

KERNEL real SWEEP_TEXEL(CTX cx, real v, real u, real slice) { return cx->podee->sweep[((size_t)slice * PODEE_ROWS + (size_t)u) * PODEE_COLUMNS + (size_t)v]; }

KERNEL real FRACTION_TEXEL(CTX cx, real r, real slice) { return cx->podee->share[(size_t)slice * PODEE_COLUMNS + (size_t)r]; }

#define LEAN(cx) ((cx)->lean->data)

KERNEL vec2 LEAN_MEAN(CTX cx, real level, real column, real row)
{
    const lean_map *m = cx->lean;
    const size_t at = ((size_t)row * LEAN_SIZE >> (int)level) + (size_t)column;
    const float *t = level > 0 ? m->levels[(int)level] + LEAN_MOMENTS * at : NULL;
    return t ? vec2(t[0], t[1]) : vec2(m->slope_x[at], m->slope_z[at]);
}

KERNEL vec3 LEAN_SQUARE(CTX cx, real level, real column, real row)
{
    const size_t at = ((size_t)row * LEAN_SIZE >> (int)level) + (size_t)column;
    const vec2 s = LEAN_MEAN(cx, level, column, row);
    const float *t = level > 0 ? cx->lean->levels[(int)level] + LEAN_MOMENTS * at : NULL;
    return t ? vec3(t[2], t[3], t[4]) : vec3(s.x * s.x, s.x * s.y, s.y * s.y);
}

#define light_direction kernel_light_direction /* the oracle has one of its own */
#include "kernels/glitter/glitter.k"
#include "kernels/baselines/podee.k"
#include "kernels/baselines/podee_mixture.k"
#include "kernels/baselines/bruneton.k"
#include "kernels/baselines/ggx_moments.k"
#include "kernels/baselines/leadr.k"
#include "kernels/baselines/msaa.k"
#include "kernels/glitter/sample.k"
#include "kernels/adaptive/cells.k"
#include "kernels/adaptive/slots.k"
#include "kernels/adaptive/temporal_ray.k"
#include "kernels/baselines/tndf.k"
#include "kernels/baselines/tokuyoshi.k"
#undef light_direction

#include "unit/kernel_words_off.h"

/* ---- statistics of errors ---- */

static inline int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts the values. */
static inline double quantile(double *values, size_t count, double share)
{
    qsort(values, count, sizeof *values, compare_doubles);
    return values[(size_t)(share * (double)(count - 1))];
}

/* Prints a measured error beside its bound, and holds it. */
static inline void expect_below(const char *what, double measured, double bound)
{
    print_message("  %-58s %.3g (≤ %.3g)\n", what, measured, bound);
    if (!(measured <= bound))
        fail_msg("%s: %g is above %g", what, measured, bound);
}

/* ---- a tile as the backend prepares it ---- */

typedef struct kernel_bench {
    sky_state *sky;
    mgt_scene scene;
    frame frame;
    wave_set set;
    tile_waves tile;
    struct kernel_context cx;
} kernel_bench;

/* The scene's waves must outlive the bench. */
static inline kernel_bench *kernel_bench_create(const mgt_scene *scene)
{
    kernel_bench *b = calloc(1, sizeof *b);
    assert_non_null(b);
    b->sky = sky_state_create();
    assert_non_null(b->sky);
    b->scene = *scene;
    assert_int_equal(sky_state_build(b->sky, &b->scene.sky, &b->scene.light), MGT_OK);
    frame_make(&b->scene, b->sky, false, &b->frame);
    b->cx = (struct kernel_context){.frame = &b->frame.data,
                                    .tile = &b->tile.data,
                                    .waves = b->tile.waves,
                                    .search = b->tile.search,
                                    .sky = b->sky->table,
                                    .view = &b->set.view};
    return b;
}

static inline void kernel_bench_destroy(kernel_bench *b)
{
    sky_state_destroy(b->sky);
    free(b);
}

/* Builds the tile that holds a pixel, for the whole shutter or for scene->time alone; `filter` sorts its waves. */
static inline void kernel_bench_tile(kernel_bench *b, bool shutter, bool filter, uint32_t x, uint32_t y)
{
    const double half = shutter ? b->scene.shutter / 2 : 0;
    wave_set_build(&b->frame, &b->frame.close, (interval){b->scene.time - half, half}, filter, &b->set);
    memset(&b->tile, 0, sizeof b->tile);
    lane_kernels_1.sort(&b->frame.data, &b->set, &b->set.view, x / TILE_WIDTH, y / TILE_HEIGHT, &b->tile);
}

/* The ray through the pixel's centre, in the tile built last. */
static inline vec3 kernel_bench_ray(const kernel_bench *b, uint32_t x, uint32_t y)
{
    return pixel_ray_at(&b->cx, (float)(x % TILE_WIDTH), (float)(y % TILE_HEIGHT));
}

/* A scene of random waves: wavelengths log-uniform, slopes shared alike, c by deep-water dispersion. */
static inline void random_waves(random_state *r, mgt_wave *waves, size_t count, double shortest, double longest, double slope_rms)
{
    for (size_t i = 0; i < count; i++) {
        const double length = shortest * pow(longest / shortest, random_unit(r)), k = 2 * 3.14159265358979323846 / length;
        const double direction = random_range(r, -3.2, 3.2);
        waves[i] = (mgt_wave){.amplitude = slope_rms * sqrt(2.0 / (double)count) / k,
                              .kx = k * cos(direction),
                              .kz = k * sin(direction),
                              .omega = -sqrt(9.81 * k),
                              .phase = random_range(r, 0, 6.3)};
    }
}

static inline mgt_scene black_scene(uint32_t width, uint32_t height, const mgt_wave *waves, size_t count)
{
    mgt_scene s;
    mgt_scene_init(&s, sizeof s);
    s.image = (mgt_image){.width = width, .height = height};
    s.sky.model = MGT_SKY_BLACK;
    s.time = 10;
    s.water.waves = waves;
    s.water.wave_count = count;
    return s;
}

/* A unit vector by elevation and azimuth in degrees; azimuth 0 is −z. */
static inline void direction_of(double elevation, double azimuth, double direction[3])
{
    const mgt_light light = {.elevation_deg = elevation, .azimuth_deg = azimuth};
    light_direction(&light, direction);
}

#endif
