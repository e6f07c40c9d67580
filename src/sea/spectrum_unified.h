/* SPDX-License-Identifier: MIT
 *
 * The unified directional spectrum of long and short waves of Elfouhaily, Chapron, Katsaros and Vandemark (1997), over wave numbers: gravity
 * waves by the wind over their crests' speed, short ones by the friction of the wind.
 */
#ifndef MANGATA_SEA_SPECTRUM_UNIFIED_H
#define MANGATA_SEA_SPECTRUM_UNIFIED_H

typedef struct unified_sea {
    double age;          /* inverse wave age: the wind at 10 m over the phase speed at the peak; 0.84 where fully developed, at most 5 */
    double peak_number;  /* wave number of the peak, rad/m */
    double peak_speed;   /* phase speed there, m/s */
    double gamma, width; /* how far the peak stands out, and how broad it is */
    double long_alpha;   /* equilibrium range of the long waves */
    double short_alpha;  /* of the short ones; 0 in winds that make none */
    double friction;     /* friction velocity of the wind, m/s */
} unified_sea;

#define UNIFIED_DEVELOPED 0.84 /* the least inverse wave age */
#define UNIFIED_YOUNGEST 5.0   /* the greatest that the spectrum was made for */

/* Inverse wave age after a fetch in metres, by the wind at 10 m; 0: no bound to the fetch, a fully developed sea. */
double unified_age(double wind, double fetch);

/* The fetch that leads to an inverse wave age above UNIFIED_DEVELOPED. */
double unified_fetch(double wind, double age);

unified_sea unified_sea_make(double wind, double age);

/* m³: its integral over the wave number is the variance of height. */
double unified_density(const unified_sea *sea, double wave_number);

/* Δ: the share of the density at an angle φ from the wind is 1 + Δ cos 2φ, up to a factor. */
double unified_asymmetry(const unified_sea *sea, double wave_number);

#endif
