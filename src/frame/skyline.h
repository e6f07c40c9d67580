/* SPDX-License-Identifier: MIT
 * The skyline of the water: how high crests stand above the horizon, for a camera that is lower than the crests. */
#ifndef MANGATA_FRAME_SKYLINE_H
#define MANGATA_FRAME_SKYLINE_H

#include "frame/frame.h"

/* Writes into both of `data` the range of bearings near the horizon that the picture shows with either camera. Returns the number of entries of a skyline of
 * this range; 0: the picture does not show the horizon. */
int skyline_span(const camera_rays *open, const camera_rays *close, uint32_t width, uint32_t height, FrameData *const data[2]);

/* Whether a camera may see a skyline: it is lower than the highest crests, the picture shows the horizon, and the frame's method draws skylines. */
bool skyline_may_stand(const frame *f, const camera_rays *camera);

/* Fills view.skyline, view.skyline_top and the skyline of a set, if its camera is above the surface. The set must hold filtered waves relative to a camera
 * for which skyline_may_stand() is true. */
void skyline_find(const frame *f, wave_set *set);

/* Copies the skyline between sets of the same camera and nearly the same time. */
void skyline_copy(const wave_set *from, wave_set *to);

#endif
