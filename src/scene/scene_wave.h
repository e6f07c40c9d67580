/* SPDX-License-Identifier: MIT
 *
 * Single waves of a scene by wavelength, direction and height.
 */
#ifndef MANGATA_SCENE_SCENE_WAVE_H
#define MANGATA_SCENE_SCENE_WAVE_H

#include "params/field.h"

typedef struct measured_wave {
    double wavelength;    /* m */
    double direction_deg; /* where crests travel to; 0 is -z, 90 is +x */
    double height;        /* height from trough to crest, m */
    double shift;         /* phase at x = z = 0 and time 0 */
} measured_wave;

/* The other form of an mgt_wave. It is a wave of deep water. Its numbers are rounded to seven digits, so that they are the same on every machine. */
extern const field_form measured_wave_form;

#endif
