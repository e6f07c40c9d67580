/* SPDX-License-Identifier: MIT
 * The waves of a frame at the instants and over the intervals that its methods ask for. */
#ifndef MANGATA_FRAME_FRAME_WAVES_H
#define MANGATA_FRAME_FRAME_WAVES_H

#include "frame/frame.h"

/* The waves of a frame, shared by its tiles. */
typedef struct frame_waves {
    wave_set samples; /* the instant t, as point samples see it */
    wave_set now;     /* the instant t, filtered */
    wave_set shutter; /* the interval during which the shutter is open, filtered; if the camera moves: the instant t */
    wave_set open;    /* if the camera moves: the instant at which the shutter opens, relative to the camera of that instant; else not set */
    /* If the camera moves: equal parts of that interval, filtered, from the middle of the camera's way in each; else not set. */
    wave_set parts[CAMERA_PARTS];
} frame_waves;

void frame_waves_build(const frame *f, frame_waves *waves);

/* Time of the time sample `m` of method ssaa as a fraction of the shutter, from its opening (0) to its closing (1). */
double shutter_fraction(const mgt_quality *q, uint64_t m);

/* The camera at such a fraction of the shutter. */
camera_rays camera_at(const frame *f, double share);

#endif
