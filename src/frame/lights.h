/* SPDX-License-Identifier: MIT
 *
 * The lights of a frame: disks at infinity, and what of them comes through the air. Only lights.c looks inside the structs.
 */
#ifndef MANGATA_FRAME_LIGHTS_H
#define MANGATA_FRAME_LIGHTS_H

#include <stdbool.h>

#include "frame/kernel_data.h"
#include "mangata/mangata.h"

struct scattering;
struct spectrum_weights;

enum { MAX_LIGHTS = sizeof((FrameData){0}.lights) / sizeof(LightData) };

/* Radiance in kcd/m², irradiance in klx (kcd·sr/m²), linear sRGB. */
typedef struct light_state {
    mgt_light light; /* what it was made from */

    double direction[3]; /* unit, to the light's centre */
    double azimuth[2];   /* x, z of the unit horizontal direction to the light; (0, −1) when it stands in the zenith */
    double tan_radius;   /* tangent of the light's angular radius */
    double limb;         /* u of the limb darkening I(μ)/I(1) = 1 − u·(1 − μ), μ² = 1 − (angle/radius)²: sun 0.6, moon 0 */

    /* Mean radiance of the whole disk as seen from the water: what lies below the horizon counts as zero, so this fades to 0
     * while the light sets. The part still above has light_radiance / light_visible. */
    double light_radiance[3];
    double light_visible;       /* share of the disk's light-weighted area above the horizon, [0, 1] */
    double light_solid_angle;   /* sr, of the whole disk */
    double irradiance_light[3]; /* on the horizontal, from the disk */
} light_state;

typedef struct light_set {
    int count;
    light_state of[MAX_LIGHTS]; /* the sky lies around the first */
} light_set;

/* ---- from a scene ---- */

/* Sine of a light's angular radius. */
double light_radius_sine(const mgt_light *light);

/* Places the lights; what comes through the air stays open. */
void lights_set(light_set *set, const mgt_light *lights, int count);

/* Whether the set was made from these. Never true for a zeroed set. */
bool lights_same(const light_set *set, const mgt_light *lights, int count);

/* What of the light comes through the air. */
void light_through_air(light_state *state, const struct scattering *air, const struct spectrum_weights *weights);

/* Without air: all of it until the light's centre meets the horizon. */
void light_without_air(light_state *state);

/* ---- what the rest of a frame asks ---- */

/* A unit vector, and x, z of a horizontal one, (0, −1) for a light in the zenith. */
const double *light_toward(const light_state *state);
const double *light_azimuth(const light_state *state);

/* Tangent of the angular radius. */
double light_tan_radius(const light_state *state);

/* Limb darkening at a distance from the disk's centre (1 at its edge; beyond, the edge's): factor on the disk's mean radiance. Its mean
 * over the disk is 1. */
double light_limb_factor(const light_state *state, double relative_distance);

/* Mean radiance of the whole disk as seen from the water; what lies below the horizon counts as zero. */
void light_mean_radiance(const light_state *state, double rgb[3]);

/* Irradiance on a plane that faces the light: outside the atmosphere, and at the water. */
void light_beam_outside(const light_state *state, double rgb[3]);
void light_beam(const light_state *state, double rgb[3]);

/* Irradiance of the horizontal. */
void light_irradiance(const light_state *state, double rgb[3]);

/* Luminance outside the atmosphere, of the brightest light's disk. */
double lights_luminance(const light_set *set);

/* ---- for kernels ---- */

/* Fills the frame's array; `under`: mirrored at the mean surface. */
void lights_place(const light_set *set, bool under, FrameData *frame);

/* The first light's disk_radius. */
double lights_disk_radius(const FrameData *frame);
/* Whether all of them are black. */
bool lights_dark(const FrameData *frame);

#endif
