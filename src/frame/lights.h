/* SPDX-License-Identifier: MIT
 *
 * The lights of a frame: disks at infinity, whose light is attenuated by the air. Radiance is in kcd/m², irradiance in klx, both linear sRGB.
 */
#ifndef MANGATA_FRAME_LIGHTS_H
#define MANGATA_FRAME_LIGHTS_H

#include <stdbool.h>

#include "frame/kernel_data.h"
#include "mangata/mangata.h"

struct scattering;
struct spectrum_weights;

enum { MAX_LIGHTS = sizeof((FrameData){0}.lights) / sizeof(LightData) };

typedef struct light_state light_state; /* one light */
typedef struct light_set light_set;

/* ---- from a scene ---- */

/* Creates an empty set, which the caller owns. NULL: out of memory. */
light_set *lights_create(void);
void lights_destroy(light_set *set); /* NULL does nothing */

/* Sine of a light's angular radius. */
double light_radius_sine(const mgt_light *light);

/* Fills the set with the first MAX_LIGHTS of the lights, seen through `air`. `air` NULL: nothing attenuates them. */
void lights_set(light_set *set, const mgt_light *lights, int count, const struct scattering *air, const struct spectrum_weights *weights);

/* Whether the set was made from lights equal to these. Never true for an empty set. */
bool lights_same(const light_set *set, const mgt_light *lights, int count);

/* ---- what the rest of a frame asks ---- */

/* Number of the lights. */
int lights_count(const light_set *set);

/* One of the lights, which the set owns. The sky lies around the first light. */
const light_state *lights_get(const light_set *set, int index);

/* Unit vector to the light's centre, 3 numbers. */
const double *light_toward(const light_state *state);

/* x and z of the horizontal unit vector towards the light; (0, −1) for a light in the zenith. */
const double *light_azimuth(const light_state *state);

/* Tangent of the light's angular radius. */
double light_tan_radius(const light_state *state);

/* Solid angle of the whole disk, sr. */
double light_solid_angle(const light_state *state);

/* Fraction of the disk's light that stands above the horizon, [0, 1]. */
double light_visible_part(const light_state *state);

/* Limb darkening: radiance at a distance from the disk's centre, divided by the disk's mean radiance. The distance is 1 at the disk's edge; beyond the edge
 * the edge's factor is returned. */
double light_limb_factor(const light_state *state, double relative_distance);

/* Mean radiance of the whole disk as seen from the water. The part of the disk below the horizon counts as black. */
void light_mean_radiance(const light_state *state, double rgb[3]);

/* Irradiance outside the atmosphere, on a plane that faces the light. */
void light_beam_outside(const light_state *state, double rgb[3]);

/* Irradiance at the water, on a plane that faces the light. */
void light_beam(const light_state *state, double rgb[3]);

/* Irradiance at the water, on a horizontal plane. */
void light_irradiance(const light_state *state, double rgb[3]);

/* Luminance of the brightest light's disk outside the atmosphere, kcd/m². */
double lights_luminance(const light_set *set);

/* ---- for kernels ---- */

/* Fills the frame's array of lights. `under` true: their directions are mirrored at the mean surface. */
void lights_place(const light_set *set, bool under, FrameData *frame);

/* disk_radius of the first light. */
double lights_disk_radius(const FrameData *frame);

/* Whether all lights are black. */
bool lights_dark(const FrameData *frame);

#endif
