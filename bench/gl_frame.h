/* SPDX-License-Identifier: MIT
 * Frames by OpenGL, timed. */
#ifndef MANGATA_BENCH_GL_FRAME_H
#define MANGATA_BENCH_GL_FRAME_H

#include "mangata/gl.h"

enum { GL_FRAME_PASSES = 16 };

typedef struct gl_frame {
    mgt_context *gl;
    bool software;
    float *pixels; /* room for the largest frame, three floats a pixel */
} gl_frame;

/* Says on stderr what is wrong. */
bool frame_render(mgt_context *context, const mgt_scene *scene, float *pixels);

/* GPU seconds of the passes of a frame, without reading back; negative where it fails. `passes`, room for GL_FRAME_PASSES, may be NULL. A frame's timers
 * are read when one of the next two begins. Software takes too long to render so often: there a frame's wall time serves where the passes are not asked
 * for. */
double gl_frame_seconds(const gl_frame *f, const mgt_scene *scene, mgt_gl_timing *passes, size_t *pass_count);

#endif
