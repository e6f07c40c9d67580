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

/* The eye that looks along a path and the light that shines on it. */
typedef struct air_view {
    double height;            /* of the eye above the sea, metres; clamped to [AIR_LEAST, AIR_MOST] */
    double sin_light;         /* sine of the light's elevation */
    double rgb_irradiance[3]; /* by the light outside the atmosphere, on a plane that faces it, linear sRGB, klx */
} air_view;

/* Limits of the eye's height, metres. */
#define AIR_LEAST 0.1
#define AIR_MOST 5e4

/* Mean extinction at 540 nm between the sea and an eye at `height` metres, 1/metre. Kernels read it as FRAME(cx).air_rate. */
double air_rate(const scattering *air, double height);

/* Transmittance (`leaves`, may be NULL) and in-scattered light (`light`, kcd/m²) of a path of `distance` metres, both linear sRGB. `cos_azimuth` is the
 * cosine of the angle between the horizontal directions of the path and of the light. `ray` is scratch memory. */
void air_along(const scattering *air, const spectrum_weights *weights, const air_view *view, double distance, double cos_azimuth, scattering_ray *ray,
               double leaves[3], double light[3]);

/* Fills AIR_ROWS + 1 rows of SKY_COLUMNS texels in `table`. `horizon` is the row of the sky's table at the horizon. That row includes `night`, the radiance
 * of the night sky, so a path gets the part of it that grows with the path's opacity. `ray` is scratch memory. */
void air_fill(const scattering *air, const spectrum_weights *weights, const air_view *view, const float *horizon, const float night[3], scattering_ray *ray,
              float *table);

#endif
