/* SPDX-License-Identifier: MIT
 *
 * Whitecaps: the waves, moments and patterns of a sea's foam, for the kernels and for the reference.
 *
 * Choppy water is compressed at its crests. With B = 1 + ∂(shift)/∂(place at rest) foam covers the water where J = det B < ε, after Dupuy and Bruneton,
 * Real-time animation and rendering of ocean whitecaps (2012). Here B is that of waves that are long enough to break, and ε follows from the fraction of the
 * water that foam shall cover. Old foam is a weighted mean over earlier moments at the same place at rest.
 */
#ifndef MANGATA_PARAMS_FOAM_H
#define MANGATA_PARAMS_FOAM_H

#include "base/foam_numbers.h"
#include "mangata/mangata.h"

/* Fraction of the water that whitecaps cover in a wind of U m/s at 10 m: 3.84e-6 U^3.41, Monahan and O'Muircheartaigh 1980, but at most MOST_FOAM. */
double foam_share_of_wind(double wind);

#define MOST_FOAM 0.5

/* A wave that breaks. At the place (X, Z) at rest it adds −press k̂k̂ᵀ sin(x·X + z·Z + frequency·t + start) to B. */
typedef struct foam_wave {
    double x, z;               /* wave vector, radians per metre */
    double frequency, start;   /* angular frequency, radians per second, and phase, radians */
    double height;             /* amplitude, metres */
    double press;              /* amplitude of the compression */
    double held[FOAM_MOMENTS]; /* factor on the compression that the mean over each moment's length leaves */
} foam_wave;

/* A sine of a pattern: size · cos(x·X + z·Z + start) at the place (X, Z) at rest. */
typedef struct foam_sine {
    double x, z, start, size;
} foam_sine;

/* A sea's foam. */
typedef struct foam_sea {
    int wave_count;
    int moments;                    /* number of moments: FOAM_MOMENTS, or 1 if foam does not last */
    double least;                   /* the threshold ε */
    double share;                   /* fraction of the water that foam shall cover */
    double age[FOAM_MOMENTS];       /* age of foam of each moment, seconds */
    double weight[FOAM_MOMENTS];    /* weight of each moment in the mean */
    double whiteness[FOAM_MOMENTS]; /* albedo of foam of each moment */
    double deviation;               /* standard deviation of the height of all waves, metres */
    double variance;                /* variance of J at places at rest */
    double shape[5];                /* Σ ½press² k̂ᵢk̂ⱼk̂ₖk̂ₗ / variance: xxxx, xxxz, xxzz, xzzz, zzzz */
    foam_wave waves[MGT_MAX_WAVES]; /* from the longest to the shortest */
    foam_sine fresh[FOAM_SINES];    /* pattern of fresh foam, of the variance 1 − FOAM_FINE² */
    foam_sine old[FOAM_SINES];      /* pattern of old foam, of the same variance and stretched along the wind */
} foam_sea;

/* Whether a scene whose mean surface is y = 0 has foam that its camera sees. */
bool foam_draws(const mgt_scene *scene);

/* Fills the foam of a scene. False: there is none, and `sea` is unfinished. */
bool foam_sea_of(const mgt_scene *scene, foam_sea *sea);

/* Expected fraction of the water that foam covers for a threshold. */
double foam_sea_share(const foam_sea *sea, double least);

#endif
