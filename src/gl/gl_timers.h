/* SPDX-License-Identifier: MIT
 * GPU times of passes by timestamps. They are read a few frames later, so that the CPU never waits for them. */
#ifndef MANGATA_GL_GL_TIMERS_H
#define MANGATA_GL_GL_TIMERS_H

#include "gl/gl_api.h"
#include "mangata/gl.h"

enum { TIMER_FRAMES = 4, TIMER_INTERVALS = 48, TIMER_NAMES = 16 };

/* The intervals of one frame; more than TIMER_INTERVALS of them are not timed. */
typedef struct timer_frame {
    GLuint queries[2 * TIMER_INTERVALS];
    const char *names[TIMER_INTERVALS];
    int count;
} timer_frame;

typedef struct gl_timers {
    timer_frame frames[TIMER_FRAMES];
    int current; /* frame that is being timed; −1: none, because the GPU is behind */
    int next;
    mgt_gl_timing timings[TIMER_NAMES];
    size_t count;
} gl_timers;

void gl_timers_create(const gl_api *gl, gl_timers *t);
void gl_timers_free(const gl_api *gl, gl_timers *t);

/* gl_timers_frame() begins a frame and reads the timestamps of earlier ones. gl_timers_begin() and gl_timers_end() enclose a pass. `name` must outlive the
 * timers. */
void gl_timers_frame(const gl_api *gl, gl_timers *t);
void gl_timers_begin(const gl_api *gl, gl_timers *t, const char *name);
void gl_timers_end(const gl_api *gl, gl_timers *t);

#endif
