/* SPDX-License-Identifier: MIT
 * How long the last frames took. */
#ifndef MANGATA_VIEWER_PICTURE_TIMINGS_H
#define MANGATA_VIEWER_PICTURE_TIMINGS_H

#include "mangata/gl.h"

enum { TIMING_FRAMES = 120, PASS_COUNT = 12 };

/* The last times, milliseconds; a ring. */
typedef struct timing_ring {
    float ms[TIMING_FRAMES];
    int next, count;
} timing_ring;

void timing_add(timing_ring *ring, double seconds);

/* The i-th of ring->count, the oldest first. */
float timing_at(const timing_ring *ring, int i);

/* 0 when there is none. */
float timing_median(const timing_ring *ring);

typedef struct timings {
    timing_ring window; /* from frame to frame of the window */
    timing_ring render; /* of rendering alone */
    mgt_gl_timing passes[PASS_COUNT];
    size_t pass_count;
    double last_frame; /* seconds_now() */
} timings;

#endif
