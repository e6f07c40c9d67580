/* SPDX-License-Identifier: MIT
 * The lights of a frame. */
#ifndef MANGATA_FRAME_LIGHTS_H
#define MANGATA_FRAME_LIGHTS_H

#include "frame/atmosphere.h"
#include "frame/kernel_data.h"

/* Fills the frame's array; `under`: mirrored at the mean surface. */
void lights_place(const sky_state *sky, const mgt_light *light, bool under, FrameData *frame);

#endif
