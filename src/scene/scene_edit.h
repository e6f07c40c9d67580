/* SPDX-License-Identifier: MIT
 *
 * Functions for programs that change scenes: values of a scene file, the scene at any time, and the values as text, in `--set` words or as a whole file.
 */
#ifndef MANGATA_SCENE_SCENE_EDIT_H
#define MANGATA_SCENE_SCENE_EDIT_H

#include "scene/scene_fields.h"

/* The values of a file after defaults and overrides. They live as long as `file`. */
const scene_values *scene_file_values(const scene_file *file);

/* Makes the scene at `time` seconds, as scene_file_frame() does for a frame. out->water.waves points into `values`. False: the camera is illegal, and *out is
 * unchanged. */
bool scene_values_shot(const scene_values *values, double time, mgt_scene *out);

/* Replaces `auto` of aerial, stars and night tint by `on` if it stands for that. */
void scene_values_write_out_auto(scene_values *values);

/* Replaces spectrum, wind, swells and factor by explicit waves and by the foam and `auto` values that they give. */
void scene_values_write_out_sea(scene_values *values);

/* Makes the paths of meshes, textures, heights and a buoy's table independent of the folder of the scene's file. False: out of memory. */
bool scene_values_fix_files(scene_values *values, const char *scene_path);

/* The opposite: paths of files in the folder of `scene_path`, in that beside it or below these become relative to the scene's folder, others stay. The scene's
 * file need not exist, its folder must. False: out of memory. */
bool scene_values_relative_files(scene_values *values, const char *scene_path);

/* scene_file_parse() for a text that differs little from `like`. Objects that are unchanged share its models. `like` may be NULL. */
scene_file *scene_file_parse_like(const scene_values *like, const char *text, size_t length, const char *name, const char *const *overrides,
                                  size_t override_count, scene_error *error);

/* Whether both have the same value for every key. */
bool scene_values_equal(const scene_values *left, const scene_values *right);

/* The row that a path such as "light.elevation_deg", "water.waves[2].a" or "camera.path" names. *value becomes a pointer to its value in `values`. NULL: there
 * is no such row or item. */
const field_row *scene_values_find(const scene_values *values, const char *path, const void **value);

/* Writes a whole scene file that reads back as the same values. False: a write error. */
bool scene_values_write(FILE *stream, const scene_values *values);

/* A scene file with these values and overrides. `name` replaces the file's name. NULL: *error is filled. */
scene_file *scene_values_parse(const scene_values *values, const char *name, const char *const *overrides, size_t override_count, scene_error *error);

/* Overrides "key=value" in the order in which they must be applied. */
typedef struct scene_overrides {
    char **words; /* the struct owns the array and the words */
    size_t count;
} scene_overrides;

/* The words that change a file with the values `from` to `to`. If `to` has the waves of a spectrum, wind or swells of `from` as explicit ones, no word is about
 * waves. False: out of memory, and *out is empty. */
bool scene_overrides_between(const scene_values *from, const scene_values *to, scene_overrides *out);
void scene_overrides_free(scene_overrides *overrides);

#endif
