/* SPDX-License-Identifier: MIT
 *
 * Ranges, defaults and spectra of seas of wind and swell, shared by scene files and the public interface.
 */
#ifndef MANGATA_SEA_SEA_H
#define MANGATA_SEA_SEA_H

#include "sea/spectrum_model.h"

/* Least and greatest value of each member. */
#define SEA_WIND 0.5, 75
#define SEA_WIND_HEIGHT 0.5, 200 /* or 0; the logarithmic profile does not hold nearer to the water */
#define SEA_DIRECTION -1e6, 1e6
#define SEA_FETCH 100, 1e7
#define SEA_DEPTH 0, 12000
#define SEA_GAMMA 1, 20
#define SEA_SPREAD 0, 1000
#define SEA_SHORTEST 1e-4, 1000 /* or 0; so wave numbers stay below 1e5, the most of mgt_wave */
#define SEA_FOAM 0, 10
#define SWELL_HEIGHT 0.001, 50
#define SWELL_PERIOD 1, 40

enum { SEA_SWELLS = 16 }; /* largest number of swells */

/* Defaults. */
#define SEA_COUNT 160
#define SEA_CHOPPINESS 0.7f
#define SEA_PEAKEDNESS 3.3 /* peak enhancement factor gamma */
#define SWELL_COUNT 24
#define SWELL_USUAL_PERIOD 12
#define SWELL_USUAL_SPREAD 40

/* Settings of a sea by the wind at 10 m, m/s: the spectrum of Elfouhaily et al. with Cox and Munk's slopes. `fetch`: metres; 0: fully developed. `depth`:
 * metres; 0: deep. */
spectrum_settings sea_of_wind(double wind, double direction_deg, double fetch, double depth);

/* Makes a spectrum, and bends its tail to Cox and Munk's slopes if the settings ask for it. On failure returns false and fills *fault; fault->key is NULL if
 * memory runs out. */
bool sea_spectrum_make(wave_spectrum *out, const spectrum_settings *settings, const spectrum_table *table, spectrum_fault *fault);

/* The seed of swell `index`. It differs from `seed`, because swells and wind waves must not share random numbers. */
uint32_t swell_seed(uint32_t seed, size_t index);

#endif
