/* SPDX-License-Identifier: MIT
 *
 * Single waves of a scene as people measure them: by wavelength, direction and height.
 */
#ifndef MANGATA_SCENE_SCENE_WAVE_H
#define MANGATA_SCENE_SCENE_WAVE_H

#include "params/field.h"

typedef struct measured_wave {
    double wavelength;    /* m */
    double direction_deg; /* where crests travel to: 0 is -z, 90 is +x */
    double height;        /* m, from trough to crest */
    double shift;         /* phase at x = z = 0, time 0 */
} measured_wave;

/* The other form of an mgt_wave: one of deep water, with numbers of seven digits so that it is the same on every machine. */
extern const field_form measured_wave_form;

#endif
