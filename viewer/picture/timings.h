/* SPDX-License-Identifier: MIT
 * Durations of the last frames. */
#ifndef MANGATA_VIEWER_PICTURE_TIMINGS_H
#define MANGATA_VIEWER_PICTURE_TIMINGS_H

#include "mangata/gl.h"

enum { TIMING_FRAMES = 120, PASS_COUNT = 12 };

/* A ring of the last durations, in milliseconds. */
typedef struct timing_ring {
    float ms[TIMING_FRAMES];
    int next, count;
} timing_ring;

void timing_add(timing_ring *ring, double seconds);

/* Duration number i of ring->count, milliseconds; number 0 is the oldest. */
float timing_at(const timing_ring *ring, int i);

/* The median, milliseconds; 0 if the ring is empty. */
float timing_median(const timing_ring *ring);

typedef struct timings {
    timing_ring window; /* from frame to frame of the window */
    timing_ring render; /* of rendering alone */
    mgt_gl_timing passes[PASS_COUNT];
    size_t pass_count;
    double last_frame; /* seconds_now() */
} timings;

#endif
