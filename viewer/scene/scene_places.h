/* SPDX-License-Identifier: MIT
 * Sources of scenes: seas in a few words, scenes that come with the program, recently opened scenes, files of a folder. */
#ifndef MANGATA_VIEWER_SCENE_SCENE_PLACES_H
#define MANGATA_VIEWER_SCENE_SCENE_PLACES_H

#include <stdbool.h>
#include <stddef.h>

/* A sea in a few words, to be opened as "--sea WORDS". */
typedef struct sea_preset {
    const char *name, *path;
} sea_preset;

extern const sea_preset sea_presets[];
extern const size_t sea_preset_count;

/* Paths or names, sorted; owned. */
typedef struct name_list {
    char **names;
    size_t count;
} name_list;

void name_list_free(name_list *list);

/* The folder of the scenes that come with the program, to be freed; NULL where it is missing. */
char *shipped_folder(void);

/* The names of a folder's scene files (.yaml, .yml, .json) and, with "/" behind them, of its folders, ".." first. Empty where it cannot be read. */
name_list scenes_of_folder(const char *folder);

/* Recently opened scenes, the last one first. They are read from $XDG_STATE_HOME/mangata/recent; the default of the variable is ~/.local/state. */
name_list recent_scenes(void);

/* Puts a path first among them; files by their whole path. What cannot be written is not remembered. */
void recent_add(const char *path);

/* Whether the name ends as those of scene files, or of models, do. */
bool is_scene_name(const char *name);
bool is_model_name(const char *name);

#endif
