/* SPDX-License-Identifier: MIT
 *
 * Scene files: reads YAML 1.2 or JSON files and `--set` overrides, and makes one mgt_scene per frame.
 */
#ifndef MANGATA_SCENE_SCENE_FILE_H
#define MANGATA_SCENE_SCENE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "mangata/mangata.h"

enum { SCENE_PIXELS_MOST = 268435456 }; /* largest number of pixels of a scene's image, 2^28 */

typedef struct scene_file scene_file; /* immutable after loading: any number of threads may read it */

typedef enum scene_error_kind {
    SCENE_ERROR_NONE = 0,
    SCENE_ERROR_MISSING_INPUT, /* the file does not exist or cannot be read (exit 66) */
    SCENE_ERROR_BAD_SCENE,     /* the file, or an override's key or value, has a wrong syntax or meaning (exit 65) */
    SCENE_ERROR_BAD_OVERRIDE,  /* an override has not the form key=value, or words about a sea are wrong (exit 64) */
    SCENE_ERROR_MEMORY         /* out of memory (exit 1) */
} scene_error_kind;

/* An error. `text` is one line of UTF-8 without a newline: "file:line:column: what is wrong, what is allowed", with lines and columns in characters from 1;
 * "file: …" without a place; or "--set key=value: …" for an override. */
typedef struct scene_error {
    scene_error_kind kind;
    char text[512];
} scene_error;

/* Reads and checks a scene file of at most 16 MiB. "-" is standard input. A named pipe or a device is refused. An override is "key=value". The key is a path in
 * the format ("light.elevation_deg", "water.waves[0].amplitude", "camera.position", "camera.position[1]"). The value is a piece of YAML ("3", "[0, 5, 0]",
 * "{model: black}"). Overrides are applied in order and before defaults are filled in, so "light.body=moon" also sets the moon's radius. A list index may be
 * one past the end, which appends an item. `overrides` may be NULL if override_count is 0. `error` may be NULL. The caller frees the result by
 * scene_file_free(). NULL: *error is filled. */
scene_file *scene_file_load(const char *path, const char *const *overrides, size_t override_count, scene_error *error);

/* Reads a scene file from memory. `name` replaces the file's name in errors and in scene_file_path(). */
scene_file *scene_file_parse(const char *text, size_t length, const char *name, const char *const *overrides, size_t override_count, scene_error *error);

/* Makes a scene from a few words about its sea, such as "wind=12,direction=30,seed=3". Keys are those of water.wind without "_deg", with `wind` for its speed,
 * and those of one water.swell, with `swell` for its height and otherwise with "swell_" in front. The scene has a low sun straight ahead, a camera over the
 * crests, and two seconds of film. scene_file_path() is "--sea wind=12,…". Errors are those of scene_file_load(); "--sea wind=12,…: …" is a
 * SCENE_ERROR_BAD_OVERRIDE. */
scene_file *scene_file_sea(const char *words, const char *const *overrides, size_t override_count, scene_error *error);

/* scene_file_load(), or scene_file_sea() of the rest if `path` begins with "--sea ". */
scene_file *scene_file_open(const char *path, const char *const *overrides, size_t override_count, scene_error *error);

typedef struct scene_sea_names {
    char text[160];
} scene_sea_names;

/* The keys of scene_file_sea()'s words, for messages: "wind, direction, …". */
scene_sea_names scene_sea_word_names(void);

/* NULL is allowed. */
void scene_file_free(scene_file *file);

/* Makes the scene of frame `frame`. The shutter closes at start + frame / fps. camera and camera_open are those of the keyframes if there are some. quality has
 * the options that its method takes. The crop is that of mgt_scene_init(). out->water.waves and out->objects point into `file` and live as long. Frames behind
 * the last one are legal, too: time goes on, and the camera stays at the end of its path. False: `frame` is negative or has no legal camera, and *out is
 * unchanged. */
bool scene_file_frame(const scene_file *file, int frame, mgt_scene *out);

/* Name of object `object` of a frame's scene: the file's `name`, with "/2" behind it for the first of its instances. Without a name it follows from the shape
 * or from the mesh's file, and differs from earlier names. The parts of one mesh have the same name. NULL: there is no such object. */
const char *scene_file_object_name(const scene_file *file, size_t object);

const char *scene_file_path(const scene_file *file);        /* the path given to scene_file_load(); never NULL */
const char *scene_file_description(const scene_file *file); /* "": there is none; never NULL */

/* A warning of values that are legal but probably a mistake, in the form of an error's text: waves that are steeper than water can be, or a camera that waves
 * wash over. "": there is none. It is never NULL. */
const char *scene_file_warning(const scene_file *file);

int scene_file_frame_count(const scene_file *file);   /* ≥ 1 */
double scene_file_fps(const scene_file *file);        /* > 0, may be fractional */
double scene_file_start(const scene_file *file);      /* seconds, the time of frame 0 */
size_t scene_file_wave_count(const scene_file *file); /* 0 … MGT_MAX_WAVES */

/* The key `quality` with defaults for missing keys. It may have options that its method does not take, for a method that is chosen elsewhere. */
mgt_quality scene_file_quality(const scene_file *file);

/* The text for the render hash: every effective value that can change a pixel, after defaults and overrides, one "key value" per line in a fixed order with
 * exact numbers. So pictures that are the same have the same text, whatever the file's spelling. `description`, `time.frames` and `quality` are left out. The
 * text is NUL-terminated, *length becomes its length (`length` may be NULL), and the caller frees it. NULL: out of memory. */
char *scene_file_canonical(const scene_file *file, size_t *length);

/* Writes the JSON Schema (draft 2020-12) of the format, docs/scene.schema.json. False: a write error. */
bool scene_schema_write(FILE *stream);

/* Writes the tables of docs/scenes.md: every key with its type, range and default. False: a write error. */
bool scene_reference_write(FILE *stream);

#endif
