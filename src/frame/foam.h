/* SPDX-License-Identifier: MIT
 * A frame's foam in single precision, relative to a camera. */
#ifndef MANGATA_FRAME_FOAM_H
#define MANGATA_FRAME_FOAM_H

#include <stdbool.h>
#include <stddef.h>

#include "frame/atmosphere.h"
#include "frame/kernel_data.h"
#include "params/foam.h"

/* What is the same for every camera and instant of a frame. */
typedef struct frame_foam {
    bool some; /* false: there is no foam, and the other members are not set */
    foam_sea sea;
    double toward[3], beam[3], sky[3]; /* see the members of FoamData with these names */
} frame_foam;

/* The foam over an interval of time relative to a camera, in the layout of the GPU's storage buffer. */
typedef struct foam_set {
    FoamData data;
    FoamSine sines[2 * FOAM_SINES];
    FoamWave waves[MGT_MAX_WAVES + 1]; /* one more than there are, see FoamData.foam_waves */
} foam_set;

/* Size of a set up to the last of its waves. */
static inline size_t foam_set_bytes(const foam_set *set) { return offsetof(foam_set, waves) + (size_t)(set->data.foam_waves + 1) * sizeof *set->waves; }

/* Fills `foam`. `sky` must have been built from the scene. */
void frame_foam_of(const mgt_scene *scene, const sky_state *sky, frame_foam *foam);

/* Radiance of foam with albedo 1, kcd/m²: `by_sky` of horizontal foam under the sky, `by_light` of foam that faces each light. */
void frame_foam_light(const mgt_scene *scene, const sky_state *sky, double by_sky[3], double by_light[MAX_LIGHTS][3]);

/* Fills `out` relative to the point (x, z) under the camera, metres, for the interval of time [middle − half, middle + half], seconds. `filter` false: point
 * samples, which see all the waves. */
void foam_place(const frame_foam *foam, double x, double z, double middle, double half, bool filter, foam_set *out);

#endif
