/* SPDX-License-Identifier: MIT
 * Films and numbered pictures by the command itself, `mangata render`, as a process of its own: what it writes is what the command writes, whole or not at all. */
#ifndef MANGATA_VIEWER_PICTURE_FILM_EXPORT_H
#define MANGATA_VIEWER_PICTURE_FILM_EXPORT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct film_export film_export;

/* Starts the command, beside this program or else on the PATH, on a scene of this text; `words` follow "mangata render -" and end with NULL. NULL on failure,
 * with the reason in `error`. */
film_export *film_export_start(const char *scene, size_t scene_size, const char *const *words, char *error, size_t error_size);

/* Stops it; nothing unfinished is left behind. NULL is allowed. */
void film_export_destroy(film_export *f);

typedef enum film_state { FILM_BUSY, FILM_SAVED, FILM_FAILED } film_state;

/* Does not wait. *fraction of the whole is done; FAILED: the reason is in `error`. */
film_state film_export_poll(film_export *f, double *fraction, char *error, size_t error_size);

#endif
