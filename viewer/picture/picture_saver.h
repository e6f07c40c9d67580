/* SPDX-License-Identifier: MIT
 * Renders pictures into files in the background, one at a time, in a context of its own. */
#ifndef MANGATA_VIEWER_PICTURE_PICTURE_SAVER_H
#define MANGATA_VIEWER_PICTURE_PICTURE_SAVER_H

#include "mangata/mangata.h"

struct scene_models;

typedef struct picture_saver picture_saver;

/* Creates a saver whose context is created by `desc`. It calls `wake` on another thread when a picture is done. Returns NULL when out of memory. */
picture_saver *picture_saver_create(const mgt_context_desc *desc, void (*wake)(void));

/* Stops the rendering, which leaves no unfinished file, and frees the saver. NULL is allowed. */
void picture_saver_destroy(picture_saver *s);

/* Starts on a copy of the scene, whose objects belong to `models`. `path` ends in .png (displayed colour) or .exr (every layer). False with the reason in `error`. */
bool picture_saver_start(picture_saver *s, const mgt_scene *scene, struct scene_models *models, const char *path, char *error, size_t error_size);

typedef enum picture_saver_state { SAVER_IDLE, SAVER_BUSY, SAVER_SAVED, SAVER_FAILED } picture_saver_state;

/* The state of the saver. SAVER_SAVED and SAVER_FAILED are returned once, with the path or the reason in `text`. With SAVER_BUSY *fraction is the part that is
 * done, in [0, 1]. */
picture_saver_state picture_saver_poll(picture_saver *s, char *text, size_t size, double *fraction);

#endif
