/* SPDX-License-Identifier: MIT
 * The skyline of the water: how high crests stand above the horizon, where the camera is lower than they are. */
#ifndef MANGATA_FRAME_SKYLINE_H
#define MANGATA_FRAME_SKYLINE_H

#include "frame/frame.h"

/* Which bearings the picture shows near the horizon with either camera, into both of `data`. Returns how many entries a skyline of them has; 0: the
 * horizon is not shown. */
int skyline_span(const camera_rays *open, const camera_rays *close, uint32_t width, uint32_t height, FrameData *const data[2]);

/* Whether a camera is lower than the highest crests, and the picture shows the horizon by a method that draws these. */
bool skyline_may_stand(const frame *f, const camera_rays *camera);

/* Fills view.skyline, view.skyline_top and the skyline of a set of filtered waves that has been placed before such a camera. A camera within a wave sees
 * none. */
void skyline_find(const frame *f, wave_set *set);

/* Gives a set the skyline of another one of nearly the same time and camera. */
void skyline_copy(const wave_set *from, wave_set *to);

#endif
