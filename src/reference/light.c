/* SPDX-License-Identifier: MIT
 *
 * The lights of a scene in double precision.
 */
#include "reference/light.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const long double pi = 3.14159265358979323846264338327950288L;

typedef struct reference_light {
    double direction[3];
    double chord_squared; /* of the angular radius R: (2 sin(R/2))² */
    double radius;        /* radians */
    double limb;          /* u of I(μ) ∝ 1 − u·(1 − μ) */
    bool risen;           /* its centre stands at or above the horizon */
} reference_light;

struct reference_lights {
    int count;
    reference_light of[REFERENCE_LIGHTS];
};

void light_direction(const mgt_light *light, double direction[3])
{
    const double elevation = light->elevation_deg * (double)pi / 180, azimuth = light->azimuth_deg * (double)pi / 180;
    direction[0] = sin(azimuth) * cos(elevation);
    direction[1] = sin(elevation);
    direction[2] = -cos(azimuth) * cos(elevation);
}

double limb_profile(double u, double relative)
{
    const double cosine = sqrt(fmax(1 - relative * relative, 0));
    return (1 - u * (1 - cosine)) / (1 - u / 3);
}

static reference_light light_of(const mgt_light *light)
{
    reference_light l = {.limb = light->body == MGT_SOURCE_SUN ? 0.6 : 0, .risen = light->elevation_deg >= 0};
    light_direction(light, l.direction);
    l.radius = light->angular_radius_deg * (double)(pi / 180);
    const double chord = 2 * sin(0.5 * l.radius);
    l.chord_squared = chord * chord;
    return l;
}

reference_lights *reference_lights_of(const mgt_scene *scene)
{
    reference_lights *lights = calloc(1, sizeof *lights);
    if (lights)
        lights->of[lights->count++] = light_of(&scene->light);
    return lights;
}

/* Squared distance of two unit vectors: for small angles far better than their dot product. */
static double chord_squared(const double a[3], const double b[3])
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

bool reference_lights_met(const reference_lights *lights, const double direction[3])
{
    bool met = false;
    for (int i = 0; i < lights->count; i++)
        met = met || (lights->of[i].risen && chord_squared(direction, lights->of[i].direction) < lights->of[i].chord_squared);
    return met;
}

int reference_lights_count(const reference_lights *lights) { return lights->count; }

void reference_lights_toward(const reference_lights *lights, int light, double direction[3])
{
    memcpy(direction, lights->of[light].direction, sizeof lights->of[light].direction);
}

bool reference_lights_disk(const reference_lights *lights, int light, double direction[3], double *radius)
{
    memcpy(direction, lights->of[light].direction, sizeof lights->of[light].direction);
    *radius = lights->of[light].radius;
    return lights->of[light].risen;
}

void reference_lights_add(const reference_lights *lights, const double means[REFERENCE_LIGHTS][3], const double direction[3], bool risen, double rgb[3])
{
    for (int i = 0; i < lights->count; i++) {
        const reference_light *light = &lights->of[i];
        const double chord = chord_squared(direction, light->direction);
        if ((risen && !light->risen) || chord >= light->chord_squared)
            continue;
        const double limb = limb_profile(light->limb, 2 * asin(fmin(0.5 * sqrt(chord), 1)) / light->radius);
        for (int c = 0; c < 3; c++)
            rgb[c] += means[i][c] * limb;
    }
}
