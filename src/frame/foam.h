/* SPDX-License-Identifier: MIT
 * A frame's foam in single precision, as a camera meets it. */
#ifndef MANGATA_FRAME_FOAM_H
#define MANGATA_FRAME_FOAM_H

#include <stdbool.h>
#include <stddef.h>

#include "frame/atmosphere.h"
#include "frame/kernel_data.h"
#include "params/foam.h"

/* What is the same for every camera and instant of a frame. */
typedef struct frame_foam {
    bool some; /* false: there is no foam, and nothing else counts */
    foam_sea sea;
    double toward[3], beam[3], sky[3]; /* see FoamData */
} frame_foam;

/* The foam of an interval of time before a camera, as a storage buffer has it. */
typedef struct foam_set {
    FoamData data;
    FoamSine sines[2 * FOAM_SINES];
    FoamWave waves[MGT_MAX_WAVES];
} foam_set;

/* Up to its last wave. */
static inline size_t foam_set_bytes(const foam_set *set) { return offsetof(foam_set, waves) + (size_t)set->data.foam_waves * sizeof *set->waves; }

void frame_foam_of(const mgt_scene *scene, const sky_state *sky, frame_foam *foam);

/* Radiance of white foam, kcd/m²: by the sky, and by each light facing it. */
void frame_foam_light(const mgt_scene *scene, const sky_state *sky, double by_sky[3], double by_light[MAX_LIGHTS][3]);

/* Horizontal position under the camera, and an interval of time by its middle and half. `filter` false: point samples. */
void foam_place(const frame_foam *foam, double x, double z, double middle, double half, bool filter, foam_set *out);

#endif
