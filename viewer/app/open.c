/* SPDX-License-Identifier: MIT
 * Opening another scene: the dialog, and files that are dropped on the window. */
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/app/panels.h"

/* ---- another scene ---- */

void viewer_set_title(viewer *v)
{
    char title[VIEWER_TEXT];
    snprintf(title, sizeof title, "%.500s - Mangata", scene_source_name(v->document.source));
    glfwSetWindowTitle(v->window, title);
}

void viewer_take_document(viewer *v, document *other)
{
    document_close(&v->document);
    v->document = *other;
    *other = (document){0};
    v->selected_wave = v->selected_keyframe = 0;
    snprintf(v->scene_error.text, sizeof v->scene_error.text, "%s", v->document.source->error.text);
    v->inspection.valid = false;
    document_save_name(&v->document, v->save_name, sizeof v->save_name);
    viewer_set_title(v);
}

bool viewer_open(viewer *v, const char *path, char *error, size_t error_size)
{
    document other;
    scene_error problem;
    if (!document_open(&other, path, NULL, 0, &problem)) {
        snprintf(error, error_size, "%s", problem.text);
        return false;
    }
    viewer_keep_step(v, true);
    viewer_take_document(v, &other);
    v->settings.sides[SIDE_A] = scene_file_quality(v->document.source->file);
    v->settings.waves = settings_defaults().waves;
    v->settings.clock.time = v->document.values.time.start;
    viewer_reset_camera(v);
    viewer_keep_step(v, true);
    recent_add(path);
    v->dialog.shown = false;
    return true;
}

static void open_or_tell(viewer *v, const char *path)
{
    char error[VIEWER_TEXT];
    if (viewer_open(v, path, error, sizeof error))
        viewer_report(v, false, "opened %s", path);
    else
        viewer_report(v, true, "%s", error);
}

/* Adds a model as an object of the scene. */
static void add_model(viewer *v, const char *path)
{
    char name[40], value[VIEWER_TEXT], error[VIEWER_TEXT];
    snprintf(name, sizeof name, "objects[%zu]", v->document.values.objects.count);
    snprintf(value, sizeof value, "{mesh: \"%.500s\"}", path);
    if (control_set(&v->board, name, value, error, sizeof error))
        viewer_report(v, false, "added %s", path);
    else
        viewer_report(v, true, "%s", error);
}

void viewer_drop(viewer *v, const char *path)
{
    if (is_model_name(path))
        add_model(v, path);
    else
        open_or_tell(v, path);
}

/* ---- the dialog ---- */

void dialog_free(viewer *v)
{
    open_dialog *d = &v->dialog;
    name_list_free(&d->shipped);
    name_list_free(&d->recent);
    name_list_free(&d->files);
    free(d->shipped_folder);
    d->shipped_folder = NULL;
}

void dialog_toggle(viewer *v)
{
    open_dialog *d = &v->dialog;
    d->shown = !d->shown;
    dialog_free(v);
    if (!d->shown)
        return;
    d->shipped_folder = shipped_folder();
    if (d->shipped_folder)
        d->shipped = scenes_of_folder(d->shipped_folder);
    d->recent = recent_scenes();
    if (!d->folder[0])
        snprintf(d->folder, sizeof d->folder, ".");
    d->files = scenes_of_folder(d->folder);
}

static bool is_folder(const char *name) { return name[0] && name[strlen(name) - 1] == '/'; }

/* Draws a row for each name. Returns the path of the one that was chosen, in `path`; NULL: none. */
static const char *draw_rows(const char *folder, const name_list *list, bool with_folders, char path[OPEN_PATH])
{
    const char *chosen = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const char *name = list->names[i];
        char label[OPEN_PATH];
        if (is_folder(name) && !with_folders)
            continue;
        snprintf(label, sizeof label, "   %.900s##%zu", name, i);
        if (!ui_selectable(label, false, 0))
            continue;
        snprintf(path, OPEN_PATH, "%s%s%.900s", folder, folder[0] ? "/" : "", name);
        chosen = path;
    }
    return chosen;
}

/* Lists the files of another folder. */
static void enter(viewer *v, const char *path)
{
    open_dialog *d = &v->dialog;
    char *whole = realpath(path, NULL);
    snprintf(d->folder, sizeof d->folder, "%s", whole ? whole : path);
    free(whole);
    name_list_free(&d->files);
    d->files = scenes_of_folder(d->folder);
}

static void draw_places(viewer *v)
{
    open_dialog *d = &v->dialog;
    char path[OPEN_PATH];
    const char *chosen = NULL, *pick;
    if (ui_header("Seas", true))
        for (size_t i = 0; i < sea_preset_count; i++) {
            snprintf(path, sizeof path, "   %s", sea_presets[i].name);
            if (ui_selectable(path, false, 0))
                chosen = sea_presets[i].path;
        }
    if (d->shipped.count > 0 && ui_header("Scenes", true) && (pick = draw_rows(d->shipped_folder, &d->shipped, false, path)))
        chosen = pick;
    if (d->recent.count > 0 && ui_header("Opened lately", true) && (pick = draw_rows("", &d->recent, false, path)))
        chosen = pick;
    if (ui_header("Files", true)) {
        ui_text(UI_TONE_FAINT, d->folder);
        if ((pick = draw_rows(d->folder, &d->files, true, path))) {
            if (is_folder(pick))
                enter(v, pick);
            else
                chosen = pick;
        }
    }
    if (chosen)
        open_or_tell(v, chosen);
}

void dialog_draw(viewer *v)
{
    open_dialog *d = &v->dialog;
    if (!d->shown)
        return;
    const float unit = 13.5f * v->ui_scale, width = fminf(34 * unit, v->place.room.width - 2 * unit),
                height = fminf(46 * unit, v->place.room.height - 8 * unit);
    const ui_rect place = {(v->place.room.width - width) / 2, (v->place.room.height - 3 * unit - height) / 2, width, height};
    if (ui_panel_begin("open", place, UI_PANEL_PLAIN)) {
        ui_text(UI_TONE_ACCENT, "Open a scene");
        ui_same_line(width - 5.5f * unit);
        const bool closed = ui_button("close", 4.5f * unit);
        ui_item_width(-6.2f * unit);
        ui_text_field("##path", d->path, sizeof d->path);
        ui_tooltip("The path of a .yaml or .json file; files can be dropped on the window, too.");
        ui_same_line(width - 5.5f * unit);
        if (ui_button("open", 4.5f * unit) && d->path[0])
            open_or_tell(v, d->path);
        if (ui_child_begin("places", height - 7.4f * unit))
            draw_places(v);
        ui_child_end();
        if (closed && d->shown)
            dialog_toggle(v);
    }
    ui_panel_end();
}
