/* SPDX-License-Identifier: MIT
 *
 * Scenes that a program changes: copies of their values, the scene of any moment, and the way back to text, as `--set` words and as a
 * whole file.
 */
#ifndef MANGATA_SCENE_SCENE_EDIT_H
#define MANGATA_SCENE_SCENE_EDIT_H

#include "scene/scene_fields.h"

/* What a file holds after defaults and overrides; lives as long as `file`. */
const scene_values *scene_file_values(const scene_file *file);

/* The scene at `time` seconds, as scene_file_frame() makes it for a frame. out->water.waves points into `values`. False, with *out untouched,
 * where the camera is not a legal one. */
bool scene_values_shot(const scene_values *values, double time, mgt_scene *out);

/* Writes out what `auto` stands for where it follows from the wind. */
void scene_values_write_out_auto(scene_values *values);

/* Turns what a spectrum and a factor made into explicit waves, the spectrum into none, the factor into 1. */
void scene_values_write_out_sea(scene_values *values);

/* Makes the paths of meshes, textures, heights and a buoy's table independent of the folder of the scene's file. False when memory runs out. */
bool scene_values_fix_files(scene_values *values, const char *scene_path);

/* scene_file_parse() for a text that differs little from `like`, whose models are taken where the new objects are made of the same. NULL: there is none. */
scene_file *scene_file_parse_like(const scene_values *like, const char *text, size_t length, const char *name, const char *const *overrides,
                                  size_t override_count, scene_error *error);

/* Whether both hold the same for every key. */
bool scene_values_equal(const scene_values *left, const scene_values *right);

/* The field that a path such as "light.elevation_deg", "water.waves[2].a" or "camera.path" names, and where `values` hold it. NULL where
 * there is none, or no such item. */
const field_row *scene_values_find(const scene_values *values, const char *path, const void **value);

/* A whole scene file that reads back as the same values. False on a write error. */
bool scene_values_write(FILE *stream, const scene_values *values);

/* The same as a file that was read, with overrides; `name` stands for the file's name. NULL on failure, with *error filled. */
scene_file *scene_values_parse(const scene_values *values, const char *name, const char *const *overrides, size_t override_count, scene_error *error);

/* Words "key=value" in the order in which they must be applied. */
typedef struct scene_overrides {
    char **words; /* owned, as is each of them */
    size_t count;
} scene_overrides;

/* The words that turn a file with the values `from` into `to`; where `to` holds a spectrum, a wind or swells of `from` written out there are none about waves.
 * False when memory runs out; *out is then empty. */
bool scene_overrides_between(const scene_values *from, const scene_values *to, scene_overrides *out);
void scene_overrides_free(scene_overrides *overrides);

#endif
