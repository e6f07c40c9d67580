/* SPDX-License-Identifier: MIT
 * Waves by length, direction and speed instead of the scene format's a, b and c. */
#ifndef MANGATA_VIEWER_SCENE_WAVE_SHAPE_H
#define MANGATA_VIEWER_SCENE_WAVE_SHAPE_H

#include "scene/scene_fields.h"

typedef struct wave_shape {
    double wavelength;    /* metres from crest to crest */
    double direction_deg; /* where crests travel to: 0 is -z, 90 is +x; -180 to 180 */
    double speed;         /* metres a second that crests travel, along the direction */
} wave_shape;

/* The shape of a wave. A wave without a wave vector has the greatest allowed length. */
wave_shape wave_shape_of(const mgt_wave *wave);
void wave_set_shape(mgt_wave *wave, const wave_shape *shape);

/* The fields of a wave_shape, ended by one without a key. */
extern const field_row wave_shape_fields[];

/* A wave of deep water at its natural speed, a little unlike the ones before it. */
mgt_wave wave_new(size_t index);

#endif
