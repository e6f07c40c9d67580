/* SPDX-License-Identifier: MIT
 * The first light of a sky, as tests read it. */
#ifndef MANGATA_TESTS_SKY_LIGHT_H
#define MANGATA_TESTS_SKY_LIGHT_H

#include <string.h>

#include "frame/atmosphere.h"

typedef struct sky_light {
    double direction[3], azimuth[2], tan_radius, light_radiance[3], irradiance_light[3], light_solid_angle, light_visible;
} sky_light;

static inline sky_light light_of(const sky_state *sky)
{
    const light_state *light = lights_get(sky->lights, 0);
    sky_light l = {.tan_radius = light_tan_radius(light), .light_solid_angle = light_solid_angle(light), .light_visible = light_visible_part(light)};
    memcpy(l.direction, light_toward(light), sizeof l.direction);
    memcpy(l.azimuth, light_azimuth(light), sizeof l.azimuth);
    light_mean_radiance(light, l.light_radiance);
    light_irradiance(light, l.irradiance_light);
    return l;
}

#endif
