/* SPDX-License-Identifier: MIT
 * Frames by OpenGL, timed. */
#include "gl_frame.h"

#include <stdio.h>
#include <string.h>

#include "timing.h"

bool frame_render(mgt_context *context, const mgt_scene *scene, float *pixels)
{
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.format = MGT_FORMAT_RGB32F;
    target.pixels = pixels;
    if (mgt_render(context, scene, &target, 1) == MGT_OK)
        return true;
    fprintf(stderr, "bench: %s\n", mgt_last_error(context));
    return false;
}

double gl_frame_seconds(const gl_frame *f, const mgt_scene *scene, mgt_gl_timing *passes, size_t *pass_count)
{
    mgt_gl_timing timings[GL_FRAME_PASSES];
    if (f->software && !passes) {
        const double begin = seconds_now();
        return frame_render(f->gl, scene, f->pixels) ? seconds_now() - begin : -1;
    }
    for (int i = 0; i < 3; i++)
        if (!frame_render(f->gl, scene, f->pixels))
            return -1;
    const size_t count = mgt_gl_get_timings(f->gl, timings, GL_FRAME_PASSES);
    double sum = 0;
    for (size_t i = 0; i < count && i < GL_FRAME_PASSES; i++)
        sum += timings[i].seconds;
    if (passes) {
        memcpy(passes, timings, sizeof timings);
        *pass_count = count < GL_FRAME_PASSES ? count : GL_FRAME_PASSES;
    }
    return sum;
}
