/* SPDX-License-Identifier: MIT
 *
 * The sky: a table of radiance over the upper hemisphere, the lights as seen from the water, the irradiance at the water and the automatic exposure.
 * It is built once for a pair of sky and light, and every pixel reads it.
 */
#ifndef MANGATA_FRAME_ATMOSPHERE_H
#define MANGATA_FRAME_ATMOSPHERE_H

#include <stdbool.h>

#include "frame/lights.h"
#include "kernels/common/constants.h"
#include "mangata/mangata.h"

/*
 * A sky and what was computed from it, 390 KiB. Radiance is in kcd/m², irradiance in klx (kcd·sr/m²), both linear sRGB.
 *
 * The table's columns run over the azimuth φ from the first light, with u = sin(φ/2). Its rows run over the height, with v = sqrt(direction.y). Its nodes lie
 * at u = column/(SKY_COLUMNS − 1) and v = row/(SKY_ROWS − 1). So its edges are the horizon, the zenith, and the vertical half-planes towards the first light
 * and away from it.
 */
typedef struct sky_state {
    mgt_sky sky; /* the input it was built from */
    light_set *lights;

    double irradiance_sky[3]; /* on a horizontal plane, without the lights' disks */
    double exposure_ev;       /* automatic exposure: the picture is radiance · 2^exposure_ev before the tone map */

    double adaptation; /* common luminance of the water and the sky near the horizon, kcd/m²; 0: the sky is black */

    double air_height; /* height of the eye that the rows of air were filled for, metres; < 0: not filled */
    double air_rate;   /* see air_rate() of air.h */

    struct scattering *air;     /* of MGT_SKY_ATMOSPHERE; NULL: another model */
    struct scattering_ray *ray; /* scratch memory for `air` */

    float table[SKY_TABLE_ROWS * SKY_COLUMNS * 3 +
                1]; /* the sky without disks from the horizon up, then the rows of air.h and stars.h, then a float of padding */
} sky_state;

/* Creates a black sky without lights, which the caller owns. NULL: out of memory. */
sky_state *sky_state_create(void);
void sky_state_destroy(sky_state *state); /* NULL does nothing */

/* Fills `state` from inputs that mgt_scene_check() has found valid. It takes up to 0.1 s for MGT_SKY_ATMOSPHERE and microseconds for the other models.
 * Returns MGT_OK or MGT_ERROR_MEMORY. After a failure `state` is unchanged. */
mgt_status sky_state_build(sky_state *state, const mgt_sky *sky, const mgt_light *light);

/* Fills the rows of air for an eye at scene->camera.position, if the scene has aerial perspective. Returns whether the table has changed. */
bool sky_state_see_air(sky_state *state, const mgt_scene *scene);

/* Whether the scene is drawn with aerial perspective. */
bool sky_state_has_air(const mgt_scene *scene);

/* Whether a build from these inputs would give the bytes that `state` holds. Never true for a new state. */
bool sky_state_same_inputs(const sky_state *state, const mgt_sky *sky, const mgt_light *light);

/* Radiance of the sky without disks in a unit direction, by the formulas of sky.k in double. A direction below the horizon gets the horizon's radiance. */
void sky_lookup(const sky_state *state, const double direction[3], double rgb[3]);

/* Transmittance (`leaves`) and in-scattered light of the air up to `distance` metres along a unit direction, by the formulas of air.k in double. Call
 * sky_state_see_air() first. */
void sky_air_lookup(const sky_state *state, const double direction[3], double distance, double leaves[3], double light[3]);

/* Upwelling radiance of deep water above a flat surface, kcd/m², 0 with a black sky. The caller multiplies it by 1 − F of the view, F being Fresnel's
 * reflectance:
 *   body = body_albedo · E_w / (π·n²),
 *   E_w  = Σ irradiance of a light·(1 − F(its elevation)) + irradiance_sky·(1 − F_diffuse).
 * E_w is the irradiance that enters the water. The upwelling light is taken as isotropic. The factor 1/n² is its dilution on leaving the denser medium. */
void sky_upwelling_radiance(const sky_state *state, const mgt_water *water, double rgb[3]);

#endif
