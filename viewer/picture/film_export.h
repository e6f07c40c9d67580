/* SPDX-License-Identifier: MIT
 * Exports films and numbered pictures by the command `mangata render` in a process of its own. So a file is the same as the command's, and it appears whole or
 * not at all. */
#ifndef MANGATA_VIEWER_PICTURE_FILM_EXPORT_H
#define MANGATA_VIEWER_PICTURE_FILM_EXPORT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct film_export film_export;

/* Starts the command with a scene of this text. The command is the one beside this program, or else that on the PATH. `words` follow "mangata render -" and end
 * with NULL. NULL: `error` says why it cannot be started. */
film_export *film_export_start(const char *scene, size_t scene_size, const char *const *words, char *error, size_t error_size);

/* Stops the command, which leaves no unfinished file, and frees the export. NULL is allowed. */
void film_export_destroy(film_export *f);

typedef enum film_state { FILM_BUSY, FILM_SAVED, FILM_FAILED } film_state;

/* The state of the export; does not wait. *fraction is the part that is done, in [0, 1]. After FILM_FAILED the reason is in `error`. */
film_state film_export_poll(film_export *f, double *fraction, char *error, size_t error_size);

#endif
