/* SPDX-License-Identifier: MIT
 *
 * Published wave spectra: density over frequency, directional spreading, dispersion, and the slopes of a clean sea.
 *
 * Frequencies are angular, rad/s. Azimuths are in radians, clockwise from -z seen from above, and tell where waves travel to or the wind blows to. Directions
 * in settings are in degrees and tell where they come from, as in weather reports and buoys' data.
 */
#ifndef MANGATA_SEA_SPECTRUM_MODEL_H
#define MANGATA_SEA_SPECTRUM_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "sea/spectrum_table.h"
#include "sea/spectrum_unified.h"

#define SPECTRUM_GRAVITY 9.80665 /* m/s² */

typedef enum spectrum_kind {
    SPECTRUM_NONE,
    SPECTRUM_PIERSON_MOSKOWITZ, /* fully developed sea of the open ocean (Pierson and Moskowitz 1964) */
    SPECTRUM_JONSWAP,           /* limited by fetch (Hasselmann et al. 1973) */
    SPECTRUM_TMA,               /* JONSWAP times Kitaigorodskii's factor of depth (Bouws et al. 1985) */
    SPECTRUM_ELFOUHAILY,        /* long and short waves, limited by fetch (Elfouhaily et al. 1997); with a depth times Kitaigorodskii's factor */
    SPECTRUM_BUOY               /* a table of measured densities */
} spectrum_kind;

typedef enum spectrum_directions {
    DIRECTIONS_MITSUYASU,      /* cos^2s of half the angle, with s by frequency and wind (Mitsuyasu et al. 1975) */
    DIRECTIONS_HASSELMANN,     /* the same form with another s (Hasselmann et al. 1980) */
    DIRECTIONS_DONELAN_BANNER, /* sech² (Donelan et al. 1985, high frequencies after Banner 1990) */
    DIRECTIONS_FIXED           /* cos^2s of half the angle, with one s for all frequencies */
} spectrum_directions;

typedef enum spectrum_slope {
    SLOPE_SPECTRUM, /* the slopes are those of the spectrum down to the shortest wave */
    SLOPE_COX_MUNK  /* the tail is bent so that the mean-square slope is that of Cox and Munk's clean sea (1954) */
} spectrum_slope;

typedef struct spectrum_settings {
    spectrum_kind kind;
    double wind;          /* m/s */
    double wind_height;   /* height of the wind over the water, m; 0: that of the kind's paper, 19.5 m for Pierson-Moskowitz, else 10 m */
    double fetch;         /* m; read if spectrum_takes_fetch(); 0, for Elfouhaily et al. alone: a fully developed sea */
    double depth;         /* m; 0: deep */
    double gamma;         /* peak enhancement factor; read if spectrum_takes_gamma() */
    double direction_deg; /* where the wind comes from; 0 is -z ("north"), 90 is +x ("east") */
    spectrum_directions directions;
    double spread; /* s of DIRECTIONS_FIXED */
    spectrum_slope slope;
    double shortest; /* shortest wavelength, m; 0: SPECTRUM_SHORTEST, or the end of a table without SLOPE_COX_MUNK */
} spectrum_settings;

#define SPECTRUM_SHORTEST 0.05

/* Whether the kind depends on the fetch. */
static inline bool spectrum_takes_fetch(spectrum_kind kind) { return kind == SPECTRUM_JONSWAP || kind == SPECTRUM_TMA || kind == SPECTRUM_ELFOUHAILY; }

/* Whether the kind can be limited by the depth of the water. */
static inline bool spectrum_takes_depth(spectrum_kind kind) { return kind == SPECTRUM_TMA || kind == SPECTRUM_ELFOUHAILY; }

/* Whether the peak enhancement factor gamma is a setting of the kind. */
static inline bool spectrum_takes_gamma(spectrum_kind kind) { return kind == SPECTRUM_JONSWAP || kind == SPECTRUM_TMA; }

/* Whether the kind defines its own directional spreading. */
static inline bool spectrum_has_directions(spectrum_kind kind) { return kind == SPECTRUM_ELFOUHAILY || kind == SPECTRUM_BUOY; }

/* Wind speed of the settings at a height of 10 m, m/s. */
double spectrum_wind_10(const spectrum_settings *settings);

/* A spectrum ready to be evaluated. */
typedef struct wave_spectrum {
    spectrum_kind kind;
    double alpha;        /* parametric kinds: equilibrium level */
    double gamma;        /* parametric kinds: peak enhancement factor */
    double peak;         /* peak frequency; of a buoy that of the row with the highest density */
    unified_sea unified; /* SPECTRUM_ELFOUHAILY: its parameters */
    double depth;        /* m; 0: deep */
    double wind_10;      /* wind speed at 10 m, m/s */
    double low, high;    /* lowest and highest frequency of waves */
    double tail_from;    /* frequency at which a table ends and its tail of ω⁻⁵ begins; +inf: there is none */
    double bend_from;    /* beyond it the density is multiplied by (ω / bend_from)^bend_power, see spectrum_bend_tail(); +inf: the tail is not bent */
    double bend_power;
    double bend_spread; /* s of cos^2s of half the angle beyond bend_from */
    spectrum_directions directions;
    double spread;               /* s of DIRECTIONS_FIXED */
    double downwind;             /* azimuth that the wind blows to; of a buoy the mean azimuth of its waves */
    const spectrum_table *table; /* SPECTRUM_BUOY: the caller's table */
} wave_spectrum;

/* A fault of settings: the key at fault, and a text "is …; allowed: …". */
typedef struct spectrum_fault {
    const char *key;
    char text[240];
} spectrum_fault;

/* Makes a spectrum from settings within the ranges of the scene format. Only a buoy reads `table`, which must outlive the spectrum. The tail is not bent, see
 * spectrum_bend_tail(). On failure returns false and fills *fault. */
bool wave_spectrum_make(wave_spectrum *out, const spectrum_settings *settings, const spectrum_table *table, spectrum_fault *fault);

/* Density at a frequency, m²·s/rad. Its integral over frequency is the variance of the height. */
double wave_spectrum_density(const wave_spectrum *spectrum, double frequency);

/* Directional distribution of the density at an azimuth, up to a factor that depends on the frequency alone. */
double wave_spectrum_spreading(const wave_spectrum *spectrum, double frequency, double azimuth);

/* The frequency of the highest density, rad/s. */
double wave_spectrum_peak(const wave_spectrum *spectrum);

/* ---- dispersion: ω² = g k tanh(k d) ------------------------------------------------------------------------- */

double dispersion_frequency(double wave_number, double depth); /* depth 0: deep */
double dispersion_wave_number(double frequency, double depth);

/* Kitaigorodskii's factor, 0 … 1, by which the depth of the water limits the spectrum of a deep sea. */
double depth_factor(double frequency, double depth);

/* ---- closed forms ------------------------------------------------------------------------------------------- */

/* Wind speed at another height, by the logarithmic profile over a neutral sea with the drag coefficient 1.3e-3. */
double wind_at_height(double wind, double height, double wanted_height);

/* Significant wave height 4 √m0 of the spectrum α g² ω⁻⁵ exp(-5/4 (ω_p/ω)⁴) γ^…. It is exact for γ = 1. Up to γ = 7 it uses the fit 1 - 0.287 ln γ, whose error
 * is 1 %. For larger γ it is NAN. */
double closed_form_height(double alpha, double peak, double gamma);

/* Mean-square slope of that spectrum with γ = 1 in deep water, up to the frequency `high`: α/4 E₁(5/4 (ω_p/high)⁴). */
double closed_form_slope(double alpha, double peak, double high);

/* Mean-square slopes of a clean sea by Cox and Munk (1954). */
typedef struct cox_munk {
    double total, upwind, crosswind; /* `total` is their separate fit, 0.003 + 0.00512 U */
} cox_munk;

/* `wind_12_5`: wind speed at 12.5 m (41 feet), m/s. */
cox_munk cox_munk_slopes(double wind_12_5);

#endif
