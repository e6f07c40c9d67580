/* SPDX-License-Identifier: MIT
 *
 * The sea of a scene's `water.spectrum`, `water.wind` and `water.swell`: settings and a table's file in, waves out.
 */
#ifndef MANGATA_SCENE_SCENE_SEA_H
#define MANGATA_SCENE_SCENE_SEA_H

#include "scene/scene_fields.h"
#include "scene/scene_tree.h"
#include "sea/spectrum_sample.h"

/* A spectrum with the table that it may need. Not to be moved: the one points at the other. */
typedef struct scene_sea {
    wave_spectrum spectrum;
    spectrum_table table; /* owned */
    cox_munk slopes;      /* of the wind, whether the spectrum meets them or not */
} scene_sea;

/* `file` as seen from the folder of the scene's file; the caller frees it. NULL when memory runs out. */
char *scene_file_beside(const char *scene_path, const char *file);

/* What went wrong: a key of the spectrum and what is wrong with it, or, where `key` is NULL, a whole message. */
typedef struct scene_sea_fault {
    spectrum_fault setting;
    scene_error error;
} scene_sea_fault;

/* `scene_path` is the scene's file, beside which a relative `file` lies. False with *fault filled and nothing to close. */
bool scene_sea_open(scene_sea *sea, const scene_spectrum *settings, const char *scene_path, scene_sea_fault *fault);
void scene_sea_close(scene_sea *sea);

/* m/s at 10 m, of the wind that makes the waves; 0: none does. */
double scene_water_wind(const scene_water *water);

/* Share of the water that foam covers. */
double scene_water_foam(const scene_water *water);

/* A fault of that spectrum by the keys of the wind. */
void scene_wind_fault(spectrum_fault *fault);

/* What a scene of a sea begins with: a low sun straight ahead and two seconds of film. */
scene_values scene_sea_values(void);

/* Above the crests of a sea of this significant height, in metres, looking 7 degrees down. */
void scene_sea_place_camera(mgt_camera *camera, double wave_height);

/* The number of waves of all swells, which are the last ones of the sea. */
size_t scene_swell_count(const scene_water *water);

/* Fills water->sea with the waves, those of the spectrum and those of swells, times the factor, where there is one or the other. */
bool scene_sea_fill(scene_water *water, const char *scene_path, scene_sea_fault *fault);

/* The same while a file is read: errors at the key's place. */
bool scene_sea_read(const scene_tree *tree, scene_water *water, scene_error *error);

#endif
