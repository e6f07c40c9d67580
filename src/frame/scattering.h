/* SPDX-License-Identifier: MIT
 *
 * Light scattered by a spherical atmosphere of air, aerosol and ozone over a dark sea, seen from sea level.
 *
 * Single scattering is summed along each view ray with the true phase functions. All further orders use a small table of the
 * mean radiance J(height, sun) at a point: order n + 1 is gathered from order n with isotropic scattering. This follows Hillaire,
 * "A scalable and production ready sky and atmosphere rendering technique" (2020). Unlike there, the orders are gathered one by one instead of by a closed
 * local sum, because twilight comes from far away.
 */
#ifndef MANGATA_FRAME_SCATTERING_H
#define MANGATA_FRAME_SCATTERING_H

#include <stdbool.h>

#include "frame/spectrum.h"

typedef struct scattering scattering;

/* turbidity: (air + aerosol)/air optical thickness at 550 nm, ≥ 1. sin_radius: sine of the light's angular radius, which softens the
 * edge of the Earth's shadow. NULL when memory is short. Free with scattering_destroy (NULL allowed). */
scattering *scattering_create(double turbidity, double sin_radius);
void scattering_destroy(scattering *air);

/* Transmittance from sea level to space along a ray whose elevation has this sine, ≥ 0. */
void scattering_transmittance(const scattering *air, double sin_elevation, double transmittance[SPECTRUM_BANDS]);

/* One view elevation, prepared for many light positions. */
typedef struct scattering_ray scattering_ray;
scattering_ray *scattering_ray_create(void);
void scattering_ray_destroy(scattering_ray *ray);
void scattering_ray_aim(const scattering *air, double sin_elevation, scattering_ray *ray);

/* Prepares a path that begins at `height` and ends after `length`, both in kilometres. `sine` is that of its elevation, −1 … 1. */
void scattering_ray_aim_through(const scattering *air, double height, double sine, double length, scattering_ray *ray);

/* Transmittance of the whole ray. */
void scattering_ray_transmittance(const scattering_ray *ray, double transmittance[SPECTRUM_BANDS]);

/* Mean extinction at 540 nm from the sea to a height in kilometres, 1/km. */
double scattering_extinction(const scattering *air, double height);

/* Radiance along the ray per unit of irradiance outside the atmosphere (on a plane facing the light), 1/sr, per band.
 * sin_light: sine of the light's elevation; cos_angle: cosine of the angle between ray and light. */
void scattering_radiance(const scattering *air, const scattering_ray *ray, double sin_light, double cos_angle, double radiance[SPECTRUM_BANDS]);

#endif
