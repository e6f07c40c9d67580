/* SPDX-License-Identifier: MIT
 *
 * The lights of a frame: disks at infinity, and what of them comes through the air.
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

/* An empty set, NULL without memory. The caller owns it. */
light_set *lights_create(void);
void lights_destroy(light_set *set); /* NULL does nothing */

/* Sine of a light's angular radius. */
double light_radius_sine(const mgt_light *light);

/* Places the lights, as many as a frame has room for; `air` is what they shine through, or NULL. */
void lights_set(light_set *set, const mgt_light *lights, int count, const struct scattering *air, const struct spectrum_weights *weights);

/* Whether the set was made from these. Never true for an empty set. */
bool lights_same(const light_set *set, const mgt_light *lights, int count);

/* ---- what the rest of a frame asks ---- */

/* How many lights there are, and one of them; the sky lies around the first. Theirs stays the set's. */
int lights_count(const light_set *set);
const light_state *lights_get(const light_set *set, int index);

/* A unit vector, and x, z of a horizontal one, (0, −1) for a light in the zenith. */
const double *light_toward(const light_state *state);
const double *light_azimuth(const light_state *state);

/* Tangent of the angular radius, and the whole disk's solid angle, sr. */
double light_tan_radius(const light_state *state);
double light_solid_angle(const light_state *state);

/* Fraction of the disk's light that stands above the horizon, [0, 1]. */
double light_visible_part(const light_state *state);

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
