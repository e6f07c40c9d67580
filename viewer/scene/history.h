/* SPDX-License-Identifier: MIT
 * Undo and redo: one list of states of everything that a person changes. */
#ifndef MANGATA_VIEWER_SCENE_HISTORY_H
#define MANGATA_VIEWER_SCENE_HISTORY_H

#include "viewer/scene/document.h"
#include "viewer/scene/settings.h"

typedef struct history_state {
    scene_source *source; /* a share: opening another scene is a step, too */
    scene_values values;  /* owned */
    settings settings;
} history_state;

typedef struct history {
    history_state *states; /* owned, the oldest first; the oldest ones are dropped when there are many */
    size_t count, capacity;
    size_t at; /* the one that is shown */
} history;

/* Forgets all and begins with this state. False when memory runs out; the history is then empty and takes no states. */
bool history_start(history *h, const document *shown, const settings *chosen);
void history_free(history *h);

/* Whether the state that is shown is this one. */
bool history_is_current(const history *h, const document *shown, const settings *chosen);

/* Adds the state behind the one that is shown, in place of those that had been undone. False when it is the one that is shown, or memory runs out. */
bool history_add(history *h, const document *shown, const settings *chosen);

/* What moves by itself is no step: clock and camera of the state that is shown become these. */
void history_follow(history *h, double time, const mgt_camera *camera);

/* Moves by -1 or 1. The state that is shown then, or NULL where there is none. */
const history_state *history_step(history *h, int by);

#endif
