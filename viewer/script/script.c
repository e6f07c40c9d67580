/* SPDX-License-Identifier: MIT
 * The engine of scripts: it runs the commands of a file line by line, and lets frames pass while a command waits. */
#include <GLFW/glfw3.h>

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/progress.h"
#include "params/methods.h"
#include "viewer/script/script_state.h"

enum { VARY_TRIES = 6 }; /* values that the command vary tries before it fails */

script *script_open(const char *path)
{
    script *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->path = path;
    s->chance = 1;
    s->stream = strcmp(path, "-") == 0 ? stdin : fopen(path, "r");
    if (s->stream)
        return s;
    free(s);
    return NULL;
}

void script_close(script *s)
{
    if (!s)
        return;
    if (s->stream != stdin)
        fclose(s->stream);
    free(s->mark.bytes);
    free(s->before.bytes);
    free(s->after.bytes);
    free(s->values_before);
    free(s->values_after);
    free(s);
}

void script_fail(viewer *v, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fprintf(stderr, "%s:%d: %s\n", v->script->path, v->script->line, text);
    v->exit_code = 1;
    v->quit = true;
}

/* ---- waiting ---- */

void script_wait(script *s, int frames) { s->frames_left = frames; }

void script_settle(script *s, uint64_t samples)
{
    s->frames_left = 2;
    s->settling = true;
    s->samples = samples;
    s->give_up_at = seconds_now() + 120;
}

void script_capture(script *s, capture what)
{
    script_settle(s, 1);
    s->capture = what;
}

/* ---- words ---- */

/* Splits the line into at most `most` words. Word number `most` is the rest of the line. */
static void split(script *s, int most)
{
    char *p = s->text;
    s->count = 0;
    while (s->count < most) {
        p += strspn(p, " \t");
        if (!*p)
            break;
        s->words[s->count++] = p;
        if (s->count == most)
            break;
        p += strcspn(p, " \t");
        if (*p)
            *p++ = 0;
    }
    for (int i = s->count; i <= WORDS; i++)
        s->words[i] = NULL;
}

/* ---- going on ---- */

/* Reads the next line that is neither empty nor a comment. False: the file has ended. */
static bool read_line(script *s)
{
    while (fgets(s->text, sizeof s->text, s->stream)) {
        s->line++;
        s->text[strcspn(s->text, "\r\n")] = 0;
        if (s->text[strspn(s->text, " \t")] && s->text[strspn(s->text, " \t")] != '#')
            return true;
    }
    return false;
}

static void run_line(viewer *v)
{
    script *s = v->script;
    const char *start = s->text + strspn(s->text, " \t");
    const size_t length = strcspn(start, " \t");
    for (size_t i = 0; i < script_command_count; i++) {
        const script_command *c = &script_commands[i];
        if (strlen(c->name) != length || memcmp(c->name, start, length) != 0)
            continue;
        split(s, c->most);
        if (s->count < c->least)
            script_fail(v, "%s: %d words more are needed", c->name, c->least - s->count);
        else
            c->run(v);
        return;
    }
    script_fail(v, "unknown command %.*s", (int)length, start);
}

/* Moves the pointer by one frame of the drag. */
static void step_drag(viewer *v)
{
    script *s = v->script;
    const double fraction = s->drag_at <= 1 ? 0 : s->drag_at - 1 < s->drag_frames ? (double)(s->drag_at - 1) / s->drag_frames : 1;
    const double x = (double)s->drag_from[0] + fraction * (double)(s->drag_to[0] - s->drag_from[0]);
    const double y = (double)s->drag_from[1] + fraction * (double)(s->drag_to[1] - s->drag_from[1]);
    v->stand_in.x = (float)x;
    v->stand_in.y = (float)y;
    input_pointer(v, x, y);
    /* In the first frame the panels get the pointer's place. The button goes down in the second one. */
    if (s->drag_at == 1) {
        v->stand_in.down[s->drag_button] = true;
        input_button(v, s->drag_button, GLFW_PRESS, 0);
    }
    if (s->drag_at > s->drag_frames) {
        v->stand_in.down[s->drag_button] = false;
        input_button(v, s->drag_button, GLFW_RELEASE, 0);
        s->dragging = false;
    }
    s->drag_at++;
}

/* Sets a random control to a random value. */
static void step_random(viewer *v)
{
    script *s = v->script;
    char error[VIEWER_TEXT];
    size_t count;
    control *list = control_list(&v->board, &count);
    if (!list)
        return;
    const size_t length = strlen(s->spared);
    const control *c;
    do
        c = &list[(size_t)(random_fraction(&s->chance) * (double)count)];
    while (length > 0 && strncmp(c->name, s->spared, length) == 0);
    const control_text value = control_random(c, &s->chance);
    /* A value may be refused, because some values exclude each other. */
    if (!control_set(&v->board, c->name, value.text, error, sizeof error))
        viewer_log(v, "refused: %s", error);
    free(list);
    s->random_left--;
    script_wait(s, 1);
}

/* Prints the figures if they are against as many samples as the command asks for. False: they are not yet. */
static bool take_judgement(viewer *v)
{
    static const char letters[] = {'A', 'B'};
    const judging *state = &v->judging;
    if (!state->has_found || state->found.samples < v->script->judging) {
        if (seconds_now() > v->script->give_up_at)
            script_fail(v, "there is no judgement after ten minutes");
        glfwWaitEventsTimeout(0.02); /* leaves the processor to the judge */
        return false;
    }
    for (int side = 0; side < SIDE_COUNT; side++)
        printf("judge %c: error %.5f, FLIP %.5f, flicker %.5f, against %u samples, noise %.5f\n", letters[side], state->found.sides[side].error,
               state->found.sides[side].flip, state->found.sides[side].flicker, state->found.samples, state->found.noise);
    v->script->judging = 0;
    return true;
}

/* Whether the next command has to wait. Fails the script if it has waited too long. */
static bool is_waiting(viewer *v)
{
    script *s = v->script;
    if (s->held_left > 0 && --s->held_left == 0)
        input_key(v, s->held_key, s->held_key, GLFW_RELEASE, s->held_modifiers);
    if (s->frames_left > 0) {
        s->frames_left--;
        return true;
    }
    if (s->saving && viewer_watch_saver(v))
        return true;
    if (s->saving && v->film_export)
        return true;
    if (s->saving && v->save_problem[0])
        script_fail(v, "%s", v->save_problem);
    s->saving = false;
    if (s->settling && !viewer_is_settled(v, s->samples)) {
        if (seconds_now() > s->give_up_at)
            script_fail(v, "the picture is not done after two minutes");
        return true;
    }
    s->settling = false;
    if (s->judging > 0 && !take_judgement(v))
        return true;
    if (s->waiting_reload && s->words[0] && strcmp(s->words[0], "wait-reload") == 0) {
        const struct stat *a = &s->reload_stamp, *b = &v->document.source->stamp;
        if (a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec && a->st_size == b->st_size) {
            if (seconds_now() > s->give_up_at)
                script_fail(v, "the scene has not been read again");
            return true;
        }
        s->waiting_reload = false;
    }
    return s->capture != CAPTURE_NONE; /* a capture waits until the frame is drawn */
}

void script_step(viewer *v)
{
    script *s = v->script;
    v->stand_in.active = true;
    if (s->dragging)
        step_drag(v);
    while (!v->quit && !is_waiting(v)) {
        if (s->random_left > 0)
            step_random(v);
        else if (read_line(s)) {
            viewer_keep_step(v, false); /* what the command before has changed is a step of its own */
            run_line(v);
        } else
            v->quit = true;
    }
}

/* ---- pixels ---- */

static window_pixels read_pixels(viewer *v)
{
    window_pixels p = {0};
    p.bytes = viewer_read_window(v, &p.width, &p.height);
    if (!p.bytes)
        script_fail(v, "the window's pixels cannot be read");
    return p;
}

static bool same_pixels(const window_pixels *a, const window_pixels *b)
{
    return a->bytes && b->bytes && a->width == b->width && a->height == b->height && memcmp(a->bytes, b->bytes, (size_t)a->width * a->height * 4) == 0;
}

static void keep_pixels(window_pixels *to, window_pixels from)
{
    free(to->bytes);
    *to = from;
}

/* ---- a control changed, undone and redone ---- */

/* The values of all controls, one per line. The caller frees the text. NULL: out of memory. */
static char *all_values(const viewer *v)
{
    size_t count, size;
    char *text = NULL;
    control *list = control_list(&v->board, &count);
    FILE *stream = list ? open_memstream(&text, &size) : NULL;
    for (size_t i = 0; stream && i < count; i++)
        fprintf(stream, "%s=%s\n", list[i].name, control_print(&list[i]).text);
    free(list);
    if (stream && fclose(stream) == 0)
        return text;
    free(text);
    return NULL;
}

static void keep_values(const viewer *v, char **to)
{
    free(*to);
    *to = all_values(v);
}

static void expect_values(viewer *v, const char *expected, const char *what)
{
    char *now = all_values(v);
    if (!now || !expected || strcmp(now, expected) != 0)
        script_fail(v, "%s: %s, the controls have other values than before", v->script->vary_name, what);
    free(now);
}

/* Whether all sides that are shown have at most 16 samples. */
static bool has_few_samples(const viewer *v)
{
    bool few = true;
    for (int side = 0; side < SIDE_COUNT; side++) {
        const mgt_quality *q = &v->settings.sides[side];
        const bool seen = side == SIDE_A || v->settings.view.compare != COMPARE_OFF;
        few &= !seen || !method_is_sampled(q->method) || (uint64_t)q->spatial_samples * q->spatial_samples * q->time_samples <= 16;
    }
    return few;
}

/* Pictures of few samples are only compared when all samples are there. Those of many samples would take too long. */
void script_capture_vary(viewer *v, capture what)
{
    script_capture(v->script, what);
    v->script->samples = has_few_samples(v) ? 0 : 1;
}

static void expect_pixels(viewer *v, const window_pixels *expected, const window_pixels *now, const char *what)
{
    if (has_few_samples(v) && !same_pixels(expected, now))
        script_fail(v, "%s: %s, the window has other pixels than before", v->script->vary_name, what);
}

static void try_other_value(viewer *v)
{
    script *s = v->script;
    char error[VIEWER_TEXT];
    control c;
    if (!control_find(&v->board, s->vary_name, &c))
        return;
    if (!control_set(&v->board, s->vary_name, control_random(&c, &s->chance).text, error, sizeof error))
        viewer_log(v, "refused: %s", error);
    viewer_keep_step(v, true);
    s->vary_tries++;
    script_capture_vary(v, CAPTURE_VARY_AFTER);
}

static void undo_to(viewer *v, size_t step)
{
    while (v->history.at > step && viewer_undo(v, -1))
        continue;
}

/* Goes on with the command vary after a capture. Takes ownership of `now`. */
static void go_on_varying(viewer *v, capture what, window_pixels now)
{
    script *s = v->script;
    switch (what) {
    case CAPTURE_VARY_BEFORE:
        keep_pixels(&s->before, now);
        keep_values(v, &s->values_before);
        try_other_value(v);
        return;
    case CAPTURE_VARY_AFTER:
        keep_pixels(&s->after, now);
        keep_values(v, &s->values_after);
        if (!same_pixels(&s->before, &s->after)) {
            if (v->history.at == s->vary_step)
                script_fail(v, "%s: its change is no step", s->vary_name);
            undo_to(v, s->vary_step);
            script_capture_vary(v, CAPTURE_VARY_UNDONE);
        } else if (s->vary_tries < VARY_TRIES) {
            undo_to(v, s->vary_step);
            try_other_value(v);
        } else {
            script_fail(v, "%s: no value changes what is seen", s->vary_name);
        }
        return;
    case CAPTURE_VARY_UNDONE:
        expect_values(v, s->values_before, "undone");
        expect_pixels(v, &s->before, &now, "undone");
        viewer_undo(v, 1);
        script_capture_vary(v, CAPTURE_VARY_REDONE);
        break;
    case CAPTURE_VARY_REDONE:
        expect_values(v, s->values_after, "redone");
        expect_pixels(v, &s->after, &now, "redone");
        undo_to(v, s->vary_step);
        break;
    case CAPTURE_NONE:
    case CAPTURE_FILE:
    case CAPTURE_MARK:
    case CAPTURE_CHANGE:
    case CAPTURE_SAME:
        break;
    }
    free(now.bytes);
}

void script_after_frame(viewer *v)
{
    script *s = v->script;
    char error[VIEWER_TEXT];
    const GLenum gl_error = v->gl_functions.GetError();
    if (gl_error != GL_NO_ERROR) {
        script_fail(v, "OpenGL error 0x%04x", gl_error);
        return;
    }
    if (s->capture == CAPTURE_NONE || s->frames_left > 0 || (s->settling && !viewer_is_settled(v, s->samples)))
        return;
    const capture what = s->capture;
    s->capture = CAPTURE_NONE;
    s->settling = false;
    if (what == CAPTURE_FILE) {
        if (!viewer_save_window(v, s->file, error, sizeof error))
            script_fail(v, "%s", error);
        return;
    }
    window_pixels now = read_pixels(v);
    switch (what) {
    case CAPTURE_MARK:
        keep_pixels(&s->mark, now);
        break;
    case CAPTURE_CHANGE:
    case CAPTURE_SAME:
        if (same_pixels(&s->mark, &now) != (what == CAPTURE_SAME))
            script_fail(v, what == CAPTURE_SAME ? "the window looks other than at the mark" : "the window looks as at the mark");
        free(now.bytes);
        break;
    case CAPTURE_VARY_BEFORE:
    case CAPTURE_VARY_AFTER:
    case CAPTURE_VARY_UNDONE:
    case CAPTURE_VARY_REDONE:
        go_on_varying(v, what, now);
        break;
    case CAPTURE_NONE:
    case CAPTURE_FILE:
        free(now.bytes);
        break;
    }
}
