/* SPDX-License-Identifier: MIT
 *
 * The unified directional spectrum of Elfouhaily et al. (1997).
 */
#include "sea/spectrum_unified.h"

#include <math.h>

#include "sea/spectrum_math.h"
#include "sea/spectrum_model.h"

static const double G = SPECTRUM_GRAVITY;
static const double SLOWEST = 0.23;        /* least phase speed, at which gravity and surface tension are equal, m/s */
static const double LONGEST_FETCH = 2.2e4; /* X0 of the paper, a fetch over U²/g */
static const double LN10 = 2.30258509299404568402;

double unified_age(double wind, double fetch)
{
    if (!(fetch > 0))
        return UNIFIED_DEVELOPED;
    const double x = portable_pow(G * fetch / (wind * wind * LONGEST_FETCH), 0.4);
    return UNIFIED_DEVELOPED * portable_pow(portable_tanh(x), -0.75);
}

double unified_fetch(double wind, double age)
{
    const double t = portable_pow(age / UNIFIED_DEVELOPED, -1 / 0.75), x = portable_log((1 + t) / (1 - t)) / 2;
    return LONGEST_FETCH * wind * wind / G * portable_pow(x, 2.5);
}

/* Friction velocity by the roughness of a sea of this inverse wave age (Donelan et al. 1993), m/s. */
static double friction_velocity(double wind, double age)
{
    const double roughness = 3.7e-5 * wind * wind / G * portable_pow(age, 0.9);
    return 0.4 * wind / portable_log(10 / roughness);
}

/* Equilibrium level of short waves. It is below 0 if the wind is too weak for them. */
static double short_equilibrium(double friction)
{
    const double growth = portable_log(friction / SLOWEST);
    return 0.01 * (1 + (growth > 0 ? 3 : 1) * growth);
}

unified_sea unified_sea_make(double wind, double age)
{
    const double friction = friction_velocity(wind, age);
    return (unified_sea){.age = age,
                         .peak_number = G * age * age / (wind * wind),
                         .peak_speed = wind / age,
                         .gamma = 1.7 + (age > 1 ? 6 * portable_log(age) / LN10 : 0),
                         .width = 0.08 * (1 + 4 / (age * age * age)),
                         .long_alpha = 0.006 * portable_pow(age, 0.55),
                         .short_alpha = fmax(short_equilibrium(friction), 0),
                         .friction = friction};
}

/* Wave number of the least phase speed. */
static double slowest_number(void) { return 2 * G / (SLOWEST * SLOWEST); }

/* Phase speed of gravity waves with surface tension. */
static double phase_speed(double wave_number)
{
    const double ratio = wave_number / slowest_number();
    return sqrt(G / wave_number * (1 + ratio * ratio));
}

double unified_density(const unified_sea *sea, double wave_number)
{
    const double inverse = sea->peak_number / wave_number, beyond = sqrt(wave_number / sea->peak_number) - 1, speed = phase_speed(wave_number);
    /* The factors of Pierson and Moskowitz and of JONSWAP apply to both parts. The paper prints them with the long waves alone, but without them the short
     * waves would double the height of the sea. */
    const double shape = portable_exp(-1.25 * inverse * inverse) * portable_pow(sea->gamma, portable_exp(-beyond * beyond / (2 * sea->width * sea->width)));
    const double of_gravity = sea->long_alpha * sea->peak_speed / speed * portable_exp(-sea->age / sqrt(10) * beyond);
    const double off = wave_number / slowest_number() - 1, of_friction = sea->short_alpha * SLOWEST / speed * portable_exp(-off * off / 4);
    return (of_gravity + of_friction) / 2 * shape / (wave_number * wave_number * wave_number);
}

double unified_asymmetry(const unified_sea *sea, double wave_number)
{
    const double isotropic = 0.17328679513998632735 /* ln 2 / 4 */, longest = 4, shortest = 0.13 * sea->friction / SLOWEST;
    const double speed = phase_speed(wave_number);
    return portable_tanh(isotropic + longest * portable_pow(speed / sea->peak_speed, 2.5) + shortest * portable_pow(SLOWEST / speed, 2.5));
}
