/* SPDX-License-Identifier: MIT
 * Where a camera's rays meet the waves, a ball and a pole: from the wave sum itself, in double, without any of the library.
 */
#ifndef MANGATA_TESTS_HOST_GEOMETRY_H
#define MANGATA_TESTS_HOST_GEOMETRY_H

#include "mangata/mangata.h"

typedef struct geometry {
    double view[16], projection[16]; /* column-major; a rotation and a translation, a perspective */
    uint32_t width, height;
    const mgt_wave *waves;
    size_t wave_count;
    double time;
    double ball[4]; /* centre and radius */
    double pole[5]; /* centre, radius and height */
} geometry;

/* Metres in front of the camera, along its axis; +infinity where the ray through the pixel's centre does not meet it. Row 0 is the lowest. */
typedef struct geometry_depths {
    double water, ball, pole;
} geometry_depths;

geometry_depths geometry_at(const geometry *g, uint32_t x, uint32_t y);

#endif
