/* SPDX-License-Identifier: MIT
 *
 * The stars that the naked eye sees: as many of each magnitude as there are in the mean over the sky, at places by chance that are the same for all
 * scenes. The table is what stars.k reads.
 */
#ifndef MANGATA_FRAME_STARS_H
#define MANGATA_FRAME_STARS_H

#include "frame/scattering.h"
#include "kernels/common/constants.h"

/* The visual magnitude than which so many stars of the whole sky, ≥ 1, are brighter; their logarithm is linear between whole magnitudes (Allen 1973, section 117). */
double stars_magnitude_of(double rank);

/* Illuminance outside the atmosphere of a star of a visual magnitude, klx: 2.54e-9 at 0. */
double stars_illuminance(double magnitude);

/* Mean radiance of all of them outside the atmosphere, kcd/m². */
double stars_mean_radiance(void);

/* Fills the rows of `table` from STAR_CLEAR_ROW on. `night` is sky.night, which holds the stars' mean where it is as bright. */
void stars_fill(const scattering *air, const spectrum_weights *weights, const float night[3], float *table);

/* What star_radiance() of stars.k gives, in double. */
void stars_lookup(const float *table, const double direction[3], double pixel_angle, double rgb[3]);

#endif
