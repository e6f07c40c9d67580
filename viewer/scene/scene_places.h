/* SPDX-License-Identifier: MIT
 * Sources of scenes: seas in a few words, scenes that come with the program, recently opened scenes, files of a folder. */
#ifndef MANGATA_VIEWER_SCENE_SCENE_PLACES_H
#define MANGATA_VIEWER_SCENE_SCENE_PLACES_H

#include <stdbool.h>
#include <stddef.h>

/* A sea in a few words. `path` is "--sea WORDS", which document_open() opens. */
typedef struct sea_preset {
    const char *name, *path;
} sea_preset;

extern const sea_preset sea_presets[];
extern const size_t sea_preset_count;

/* A list of paths or names; owned. */
typedef struct name_list {
    char **names;
    size_t count;
} name_list;

void name_list_free(name_list *list);

/* The folder of the scenes that come with the program. The caller frees it. NULL: it is missing, or memory has run out. */
char *shipped_folder(void);

/* The names of a folder's folders, which end in "/" and begin with "../", then those of its scene files (.yaml, .yml, .json), both sorted. The list is empty if
 * the folder cannot be read. */
name_list scenes_of_folder(const char *folder);

/* Recently opened scenes, the last one first. They are read from $XDG_STATE_HOME/mangata/recent; the default of the variable is ~/.local/state. */
name_list recent_scenes(void);

/* Puts a scene at the front of that list, a file by its absolute path. If the list cannot be written, it stays as it is. */
void recent_add(const char *path);

/* Whether a name has the ending of a scene file, or of a model. */
bool is_scene_name(const char *name);
bool is_model_name(const char *name);

#endif
