/* SPDX-License-Identifier: MIT
 *
 * Light along a straight path through the air.
 */
#include "reference/air.h"

#include <math.h>

static const double earth = 6371;

/* Density of air relative to that at sea level, up to 30 km: U.S. Standard Atmosphere 1976, whose logarithm is tabulated every 5 km. */
static double air_density(double height)
{
    static const double falls[] = {0, 0.509, 1.085, 1.839, 2.623, 3.412, 4.198};
    const double x = fmin(fmax(height / 5, 0), 5.999), low = floor(x);
    const double fall = falls[(int)low] + (falls[(int)low + 1] - falls[(int)low]) * (x - low);
    return exp(-fall);
}

/* Extinction at a height, 1/km: air after Bucholtz 1995, and sea aerosol with the Ångström exponent 1 and a scale height of 1.2 km. Ozone is left out: it
 * begins at 12 km, and paths end below. */
static double extinction(double turbidity, double nanometres, double height)
{
    const double air = 0.01162 * pow(nanometres / 550, -4.08), aerosol = 0.0972 * (turbidity - 1) / 1.2 * (550 / nanometres);
    return air * air_density(height) + aerosol * exp(-fmax(height, 0) / 1.2);
}

static double radius_along(const reference_way *way, double distance)
{
    const double start = earth + way->height;
    return sqrt(start * start + distance * distance + 2 * start * way->sine * distance);
}

enum { STEPS = 1000 };

double reference_air_leaves(const reference_way *way, double nanometres)
{
    const double step = way->length / STEPS;
    double depth = 0;
    for (int i = 0; i < STEPS; i++)
        depth += extinction(way->turbidity, nanometres, radius_along(way, (i + 0.5) * step) - earth) * step;
    return exp(-depth);
}

double reference_air_light(const reference_way *way, double nanometres, reference_source *source, const void *user)
{
    const double step = way->length / STEPS;
    double depth = 0, light = 0;
    for (int i = 0; i < STEPS; i++) {
        const double distance = (i + 0.5) * step, radius = radius_along(way, distance), height = radius - earth;
        const double lost = extinction(way->turbidity, nanometres, height) * step;
        const double sine = ((earth + way->height) * way->sine + distance) / radius;
        light += exp(-depth - 0.5 * lost) * source(user, height, sine, distance) * step;
        depth += lost;
    }
    return light;
}
