/* SPDX-License-Identifier: MIT
 *
 * The lights of a scene in double precision: disks at infinity. Only light.c accesses the struct's members.
 */
#ifndef MANGATA_REFERENCE_LIGHT_H
#define MANGATA_REFERENCE_LIGHT_H

#include <stdbool.h>

#include "mangata/mangata.h"

enum { REFERENCE_LIGHTS = 1 }; /* largest number of lights of a scene */

typedef struct reference_lights reference_lights;

/* Unit direction to a light: (sin az·cos el, sin el, −cos az·cos el). */
void light_direction(const mgt_light *light, double direction[3]);

/* Limb darkening: the radiance at a point of the disk, divided by the disk's mean radiance: (1 − u (1 − μ)) / (1 − u/3), with μ = √(1 − relative²).
 * `relative`, in [0, 1], is the point's angle from the disk's centre, divided by the angular radius. */
double limb_profile(double u, double relative);

/* The lights of a scene, which the caller frees by free(). NULL: out of memory. */
reference_lights *reference_lights_of(const mgt_scene *scene);

/* Whether a unit direction meets the disk of a light whose centre stands at or above the horizon. */
bool reference_lights_met(const reference_lights *lights, const double direction[3]);

int reference_lights_count(const reference_lights *lights);

/* Unit direction to a light's centre. */
void reference_lights_toward(const reference_lights *lights, int light, double direction[3]);

/* Direction and angular radius (radians) of a light. False where its centre stands below the horizon. */
bool reference_lights_disk(const reference_lights *lights, int light, double direction[3], double *radius);

/* Adds to `rgb` the radiance of the disks that a unit direction meets. means[i] is the mean radiance of the disk of light i. `risen` true: only lights whose
 * centre stands at or above the horizon count. */
void reference_lights_add(const reference_lights *lights, const double means[REFERENCE_LIGHTS][3], const double direction[3], bool risen, double rgb[3]);

#endif
