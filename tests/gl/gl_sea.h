/* SPDX-License-Identifier: MIT
 * The small sea with OpenGL: its context, and all that is rendered of a scene. */
#ifndef MANGATA_TESTS_GL_SEA_H
#define MANGATA_TESTS_GL_SEA_H

#include "gl_host.h"
#include "unit/api_sea.h"

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT };

static inline mgt_context *gl_context(void) { return gl_context_of(NULL); }

typedef struct layers {
    float color[PIXELS * 3], color4[PIXELS * 4], coverage[PIXELS], mask[PIXELS], depth[PIXELS], normal[PIXELS * 3], normal4[PIXELS * 4];
    float refraction[PIXELS * 3], error[PIXELS];
    unsigned char shown[PIXELS * 4];
} layers;

/* Refraction where there are objects and the camera rests: those layers of a moving camera would have the CPU render all. NaN where nothing is rendered. */
static inline void render_all(mgt_context *context, const mgt_scene *scene, layers *out)
{
    const mgt_target targets[] = {
        sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, out->color, 0),
        sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA32F, out->color4, 0),
        sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, out->shown, 0),
        sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, out->coverage, 0),
        sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, out->mask, 0),
        sea_target(MGT_LAYER_DEPTH, MGT_FORMAT_R32F, out->depth, 0),
        sea_target(MGT_LAYER_NORMAL, MGT_FORMAT_RGB32F, out->normal, 0),
        sea_target(MGT_LAYER_NORMAL, MGT_FORMAT_RGBA32F, out->normal4, 0),
        sea_target(MGT_LAYER_REFRACTION, MGT_FORMAT_RGB32F, out->refraction, 0),
        sea_target(MGT_LAYER_REFRACTION_ERROR, MGT_FORMAT_R32F, out->error, 0),
    };
    const bool refracts = scene->object_count > 0 && !scene->camera_moves;
    memset(out, 0xff, sizeof *out);
    sea_render(context, scene, targets, sizeof targets / sizeof *targets - (refracts ? 0 : 2));
}

/* Values that differ by more than `limit`, relative to values over 1. */
static inline size_t count_off(const float *a, const float *b, size_t count, double limit)
{
    size_t off = 0;
    for (size_t i = 0; i < count; i++) {
        const double x = (double)a[i], y = (double)b[i];
        off += x != y && !(fabs(x - y) <= limit * fmax(1, fabs(y)));
    }
    return off;
}

/* One of 200 values may be off. */
static inline void expect_same(const char *what, const float *a, const float *b, size_t count, double limit)
{
    const size_t off = count_off(a, b, count, limit);
    if (off > count / 200)
        fail_msg("%s: %zu of %zu values differ", what, off, count);
}

#endif
