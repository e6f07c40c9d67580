/* SPDX-License-Identifier: MIT
 * The commands of scripts; docs/viewer.md describes them. */
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "cli/common/progress.h"
#include "viewer/scene/camera_moves.h"
#include "viewer/script/script_state.h"

/* Reads word number `word` as a number. False: it is none, and the script has failed. */
static bool number_at(viewer *v, int word, double *number)
{
    const script *s = v->script;
    if (word < s->count && number_parse_double(s->words[word], number))
        return true;
    script_fail(v, "%s: word %d must be a number", s->words[0], word + 1);
    return false;
}

/* Reads the first `count` words after the command as numbers. False: one is none, and the script has failed. */
static bool numbers_at(viewer *v, int count, double *numbers)
{
    for (int i = 0; i < count; i++)
        if (!number_at(v, 1 + i, &numbers[i]))
            return false;
    return true;
}

/* ---- commands ---- */

static void do_set(viewer *v)
{
    char error[VIEWER_TEXT];
    const script *s = v->script;
    if (!control_set(&v->board, s->words[1], s->words[2], error, sizeof error))
        script_fail(v, "%s", error);
}

static void do_expect_refused(viewer *v)
{
    char error[VIEWER_TEXT];
    const script *s = v->script;
    if (control_set(&v->board, s->words[1], s->words[2], error, sizeof error))
        script_fail(v, "%s=%s was accepted", s->words[1], s->words[2]);
    else
        printf("%s\n", error);
}

/* Numbers that are computed from what is kept, such as a wavelength from a wave vector, differ by rounding from those that were set. */
static bool same_value(const char *value, const char *expected)
{
    double a, b;
    return strcmp(value, expected) == 0 || (number_parse_double(value, &a) && number_parse_double(expected, &b) && fabs(a - b) <= 1e-12 * fabs(b));
}

static void do_expect_value(viewer *v)
{
    const script *s = v->script;
    control c;
    if (!control_find(&v->board, s->words[1], &c))
        script_fail(v, "no control %s", s->words[1]);
    else if (!same_value(control_print(&c).text, s->words[2]))
        script_fail(v, "%s is %s instead of %s", s->words[1], control_print(&c).text, s->words[2]);
}

static void do_press(viewer *v)
{
    int modifiers;
    if (key_from_name(v->script->words[1], &modifiers) < 0)
        script_fail(v, "no key %s", v->script->words[1]);
    else
        input_press_key(v, v->script->words[1]);
    script_wait(v->script, 1);
}

static void do_hold(viewer *v)
{
    script *s = v->script;
    double frames;
    if (!number_at(v, 2, &frames))
        return;
    s->held_key = key_from_name(s->words[1], &s->held_modifiers);
    if (s->held_key < 0) {
        script_fail(v, "no key %s", s->words[1]);
        return;
    }
    input_key(v, s->held_key, s->held_key, GLFW_PRESS, s->held_modifiers);
    s->held_left = (int)frames;
    script_wait(s, (int)frames + 1);
}

static void do_drag(viewer *v)
{
    script *s = v->script;
    double n[4];
    if (!numbers_at(v, 4, n))
        return;
    const char *button = s->words[5] ? s->words[5] : "left";
    s->drag_button = strcmp(button, "right") == 0 ? GLFW_MOUSE_BUTTON_RIGHT : strcmp(button, "middle") == 0 ? GLFW_MOUSE_BUTTON_MIDDLE : GLFW_MOUSE_BUTTON_LEFT;
    for (int i = 0; i < 2; i++) {
        s->drag_from[i] = (float)n[i];
        s->drag_to[i] = (float)n[2 + i];
    }
    s->dragging = true;
    s->drag_at = 0;
    s->drag_frames = 8;
    script_wait(s, s->drag_frames + 4);
}

static void do_pointer(viewer *v)
{
    double n[2];
    if (!numbers_at(v, 2, n))
        return;
    v->stand_in.x = (float)n[0];
    v->stand_in.y = (float)n[1];
    input_pointer(v, n[0], n[1]);
    script_wait(v->script, 2);
}

static void do_scroll(viewer *v)
{
    double n[3];
    if (!numbers_at(v, 3, n))
        return;
    const bool magnifies = v->script->words[4] && strcmp(v->script->words[4], "ctrl") == 0;
    input_pointer(v, n[0], n[1]);
    input_scroll(v, n[2], magnifies ? GLFW_MOD_CONTROL : 0);
    script_wait(v->script, 1);
}

static void do_wipe(viewer *v)
{
    static const char *const names[] = {"a.method", "b.method", "view.wipe", "view.compare"};
    char error[VIEWER_TEXT];
    const char *const values[] = {v->script->words[1], v->script->words[2], v->script->words[3], "wipe"};
    for (int i = 0; i < 4 && !v->quit; i++)
        if (!control_set(&v->board, names[i], values[i], error, sizeof error))
            script_fail(v, "%s", error);
}

static void do_frames(viewer *v)
{
    double frames;
    if (number_at(v, 1, &frames))
        script_wait(v->script, (int)frames);
}

static void do_settle(viewer *v)
{
    double samples = 0;
    if (v->script->count > 1 && !number_at(v, 1, &samples))
        return;
    script_settle(v->script, (uint64_t)samples);
}

static void do_screenshot(viewer *v)
{
    snprintf(v->script->file, sizeof v->script->file, "%s", v->script->words[1]);
    script_capture(v->script, CAPTURE_FILE);
}

static void do_picture(viewer *v)
{
    char error[VIEWER_TEXT];
    uint64_t side[2] = {0, 0};
    const script *s = v->script;
    if (s->words[2] && !number_parse_list(s->words[2], 'x', MGT_MAX_IMAGE_SIDE, 2, side))
        script_fail(v, "picture: %s is no size; allowed is WxH", s->words[2]);
    else if (!viewer_save_picture(v, s->words[1], (uint32_t)side[0], (uint32_t)side[1], error, sizeof error))
        script_fail(v, "%s", error);
    else
        v->script->saving = true;
}

static void do_open(viewer *v)
{
    char error[VIEWER_TEXT];
    if (!viewer_open(v, v->script->words[1], error, sizeof error))
        script_fail(v, "%s", error);
}

static void do_drop(viewer *v) { viewer_drop(v, v->script->words[1]); }

static void do_film(viewer *v)
{
    char error[VIEWER_TEXT];
    double range[2];
    uint64_t size[2] = {0, 0};
    const script *s = v->script;
    film_choice *c = &v->film;
    if (!number_at(v, 2, &range[0]) || !number_at(v, 3, &range[1]))
        return;
    if (s->words[4] && !number_parse_list(s->words[4], 'x', MGT_MAX_IMAGE_SIDE, 2, size)) {
        script_fail(v, "film: %s is no size; allowed is WxH", s->words[4]);
        return;
    }
    snprintf(c->name, sizeof c->name, "%s", s->words[1]);
    if (!film_take_kind(v)) {
        script_fail(v, "film: %s ends in none of .mp4, .mov, .y4m, .png and .exr", s->words[1]);
        return;
    }
    c->first = (uint32_t)range[0];
    c->last = (uint32_t)range[1];
    c->size[0] = (uint32_t)size[0];
    c->size[1] = (uint32_t)size[1];
    v->script->saving = film_begin(v, error, sizeof error);
    if (!v->script->saving)
        script_fail(v, "%s", error);
}

/* Waits for the judge, and prints its figures. */
static void do_judge(viewer *v)
{
    double samples;
    if (!number_at(v, 1, &samples))
        return;
    script_settle(v->script, 1);
    v->settings.panel.judge = 1;
    v->script->judging = (uint32_t)fmax(samples, 2);
    v->script->give_up_at = seconds_now() + 600; /* long, because the judge has a low priority */
}

static void do_lose_renderer(viewer *v) { viewer_lose_gl(v, "the script took it away"); }

static void do_command(viewer *v)
{
    char *text = viewer_command(v);
    if (text)
        printf("%s\n", text);
    else
        script_fail(v, "out of memory");
    free(text);
}

static void do_save_scene(viewer *v)
{
    char error[VIEWER_TEXT];
    if (!viewer_save_scene(v, v->script->words[1], error, sizeof error))
        script_fail(v, "%s", error);
}

/* Copies the content of a file to another one. */
static void do_copy(viewer *v)
{
    const script *s = v->script;
    FILE *from = fopen(s->words[1], "rb"), *to = from ? fopen(s->words[2], "wb") : NULL;
    char block[4096];
    bool good = from && to;
    for (size_t n; good && (n = fread(block, 1, sizeof block, from)) > 0;)
        good = fwrite(block, 1, n, to) == n;
    if (from)
        fclose(from);
    if (to)
        good &= fclose(to) == 0;
    if (!good)
        script_fail(v, "%s cannot be copied to %s", s->words[1], s->words[2]);
    v->script->waiting_reload = true;
    v->script->reload_stamp = v->document.source->stamp;
}

static void do_wait_reload(viewer *v)
{
    v->script->give_up_at = seconds_now() + 10;
    script_wait(v->script, 1);
}

const char *script_any_error(const viewer *v)
{
    if (v->scene_error.text[0])
        return v->scene_error.text;
    return v->shader_error.text[0] ? v->shader_error.text : v->render_error.text;
}

static void do_expect_error(viewer *v)
{
    if (!strstr(script_any_error(v), v->script->words[1]))
        script_fail(v, "no error with \"%s\"; the error is \"%s\"", v->script->words[1], script_any_error(v));
}

static void do_expect_no_error(viewer *v)
{
    if (script_any_error(v)[0])
        script_fail(v, "there is an error: %s", script_any_error(v));
}

static void do_mark(viewer *v) { script_capture(v->script, CAPTURE_MARK); }

static void do_expect_change(viewer *v) { script_capture(v->script, CAPTURE_CHANGE); }

static void do_expect_same(viewer *v) { script_capture(v->script, CAPTURE_SAME); }

/* ---- movements of the camera ---- */

static double aspect_of(const viewer *v) { return (double)v->place.place.width / (double)v->place.place.height; }

static void do_mark_point(viewer *v)
{
    double n[2], at[2], middle[2];
    if (!numbers_at(v, 2, n))
        return;
    input_fraction(v, n[0], n[1], at);
    if (!viewer_point_at(v, at, v->script->point, middle))
        script_fail(v, "mark-point: no water is seen there");
}

static void do_expect_point(viewer *v)
{
    double n[3], at[2], pointer[2];
    if (!numbers_at(v, 3, n))
        return;
    const mgt_camera *camera = viewer_free_camera(v);
    const ui_rect *place = &v->place.place;
    input_fraction(v, n[0], n[1], pointer);
    if (!camera_project(camera, aspect_of(v), v->script->point, at)) {
        script_fail(v, "expect-point: the marked point lies behind the camera");
        return;
    }
    const double off = hypot((at[0] - pointer[0]) * (double)place->width, (at[1] - pointer[1]) * (double)place->height);
    printf("point: %.2f pixels from %g, %g\n", off, n[0], n[1]);
    if (!(off <= n[2]))
        script_fail(v, "expect-point: the marked point is %.2f pixels off; allowed is %g", off, n[2]);
}

static void do_mark_camera(viewer *v)
{
    mgt_camera *camera = viewer_free_camera(v);
    camera_set_pivot(camera, v->document.values.water.level);
    v->script->camera = *camera;
}

/* Checks the angle between the directions from the pivot to the marked camera and to the present one, in degrees per pixel of the drag, and that the distance
 * has not changed. */
static void do_expect_orbit(viewer *v)
{
    double n[2], dot = 0, length[2] = {0, 0};
    if (!numbers_at(v, 2, n))
        return;
    const mgt_camera *old = &v->script->camera, *now = viewer_free_camera(v);
    for (int i = 0; i < 3; i++) {
        const double a = old->position[i] - old->target[i], b = now->position[i] - now->target[i];
        dot += a * b;
        length[0] += a * a;
        length[1] += b * b;
    }
    const double cosine = dot / sqrt(length[0] * length[1]), angle = acos(fmin(fmax(cosine, -1), 1)) * 180 / 3.14159265358979323846;
    const double farther = sqrt(length[1] / length[0]) - 1;
    printf("orbit: %.3f degrees a pixel, distance %.6f m, changed by %.1e of it\n", angle / n[0], sqrt(length[1]), farther);
    if (!(angle / n[0] <= n[1] && angle > 0 && fabs(farther) < 1e-6))
        script_fail(v, "expect-orbit: %.3f degrees a pixel, and the distance changed by %.1e of it; allowed are up to %g and 0", angle / n[0], farther, n[1]);
}

static void do_vary(viewer *v)
{
    script *s = v->script;
    control c;
    if (!control_find(&v->board, s->words[1], &c)) {
        script_fail(v, "no control %s", s->words[1]);
        return;
    }
    snprintf(s->vary_name, sizeof s->vary_name, "%s", s->words[1]);
    s->vary_tries = 0;
    viewer_keep_step(v, true);
    s->vary_step = v->history.at;
    script_capture_vary(v, CAPTURE_VARY_BEFORE);
}

static void do_list_controls(viewer *v)
{
    size_t count;
    control *list = control_list(&v->board, &count);
    for (size_t i = 0; list && i < count; i++)
        printf("%s=%s\n", list[i].name, control_print(&list[i]).text);
    free(list);
}

static void do_inspect(viewer *v)
{
    double n[2];
    if (!numbers_at(v, 2, n))
        return;
    v->settings.inspect = (inspect_settings){(uint32_t)n[0], (uint32_t)n[1]};
    v->settings.panel.inspector = 1;
    v->inspection.valid = false;
    viewer_inspect(v);
    const mgt_pixel_info *i = &v->inspection.info;
    if (!v->inspection.valid)
        script_fail(v, "inspect: %s", script_any_error(v));
    else
        printf("{\"water\": %.9g, \"coverage\": %.9g, \"radiance\": [%.9g, %.9g, %.9g], \"distance\": %.9g, \"waves\": [%u, %u, %u]}\n", i->water, i->coverage,
               i->radiance[0], i->radiance[1], i->radiance[2], i->distance, i->resolved, i->mixed, i->filtered);
}

static void do_random(viewer *v)
{
    double n[2];
    if (!numbers_at(v, 2, n))
        return;
    v->script->random_left = (int)n[0];
    snprintf(v->script->spared, sizeof v->script->spared, "%s", v->script->words[3] ? v->script->words[3] : "");
    v->script->chance = (uint64_t)n[1] * 2 + 1;
}

static void do_memory(viewer *v)
{
    char line[256];
    FILE *stream = fopen("/proc/self/status", "r");
    if (!stream) {
        script_fail(v, "memory: /proc/self/status cannot be read");
        return;
    }
    while (fgets(line, sizeof line, stream))
        if (strncmp(line, "VmRSS:", 6) == 0)
            printf("memory %ld kB\n", strtol(line + 6, NULL, 10));
    fclose(stream);
}

static void do_timings(viewer *v)
{
    const mgt_image *image = &v->render.last.scene.image;
    printf("timings: %u x %u, render %.2f ms, window %.2f ms\n", image->width, image->height, (double)timing_median(&v->timings.render),
           (double)timing_median(&v->timings.window));
    v->timings = (timings){0};
}

static void do_resize(viewer *v)
{
    double n[2];
    if (!numbers_at(v, 2, n))
        return;
    glfwSetWindowSize(v->window, (int)n[0], (int)n[1]);
    script_wait(v->script, 6);
}

static void do_page(viewer *v)
{
    double n;
    if (number_at(v, 1, &n))
        v->open_tab = (int)n;
    script_wait(v->script, 2);
}

static void do_wave(viewer *v)
{
    const script *s = v->script;
    double n = 0;
    if (strcmp(s->words[1], "add") == 0)
        wave_add(v);
    else if (strcmp(s->words[1], "remove") == 0 && number_at(v, 2, &n))
        wave_remove(v, (size_t)n);
    else if (!v->quit)
        script_fail(v, "wave: allowed is add or remove INDEX");
}

static void do_undo(viewer *v)
{
    const bool redo = strcmp(v->script->words[0], "redo") == 0;
    if (!viewer_undo(v, redo ? 1 : -1))
        script_fail(v, "there is nothing to %s", v->script->words[0]);
}

static void do_revert(viewer *v) { viewer_revert(v); }

static void do_quit(viewer *v) { v->quit = true; }

const script_command script_commands[] = {
    {"set", 3, 3, do_set},
    {"expect-refused", 3, 3, do_expect_refused},
    {"expect-value", 3, 3, do_expect_value},
    {"press", 2, 2, do_press},
    {"hold", 3, 3, do_hold},
    {"drag", 5, 6, do_drag},
    {"pointer", 3, 3, do_pointer},
    {"scroll", 4, 5, do_scroll},
    {"wipe", 4, 4, do_wipe},
    {"frames", 2, 2, do_frames},
    {"settle", 1, 2, do_settle},
    {"screenshot", 2, 2, do_screenshot},
    {"picture", 2, 3, do_picture},
    {"open", 2, 2, do_open},
    {"drop", 2, 2, do_drop},
    {"film", 4, 5, do_film},
    {"judge", 2, 2, do_judge},
    {"lose-renderer", 1, 1, do_lose_renderer},
    {"command", 1, 1, do_command},
    {"save-scene", 2, 2, do_save_scene},
    {"copy", 3, 3, do_copy},
    {"wait-reload", 1, 1, do_wait_reload},
    {"expect-error", 2, 2, do_expect_error},
    {"expect-no-error", 1, 1, do_expect_no_error},
    {"mark", 1, 1, do_mark},
    {"expect-change", 1, 1, do_expect_change},
    {"expect-same", 1, 1, do_expect_same},
    {"mark-point", 3, 3, do_mark_point},
    {"expect-point", 4, 4, do_expect_point},
    {"mark-camera", 1, 1, do_mark_camera},
    {"expect-orbit", 3, 3, do_expect_orbit},
    {"vary", 2, 2, do_vary},
    {"list-controls", 1, 1, do_list_controls},
    {"inspect", 3, 3, do_inspect},
    {"random", 3, 4, do_random},
    {"memory", 1, 1, do_memory},
    {"timings", 1, 1, do_timings},
    {"resize", 3, 3, do_resize},
    {"page", 2, 2, do_page},
    {"wave", 2, 3, do_wave},
    {"undo", 1, 1, do_undo},
    {"redo", 1, 1, do_undo},
    {"revert", 1, 1, do_revert},
    {"quit", 1, 1, do_quit},
};
const size_t script_command_count = sizeof script_commands / sizeof script_commands[0];
