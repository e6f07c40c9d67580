/* SPDX-License-Identifier: MIT
 * Undo and redo. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/progress.h"
#include "viewer/app/viewer.h"

/* Seconds. Steps of the wheel that follow each other faster are one step of undo. */
static const double wheel_pause = 0.4;

/* Whether a key, a button, the wheel or a control is held, so that the change may go on. */
static bool is_held(const viewer *v)
{
    const bool *k = v->pointer.keys;
    return k[0] || k[1] || k[2] || k[3] || k[4] || k[5] || v->pointer.drag.kind != DRAG_NONE || ui_holds_item() ||
           seconds_now() - v->pointer.scrolled_at < wheel_pause;
}

void viewer_keep_step(viewer *v, bool all)
{
    if (!all && is_held(v))
        return;
    document_refresh(&v->document);
    history_add(&v->history, &v->document, &v->settings);
}

/* Writes the name of the first control in which two boards differ, and the number of the others. */
static void describe(const control_board *from, const control_board *to, char *text, size_t size)
{
    size_t counts[2], others = 0;
    control *left = control_list(from, &counts[0]), *right = control_list(to, &counts[1]);
    text[0] = 0;
    for (size_t i = 0; left && right && i < counts[0] && i < counts[1]; i++) {
        const bool same_name = strcmp(left[i].name, right[i].name) == 0;
        if (same_name && strcmp(control_print(&left[i]).text, control_print(&right[i]).text) == 0)
            continue;
        if (text[0])
            others++;
        else
            snprintf(text, size, "%s", left[i].name);
        if (!same_name) /* a list has another length: the controls after it have moved */
            break;
    }
    free(left);
    free(right);
    const size_t used = strlen(text);
    if (others > 0)
        snprintf(text + used, size - used, " and %zu more", others);
}

bool viewer_undo(viewer *v, int by)
{
    char what[96];
    const char *const word = by < 0 ? "undo" : "redo";
    viewer_keep_step(v, true);
    const history_state *state = history_step(&v->history, by);
    document there = {0};
    if (!state) {
        viewer_tell(v, "there is nothing to %s", word);
        return false;
    }
    if (!scene_values_copy(&there.values, &state->values)) {
        history_step(&v->history, -by);
        viewer_report(v, true, "out of memory");
        return false;
    }
    settings chosen = state->settings;
    if (state->source == v->document.source) {
        if (v->settings.clock.play && chosen.clock.play) /* a running clock is not set back */
            chosen.clock.time = v->settings.clock.time;
        const control_board other = {&there, &chosen};
        describe(&v->board, &other, what, sizeof what);
        document_replace(&v->document, &there.values);
    } else {
        snprintf(what, sizeof what, "scene %s", scene_source_name(state->source));
        there.source = scene_source_share(state->source);
        viewer_take_document(v, &there);
    }
    document_changed(&v->document, false); /* makes the sea again, so that an error of it is shown again */
    v->settings = chosen;
    history_follow(&v->history, chosen.clock.time, &v->document.values.camera.still);
    viewer_tell(v, "%s%s%s", word, what[0] ? ": " : "", what);
    return true;
}
