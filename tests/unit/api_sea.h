/* SPDX-License-Identifier: MIT
 *
 * A small sea for tests of the API, and shorthand for rendering it.
 */
#ifndef MANGATA_TESTS_API_SEA_H
#define MANGATA_TESTS_API_SEA_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mangata/mangata.h"

enum { SEA_WAVES = 12, SEA_WIDTH = 83, SEA_HEIGHT = 47 }; /* no multiple of any tile */

typedef struct sea_method {
    mgt_method method;
    mgt_adaptive adaptive;
} sea_method;

static const sea_method sea_methods[] = {{MGT_METHOD_NONE, 0},
                                         {MGT_METHOD_SSAA, 0},
                                         {MGT_METHOD_PODEE_UNIFORM, 0},
                                         {MGT_METHOD_PODEE_PIXEL, 0},
                                         {MGT_METHOD_MANGATA, 0},
                                         {MGT_METHOD_REFERENCE, 0},
                                         {MGT_METHOD_ADAPTIVE, MGT_ADAPTIVE_PODEE},
                                         {MGT_METHOD_ADAPTIVE, MGT_ADAPTIVE_CELLS}};
enum { SEA_METHODS = sizeof sea_methods / sizeof *sea_methods };
static const mgt_method sea_baselines[] = {MGT_METHOD_MSAA32, MGT_METHOD_LEAN, MGT_METHOD_LEADR, MGT_METHOD_TOKUYOSHI,  MGT_METHOD_BRUNETON,
                                           MGT_METHOD_FXAA,   MGT_METHOD_TAA,  MGT_METHOD_TNDF,  MGT_METHOD_GGX_MOMENTS};
enum { SEA_BASELINES = sizeof sea_baselines / sizeof *sea_baselines };

/* Twelve waves from 20 m to 10 cm under a large sun: glitter in most pixels of its road. */
static inline mgt_scene sea_scene(mgt_wave waves[SEA_WAVES])
{
    for (int i = 0; i < SEA_WAVES; i++) {
        const double k = 0.3 * pow(200, i / (SEA_WAVES - 1.0)), direction = 2.4 * i;
        waves[i] = (mgt_wave){0.04 / k, k * cos(direction), k * sin(direction), -sqrt(9.81 * k), 1.7 * i};
    }
    mgt_scene s;
    mgt_scene_init(&s, sizeof s);
    s.image = (mgt_image){.width = SEA_WIDTH, .height = SEA_HEIGHT};
    s.time = 3;
    s.light.elevation_deg = 15;
    s.light.angular_radius_deg = 2;
    s.sky.model = MGT_SKY_GRADIENT;
    s.water.waves = waves;
    s.water.wave_count = SEA_WAVES;
    s.quality.spatial_samples = 2;
    s.quality.time_samples = 2;
    return s;
}

static inline void sea_take_method(mgt_scene *scene, int m)
{
    scene->quality.method = sea_methods[m].method;
    scene->quality.adaptive = sea_methods[m].adaptive;
}

static inline mgt_context *sea_context(uint32_t threads, mgt_isa isa)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = threads;
    desc.isa = isa;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    assert_non_null(context);
    return context;
}

static inline mgt_target sea_target(mgt_layer layer, mgt_format format, void *pixels, ptrdiff_t row_stride)
{
    mgt_target t;
    mgt_target_init(&t, sizeof t);
    t.layer = layer;
    t.format = format;
    t.pixels = pixels;
    t.row_stride = row_stride;
    return t;
}

static inline void sea_render(mgt_context *context, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    const mgt_status status = mgt_render(context, scene, targets, count);
    if (status != MGT_OK)
        fail_msg("mgt_render: %s: %s", mgt_status_text(status), mgt_last_error(context));
}

#endif
