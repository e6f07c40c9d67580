/* SPDX-License-Identifier: MIT
 *
 * Aerial perspective above the sea: transmittance and in-scattered light between the eye and a point, as the table that air.k reads.
 *
 * A path runs straight through the sky's round atmosphere, from the eye's height, at the angle at which it would meet a flat sea at its length. At infinity
 * the light is that of the sky at the horizon and the transmittance is 0, so that the far sea has no edge before the sky.
 */
#ifndef MANGATA_FRAME_AIR_H
#define MANGATA_FRAME_AIR_H

#include "frame/scattering.h"
#include "kernels/common/constants.h"

/* An eye and a light. */
typedef struct air_view {
    double height;            /* of the eye, metres above the sea; taken as AIR_LEAST to AIR_MOST */
    double sin_light;         /* of the light's elevation */
    double rgb_irradiance[3]; /* of the light outside the atmosphere */
} air_view;

#define AIR_LEAST 0.1
#define AIR_MOST 5e4

/* FRAME(cx).air_rate: extinction at 540 nm, the mean from the sea to the eye, 1/metre. */
double air_rate(const scattering *air, double height);

/* Transmittance (`leaves`, NULL: not wanted) and in-scattered light (kcd/m²) of a path of `distance` metres. cos_azimuth: cosine between the path's
 * horizontal direction and the light's. `ray` is scratch memory. */
void air_along(const scattering *air, const spectrum_weights *weights, const air_view *view, double distance, double cos_azimuth, scattering_ray *ray,
               double leaves[3], double light[3]);

/* Fills AIR_ROWS + 1 rows of SKY_COLUMNS texels. `horizon` are the sky's texels there, in which `night` is added everywhere. */
void air_fill(const scattering *air, const spectrum_weights *weights, const air_view *view, const float *horizon, const float night[3], scattering_ray *ray,
              float *table);

#endif
