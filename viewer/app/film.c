/* SPDX-License-Identifier: MIT
 * Film export: its part of the page Files, and the command that renders the film. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/progress.h"
#include "scene/scene_edit.h"
#include "viewer/app/panels.h"

static const float label_units = 8.2f; /* widths, in heights of the text */

typedef struct film_kind {
    const char *label, *ending, *codec; /* codec NULL: the kind has none */
    bool has_crf;
} film_kind;

static const film_kind kinds[] = {
    {"H.264 (.mp4)", ".mp4", "h264", true},       {"HEVC, 10 bits (.mp4)", ".mp4", "hevc", true}, {"ProRes 422 HQ (.mov)", ".mov", "prores", false},
    {"uncompressed (.y4m)", ".y4m", NULL, false}, {"pictures (.png)", "-####.png", NULL, false},  {"pictures (.exr)", "-####.exr", NULL, false},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* ---- sizes ---- */

typedef struct size_choice {
    const char *label;
    uint32_t width, height;
} size_choice;

static const size_choice sizes[] = {{"1280 x 720", 1280, 720},   {"1920 x 1080", 1920, 1080}, {"2560 x 1440", 2560, 1440},
                                    {"3840 x 2160", 3840, 2160}, {"2048 x 1080", 2048, 1080}, {"1080 x 1920", 1080, 1920}};
enum { SIZES = sizeof sizes / sizeof sizes[0], AS_WINDOW = 0, AS_SCENE, FIRST_SIZE };

void size_draw(viewer *v, const char *label, uint32_t size[2])
{
    char window[48], scene[48], other[48];
    const char *words[SIZES + 3] = {window, scene};
    const mgt_image *image = &v->document.values.image;
    int chosen = size[0] == 0 || size[1] == 0                          ? AS_WINDOW
                 : size[0] == image->width && size[1] == image->height ? AS_SCENE
                                                                       : FIRST_SIZE + SIZES,
        count = FIRST_SIZE;
    snprintf(window, sizeof window, "window, %u x %u", v->place.width, v->place.height);
    snprintf(scene, sizeof scene, "scene, %u x %u", image->width, image->height);
    for (int i = 0; i < SIZES; i++) {
        words[count++] = sizes[i].label;
        if (chosen == FIRST_SIZE + SIZES && size[0] == sizes[i].width && size[1] == sizes[i].height)
            chosen = FIRST_SIZE + i;
    }
    snprintf(other, sizeof other, chosen == count ? "%u x %u" : "other ...", size[0], size[1]);
    words[count++] = other;
    ui_item_width(-label_units * ui_font_size());
    if (ui_choice(label, &chosen, words, count)) {
        size[0] = chosen == AS_WINDOW ? 0 : chosen == AS_SCENE ? image->width : chosen < FIRST_SIZE + SIZES ? sizes[chosen - FIRST_SIZE].width : 1000;
        size[1] = chosen == AS_WINDOW ? 0 : chosen == AS_SCENE ? image->height : chosen < FIRST_SIZE + SIZES ? sizes[chosen - FIRST_SIZE].height : 1000;
    }
    if (chosen < FIRST_SIZE + SIZES)
        return;
    for (int i = 0; i < 2; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s%s", i == 0 ? "width" : "height", label);
        ui_item_width(-label_units * ui_font_size());
        ui_slider_count(name, &size[i], 16, i == 0 ? 7680 : 4320, false, NULL);
    }
}

/* ---- the command ---- */

/* The text of the scene that the film shows: as in the window, but with the document's start, and by side A's method. The caller frees it. NULL: out of
 * memory. */
static char *film_text(const viewer *v, size_t *size)
{
    const film_choice *c = &v->film;
    scene_values values;
    char *text = NULL;
    if (!viewer_frame_values(v, c->size[0] ? c->size[0] : v->place.width, c->size[1] ? c->size[1] : v->place.height, &values))
        return NULL;
    values.time.start = v->document.values.time.start;
    values.quality = quality_restricted(&v->settings.sides[SIDE_A]);
    FILE *stream = open_memstream(&text, size);
    const bool good = stream && scene_values_write(stream, &values);
    if (stream && (fclose(stream) != 0 || !good)) {
        free(text);
        text = NULL;
    }
    scene_values_free(&values);
    return text;
}

void film_path(const viewer *v, char *path, size_t size)
{
    const film_choice *c = &v->film;
    const char *ending = kinds[c->kind].ending, *dot = strrchr(c->name, '.');
    const bool ended =
        dot && (strcmp(dot, ".mp4") == 0 || strcmp(dot, ".mov") == 0 || strcmp(dot, ".y4m") == 0 || strcmp(dot, ".png") == 0 || strcmp(dot, ".exr") == 0);
    const bool whole = ended && (strchr(c->name, '#') || strchr(c->name, '%')) && ending[0] == '-' && strcmp(strrchr(ending, '.'), dot) == 0;
    const int length = whole || !ended ? (int)strlen(c->name) : (int)(dot - c->name);
    snprintf(path, size, "%.*s%s", length, c->name, whole ? "" : ending);
}

bool film_take_kind(viewer *v)
{
    const char *dot = strrchr(v->film.name, '.');
    for (int i = 0; dot && i < KINDS; i++)
        if (strcmp(dot, strrchr(kinds[i].ending, '.')) == 0) {
            v->film.kind = i;
            return true;
        }
    return false;
}

bool film_begin(viewer *v, char *error, size_t error_size)
{
    film_choice *c = &v->film;
    char path[VIEWER_TEXT], frames[40], crf[16], threads[16];
    const char *words[24];
    size_t count = 0, text_size = 0;
    if (v->film_export) {
        snprintf(error, error_size, "a film is still being saved");
        return false;
    }
    const mgt_context_desc desc = viewer_cpu_desc(v);
    film_path(v, path, sizeof path);
    const uint32_t last = v->document.values.time.frames - 1, first = c->first < last ? c->first : last, end = c->last < first ? first : c->last;
    snprintf(frames, sizeof frames, "%u-%u", first, end < last ? end : last);
    snprintf(crf, sizeof crf, "%u", c->crf);
    snprintf(threads, sizeof threads, "%u", desc.threads);
    const char *const always[] = {"-o", path, "--frames", frames, "--backend", v->render.gl ? "gl" : "cpu"};
    for (size_t i = 0; i < sizeof always / sizeof always[0]; i++)
        words[count++] = always[i];
    if (desc.threads > 0) {
        words[count++] = "--threads";
        words[count++] = threads;
    }
    if (kinds[c->kind].codec) {
        words[count++] = "--codec";
        words[count++] = kinds[c->kind].codec;
    }
    if (kinds[c->kind].has_crf) {
        words[count++] = "--crf";
        words[count++] = crf;
    }
    if (c->replaces)
        words[count++] = "--overwrite";
    words[count] = NULL;
    char *text = film_text(v, &text_size);
    if (!text) {
        snprintf(error, error_size, "out of memory");
        return false;
    }
    v->film_export = film_export_start(text, text_size, words, error, error_size);
    free(text);
    return v->film_export != NULL;
}

void film_stop(viewer *v)
{
    film_export_destroy(v->film_export);
    v->film_export = NULL;
}

bool film_watch(viewer *v)
{
    char error[VIEWER_TEXT] = "", path[VIEWER_TEXT];
    if (!v->film_export)
        return false;
    const film_state state = film_export_poll(v->film_export, &v->film_fraction, error, sizeof error);
    if (state == FILM_BUSY)
        return true;
    film_stop(v);
    film_path(v, path, sizeof path);
    snprintf(v->save_problem, sizeof v->save_problem, "%s", state == FILM_FAILED ? error : "");
    if (state == FILM_SAVED)
        viewer_report(v, false, "saved %s", path);
    else
        viewer_report(v, true, "%s", error);
    return false;
}

/* ---- the panel ---- */

void film_draw(viewer *v)
{
    film_choice *c = &v->film;
    const char *labels[KINDS];
    char error[VIEWER_TEXT], text[VIEWER_TEXT], path[VIEWER_TEXT];
    const uint32_t last = v->document.values.time.frames - 1;
    const float label = -label_units * ui_font_size();
    for (int i = 0; i < KINDS; i++)
        labels[i] = kinds[i].label;
    ui_text(UI_TONE_ACCENT, "Film");
    ui_item_width(label);
    ui_text_field("file##film", c->name, sizeof c->name);
    ui_item_width(label);
    ui_choice("format##film", &c->kind, labels, KINDS);
    ui_tooltip("What mangata render writes; .mp4 and .mov need ffmpeg.");
    size_draw(v, "size##film", c->size);
    uint32_t range[2] = {c->first < last ? c->first : last, c->last < last ? c->last : last};
    ui_item_width(label);
    if (ui_slider_count("first frame##film", &range[0], 0, last, false, NULL))
        c->first = range[0];
    ui_item_width(label);
    if (ui_slider_count("last frame##film", &range[1], 0, last, false, NULL))
        c->last = range[1] < last ? range[1] : UINT32_MAX;
    if (kinds[c->kind].has_crf) {
        ui_item_width(label);
        ui_slider_count("quality (CRF)##film", &c->crf, 0, 51, false, NULL);
        ui_tooltip("0 is best, 16 looks lossless, 30 is small.");
    }
    ui_checkbox("replace files##film", &c->replaces);
    film_path(v, path, sizeof path);
    if (v->film_export) {
        snprintf(text, sizeof text, "%.0f%%", 100 * v->film_fraction);
        ui_progress((float)v->film_fraction, text);
        if (ui_button("stop##film", 0)) {
            film_stop(v);
            viewer_report(v, false, "stopped; nothing unfinished was left behind");
        }
        return;
    }
    if (ui_button("save film", 0) && !film_begin(v, error, sizeof error))
        viewer_report(v, true, "%s", error);
    ui_same_line(0);
    snprintf(text, sizeof text, "%.300s, %u frames", path, range[1] < range[0] ? 1 : range[1] - range[0] + 1);
    ui_text(UI_TONE_FAINT, text);
}
