/* SPDX-License-Identifier: MIT
 *
 * Whitecaps: which waves, moments and patterns foam is made of, for those who draw it and for those who judge them.
 *
 * Choppy water is pressed together at its crests. With B = 1 + ∂(shift)/∂(place of rest) there is foam where J = det B < ε, as in Dupuy and Bruneton,
 * Real-time animation and rendering of ocean whitecaps (2012). Here B is that of waves long enough to break; ε follows from the share of the water
 * that foam is to cover; and old foam is a weighted mean over earlier moments at the same place of rest.
 */
#ifndef MANGATA_PARAMS_FOAM_H
#define MANGATA_PARAMS_FOAM_H

#include "base/foam_numbers.h"
#include "mangata/mangata.h"

/* Share of the water that whitecaps cover in a wind of so many m/s at 10 m: W = 3.84e-6 U^3.41, Monahan and O'Muircheartaigh 1980, at most MOST_FOAM. */
double foam_share_of_wind(double wind);

#define MOST_FOAM 0.5

/* A wave that breaks: at a place of rest it adds −press k̂k̂ᵀ sin(x·X + z·Z + frequency·t + start) to B. */
typedef struct foam_wave {
    double x, z; /* radians per metre */
    double frequency, start;
    double height; /* metres, of the wave */
    double press;
    double held[FOAM_MOMENTS]; /* share of it that the mean over a moment's length leaves */
} foam_wave;

/* A sine of the pattern, size · cos(x·X + z·Z + start) at a place of rest. */
typedef struct foam_sine {
    double x, z, start, size;
} foam_sine;

/* A sea's foam. Waves stand in falling order of length. */
typedef struct foam_sea {
    int wave_count;
    int moments; /* 1: fresh foam alone */
    double least;
    double share;                   /* of the water, as asked for */
    double age[FOAM_MOMENTS];       /* seconds, of each moment */
    double weight[FOAM_MOMENTS];    /* of each moment in the mean */
    double whiteness[FOAM_MOMENTS]; /* share of light that foam of that age sends back */
    double deviation;               /* metres, of the height of all waves */
    double variance;                /* of J at rest */
    double shape[5];                /* Σ ½press² k̂ᵢk̂ⱼk̂ₖk̂ₗ over the variance: xxxx, xxxz, xxzz, xzzz, zzzz */
    foam_wave waves[MGT_MAX_WAVES];
    foam_sine fresh[FOAM_SINES]; /* a field of variance 1 − FOAM_FINE² */
    foam_sine old[FOAM_SINES];   /* another, drawn out along the wind */
} foam_sea;

/* Whether a scene, its mean surface at y = 0, has foam that its camera sees. */
bool foam_draws(const mgt_scene *scene);

/* False where there is no foam; `sea` is then unfinished. */
bool foam_sea_of(const mgt_scene *scene, foam_sea *sea);

/* Share of the water, over the whole sea, that foam covers for a threshold. */
double foam_sea_share(const foam_sea *sea, double least);

#endif
