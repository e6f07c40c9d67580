/* SPDX-License-Identifier: MIT
 *
 * Samples a spectrum by sines.
 *
 * Frequencies: the spectrum is cut into as many strata as there are waves. Each has the same amount of a mixture of three quarters relative mean-square slope
 * and one quarter relative variance of height. Slopes have the greater weight because glitter depends on them; height has some so that the longest waves do not
 * become a single one. The wave of a stratum has the stratum's variance, A² / 2, and its mean-square slope. So any number of waves has exactly the spectrum's
 * variances of height and slope. Directions: quantiles of the spreading at the wave's frequency, at multiples of the golden ratio from a start by the seed, so
 * that waves of neighbouring frequencies have different directions. Of up to four waves the longest runs with the wind, and the others lie evenly around it.
 * Phases: uniform, by the seed. Values are rounded to seven digits.
 */
#ifndef MANGATA_SEA_SPECTRUM_SAMPLE_H
#define MANGATA_SEA_SPECTRUM_SAMPLE_H

#include "mangata/mangata.h"
#include "sea/spectrum_model.h"

/* Bends the spectrum's tail so that the mean-square slope down to the shortest wave is `slopes.total`, and sets the tail's spreading so that the ratio of
 * upwind and crosswind slopes is theirs as far as possible. The tail begins at three times the peak frequency, or at the geometric mean of peak and highest
 * frequency if that is lower, or where a table ends. Returns false and fills *fault if no tail can do this, and with fault->key NULL if memory runs out. */
bool spectrum_bend_tail(wave_spectrum *spectrum, cox_munk slopes, spectrum_fault *fault);

/* Fills `count` waves from the longest to the shortest. False: out of memory. */
bool spectrum_sample(const wave_spectrum *spectrum, uint32_t seed, size_t count, mgt_wave *waves);

typedef struct sea_statistics {
    double height;            /* significant wave height 4 √m0, m */
    double slope;             /* mean-square slope: upwind + crosswind */
    double upwind, crosswind; /* mean-square slopes along and across an azimuth */
} sea_statistics;

/* Statistics of a spectrum, by quadrature. The azimuth is that of the wind. False: out of memory. */
bool spectrum_statistics(const wave_spectrum *spectrum, sea_statistics *out);

/* Statistics of waves. */
sea_statistics waves_statistics(const mgt_wave *waves, size_t count, double azimuth);

#endif
