/* SPDX-License-Identifier: MIT
 *
 * Scene files: a YAML 1.2 or JSON file and `--set` overrides in, one mgt_scene a frame out.
 */
#ifndef MANGATA_SCENE_SCENE_FILE_H
#define MANGATA_SCENE_SCENE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "mangata/mangata.h"

enum { SCENE_PIXELS_MOST = 268435456 }; /* pixels of a scene's image: 2^28 */

typedef struct scene_file scene_file; /* immutable after loading: any number of threads may read it */

typedef enum scene_error_kind {
    SCENE_ERROR_NONE = 0,
    SCENE_ERROR_MISSING_INPUT, /* the file does not exist or cannot be read (exit 66) */
    SCENE_ERROR_BAD_SCENE,     /* syntax or meaning, of the file or of an override's key or value (exit 65) */
    SCENE_ERROR_BAD_OVERRIDE,  /* an override that is not of the form key=value, or words about a sea that make none (exit 64) */
    SCENE_ERROR_MEMORY         /* an allocation failed (exit 1) */
} scene_error_kind;

/* What was wrong: one line without a newline, in UTF-8. Of a file "file:line:column: what is wrong, what is allowed"
 * (line and column from 1, columns in characters), "file: …" where no place in it can be named; of an override
 * "--set key=value: …". */
typedef struct scene_error {
    scene_error_kind kind;
    char text[512];
} scene_error;

/* Reads and checks a scene file of at most 16 MiB; "-" is standard input. A named pipe or a device is refused. Each override is "key=value": the key a path in the format
 * ("light.elevation_deg", "water.waves[0].amplitude", "camera.position", "camera.position[1]"), the value a piece of
 * YAML ("3", "[0, 5, 0]", "{model: black}"); they are applied in order, before defaults are filled in, so that
 * "light.body=moon" brings the moon's radius along. A list index may be one past the end (append).
 * overrides may be NULL when override_count is 0; error may be NULL. Prints nothing.
 * Returns NULL on failure, with *error filled; the caller frees the result with scene_file_free(). */
scene_file *scene_file_load(const char *path, const char *const *overrides, size_t override_count, scene_error *error);

/* The same from memory; `name` stands for the file's name in errors and in scene_file_path(). */
scene_file *scene_file_parse(const char *text, size_t length, const char *name, const char *const *overrides, size_t override_count, scene_error *error);

/* A scene from a few words about its sea, such as "wind=12,direction=30,seed=3": the keys of water.wind, with wind for speed and without "_deg", and
 * of one water.swell, swell for its height, else with "swell_" in front. A low sun stands straight ahead, the camera over the crests, and the film has two seconds. scene_file_path() is "--sea wind=12,…". Errors as of
 * scene_file_load(), "--sea wind=12,…: …", which are a SCENE_ERROR_BAD_OVERRIDE. */
scene_file *scene_file_sea(const char *words, const char *const *overrides, size_t override_count, scene_error *error);

/* scene_file_load(), or where `path` begins with "--sea " scene_file_sea() of the rest. */
scene_file *scene_file_open(const char *path, const char *const *overrides, size_t override_count, scene_error *error);

/* The keys of these words: "wind, direction, …". */
typedef struct scene_sea_names {
    char text[160];
} scene_sea_names;
scene_sea_names scene_sea_word_names(void);

/* NULL is allowed. */
void scene_file_free(scene_file *file);

/* The scene as frame `frame` shows it: time = start + frame / fps when the shutter closes, shutter in seconds, camera
 * (and camera_open) from the keyframes where there are some; quality as far as its method takes it, the crop as in
 * mgt_scene_init().
 * out->water.waves and out->objects point into `file` and live as long. Frames from the count on are legal too: the
 * clock runs on, and a camera path's end is where the camera rests. Returns false, with *out untouched, when frame is negative or has no legal camera. */
bool scene_file_frame(const scene_file *file, int frame, mgt_scene *out);

/* What object `object` of a frame's scene is called: the file's `name`, "NAME/2" at the first of its instances; without a name after its shape or the mesh's file, made different
 * from those before. The parts of one mesh share it. NULL: there is no such object. */
const char *scene_file_object_name(const scene_file *file, size_t object);

const char *scene_file_path(const scene_file *file);        /* as given to scene_file_load(); never NULL */
const char *scene_file_description(const scene_file *file); /* "" where there is none; never NULL */

/* A warning, in the form of an error's text, of values that are legal but probably a mistake: waves steeper than water can be, or a
 * camera that waves wash over. "" where there is none; never NULL. */
const char *scene_file_warning(const scene_file *file);

int scene_file_frame_count(const scene_file *file);   /* ≥ 1 */
double scene_file_fps(const scene_file *file);        /* > 0, may be fractional */
double scene_file_start(const scene_file *file);      /* seconds, the time of frame 0 */
size_t scene_file_wave_count(const scene_file *file); /* 0 … MGT_MAX_WAVES */

/* The key `quality`, with defaults for what is not given. It may hold options that its method does not take: for a method chosen elsewhere. */
mgt_quality scene_file_quality(const scene_file *file);

/* Every effective value that can change a pixel, after defaults and overrides, one "key value" a line in a fixed order
 * with exact numbers: the same text for the same pictures, whatever the file's spelling, for the render hash.
 * `description`, `time.frames` and `quality` are left out. NUL-terminated, its length in *length (may be NULL); the caller frees
 * it with free(). NULL when memory runs out. */
char *scene_file_canonical(const scene_file *file, size_t *length);

/* Writes the JSON Schema (draft 2020-12) of the format, the text of docs/scene.schema.json. False on a write error. */
bool scene_schema_write(FILE *stream);

/* Writes the tables of docs/scenes.md: every key with its type, range and default. False on a write error. */
bool scene_reference_write(FILE *stream);

#endif
