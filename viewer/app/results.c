/* SPDX-License-Identifier: MIT
 * Output of the viewer: pictures, scene files, and the command that renders the same frame. */
#include <GLFW/glfw3.h>

#include <stdlib.h>
#include <string.h>

#include "cli/common/markup.h"
#include "image/picture.h"
#include "params/methods.h"
#include "params/options.h"
#include "viewer/app/viewer.h"

/* ---- the command ---- */

/* Writes the options of side A's method that differ from the scene's own quality by that method. */
static void write_method(FILE *stream, const viewer *v, const mgt_quality *q)
{
    quality_choice method = quality_choice_none();
    const mgt_quality base = scene_file_quality(v->document.source->file);
    mgt_quality given;
    char unused[200];
    fprintf(stream, " --method %s", method_name(q).text);
    quality_choose(&method, quality_fields, method_name(q).text);
    if (!quality_apply(&method, &base, &given, unused, sizeof unused))
        return;
    for (const field_row *field = quality_fields; field->key; field++) {
        const void *value = field_at(field, q);
        if (!(field->flags & FIELD_NO_FLAG) && field_applies(quality_fields, field, q, false) && memcmp(value, field_at(field, &given), field_size(field)) != 0)
            fprintf(stream, " %s %s", option_flag_of(field).text, field_print(field, value).text);
    }
}

char *viewer_command(const viewer *v)
{
    const mgt_quality q = quality_restricted(&v->settings.sides[SIDE_A]);
    scene_values values;
    scene_overrides words = {0};
    char *text = NULL;
    size_t size = 0;
    if (!viewer_frame_values(v, v->place.width, v->place.height, &values))
        return NULL;
    const char *path = v->document.source->path;
    const bool good = strncmp(path, "--", 2) == 0 || scene_values_relative_files(&values, path);
    FILE *stream = good && scene_overrides_between(scene_file_values(v->document.source->file), &values, &words) ? open_memstream(&text, &size) : NULL;
    if (stream) {
        fputs("mangata render", stream);
        shell_scene(stream, path);
        fputs(" -o frame.png --frames 0", stream);
        write_method(stream, v, &q);
        if (v->settings.view.layer != MGT_LAYER_COLOR && v->settings.view.layer != MGT_LAYER_DEPTH)
            fprintf(stream, " --layer %s", layer_choices[v->settings.view.layer]);
        for (size_t i = 0; i < words.count; i++) {
            fputs(" --set", stream);
            shell_word(stream, words.words[i]);
        }
        if (fclose(stream) != 0) {
            free(text);
            text = NULL;
        }
    }
    scene_overrides_free(&words);
    scene_values_free(&values);
    return text;
}

void viewer_copy_command(viewer *v)
{
    char *text = viewer_command(v);
    if (!text) {
        viewer_report(v, true, "out of memory");
        return;
    }
    ui_clipboard(text);
    viewer_log(v, "%s", text);
    viewer_report(v, false, "the command that renders this frame is in the clipboard");
    free(text);
}

/* ---- pictures ---- */

bool viewer_save_picture(viewer *v, const char *path, uint32_t width, uint32_t height, char *error, size_t error_size)
{
    shot now;
    if (!v->saver) {
        const mgt_context_desc desc = viewer_cpu_desc(v);
        v->saver = picture_saver_create(&desc, glfwPostEmptyEvent);
    }
    if (!v->saver || !viewer_take_shot(v, &now)) {
        snprintf(error, error_size, "%s", v->saver ? v->scene_error.text : "out of memory");
        return false;
    }
    now.scene.image = (mgt_image){.width = width ? width : v->place.width, .height = height ? height : v->place.height};
    now.scene.quality = quality_restricted(&v->settings.sides[SIDE_A]);
    return picture_saver_start(v->saver, &now.scene, now.models, path, error, error_size);
}

bool viewer_watch_saver(viewer *v)
{
    char text[VIEWER_TEXT] = "";
    double fraction = 0;
    const picture_saver_state state = v->saver ? picture_saver_poll(v->saver, text, sizeof text, &fraction) : SAVER_IDLE;
    if (state == SAVER_SAVED)
        viewer_report(v, false, "saved %s", text);
    if (state == SAVER_FAILED)
        viewer_report(v, true, "%s", text);
    if (state == SAVER_SAVED || state == SAVER_FAILED)
        snprintf(v->save_problem, sizeof v->save_problem, "%s", state == SAVER_FAILED ? text : "");
    if (state == SAVER_BUSY)
        snprintf(v->progress, sizeof v->progress, "saving %.200s, %.0f%%", text, 100 * fraction);
    else
        v->progress[0] = 0;
    return state == SAVER_BUSY;
}

uint8_t *viewer_read_window(const viewer *v, uint32_t *width, uint32_t *height)
{
    const gl_functions *gl = &v->gl_functions;
    int w, h;
    glfwGetFramebufferSize(v->window, &w, &h);
    uint8_t *pixels = malloc((size_t)w * (size_t)h * 4), *row = malloc((size_t)w * 4);
    if (pixels && row) {
        const size_t stride = (size_t)w * 4;
        gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
        gl->ReadPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
        for (size_t y = 0; y < (size_t)h / 2; y++) {
            uint8_t *top = pixels + y * stride, *bottom = pixels + ((size_t)h - 1 - y) * stride;
            memcpy(row, top, stride);
            memcpy(top, bottom, stride);
            memcpy(bottom, row, stride);
        }
        *width = (uint32_t)w;
        *height = (uint32_t)h;
    } else {
        free(pixels);
        pixels = NULL;
    }
    free(row);
    return pixels;
}

bool viewer_save_window(const viewer *v, const char *path, char *error, size_t error_size)
{
    const output_options options = {.overwrite = true};
    file_error problem = {.text = "out of memory"};
    uint32_t width = 0, height = 0;
    uint8_t *pixels = viewer_read_window(v, &width, &height);
    const bool good = pixels && picture_write_png(path, width, height, pixels, 0, NULL, &options, &problem) == FILE_OK;
    if (!good)
        snprintf(error, error_size, "%s", problem.text);
    free(pixels);
    return good;
}

/* ---- scenes ---- */

bool viewer_save_scene(viewer *v, const char *path, char *error, size_t error_size)
{
    scene_values values;
    file_error problem = {0};
    const mgt_image *image = &v->document.values.image;
    document_refresh(&v->document);
    if (!viewer_frame_values(v, image->width, image->height, &values)) {
        snprintf(error, error_size, "out of memory");
        return false;
    }
    /* The saved scene keeps its start and its path, wherever the clock and the camera are. */
    values.time.start = v->document.values.time.start;
    bool good = true;
    if (values.camera.path.count == 0 && v->document.values.camera.path.count > 0) {
        const scene_list *path_list = &v->document.values.camera.path;
        const size_t size = path_list->count * sizeof(scene_keyframe);
        values.camera.path.items = malloc(size);
        if ((good = values.camera.path.items != NULL)) {
            memcpy(values.camera.path.items, path_list->items, size);
            values.camera.path.count = path_list->count;
        } else {
            snprintf(error, error_size, "out of memory");
        }
    }
    if (good && document_save(&values, path, false, &problem) != FILE_OK) {
        snprintf(error, error_size, "%s%s", problem.text, problem.status == FILE_EXISTS ? "; choose another name" : "");
        good = false;
    }
    scene_values_free(&values);
    if (good && v->document.values.camera.path.count > 0 && !viewer_follows_path(v))
        viewer_report(v, false, "saved %s; its camera follows the path: the view in the window is not in it", path);
    else if (good)
        viewer_report(v, false, "saved %s", path);
    return good;
}
