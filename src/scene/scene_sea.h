/* SPDX-License-Identifier: MIT
 *
 * The sea of a scene's `water.spectrum`: settings and a table's file in, waves out.
 */
#ifndef MANGATA_SCENE_SCENE_SEA_H
#define MANGATA_SCENE_SCENE_SEA_H

#include "scene/scene_fields.h"
#include "scene/scene_tree.h"
#include "scene/spectrum_sample.h"

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

/* Fills water->sea with the waves and those of the spectrum, times the factor, where there is one or the other. */
bool scene_sea_fill(scene_water *water, const char *scene_path, scene_sea_fault *fault);

/* The same while a file is read: errors at the key's place. */
bool scene_sea_read(const scene_tree *tree, scene_water *water, scene_error *error);

#endif
