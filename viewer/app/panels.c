/* SPDX-License-Identifier: MIT
 * The panel of controls at the right, and the clock under the picture. */
#include "viewer/app/panels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "viewer/scene/camera_moves.h"
#include "params/methods.h"
#include "params/options.h"
#include "params/scene_rows.h"
#include "params/waves.h"

static const float panel_units = 23.5f, label_units = 8.2f; /* widths of the panel and of labels, in heights of the text */

float panels_width(const viewer *v) { return v->settings.panel.shown ? floorf(panel_units * 13.5f * v->ui_scale) : 0; }

/* ---- one control ---- */

/* Sets the tooltip of a control: its description, name and range. */
static void explain(const control *c)
{
    char text[512], range[128];
    field_allowed(c->field, range, sizeof range);
    snprintf(text, sizeof text, "%s\n%s: %s", c->field->doc, c->name, range);
    ui_tooltip(text);
}

static const char *format_of(const control *c, char *room, size_t size)
{
    if (c->hint && c->hint->format)
        return c->hint->format;
    snprintf(room, size, "%%.6g%s%s", c->field->unit ? " " : "", c->field->unit ? c->field->unit : "");
    return room;
}

static bool draw_choice(const control *c, const char *label, double *number)
{
    if (field_is_switch(c->field)) {
        bool on = *number != 0;
        const bool changed = ui_checkbox(label, &on);
        *number = on;
        return changed;
    }
    const char *words[64];
    int count = 0, chosen = (int)*number;
    for (; count < 64 && field_word(c->field, count); count++)
        words[count] = field_word(c->field, count);
    const bool changed = ui_choice(label, &chosen, words, count);
    *number = chosen;
    return changed;
}

static bool draw_numbers(const control *c, const char *label, double n[3])
{
    char room[64];
    const control_hint *h = c->hint;
    const double low = h ? h->low : c->field->min, high = h ? h->high : c->field->max;
    if (c->field->type == FIELD_COLOR) {
        float rgb[3] = {(float)n[0], (float)n[1], (float)n[2]}, most = (float)c->field->max;
        const bool changed = ui_color(label, rgb, &most);
        for (int i = 0; i < 3; i++)
            n[i] = (double)rgb[i];
        return changed;
    }
    if (control_width(c) == 3)
        return ui_drag(label, n, 3, (high - low) * 2e-4, c->field->min, c->field->max, format_of(c, room, sizeof room));
    if ((c->field->type == FIELD_COUNT || (c->field->type == FIELD_LARGE && c->hint))) {
        uint32_t whole = (uint32_t)n[0];
        const bool changed = ui_slider_count(label, &whole, (uint32_t)low, (uint32_t)high, h && h->logarithmic, h ? h->zero : NULL);
        n[0] = whole;
        return changed;
    }
    return ui_slider(label, n, low, high, h && h->zero && n[0] == 0 ? h->zero : format_of(c, room, sizeof room), h && h->logarithmic);
}

bool panel_control(viewer *v, const char *name)
{
    control c;
    char label[96];
    double n[3];
    if (!control_find(&v->board, name, &c))
        return false;
    snprintf(label, sizeof label, "%.30s##%.60s", c.hint ? c.hint->label : c.field->key, name);
    control_read(&c, n);
    ui_item_width(-label_units * ui_font_size());
    const bool changed = c.field->choices ? draw_choice(&c, label, n) : draw_numbers(&c, label, n);
    explain(&c);
    if (changed)
        control_write(&v->board, &c, n);
    return changed;
}

void panel_controls(viewer *v, const char *const *names)
{
    for (; *names; names++)
        panel_control(v, *names);
}

bool panel_count(viewer *v, const char *label, uint32_t *value, uint32_t min, uint32_t max, const char *zero)
{
    (void)v;
    ui_item_width(-label_units * ui_font_size());
    return ui_slider_count(label, value, min, max, false, zero);
}

/* Draws the controls of a mapping, one per row. */
static void draw_mapping(viewer *v, const char *path, const field_row *rows)
{
    char name[64];
    for (const field_row *row = rows; row->key; row++) {
        snprintf(name, sizeof name, "%s.%s", path, row->key);
        panel_control(v, name);
    }
}

/* ---- sides ---- */

static void draw_side(viewer *v, int side)
{
    const char letter = side == SIDE_A ? 'a' : 'b';
    const mgt_quality *q = &v->settings.sides[side];
    const picture *p = &v->render.pictures[side];
    char name[64], text[64];
    for (const field_row *field = quality_fields; field->key; field++) {
        /* The seed is only shown for methods that use random numbers. */
        const bool jitters = method_is_sampled(q->method) || q->method == MGT_METHOD_ADAPTIVE || strcmp(field->key, "seed") != 0;
        snprintf(name, sizeof name, "%c.%s", letter, field->key);
        if (jitters && field_applies(quality_fields, field, q, false) && (!(field->flags & FIELD_OBJECTS) || v->document.values.objects.count > 0))
            panel_control(v, name);
    }
    if (!method_is_sampled(q->method))
        return;
    snprintf(text, sizeof text, "%llu of %llu samples", (unsigned long long)p->samples, (unsigned long long)p->samples_total);
    ui_text(UI_TONE_FAINT, text);
}

static void draw_compare(viewer *v)
{
    static const char *const labels[] = {"A", "A | B", "A - B"};
    const float width = (ui_room().width - 14) / 3;
    for (int i = 0; i < 3; i++) {
        if (i > 0)
            ui_same_line(0);
        if (ui_toggle_button(labels[i], v->settings.view.compare == i, width))
            v->settings.view.compare = i;
    }
    draw_side(v, SIDE_A);
    if (v->settings.view.compare != COMPARE_OFF)
        draw_side(v, SIDE_B);
    if (v->settings.view.compare == COMPARE_DIFFERENCE)
        panel_control(v, "view.difference_scale");
    panel_control(v, "view.layer");
    if (v->settings.view.layer == MGT_LAYER_COVERAGE && v->settings.view.compare != COMPARE_DIFFERENCE)
        panel_control(v, "view.coverage_end");
    if (v->settings.view.layer == MGT_LAYER_NORMAL && v->settings.view.compare != COMPARE_DIFFERENCE)
        panel_control(v, "view.lean_end");
}

/* ---- look ---- */

static void draw_exposure(viewer *v)
{
    scene_exposure *exposure = &v->document.values.post.exposure;
    bool automatic = exposure->automatic;
    if (ui_checkbox("automatic exposure", &automatic))
        *exposure = (scene_exposure){.automatic = automatic, .stops = automatic ? 0 : exposure->stops};
    panel_control(v, automatic ? "post.exposure_offset" : "post.exposure");
}

static const char *object_name(const scene_object *object, size_t index, char *room, size_t size)
{
    snprintf(room, size, "%zu  %.60s", index, object->name && object->name[0] ? object->name : object->mesh ? object->mesh : "shape");
    return room;
}

/* Draws the list of objects and the controls of the one that is chosen. */
static void draw_objects(viewer *v)
{
    static const char *const keys[] = {"position",           "rotation_deg",      "scale",           "size", "material.base_color",
                                       "material.roughness", "material.metallic", "material.pattern"};
    static const char *const patterned[] = {"material.pattern_color", "material.pattern_size", "material.pattern_joint"};
    const scene_list *list = &v->document.values.objects;
    const scene_object *items = list->items;
    char name[96];
    v->selected_object = v->selected_object < list->count ? v->selected_object : 0;
    for (size_t i = 0; i < list->count && list->count > 1; i++)
        if (ui_selectable(object_name(&items[i], i, name, sizeof name), v->selected_object == i, 0))
            v->selected_object = i;
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++) {
        snprintf(name, sizeof name, "objects[%zu].%s", v->selected_object, keys[k]);
        panel_control(v, name);
    }
    for (size_t k = 0; k < sizeof patterned / sizeof patterned[0] && items[v->selected_object].material.look.pattern != MGT_PATTERN_NONE; k++) {
        snprintf(name, sizeof name, "objects[%zu].%s", v->selected_object, patterned[k]);
        panel_control(v, name);
    }
    ui_text(UI_TONE_FAINT, "Refraction and caustics stand with the methods above.");
}

static void draw_look(viewer *v)
{
    static const char *const sky[][5] = {[MGT_SKY_ATMOSPHERE] = {"sky.turbidity", "sky.night", "sky.stars", "sky.aerial", NULL},
                                         [MGT_SKY_GRADIENT] = {"sky.zenith", "sky.horizon", NULL},
                                         [MGT_SKY_BLACK] = {NULL}};
    static const char *const water[] = {"water.level", "water.ior", "water.body_albedo", NULL};
    static const char *const under[] = {"water.absorption", "water.scattering", NULL}; /* only for scenes with objects, which are seen through the water */
    static const char *const post[] = {"post.tone_map", "post.night_tint", "post.glare", NULL};
    if (ui_header("Light", true))
        draw_mapping(v, "light", light_rows);
    if (ui_header("Sky", true)) {
        panel_control(v, "sky.model");
        panel_controls(v, sky[v->document.values.sky.look.model]);
    }
    if (ui_header("Water", true)) {
        panel_controls(v, water);
        if (v->document.values.objects.count > 0)
            panel_controls(v, under);
    }
    if (v->document.values.objects.count > 0 && ui_header("Objects", true))
        draw_objects(v);
    if (ui_header("Exposure", true)) {
        draw_exposure(v);
        panel_controls(v, post);
    }
    if (ui_header("Shutter", true))
        panel_control(v, "time.shutter");
}

/* ---- camera ---- */

/* Plays the camera path from its first keyframe on. */
static void play_path(viewer *v)
{
    const scene_keyframe *items = v->document.values.camera.path.items;
    v->settings.move.path = 1;
    v->settings.clock.time = items[0].time;
    v->settings.clock.play = 1;
}

static void draw_keyframes(viewer *v)
{
    scene_list *path = &v->document.values.camera.path;
    scene_keyframe *items = path->items;
    char label[64];
    if (ui_child_begin("keyframes", 6 * ui_font_size()))
        for (size_t i = 0; i < path->count; i++) {
            const double *p = items[i].camera.position;
            snprintf(label, sizeof label, "%7.3f s    %.1f  %.1f  %.1f##key%zu", items[i].time, p[0], p[1], p[2], i);
            if (ui_selectable(label, v->selected_keyframe == i, 0)) {
                v->selected_keyframe = i;
                v->settings.clock.time = items[i].time;
                v->settings.clock.play = 0;
            }
        }
    ui_child_end();
    if (ui_button("record (K)", 0))
        input_press_key(v, "k");
    ui_same_line(0);
    ui_disabled_begin(path->count == 0);
    if (ui_button("play", 0))
        play_path(v);
    ui_disabled_end();
    ui_same_line(0);
    ui_disabled_begin(v->selected_keyframe >= path->count);
    if (ui_button("delete", 0))
        keyframe_delete(path, v->selected_keyframe);
    ui_disabled_end();
    if (v->selected_keyframe >= path->count)
        return;
    double time = ((scene_keyframe *)path->items)[v->selected_keyframe].time;
    ui_item_width(-label_units * ui_font_size());
    if (ui_drag("time of key", &time, 1, 0.01, -1e6, 1e6, "%.3f s"))
        v->selected_keyframe = keyframe_move(path, v->selected_keyframe, time);
}

static void draw_camera(viewer *v)
{
    static const char *const still[] = {"camera.position", "camera.target", "camera.fov_y_deg", NULL};
    static const char *const move[] = {"move.mode", "move.speed", "move.clearance", NULL};
    panel_controls(v, move);
    if (ui_button("reset (R)", 0))
        viewer_reset_camera(v);
    if (ui_header("View", true)) {
        ui_disabled_begin(viewer_follows_path(v));
        panel_controls(v, still);
        panel_control(v, "camera.up");
        ui_disabled_end();
    }
    if (ui_header("Path", true)) {
        panel_control(v, "move.path");
        draw_keyframes(v);
    }
}

/* ---- view ---- */

static void draw_view(viewer *v)
{
    static const char *const names[] = {"view.resolution", "view.frame", "image.width", "image.height", "view.zoom", NULL};
    static const char *const depth[] = {"view.near_depth", "view.far_depth", NULL};
    static const char *const film[] = {"time.start", "time.fps", "time.frames", NULL};
    static const char *const panel[] = {"panel.timings", "panel.judge", "panel.inspector", "panel.legend", "panel.log", "panel.keys", "panel.scale", NULL};
    panel_controls(v, names);
    if (v->settings.view.layer == MGT_LAYER_DEPTH)
        panel_controls(v, depth);
    if (ui_header("Film", true))
        panel_controls(v, film);
    if (ui_header("Panels", true))
        panel_controls(v, panel);
}

/* ---- files ---- */

static void draw_files(viewer *v)
{
    char error[VIEWER_TEXT];
    ui_text(UI_TONE_ACCENT, "Picture");
    ui_item_width(-label_units * ui_font_size());
    ui_text_field("file##picture", v->picture_name, sizeof v->picture_name);
    ui_tooltip(".png: as shown; .exr: scene-linear with every layer");
    size_draw(v, "size##saved", v->picture_size);
    if (ui_button("save (F12)", 0))
        input_press_key(v, "f12");
    ui_same_line(0);
    if (ui_button("copy as command (C)", 0))
        viewer_copy_command(v);
    ui_space(6);
    film_draw(v);
    ui_space(6);
    ui_text(UI_TONE_ACCENT, "Scene");
    ui_item_width(-label_units * ui_font_size());
    ui_text_field("file##scene", v->save_name, sizeof v->save_name);
    ui_tooltip("A new file; comments of the old one are not carried over.");
    if (ui_button("save scene", 0) && !viewer_save_scene(v, v->save_name, error, sizeof error))
        viewer_report(v, true, "%s", error);
    ui_same_line(0);
    if (ui_button("back to the file", 0))
        viewer_revert(v);
    ui_tooltip("Takes back every change since the scene was read.");
    const char *description = scene_file_description(v->document.source->file);
    if (description[0]) {
        ui_space(6);
        ui_text_wrapped(UI_TONE_FAINT, description);
    }
}

/* ---- the panel ---- */

static void draw_renderer(const viewer *v)
{
    char text[256];
    const mgt_context_info *info = &v->render.info;
    const mgt_image *image = &v->render.last.scene.image;
    if (v->render.gl)
        snprintf(text, sizeof text, "%u x %u, OpenGL, %.40s", image->width, image->height, info->renderer);
    else
        snprintf(text, sizeof text, "%u x %u, CPU, %s, %u threads", image->width, image->height, mgt_isa_name(info->isa), info->threads);
    ui_text(UI_TONE_FAINT, text);
}

/* Draws the buttons above the pages. */
static void draw_tools(viewer *v)
{
    static const struct {
        const char *label, *key, *what;
    } tools[] = {{"open", "ctrl+o", "another scene (Ctrl O)"},
                 {"undo", "ctrl+z", "takes back the last step (Ctrl Z)"},
                 {"redo", "ctrl+y", "takes it back again (Ctrl Y)"},
                 {"save", "f12", "the picture, as the page Files says (F12)"}};
    enum { TOOLS = sizeof tools / sizeof tools[0] };
    const float width = (ui_room().width - 7 * (TOOLS - 1)) / TOOLS;
    for (int i = 0; i < TOOLS; i++) {
        if (i > 0)
            ui_same_line(0);
        if (ui_button(tools[i].label, width))
            input_press_key(v, tools[i].key);
        ui_tooltip(tools[i].what);
    }
}

static void draw_panel(viewer *v)
{
    static const struct {
        const char *label;
        void (*draw)(viewer *);
    } tabs[] = {{"Look", draw_look}, {"Sea", sea_page_draw}, {"Camera", draw_camera}, {"View", draw_view}, {"Files", draw_files}};
    const ui_rect *room = &v->place.room;
    const ui_rect place = {room->width, 0, panels_width(v), room->height};
    if (ui_panel_begin("controls", place, UI_PANEL_SCROLLS)) {
        draw_tools(v);
        draw_compare(v);
        draw_renderer(v);
        ui_space(2);
        if (ui_tabs_begin("pages")) {
            for (int i = 0; i < (int)(sizeof tabs / sizeof tabs[0]); i++)
                if (ui_tab_begin(tabs[i].label, v->open_tab == i + 1)) {
                    tabs[i].draw(v);
                    ui_tab_end();
                }
            ui_tabs_end();
        }
        v->open_tab = 0;
    }
    ui_panel_end();
}

/* ---- the clock ---- */

static void draw_clock(viewer *v)
{
    clock_settings *c = &v->settings.clock;
    const scene_clock *film = &v->document.values.time;
    const ui_rect *room = &v->place.room;
    const float unit = 13.5f * v->ui_scale, height = 2.9f * unit, margin = 0.8f * unit;
    const float width = fminf(room->width - 2 * margin, 62 * unit);
    const ui_rect place = {(room->width - width) / 2, room->height - height - margin, width, height};
    if (width > 24 * unit && ui_panel_begin("clock", place, UI_PANEL_GLASS)) {
        if (ui_button(c->play ? "pause" : "play", 4 * unit))
            c->play = !c->play;
        ui_same_line(0);
        if (ui_button("<", 2 * unit))
            viewer_step_frames(v, -1);
        ui_same_line(0);
        if (ui_button(">", 2 * unit))
            viewer_step_frames(v, 1);
        ui_same_line(0);
        const double end = film->start + fmax((film->frames - 1) / film->fps, 1);
        ui_item_width(width - 33 * unit > 6 * unit ? width - 33 * unit : 6 * unit);
        ui_slider("##scrub", &c->time, film->start, end, "%.3f s", false);
        ui_same_line(0);
        char frame[32];
        snprintf(frame, sizeof frame, "frame %.2f", (c->time - film->start) * film->fps);
        ui_text(UI_TONE_FAINT, frame);
        ui_same_line(width - 13.5f * unit);
        ui_item_width(6 * unit);
        ui_slider("##speed", &c->speed, 0.02, 4, "%.2f x", true);
        ui_tooltip("scene seconds a second");
        ui_same_line(0);
        bool loop = c->loop != 0;
        if (ui_checkbox("loop", &loop))
            c->loop = loop;
    }
    if (width > 24 * unit)
        ui_panel_end();
}

void panels_draw(viewer *v)
{
    if (!v->settings.panel.shown)
        return;
    draw_panel(v);
    draw_clock(v);
}
