/* SPDX-License-Identifier: MIT
 * Displayed colours of packed pixels, in lanes; for the files that are compiled once per lane width. */
#ifndef MANGATA_CPU_LANE_DISPLAY_H
#define MANGATA_CPU_LANE_DISPLAY_H

#include "kernels/display/tone.k"

/* Displayed colours of the first `count` pixels, at most MGT_LANES, of 3 floats each. Other lanes show black. */
static inline vec3 displayed_lanes(const struct kernel_context *cx, const float *rgb, size_t count)
{
    float channel[3][MGT_LANES] = {{0}};
    for (size_t lane = 0; lane < count && lane < MGT_LANES; lane++)
        for (int c = 0; c < 3; c++)
            channel[c][lane] = rgb[3 * lane + (size_t)c];
    return display_color(cx, vec3(load(channel[0]), load(channel[1]), load(channel[2])), cx->frame->tone_map);
}

#endif
