/* SPDX-License-Identifier: MIT
 *
 * Waves of a scene's `water.spectrum`, `water.wind` and `water.swell`, from settings and a table's file.
 */
#ifndef MANGATA_SCENE_SCENE_SEA_H
#define MANGATA_SCENE_SCENE_SEA_H

#include "scene/scene_fields.h"
#include "scene/scene_tree.h"
#include "sea/spectrum_sample.h"

/* A spectrum and the table that it may need. The struct must not be moved, because the spectrum points to the table. */
typedef struct scene_sea {
    wave_spectrum spectrum;
    spectrum_table table; /* owned */
    cox_munk slopes;      /* slopes for the wind, whether the spectrum has them or not */
} scene_sea;

/* The path of `file`, which is relative to the folder of the scene's file. The caller frees it. NULL: out of memory. */
char *scene_file_beside(const char *scene_path, const char *file);

/* A fault of a sea. */
typedef struct scene_sea_fault {
    spectrum_fault setting; /* fault of a key of the spectrum; its `key` NULL: `error` is set instead */
    scene_error error;      /* a whole message */
} scene_sea_fault;

/* Makes the spectrum. A relative `file` lies beside `scene_path`, the scene's file. False: *fault is filled, and there is nothing to close. */
bool scene_sea_open(scene_sea *sea, const scene_spectrum *settings, const char *scene_path, scene_sea_fault *fault);
void scene_sea_close(scene_sea *sea);

/* Speed at 10 m of the wind that makes the waves, m/s; 0: there is none. */
double scene_water_wind(const scene_water *water);

/* Fraction of the water that foam covers. */
double scene_water_foam(const scene_water *water);

/* Words a fault of the wind's spectrum by the keys of `water.wind`. */
void scene_wind_fault(spectrum_fault *fault);

/* Values with which a scene by words about its sea begins: a low sun straight ahead and two seconds of film. */
scene_values scene_sea_values(void);

/* Places the camera above the crests of a sea of this significant wave height, metres. It looks 7 degrees down. */
void scene_sea_place_camera(mgt_camera *camera, double wave_height);

/* Number of waves of all swells. They are the last ones of the sea. */
size_t scene_swell_count(const scene_water *water);

/* Fills water->sea if scene_water_has_sea(): all waves, times the factor. */
bool scene_sea_fill(scene_water *water, const char *scene_path, scene_sea_fault *fault);

/* Fills water->sea while a file is read. Errors have the place of the key at fault. */
bool scene_sea_read(const scene_tree *tree, scene_water *water, scene_error *error);

#endif
