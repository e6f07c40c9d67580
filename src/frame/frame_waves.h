/* SPDX-License-Identifier: MIT
 * The waves of a frame at the instants and over the intervals that its methods ask for. */
#ifndef MANGATA_FRAME_FRAME_WAVES_H
#define MANGATA_FRAME_FRAME_WAVES_H

#include "frame/frame.h"

/* The waves of a frame, shared by its tiles. */
typedef struct frame_waves {
    wave_set samples; /* the instant t, as point samples see it */
    wave_set now;     /* the instant t, filtered */
    wave_set shutter; /* over the shutter; where the camera moves, the instant t */
    wave_set open;    /* where the camera moves: the instant the shutter opens, from the camera's place of that time */
} frame_waves;

void frame_waves_build(const frame *f, frame_waves *waves);

/* Where in the shutter, from its opening (0) to its closing (1), ssaa's time sample `m` lies, and the camera there. */
double shutter_fraction(const mgt_quality *q, uint64_t m);
camera_rays camera_at(const frame *f, double share);

#endif
