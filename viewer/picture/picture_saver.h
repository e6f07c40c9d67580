/* SPDX-License-Identifier: MIT
 * Pictures rendered into files in the background, one at a time, by a context of their own. */
#ifndef MANGATA_VIEWER_PICTURE_PICTURE_SAVER_H
#define MANGATA_VIEWER_PICTURE_PICTURE_SAVER_H

#include "mangata/mangata.h"

struct scene_models;

typedef struct picture_saver picture_saver;

/* NULL when memory runs out. `desc` names the machine's part of the context; `wake` is called on another thread when a picture is done. */
picture_saver *picture_saver_create(const mgt_context_desc *desc, void (*wake)(void));

/* Stops what is under way; nothing unfinished is left behind. NULL is allowed. */
void picture_saver_destroy(picture_saver *s);

/* Starts on a copy of the scene, whose objects belong to `models`. `path` ends in .png (displayed colour) or .exr (every layer). False with the reason in `error`. */
bool picture_saver_start(picture_saver *s, const mgt_scene *scene, struct scene_models *models, const char *path, char *error, size_t error_size);

typedef enum picture_saver_state { SAVER_IDLE, SAVER_BUSY, SAVER_SAVED, SAVER_FAILED } picture_saver_state;

/* SAVED and FAILED are told once, with the path or the reason in `text`; while BUSY *fraction says how far it is. */
picture_saver_state picture_saver_poll(picture_saver *s, char *text, size_t size, double *fraction);

#endif
