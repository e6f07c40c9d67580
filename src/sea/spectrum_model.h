/* SPDX-License-Identifier: MIT
 *
 * Wave spectra as they were published: density over frequency, spreading over direction, dispersion, and the slopes of a clean sea.
 *
 * Frequencies are angular, rad/s. Azimuths are in radians, clockwise from -z seen from above, of where waves travel to (or the wind blows
 * to); those in degrees in settings say where it comes from, as weather reports and buoys do.
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
    SPECTRUM_ELFOUHAILY,        /* limited by fetch, long and short waves alike (Elfouhaily et al. 1997); of a depth times the same factor */
    SPECTRUM_BUOY               /* measured: a table */
} spectrum_kind;

typedef enum spectrum_directions {
    DIRECTIONS_MITSUYASU,      /* cos^2s of half the angle, s by frequency and wind (Mitsuyasu et al. 1975) */
    DIRECTIONS_HASSELMANN,     /* the same form (Hasselmann et al. 1980) */
    DIRECTIONS_DONELAN_BANNER, /* sech² (Donelan et al. 1985, high frequencies after Banner 1990) */
    DIRECTIONS_FIXED           /* cos^2s, one s for all */
} spectrum_directions;

typedef enum spectrum_slope {
    SLOPE_SPECTRUM, /* as the spectrum has it, down to the shortest wave */
    SLOPE_COX_MUNK  /* the tail is bent until the mean-square slope is that of Cox and Munk's clean sea (1954) */
} spectrum_slope;

typedef struct spectrum_settings {
    spectrum_kind kind;
    double wind;          /* m/s */
    double wind_height;   /* m over the water; 0: of the kind's own paper, 19.5 m for Pierson-Moskowitz, else 10 m */
    double fetch;         /* m; where spectrum_takes_fetch(). 0 for Elfouhaily et al. alone: a fully developed sea */
    double depth;         /* m; 0: deep */
    double gamma;         /* peak enhancement; JONSWAP, TMA */
    double direction_deg; /* where the wind comes from, 0 is -z ("north"), 90 is +x ("east") */
    spectrum_directions directions;
    double spread; /* s of DIRECTIONS_FIXED */
    spectrum_slope slope;
    double shortest; /* m; 0: SPECTRUM_SHORTEST, for a table without cox-munk its own end */
} spectrum_settings;

#define SPECTRUM_SHORTEST 0.05

static inline bool spectrum_takes_fetch(spectrum_kind kind) { return kind == SPECTRUM_JONSWAP || kind == SPECTRUM_TMA || kind == SPECTRUM_ELFOUHAILY; }

/* Whether it may be of limited depth. */
static inline bool spectrum_takes_depth(spectrum_kind kind) { return kind == SPECTRUM_TMA || kind == SPECTRUM_ELFOUHAILY; }

/* Whether it is up to the settings how far the peak stands out. */
static inline bool spectrum_takes_gamma(spectrum_kind kind) { return kind == SPECTRUM_JONSWAP || kind == SPECTRUM_TMA; }

/* Whether it comes with directions of its own. */
static inline bool spectrum_has_directions(spectrum_kind kind) { return kind == SPECTRUM_ELFOUHAILY || kind == SPECTRUM_BUOY; }

/* m/s at 10 m. */
double spectrum_wind_10(const spectrum_settings *settings);

/* A spectrum ready to be evaluated. */
typedef struct wave_spectrum {
    spectrum_kind kind;
    double alpha, gamma, peak; /* of the parametric kinds; the table's highest row for a buoy */
    unified_sea unified;       /* of Elfouhaily et al. */
    double depth;              /* 0: deep */
    double wind_10;            /* m/s at 10 m */
    double low, high;          /* frequencies between which there are waves */
    double tail_from;          /* where a table ends and its tail of ω⁻⁵ begins */
    double bend_from;          /* beyond it the density is multiplied by (ω / bend_from)^bend_power, see spectrum_bend_tail() */
    double bend_power;
    double bend_spread; /* s of cos^2s beyond bend_from */
    spectrum_directions directions;
    double spread;
    double downwind; /* azimuth */
    const spectrum_table *table;
} wave_spectrum;

/* What is wrong with settings: the key that is at fault and a text "is …; allowed: …". */
typedef struct spectrum_fault {
    const char *key;
    char text[240];
} spectrum_fault;

/* A spectrum from settings in the ranges of the scene format; `table` only for a buoy, it must outlive the spectrum. The tail is not bent
 * yet, see spectrum_bend_tail(). False with *fault filled. */
bool wave_spectrum_make(wave_spectrum *out, const spectrum_settings *settings, const spectrum_table *table, spectrum_fault *fault);

/* m²·s/rad: its integral over frequency is the variance of height. */
double wave_spectrum_density(const wave_spectrum *spectrum, double frequency);

/* Share of the density per radian at an azimuth, up to a factor that depends on the frequency alone. */
double wave_spectrum_spreading(const wave_spectrum *spectrum, double frequency, double azimuth);

/* Where the peak is, rad/s. */
double wave_spectrum_peak(const wave_spectrum *spectrum);

/* ---- dispersion: ω² = g k tanh(k d) ------------------------------------------------------------------------- */

double dispersion_frequency(double wave_number, double depth); /* depth 0: deep */
double dispersion_wave_number(double frequency, double depth);

/* Kitaigorodskii's factor, 0 … 1: how much of a deep sea's spectrum water of this depth bears. */
double depth_factor(double frequency, double depth);

/* ---- closed forms ------------------------------------------------------------------------------------------- */

/* Wind at another height over a neutral sea with the drag coefficient 1.3e-3: a logarithmic profile. */
double wind_at_height(double wind, double height, double wanted_height);

/* Significant wave height 4 √m0 of α g² ω⁻⁵ exp(-5/4 (ω_p/ω)⁴) γ^…; exact for γ = 1, to γ = 7 by the fit 1 - 0.287 ln γ, good to 1 %;
 * NAN beyond. */
double closed_form_height(double alpha, double peak, double gamma);

/* Mean-square slope of the same with γ = 1 in deep water up to the frequency `high`: α/4 E₁(5/4 (ω_p/high)⁴). */
double closed_form_slope(double alpha, double peak, double high);

/* Cox and Munk (1954), clean sea; wind at 12.5 m (41 feet). */
typedef struct cox_munk {
    double total, upwind, crosswind; /* the total is their own fit, 0.003 + 0.00512 U */
} cox_munk;
cox_munk cox_munk_slopes(double wind_12_5);

#endif
