/* SPDX-License-Identifier: MIT
 *
 * The sky around one light: a table of radiance over the upper hemisphere and what follows from it (the light as seen from
 * the water, irradiance, automatic exposure). Built once for a (sky, light) pair and read by every pixel.
 */
#ifndef MANGATA_FRAME_ATMOSPHERE_H
#define MANGATA_FRAME_ATMOSPHERE_H

#include <stdbool.h>

#include "mangata/mangata.h"
#include "kernels/common/constants.h"

/* Columns run over the azimuth φ from the light, u = sin(φ/2); rows over height, v = sqrt(direction.y). The nodes lie at
 * u = column/(SKY_COLUMNS − 1), v = row/(SKY_ROWS − 1): the table's edges are the horizon, the zenith and the two half
 * planes through the light. */

/* Plain data, 217 KiB: keep it on the heap. Radiance in kcd/m², irradiance in klx (kcd·sr/m²), linear sRGB. */
typedef struct sky_state {
    mgt_sky sky; /* the inputs it was built from */
    mgt_light light;

    double direction[3]; /* unit, to the light's centre */
    double azimuth[2];   /* x, z of the unit horizontal direction to the light; (0, −1) when it stands in the zenith */
    double tan_radius;   /* tangent of the light's angular radius */
    double limb;         /* u of the limb darkening I(μ)/I(1) = 1 − u·(1 − μ), μ² = 1 − (angle/radius)²: sun 0.6, moon 0 */

    /* Mean radiance of the whole disk as seen from the water: what lies below the horizon counts as zero, so this fades to 0
     * while the light sets. The part still above has light_radiance / light_visible. */
    double light_radiance[3];
    double light_visible;     /* share of the disk's light-weighted area above the horizon, [0, 1] */
    double light_solid_angle; /* sr, of the whole disk */

    double irradiance_light[3]; /* on the horizontal, from the disk */
    double irradiance_sky[3];   /* on the horizontal, from the table */
    double exposure_ev;         /* automatic exposure: the picture is radiance · 2^exposure_ev before the tone map */

    float table[SKY_ROWS * SKY_COLUMNS * 3]; /* rows from the horizon up; no disk in it */
} sky_state;

/* Fills `state`. The inputs must be valid (mgt_scene_check). Takes up to 0.1 s for MGT_SKY_ATMOSPHERE, microseconds for the other
 * models. MGT_OK or MGT_ERROR_MEMORY; after a failure `state` is unchanged. */
mgt_status sky_state_build(sky_state *state, const mgt_sky *sky, const mgt_light *light);

/* Whether a build from these inputs would give the bytes that `state` holds. Never true for a zeroed state. */
bool sky_state_same_inputs(const sky_state *state, const mgt_sky *sky, const mgt_light *light);

/* Radiance of the sky (no disk) in a unit direction; below the horizon the horizon's. The maths of sky.k in double. */
void sky_lookup(const sky_state *state, const double direction[3], double rgb[3]);

/* Limb darkening at a distance from the disk's centre (1 at its edge; beyond, the edge's): factor on the disk's mean radiance. Its mean
 * over the disk is 1. */
double sky_limb_factor(double limb, double relative_distance);

/* Radiance that deep water sends up through a flat surface, without the last factor: the caller multiplies by (1 − F(view)).
 *   body = body_albedo · E_w / (π·n²),
 *   E_w  = irradiance_light·(1 − F(elevation)) + irradiance_sky·(1 − F_diffuse): what enters the water;
 * the upwelling light is taken as isotropic and 1/n² is its dilution on leaving the denser medium. 0 with a black sky. */
void sky_upwelling_radiance(const sky_state *state, const mgt_water *water, double rgb[3]);

#endif
