/* SPDX-License-Identifier: MIT
 * Undo and redo: a list of states of everything that the user changes. */
#ifndef MANGATA_VIEWER_SCENE_HISTORY_H
#define MANGATA_VIEWER_SCENE_HISTORY_H

#include "viewer/scene/document.h"
#include "viewer/scene/settings.h"

/* A step of undo: the scene and the settings at one time. */
typedef struct history_state {
    scene_source *source; /* a share of it, because opening another scene is a step, too */
    scene_values values;  /* owned */
    settings settings;
} history_state;

typedef struct history {
    history_state *states; /* owned, the oldest one first; the oldest ones are dropped if there are too many */
    size_t count, capacity;
    size_t at; /* index of the state that is shown */
} history;

/* Drops all states and begins with this one. False: out of memory; the history is then empty and takes no states. */
bool history_start(history *h, const document *shown, const settings *chosen);
void history_free(history *h);

/* Whether the state that is shown has these values. */
bool history_is_current(const history *h, const document *shown, const settings *chosen);

/* Adds a state behind the one that is shown, and drops those that have been undone. False: it equals the one that is shown, or memory has run out. */
bool history_add(history *h, const document *shown, const settings *chosen);

/* Sets the clock and the camera of the state that is shown. What moves by itself makes no step. */
void history_follow(history *h, double time, const mgt_camera *camera);

/* Moves to the state before (`by` is -1) or behind (1) the one that is shown. Returns it, or NULL if there is none. */
const history_state *history_step(history *h, int by);

#endif
