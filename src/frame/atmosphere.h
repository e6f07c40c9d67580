/* SPDX-License-Identifier: MIT
 *
 * The sky around its lights: a table of radiance over the upper hemisphere and what follows from it (the lights as seen from
 * the water, irradiance, automatic exposure). Built once for a (sky, light) pair and read by every pixel.
 */
#ifndef MANGATA_FRAME_ATMOSPHERE_H
#define MANGATA_FRAME_ATMOSPHERE_H

#include <stdbool.h>

#include "frame/lights.h"
#include "kernels/common/constants.h"
#include "mangata/mangata.h"

/* Columns run over the azimuth φ from the first light, u = sin(φ/2); rows over height, v = sqrt(direction.y). The nodes lie at
 * u = column/(SKY_COLUMNS − 1), v = row/(SKY_ROWS − 1): the table's edges are the horizon, the zenith and the two half
 * planes through that light. */

/* 390 KiB. Radiance in kcd/m², irradiance in klx (kcd·sr/m²), linear sRGB. */
typedef struct sky_state {
    mgt_sky sky; /* the input it was built from, with the lights */
    light_set *lights;

    double irradiance_sky[3]; /* on the horizontal, from the table */
    double exposure_ev;       /* automatic exposure: the picture is radiance · 2^exposure_ev before the tone map */

    double adaptation; /* luminance of sky near the horizon and water, kcd/m²; 0: the sky is black */

    double air_height; /* height of the eye that the rows of air were filled for, metres; < 0: not filled */
    double air_rate;   /* FRAME(cx).air_rate, see air.h */

    struct scattering *air; /* MGT_SKY_ATMOSPHERE; NULL: another model */
    struct scattering_ray *ray;

    float table[SKY_TABLE_ROWS * SKY_COLUMNS * 3 + 1]; /* rows from the horizon up, no disk in it; then those of air.h and stars.h; one float is read beyond */
} sky_state;

/* A black sky without lights, NULL without memory. The caller owns it. */
sky_state *sky_state_create(void);
void sky_state_destroy(sky_state *state); /* NULL does nothing */

/* Fills `state`. The inputs must be valid (mgt_scene_check). Takes up to 0.1 s for MGT_SKY_ATMOSPHERE, microseconds for the other
 * models. MGT_OK or MGT_ERROR_MEMORY; after a failure `state` is unchanged. */
mgt_status sky_state_build(sky_state *state, const mgt_sky *sky, const mgt_light *light);

/* Fills the rows of air for an eye at scene->camera.position, where the scene has aerial perspective. True: the table has changed. */
bool sky_state_see_air(sky_state *state, const mgt_scene *scene);

/* Whether the scene is drawn with aerial perspective. */
bool sky_state_has_air(const mgt_scene *scene);

/* Whether a build from these inputs would give the bytes that `state` holds. Never true for a new state. */
bool sky_state_same_inputs(const sky_state *state, const mgt_sky *sky, const mgt_light *light);

/* Radiance of the sky (no disk) in a unit direction; below the horizon the horizon's. The maths of sky.k in double. */
void sky_lookup(const sky_state *state, const double direction[3], double rgb[3]);

/* Transmittance (`leaves`) and in-scattered light of the air up to `distance` metres along a unit direction, by the formulas of air.k in double. Call
 * sky_state_see_air() first. */
void sky_air_lookup(const sky_state *state, const double direction[3], double distance, double leaves[3], double light[3]);

/* Radiance that deep water sends up through a flat surface, without the last factor: the caller multiplies by (1 − F(view)).
 *   body = body_albedo · E_w / (π·n²),
 *   E_w  = Σ irradiance of a light·(1 − F(its elevation)) + irradiance_sky·(1 − F_diffuse): what enters the water;
 * the upwelling light is taken as isotropic and 1/n² is its dilution on leaving the denser medium. 0 with a black sky. */
void sky_upwelling_radiance(const sky_state *state, const mgt_water *water, double rgb[3]);

#endif
