/* SPDX-License-Identifier: MIT
 * The scene of the moment: document, settings, clock and camera put together. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/scene/camera_moves.h"
#include "scene/scene_path.h"
#include "viewer/app/viewer.h"
#include "params/waves.h"
#include "sea/sea.h"

/* ---- camera ---- */

bool viewer_follows_path(const viewer *v) { return v->settings.move.path && v->document.values.camera.path.count > 0; }

static void free_from(viewer *v, const mgt_camera *camera)
{
    v->document.values.camera.still = *camera;
    v->settings.move.path = 0;
}

mgt_camera *viewer_free_camera(viewer *v)
{
    if (viewer_follows_path(v)) {
        const mgt_camera camera = scene_camera_at(&v->document.values.camera, v->settings.clock.time);
        free_from(v, &camera);
    }
    return &v->document.values.camera.still;
}

void viewer_reset_camera(viewer *v)
{
    v->document.values.camera.still = v->document.source->home;
    v->settings.move.path = 1;
    v->settings.view.zoom = 1;
    v->settings.view.center_x = v->settings.view.center_y = 0.5;
}

void viewer_revert(viewer *v)
{
    if (!document_revert(&v->document)) {
        viewer_report(v, true, "out of memory");
        return;
    }
    v->settings.waves = settings_defaults().waves;
    viewer_reset_camera(v);
    viewer_report(v, false, "back to %s", v->document.source->path);
}

/* Keeps a camera above the waves under it by the clearance, unless it follows the path or is under water. */
static void keep_camera_above(viewer *v)
{
    mgt_camera *camera = &v->document.values.camera.still;
    const scene_list list = scene_water_all(&v->document.values.water);
    const wave_settings *w = &v->settings.waves;
    const double level = v->document.values.water.level;
    if (viewer_follows_path(v) || camera->position[1] < level)
        return;
    const size_t count = list.count < w->count ? list.count : w->count;
    const double wave = waves_height(list.items, count, camera->position[0], camera->position[2], v->settings.clock.time);
    camera_keep_above(camera, level + fmax(wave, 0) + v->settings.move.clearance);
}

/* ---- waves ---- */

void viewer_write_out_sea(viewer *v)
{
    document_refresh(&v->document);
    scene_values_write_out_sea(&v->document.values);
}

/* Appends an item, which is not set, to a list. NULL: memory has run out, or the list has `most` items; that has been reported. */
static void *list_append(viewer *v, scene_list *list, size_t size, size_t most, const char *name)
{
    char *items = list->count < most ? realloc(list->items, (list->count + 1) * size) : NULL;
    if (!items) {
        if (list->count < most)
            viewer_report(v, true, "out of memory");
        else
            viewer_report(v, true, "no further %s fits: %zu are allowed", name, most);
        return NULL;
    }
    *list = (scene_list){.items = items, .count = list->count + 1};
    return items + (list->count - 1) * size;
}

/* Removes an item. `index` must be valid. */
static void list_remove(scene_list *list, size_t size, size_t index)
{
    char *items = list->items;
    memmove(items + index * size, items + (index + 1) * size, (list->count - index - 1) * size);
    if (--list->count == 0) {
        free(items);
        list->items = NULL;
    }
}

void swell_add(viewer *v)
{
    scene_list *list = &v->document.values.water.swell;
    scene_swell *added = list_append(v, list, sizeof *added, SEA_SWELLS, "swell");
    if (!added)
        return;
    *added = scene_swell_defaults();
    added->height = 1;
    added->direction_deg = (double)(list->count - 1) * 40.0 - 30;
    document_changed(&v->document, false);
}

void swell_remove(viewer *v, size_t index)
{
    scene_list *list = &v->document.values.water.swell;
    if (index >= list->count)
        return;
    list_remove(list, sizeof(scene_swell), index);
    document_changed(&v->document, false);
}

void sea_choose(viewer *v, sea_kind kind)
{
    scene_water *water = &v->document.values.water;
    const sea_kind now = sea_of(water);
    const double wind = now == SEA_OF_WIND ? water->wind.speed : now == SEA_OF_SPECTRUM ? water->spectrum.settings.wind : 8;
    const double from = now == SEA_OF_WIND ? water->wind.direction_deg : water->spectrum.settings.direction_deg;
    if (kind == now)
        return;
    if (kind == SEA_OF_WAVES) {
        viewer_write_out_sea(v);
        return;
    }
    free(water->waves.items);
    water->waves = (scene_list){0};
    if (kind == SEA_OF_WIND)
        water->wind.direction_deg = from;
    control_set_number(&v->board, "water.wind.speed", kind == SEA_OF_WIND ? wind : 0);
    if (kind == SEA_OF_SPECTRUM) {
        water->spectrum.settings.kind = SPECTRUM_JONSWAP;
        water->spectrum.settings.wind = wind;
        water->spectrum.settings.direction_deg = from;
        document_changed(&v->document, false);
    }
}

void wave_add(viewer *v)
{
    scene_list *list = &v->document.values.water.waves;
    if (v->document.values.water.wind.speed > 0) /* a wind would replace the wave */
        viewer_write_out_sea(v);
    mgt_wave *added = list_append(v, list, sizeof *added, MGT_MAX_WAVES, "wave");
    if (!added)
        return;
    v->selected_wave = list->count - 1;
    *added = wave_new(v->selected_wave);
    document_changed(&v->document, false);
}

void wave_remove(viewer *v, size_t index)
{
    scene_list *list = &v->document.values.water.waves;
    if (index >= list->count)
        return;
    list_remove(list, sizeof(mgt_wave), index);
    if (v->selected_wave > 0 && v->selected_wave >= list->count)
        v->selected_wave--;
    document_changed(&v->document, false);
}

/* ---- the shot ---- */

/* Copies the waves that are in use, and returns their number. */
static size_t take_waves(const viewer *v, mgt_wave *waves)
{
    const scene_list list = scene_water_all(&v->document.values.water);
    const size_t count = list.count < v->settings.waves.count ? list.count : v->settings.waves.count;
    if (count > 0)
        memcpy(waves, list.items, count * sizeof *waves);
    return count;
}

bool viewer_take_shot(viewer *v, shot *out)
{
    document_refresh(&v->document);
    scene_values values = v->document.values; /* borrows the lists */
    if (!viewer_follows_path(v))
        values.camera.path = (scene_list){0};
    if (!scene_values_shot(&values, v->settings.clock.time, &out->scene)) {
        snprintf(v->scene_error.text, sizeof v->scene_error.text, "the camera looks along its own up direction, or at its own place");
        v->scene_error.is_error = true;
        return false;
    }
    if (v->document.source->error.kind == SCENE_ERROR_NONE)
        snprintf(v->scene_error.text, sizeof v->scene_error.text, "%s", v->document.fault.kind == SCENE_ERROR_NONE ? "" : v->document.fault.text);
    v->scene_error.is_error = true;
    out->models = values.models;
    out->scene.water.wave_count = take_waves(v, out->waves);
    out->scene.water.waves = out->waves;
    return true;
}

bool viewer_frame_values(const viewer *v, uint32_t width, uint32_t height, scene_values *out)
{
    if (!scene_values_copy(out, &v->document.values))
        return false;
    out->image.width = width;
    out->image.height = height;
    if (v->settings.clock.time != out->time.start)
        out->time.start = v->settings.clock.time;
    if (!viewer_follows_path(v) && out->camera.path.count > 0) {
        free(out->camera.path.items);
        out->camera.path = (scene_list){0};
    }
    if (v->settings.waves.count < scene_water_all(&out->water).count) {
        scene_values_write_out_sea(out);
        out->water.waves.count = v->settings.waves.count;
    }
    return true;
}

/* ---- clock ---- */

/* Moves a running clock on by so many seconds of the window. */
static void run_clock(viewer *v, double seconds)
{
    clock_settings *clock = &v->settings.clock;
    const scene_clock *film = &v->document.values.time;
    const double length = film->frames / film->fps;
    if (!clock->play)
        return;
    clock->time += seconds * clock->speed;
    if (clock->loop && (clock->time >= film->start + length || clock->time < film->start)) {
        clock->time = film->start + fmod(clock->time - film->start, length);
        clock->time += clock->time < film->start ? length : 0;
    }
    clock->time = fmin(fmax(clock->time, -1e8), 1e8);
}

void viewer_step_frames(viewer *v, int frames)
{
    clock_settings *clock = &v->settings.clock;
    const scene_clock *film = &v->document.values.time;
    const double frame = round((clock->time - film->start) * film->fps) + frames;
    clock->play = 0;
    clock->time = film->start + frame / film->fps;
}

void viewer_advance(viewer *v, double seconds)
{
    const bool *k = v->pointer.keys;
    const double step = v->settings.move.speed * seconds * (v->pointer.fast ? 5 : 1);
    const double forward = k[0] - k[2], right = k[3] - k[1], up = k[5] - k[4];
    const bool moves = forward != 0 || right != 0 || up != 0, kept = !moves && history_is_current(&v->history, &v->document, &v->settings);
    run_clock(v, seconds);
    if (moves)
        camera_move(viewer_free_camera(v), forward * step, right * step, up * step);
    keep_camera_above(v);
    if (kept)
        history_follow(&v->history, v->settings.clock.time, &v->document.values.camera.still);
}

/* ---- files ---- */

void viewer_poll_files(viewer *v)
{
    const scene_source *source = v->document.source;
    switch (document_poll(&v->document)) {
    case DOCUMENT_SAME:
        break;
    case DOCUMENT_READ_ANEW:
        v->scene_error.text[0] = 0;
        viewer_report(v, false, "%s: read again", source->path);
        break;
    case DOCUMENT_BROKEN:
        snprintf(v->scene_error.text, sizeof v->scene_error.text, "%s", source->error.text);
        v->scene_error.is_error = true;
        viewer_log(v, "%s", source->error.text);
        break;
    }
}
