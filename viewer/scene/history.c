/* SPDX-License-Identifier: MIT
 * The steps of undo: a list of states, of which one is current. */
#include "viewer/scene/history.h"

#include <stdlib.h>
#include <string.h>

#include "scene/scene_edit.h"

enum { MOST_STATES = 500 }; /* the oldest state is dropped beyond that */

static bool settings_equal(const settings *a, const settings *b)
{
    bool equal = true;
    for (const field_row *part = settings_root_field()->fields; part->key && equal; part++)
        equal = fields_equal(part->fields, (const char *)a + part->offset, (const char *)b + part->offset);
    return equal;
}

static void state_free(history_state *state)
{
    scene_values_free(&state->values);
    scene_source_release(state->source);
}

/* Frees and removes the states [from, to). */
static void drop(history *h, size_t from, size_t to)
{
    for (size_t i = from; i < to; i++)
        state_free(&h->states[i]);
    memmove(h->states + from, h->states + to, (h->count - to) * sizeof *h->states);
    h->count -= to - from;
}

/* Appends a state and makes it the current one. False: out of memory, nothing has changed. */
static bool append(history *h, const document *shown, const settings *chosen)
{
    if (h->count == h->capacity) {
        const size_t capacity = h->capacity ? 2 * h->capacity : 16;
        history_state *states = realloc(h->states, capacity * sizeof *states);
        if (!states)
            return false;
        h->states = states;
        h->capacity = capacity;
    }
    history_state *state = &h->states[h->count];
    if (!scene_values_copy(&state->values, &shown->values))
        return false;
    state->source = scene_source_share(shown->source);
    state->settings = *chosen;
    h->at = h->count++;
    return true;
}

bool history_start(history *h, const document *shown, const settings *chosen)
{
    history_free(h);
    return append(h, shown, chosen);
}

void history_free(history *h)
{
    if (h->count > 0)
        drop(h, 0, h->count);
    free(h->states);
    *h = (history){0};
}

bool history_is_current(const history *h, const document *shown, const settings *chosen)
{
    const history_state *now = h->count > 0 ? &h->states[h->at] : NULL;
    return now && now->source == shown->source && settings_equal(&now->settings, chosen) && scene_values_equal(&now->values, &shown->values);
}

bool history_add(history *h, const document *shown, const settings *chosen)
{
    if (h->count == 0 || history_is_current(h, shown, chosen))
        return false;
    drop(h, h->at + 1, h->count);
    if (h->count == MOST_STATES) {
        drop(h, 0, 1);
        h->at--;
    }
    return append(h, shown, chosen);
}

void history_follow(history *h, double time, const mgt_camera *camera)
{
    if (h->count == 0)
        return;
    h->states[h->at].settings.clock.time = time;
    h->states[h->at].values.camera.still = *camera;
}

const history_state *history_step(history *h, int by)
{
    if (h->count == 0 || (by < 0 ? h->at == 0 : h->at + 1 >= h->count))
        return NULL;
    h->at += by < 0 ? (size_t)-1 : 1;
    return &h->states[h->at];
}
