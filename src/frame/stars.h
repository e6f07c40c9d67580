/* SPDX-License-Identifier: MIT
 *
 * The stars that the naked eye sees. Their numbers by magnitude are those of the real sky. Their places are random and the same for all scenes. stars.k reads
 * the table.
 */
#ifndef MANGATA_FRAME_STARS_H
#define MANGATA_FRAME_STARS_H

#include "frame/scattering.h"
#include "kernels/common/constants.h"

/* The visual magnitude up to which the whole sky has `rank` ≥ 1 stars. The logarithm of their number is linear between whole magnitudes (Allen 1973, section
 * 117). */
double stars_magnitude_of(double rank);

/* Illuminance outside the atmosphere of a star of a visual magnitude, klx: 2.54e-9 at 0. */
double stars_illuminance(double magnitude);

/* Mean radiance of all stars outside the atmosphere, kcd/m². */
double stars_mean_radiance(void);

/* Fills the rows of `table` from STAR_CLEAR_ROW on. `night` is sky.night, the radiance of the night sky, which includes the stars' mean up to its own
 * brightness. */
void stars_fill(const scattering *air, const spectrum_weights *weights, const float night[3], float *table);

/* star_radiance() of stars.k in double precision. */
void stars_lookup(const float *table, const double direction[3], double pixel_angle, double rgb[3]);

#endif
