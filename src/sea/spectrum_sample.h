/* SPDX-License-Identifier: MIT
 *
 * From a spectrum to sines.
 *
 * Frequencies: the spectrum is cut into as many strata as there are waves, each with the same share of three quarters mean-square slope and
 * one quarter variance of height: glitter is made of slopes, while the swell must not become a single wave. A stratum's wave has its whole
 * variance, A² / 2, and the wave number whose square is the stratum's mean, so that any number of waves has the spectrum's variance of height
 * and of slope exactly. Directions: quantiles of the spreading at the wave's frequency, at golden ratios from a start that the seed decides,
 * so that neighbouring frequencies run apart. Phases: uniform, by the seed. Numbers are rounded to seven digits.
 */
#ifndef MANGATA_SEA_SPECTRUM_SAMPLE_H
#define MANGATA_SEA_SPECTRUM_SAMPLE_H

#include "mangata/mangata.h"
#include "sea/spectrum_model.h"

/* Bends the spectrum's tail so that the mean-square slope down to the shortest wave is `slopes.total`, and lets the tail spread so that the
 * share upwind is theirs as far as it can. The tail begins at three times the peak, halfway to the shortest wave where that is nearer, or
 * where a table ends. False with *fault filled where no tail can do it, its key NULL where memory runs out. */
bool spectrum_bend_tail(wave_spectrum *spectrum, cox_munk slopes, spectrum_fault *fault);

/* Fills `count` waves from the longest to the shortest. False when memory runs out. */
bool spectrum_sample(const wave_spectrum *spectrum, uint32_t seed, size_t count, mgt_wave *waves);

/* What a sea is like. */
typedef struct sea_statistics {
    double height;            /* significant, 4 √m0, m */
    double slope;             /* mean square, upwind + crosswind */
    double upwind, crosswind; /* its parts along and across an azimuth */
} sea_statistics;

/* By quadrature over the spectrum. */
bool spectrum_statistics(const wave_spectrum *spectrum, sea_statistics *out);

/* Of sines. */
sea_statistics waves_statistics(const mgt_wave *waves, size_t count, double azimuth);

#endif
