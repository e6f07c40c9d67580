/* SPDX-License-Identifier: MIT
 * The scene that is edited: loaded from a file that is watched for changes, changed, saved. */
#ifndef MANGATA_VIEWER_SCENE_DOCUMENT_H
#define MANGATA_VIEWER_SCENE_DOCUMENT_H

#include <sys/stat.h>

#include "image/file_error.h"
#include "scene/scene_edit.h"

/* The file of a scene. The document and the steps of undo share it. */
typedef struct scene_source {
    char *path;        /* owned */
    scene_file *file;  /* contents of the file when it was last read without an error */
    struct stat stamp; /* state of the file when it was last read */
    scene_error error; /* error of that reading; kind SCENE_ERROR_NONE: there was none */
    mgt_camera home;   /* the camera that "reset" goes back to */
    size_t shares;     /* number of owners */
} scene_source;

/* Add and remove an owner. Removing the last owner frees the source. NULL is allowed. */
scene_source *scene_source_share(scene_source *source);
void scene_source_release(scene_source *source);

typedef struct document {
    scene_source *source; /* shared with the steps of undo */
    scene_values values;  /* values of the scene with all changes */
    scene_error fault;    /* why sea or models cannot be made from the values; kind SCENE_ERROR_NONE: they can */
    bool stale;           /* true: sea and models have not been made from the present values yet */
} document;

/* Reads `path`, then changes it by `words` ("key=value"). False: *d is empty, and *error says why. */
bool document_open(document *d, const char *path, const char *const *words, size_t count, scene_error *error);
void document_close(document *d);

typedef enum document_news { DOCUMENT_SAME, DOCUMENT_READ_ANEW, DOCUMENT_BROKEN } document_news;

/* Reads the file again if it has changed on the disk. Changes of the user stay, except of values that have changed in the file. A file with an error changes
 * nothing but the source's `error`. */
document_news document_poll(document *d);

/* Reverts every change. Returns false when out of memory. */
bool document_revert(document *d);

/* Changes one value as `--set key=value` does, with every check. False: nothing has changed, and *error says why. */
bool document_set(document *d, const char *word, scene_error *error);

/* Must be called after waves, seas or, with `objects`, objects of `values` have been changed in place. If a wind makes the sea, it removes single waves and the
 * spectrum at once. */
void document_changed(document *d, bool objects);

/* Makes sea and models from the present values if they are stale. If that fails, `fault` says why, and the former ones stay. */
void document_refresh(document *d);

/* Replaces the values. Takes ownership of what `values` owns. */
void document_replace(document *d, scene_values *values);

/* Writes `values` as a scene file to `path`, whole or not at all, after reading it back in memory. Paths of
 * files in the folder of `path` or beside it are written relative to that. */
file_status document_save(const scene_values *values, const char *path, bool overwrite, file_error *error);

/* The file's name without its folder. */
const char *scene_source_name(const scene_source *source);

/* "FOLDER/NAME-edited.yaml" for the file "FOLDER/NAME.ext". */
void document_save_name(const document *d, char *name, size_t size);

#endif
