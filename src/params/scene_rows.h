/* SPDX-License-Identifier: MIT
 *
 * Rows of an mgt_scene, for ranges in the API and scene files, and for comparisons of scenes.
 */
#ifndef MANGATA_PARAMS_SCENE_ROWS_H
#define MANGATA_PARAMS_SCENE_ROWS_H

#include "params/names.h"
#include "params/options.h"
#include "params/waves.h"

#define FIELD_ANYWHERE -1e9, 1e9

/* Rows of an mgt_camera that is the member `member` of a struct. */
#define CAMERA_ROWS(type, member, required)                                                                                                                 \
    {"position",                                                                                                                                            \
     FIELD_VECTOR,                                                                                                                                          \
     offsetof(type, member.position),                                                                                                                       \
     (required),                                                                                                                                            \
     FIELD_ANYWHERE,                                                                                                                                        \
     "m",                                                                                                                                                   \
     .doc = "where the camera stands; under water where its y is below water.level"},                                                                       \
        {"target", FIELD_VECTOR, offsetof(type, member.target), (required), FIELD_ANYWHERE, "m", .doc = "a point in the middle of the picture"},            \
        {"up", FIELD_VECTOR, offsetof(type, member.up), 0, FIELD_ANYWHERE, NULL, .doc = "a direction that is up in the picture, not parallel to the view"}, \
    {                                                                                                                                                       \
        "fov_y_deg", FIELD_NUMBER, offsetof(type, member.fov_y_deg), FIELD_OPEN_MIN | FIELD_OPEN_MAX, 0, 179, "degrees", .doc = "vertical field of view"    \
    }

/* Rows of an mgt_sky that is the member `look` of a struct. */
#define SKY_LOOK_ROWS(type, look)                                                                                                                            \
    {"model", FIELD_CHOICE, offsetof(type, look.model), .doc = "atmosphere: scattering, day to night; gradient: horizon to zenith; black: only the glitter", \
     .choices = sky_model_names},                                                                                                                            \
        {"turbidity", FIELD_FLOAT, offsetof(type, look.turbidity), 0, 1, 10, NULL, .doc = "aerosol amount over clear air (atmosphere)"},                     \
        {"zenith", FIELD_COLOR, offsetof(type, look.zenith), 0, 0, 1e9, "kcd/m²", .doc = "linear sRGB, straight up (gradient)"},                             \
        {"horizon", FIELD_COLOR, offsetof(type, look.horizon), 0, 0, 1e9, "kcd/m²", .doc = "linear sRGB, at the horizon (gradient)"},                        \
    {                                                                                                                                                        \
        "night", FIELD_COLOR, offsetof(type, look.night), 0, 0, 1e9, "kcd/m²", .doc = "linear sRGB, airglow and stars, added everywhere (atmosphere)"        \
    }

/* Rows that mgt_water and the scene format have in common, for a struct with members of these names. */
#define WATER_BODY_ROWS(type)                                                                                                                  \
    {"level", FIELD_NUMBER, offsetof(type, level), 0, -1e6, 1e6, "m", .doc = "height of the mean surface"},                                    \
        {"choppiness",                                                                                                                         \
         FIELD_FLOAT,                                                                                                                          \
         offsetof(type, choppiness),                                                                                                           \
         0,                                                                                                                                    \
         0,                                                                                                                                    \
         1,                                                                                                                                    \
         NULL,                                                                                                                                 \
         .doc = "how far waves shift the water to their crests, which sharpens them: 0 sines, 1 trochoids; 0.7 with water.wind"},              \
    {                                                                                                                                          \
        "ior", FIELD_NUMBER, offsetof(type, index_of_refraction), 0, 1, 3, NULL, .doc = "index of refraction", .member = "index_of_refraction" \
    }
#define WATER_COLOR_ROWS(type)                                                                            \
    {"absorption",                                                                                        \
     FIELD_COLOR,                                                                                         \
     offsetof(type, absorption),                                                                          \
     0,                                                                                                   \
     0,                                                                                                   \
     1000,                                                                                                \
     "1/m",                                                                                               \
     .doc = "light that a metre of water absorbs, linear sRGB; for what is seen through it"},             \
        {"scattering",                                                                                    \
         FIELD_COLOR,                                                                                     \
         offsetof(type, scattering),                                                                      \
         0,                                                                                               \
         0,                                                                                               \
         1000,                                                                                            \
         "1/m",                                                                                           \
         .doc = "light that a metre of water scatters, linear sRGB; for what is seen through it"},        \
    {                                                                                                     \
        "body_albedo", FIELD_COLOR, offsetof(type, body_albedo), 0, 0, 1, NULL,                           \
            .doc = "fraction of the light entering the water that deep water sends up again, linear sRGB" \
    }

/* Default lights by mgt_source, at elevation 30° and azimuth 0°. */
extern const mgt_light light_defaults[];

bool light_is_moon(const mgt_light *light);

/* Radius of the light's disk, degrees; 0: it has no radiance. */
double light_shining_radius_deg(const mgt_light *light);

extern const field_row image_rows[];  /* rows of an mgt_image without its crop */
extern const field_row light_rows[];  /* rows of an mgt_light */
extern const field_row sky_rows[];    /* rows of an mgt_sky */
extern const field_row camera_rows[]; /* rows of an mgt_camera */

/* Rows of an mgt_scene without its image, camera_open, waves and objects. */
extern const field_row scene_rows[];

#endif
