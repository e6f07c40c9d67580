/* SPDX-License-Identifier: MIT
 * GPU times of passes by timestamps. They are read a few frames later, so that the CPU never waits for them. */
#include "gl/gl_timers.h"

#include <string.h>

void gl_timers_create(const gl_api *gl, gl_timers *t)
{
    *t = (gl_timers){.current = -1};
    for (int i = 0; i < TIMER_FRAMES; i++)
        gl->CreateQueries(GL_TIMESTAMP, 2 * TIMER_INTERVALS, t->frames[i].queries);
}

void gl_timers_free(const gl_api *gl, gl_timers *t)
{
    for (int i = 0; i < TIMER_FRAMES; i++)
        if (t->frames[i].queries[0])
            gl->DeleteQueries(2 * TIMER_INTERVALS, t->frames[i].queries);
}

/* Adds the time of a pass to that of earlier passes of the same name. Names beyond TIMER_NAMES are dropped. */
static void add_timing(gl_timers *t, const char *name, double seconds)
{
    size_t i = 0;
    while (i < t->count && strcmp(t->timings[i].name, name) != 0)
        i++;
    if (i == TIMER_NAMES)
        return;
    if (i == t->count)
        t->timings[t->count++] = (mgt_gl_timing){name, 0};
    t->timings[i].seconds += seconds;
}

/* Reads the timestamps of a frame. False: the GPU has not written them all. */
static bool collect(const gl_api *gl, gl_timers *t, timer_frame *f)
{
    if (f->count == 0)
        return true;
    GLuint available = 0;
    gl->GetQueryObjectuiv(f->queries[2 * f->count - 1], GL_QUERY_RESULT_AVAILABLE, &available);
    if (!available)
        return false;
    t->count = 0;
    for (int i = 0; i < f->count; i++) {
        GLuint64 begin = 0, end = 0;
        gl->GetQueryObjectui64v(f->queries[2 * i], GL_QUERY_RESULT, &begin);
        gl->GetQueryObjectui64v(f->queries[2 * i + 1], GL_QUERY_RESULT, &end);
        add_timing(t, f->names[i], 1e-9 * (double)(end - begin));
    }
    f->count = 0;
    return true;
}

void gl_timers_frame(const gl_api *gl, gl_timers *t)
{
    for (int i = 0; i < TIMER_FRAMES; i++)
        if (!collect(gl, t, &t->frames[(t->next + i) % TIMER_FRAMES])) /* oldest first */
            break;
    t->current = t->frames[t->next].count == 0 ? t->next : -1;
    if (t->current >= 0)
        t->next = (t->next + 1) % TIMER_FRAMES;
}

void gl_timers_begin(const gl_api *gl, gl_timers *t, const char *name)
{
    timer_frame *f = t->current >= 0 ? &t->frames[t->current] : NULL;
    if (!f || f->count == TIMER_INTERVALS)
        return;
    f->names[f->count] = name;
    gl->QueryCounter(f->queries[2 * f->count], GL_TIMESTAMP);
}

void gl_timers_end(const gl_api *gl, gl_timers *t)
{
    timer_frame *f = t->current >= 0 ? &t->frames[t->current] : NULL;
    if (f && f->count < TIMER_INTERVALS)
        gl->QueryCounter(f->queries[2 * f->count++ + 1], GL_TIMESTAMP);
}
