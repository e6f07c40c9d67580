/* SPDX-License-Identifier: MIT
 *
 * The unified directional spectrum of Elfouhaily, Chapron, Katsaros and Vandemark (1997) over wave numbers. Its long waves depend on the ratio of wind speed
 * and phase speed, its short ones on the friction velocity of the wind.
 */
#ifndef MANGATA_SEA_SPECTRUM_UNIFIED_H
#define MANGATA_SEA_SPECTRUM_UNIFIED_H

typedef struct unified_sea {
    double age;          /* inverse wave age: wind speed at 10 m over the phase speed at the peak; UNIFIED_DEVELOPED … UNIFIED_YOUNGEST */
    double peak_number;  /* wave number of the peak, rad/m */
    double peak_speed;   /* phase speed at the peak, m/s */
    double gamma, width; /* peak enhancement factor, and width of the peak */
    double long_alpha;   /* equilibrium level of long waves */
    double short_alpha;  /* equilibrium level of short waves; 0: the wind makes none */
    double friction;     /* friction velocity of the wind, m/s */
} unified_sea;

#define UNIFIED_DEVELOPED 0.84 /* inverse wave age of a fully developed sea, the least one */
#define UNIFIED_YOUNGEST 5.0   /* greatest inverse wave age for which the spectrum holds */

/* Inverse wave age by the wind at 10 m, m/s, and the fetch, m; 0: the fetch has no bound, and the sea is fully developed. */
double unified_age(double wind, double fetch);

/* The inverse function: the fetch of an inverse wave age above UNIFIED_DEVELOPED, m. */
double unified_fetch(double wind, double age);

unified_sea unified_sea_make(double wind, double age);

/* Density at a wave number, m³. Its integral over the wave number is the variance of the height. */
double unified_density(const unified_sea *sea, double wave_number);

/* Δ of the directional distribution, which is 1 + Δ cos 2φ up to a factor, for the angle φ from the wind. */
double unified_asymmetry(const unified_sea *sea, double wave_number);

#endif
