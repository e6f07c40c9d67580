/* SPDX-License-Identifier: MIT
 * The page Sea: wind, spectrum, swells, single waves, and a plot of all waves. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "params/waves.h"
#include "sea/spectrum_model.h"
#include "viewer/app/panels.h"

static const double pi = 3.14159265358979323846;

/* ---- the plot ---- */

/* Ranges of the plot's logarithmic axes: lengths and heights, metres. */
static const double shortest = 0.03, longest = 600, lowest = 2e-4, highest = 6;
static const uint32_t back = 0x10141cff, grid = 0x232b38ff, faint = 0x8891a0ff, accent = 0xedc778ff, blue = 0x6f9fd8ff, white = 0xf2f4f8ff;

/* Window coordinate of a value on a logarithmic axis. Values are clamped to the axis. */
static float place_on(double value, double low, double high, float from, float size)
{
    return from + size * (float)(log(fmin(fmax(value, low), high) / low) / log(high / low));
}

static float plot_x(const ui_rect *box, double length) { return place_on(length, shortest, longest, box->x, box->width); }

static float plot_y(const ui_rect *box, double height) { return place_on(height, lowest, highest, box->y + box->height, -box->height); }

static double length_at(const ui_rect *box, float x) { return shortest * pow(longest / shortest, (double)((x - box->x) / box->width)); }

static double height_at(const ui_rect *box, float y) { return lowest * pow(highest / lowest, (double)((box->y + box->height - y) / box->height)); }

static void draw_grid(const ui_rect *box)
{
    static const struct {
        double length;
        const char *text;
    } ticks[] = {{0.1, "10 cm"}, {1, "1 m"}, {10, "10 m"}, {100, "100 m"}};
    ui_draw_box(UI_LAYER_WINDOW, *box, back, 3);
    for (size_t i = 0; i < sizeof ticks / sizeof ticks[0]; i++) {
        const float x = plot_x(box, ticks[i].length);
        ui_draw_line(UI_LAYER_WINDOW, x, box->y, x, box->y + box->height, grid, 1);
        ui_draw_text(UI_LAYER_WINDOW, x + 3, box->y + 2, faint, ticks[i].text);
    }
    for (double height = 1e-3; height < highest; height *= 10) {
        const float y = plot_y(box, height);
        ui_draw_line(UI_LAYER_WINDOW, box->x, y, box->x + box->width, y, grid, 1);
    }
    ui_draw_text(UI_LAYER_WINDOW, box->x + 3, plot_y(box, 1) - ui_font_size() - 1, faint, "1 m");
    ui_draw_text(UI_LAYER_WINDOW, box->x + 3, plot_y(box, 0.01) - ui_font_size() - 1, faint, "1 cm");
}

/* The highest of the first `count` waves; NULL: there are none. */
static const mgt_wave *peak_of(const scene_list *waves, size_t count)
{
    const mgt_wave *items = waves->items, *peak = NULL;
    for (size_t i = 0; i < count; i++)
        if (!peak || wave_crest(&items[i]) > wave_crest(peak))
            peak = &items[i];
    return peak;
}

/* Number of waves that the swells make. They are the last ones of the sea. */
static size_t swell_waves(const scene_water *water)
{
    const scene_swell *swells = water->swell.items;
    size_t count = 0;
    for (size_t i = 0; i < water->swell.count; i++)
        count += swells[i].count;
    return count;
}

/* A point of the plot that can be dragged. */
typedef struct plot_handle {
    double length, height; /* metres; height is that of the crest */
    const char *name;      /* shown beside it; NULL: none */
} plot_handle;

/* Finds handle `index`. The swells come first, then the peak of the wind or of the spectrum, or the single waves. False: there is no such handle. */
static bool handle_at(const viewer *v, size_t index, plot_handle *out)
{
    const scene_water *water = &v->document.values.water;
    const scene_swell *swells = water->swell.items;
    if (index < water->swell.count) {
        *out = (plot_handle){SPECTRUM_GRAVITY * swells[index].period * swells[index].period / (2 * pi), swells[index].height / 2, "swell"};
        return true;
    }
    index -= water->swell.count;
    if (sea_of(water) == SEA_OF_WAVES) {
        const mgt_wave *wave = (const mgt_wave *)water->waves.items + index;
        if (index >= water->waves.count)
            return false;
        *out = (plot_handle){wave_shape_of(wave).wavelength, water->height * wave_crest(wave), NULL};
        return true;
    }
    const scene_list all = scene_water_all(water);
    const size_t others = swell_waves(water);
    const mgt_wave *peak = peak_of(&all, all.count > others ? all.count - others : 0);
    if (index > 0 || !peak)
        return false;
    *out = (plot_handle){wave_shape_of(peak).wavelength, wave_crest(peak), sea_of(water) == SEA_OF_WIND ? "wind" : "spectrum"};
    return true;
}

/* Holds the handle next to the pointer, if one is near. */
static void pick_handle(viewer *v, const ui_rect *box, const ui_pointer *pointer)
{
    plot_handle h;
    float best = 14 * v->ui_scale;
    v->held_handle = -1;
    for (size_t i = 0; handle_at(v, i, &h); i++) {
        const float off = hypotf(plot_x(box, h.length) - pointer->x, plot_y(box, h.height) - pointer->y);
        if (off < best) {
            best = off;
            v->held_handle = (int)i;
        }
    }
}

static void set(viewer *v, const char *format, size_t index, const char *key, double number)
{
    char name[64];
    snprintf(name, sizeof name, "%s[%zu].%s", format, index, key);
    control_set_number(&v->board, name, number);
}

/* Changes the wind or the height so that the peak comes to the pointer. In a developed sea the peak's length is about proportional to the square of the wind.
 * That is not exact, so it takes several frames. */
static void pull_peak(viewer *v, const plot_handle *h, double length, double height)
{
    const scene_water *water = &v->document.values.water;
    const bool wind = sea_of(water) == SEA_OF_WIND;
    const double speed = wind ? water->wind.speed : water->spectrum.settings.wind, wanted = speed * sqrt(length / h->length);
    if (fabs(log(length / h->length)) > 0.02)
        control_set_number(&v->board, wind ? "water.wind.speed" : "water.spectrum.wind", fmin(fmax(wanted, 0.6), 40));
    else if (h->height > 0)
        control_set_number(&v->board, "water.amplitude", fmin(fmax(water->height * height / h->height, 0.01), 20));
}

/* Moves the held handle to the pointer. */
static void pull_handle(viewer *v, const ui_rect *box, const ui_pointer *pointer)
{
    plot_handle h;
    const scene_water *water = &v->document.values.water;
    const double length = length_at(box, fminf(fmaxf(pointer->x, box->x), box->x + box->width));
    const double height = height_at(box, fminf(fmaxf(pointer->y, box->y), box->y + box->height));
    if (v->held_handle < 0 || !handle_at(v, (size_t)v->held_handle, &h))
        return;
    size_t index = (size_t)v->held_handle;
    if (index < water->swell.count) {
        set(v, "water.swell", index, "period", sqrt(2 * pi * length / SPECTRUM_GRAVITY));
        set(v, "water.swell", index, "height", 2 * height);
        return;
    }
    index -= water->swell.count;
    if (sea_of(water) != SEA_OF_WAVES) {
        pull_peak(v, &h, length, height);
        return;
    }
    v->selected_wave = index;
    set(v, "water.waves", index, "wavelength", length);
    set(v, "water.waves", index, "amplitude", height / fmax(water->height, 1e-6));
}

/* Draws a line for each wave in use, from the bottom of the plot to its height. */
static void draw_sticks(const viewer *v, const ui_rect *box)
{
    const scene_water *water = &v->document.values.water;
    const scene_list all = scene_water_all(water);
    const mgt_wave *waves = all.items;
    const size_t others = swell_waves(water), own = all.count > others ? all.count - others : 0;
    for (size_t i = 0; i < all.count && i < v->settings.waves.count; i++) {
        const float x = plot_x(box, wave_shape_of(&waves[i]).wavelength), y = plot_y(box, wave_crest(&waves[i]));
        const bool chosen = i == v->selected_wave && sea_of(water) == SEA_OF_WAVES;
        ui_draw_line(UI_LAYER_WINDOW, x, box->y + box->height, x, y, chosen ? white : i < own ? 0xedc77890 : 0x6f9fd8b0, chosen ? 2 : 1);
    }
}

static void draw_plot(viewer *v)
{
    const ui_rect box = ui_canvas("spectrum", 9 * ui_font_size());
    const ui_pointer pointer = ui_canvas_pointer();
    plot_handle h;
    if (pointer.pressed)
        pick_handle(v, &box, &pointer);
    if (pointer.held)
        pull_handle(v, &box, &pointer);
    else
        v->held_handle = -1;
    draw_grid(&box);
    ui_clip_begin(UI_LAYER_WINDOW, box);
    draw_sticks(v, &box);
    const bool single = sea_of(&v->document.values.water) == SEA_OF_WAVES;
    for (size_t i = 0; handle_at(v, i, &h); i++) {
        const float x = plot_x(&box, h.length), y = plot_y(&box, h.height), radius = (h.name ? 5 : 2.5f) * v->ui_scale;
        const uint32_t color = i < v->document.values.water.swell.count ? blue : accent;
        ui_draw_disk(UI_LAYER_WINDOW, x, y, radius, (int)i == v->held_handle ? white : color);
        if (!h.name)
            continue;
        const float gap = 8 * v->ui_scale, width = ui_text_width(h.name), right = x + gap;
        ui_draw_text(UI_LAYER_WINDOW, right + width < box.x + box.width ? right : x - gap - width, y - 0.6f * ui_font_size(), color, h.name);
    }
    ui_clip_end(UI_LAYER_WINDOW);
    ui_text(UI_TONE_FAINT, single ? "Height over length. Drag a wave's head." : "Height over length. Drag a handle.");
}

/* ---- wind, spectrum, swells ---- */

static void draw_kind(viewer *v)
{
    static const char *const labels[] = {"waves", "wind", "spectrum"};
    const float width = (ui_room().width - 14) / 3;
    const sea_kind now = sea_of(&v->document.values.water);
    for (int i = 0; i < 3; i++) {
        if (i > 0)
            ui_same_line(0);
        if (ui_toggle_button(labels[i], (int)now == i, width))
            sea_choose(v, (sea_kind)i);
    }
}

static void draw_sea(viewer *v)
{
    static const char *const wind[] =
        {"water.wind.speed", "water.wind.direction_deg", "water.wind.fetch", "water.wind.depth", "water.wind.count", "water.wind.seed", NULL};
    const spectrum_kind kind = v->document.values.water.spectrum.settings.kind;
    if (sea_of(&v->document.values.water) == SEA_OF_WIND) {
        panel_controls(v, wind);
        return;
    }
    if (kind == SPECTRUM_NONE)
        return;
    const field_row *water_row = field_find(scene_root_field()->fields, "water", 5);
    for (const field_row *row = field_find(water_row->fields, "spectrum", 8)->fields; row->key; row++) {
        const bool fetch = strcmp(row->key, "fetch") == 0, gamma = strcmp(row->key, "gamma") == 0;
        const bool directions = strcmp(row->key, "directions") == 0 || strcmp(row->key, "spread") == 0;
        char name[64];
        snprintf(name, sizeof name, "water.spectrum.%s", row->key);
        if ((!fetch || spectrum_takes_fetch(kind)) && (!gamma || spectrum_takes_gamma(kind)) && (!directions || !spectrum_has_directions(kind)))
            panel_control(v, name);
    }
}

static void draw_swells(viewer *v)
{
    static const char *const keys[] = {"height", "period", "direction_deg", "spread"};
    const scene_list *list = &v->document.values.water.swell;
    char name[64];
    for (size_t i = 0; i < list->count; i++) {
        for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++) {
            snprintf(name, sizeof name, "water.swell[%zu].%s", i, keys[k]);
            panel_control(v, name);
        }
        snprintf(name, sizeof name, "remove##swell%zu", i);
        if (ui_button(name, 0))
            swell_remove(v, i);
        ui_space(4);
    }
    if (ui_button("add a swell", 0))
        swell_add(v);
}

/* ---- single waves ---- */

static void draw_wave_row(viewer *v, const mgt_wave *wave, size_t i)
{
    char label[96];
    const wave_shape shape = wave_shape_of(wave);
    snprintf(label, sizeof label, "%3zu   %7.4f m   %7.2f m   %4.0f°##wave%zu", i, wave_crest(wave), shape.wavelength, shape.direction_deg, i);
    if (ui_selectable(label, v->selected_wave == i, 0))
        v->selected_wave = i;
}

static void draw_wave(viewer *v)
{
    static const char *const keys[] = {"amplitude", "wavelength", "direction_deg", "speed", "phase"};
    char name[64];
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        snprintf(name, sizeof name, "water.waves[%zu].%s", v->selected_wave, keys[i]);
        panel_control(v, name);
    }
}

static void draw_list(viewer *v)
{
    const scene_list *own = &v->document.values.water.waves, all = scene_water_all(&v->document.values.water);
    v->settings.waves.count = v->settings.waves.count < all.count ? v->settings.waves.count : MGT_MAX_WAVES;
    uint32_t used = v->settings.waves.count < all.count ? v->settings.waves.count : (uint32_t)all.count;
    if (panel_count(v, "waves used", &used, 0, (uint32_t)all.count, NULL))
        v->settings.waves.count = used < all.count ? used : MGT_MAX_WAVES;
    ui_text(UI_TONE_FAINT, "       amplitude      length        to");
    if (ui_child_begin("waves", 11 * ui_font_size()))
        for (size_t i = 0; i < all.count; i++)
            draw_wave_row(v, (const mgt_wave *)all.items + i, i);
    ui_child_end();
    if (own->count < all.count) {
        if (ui_button("make these single waves", 0))
            viewer_write_out_sea(v);
        ui_tooltip("Wind, spectrum and swells become the waves that they have made, each to be changed.");
        return;
    }
    if (ui_button("add", 0))
        wave_add(v);
    ui_same_line(0);
    ui_disabled_begin(own->count == 0);
    if (ui_button("remove", 0))
        wave_remove(v, v->selected_wave);
    ui_disabled_end();
    if (v->selected_wave < own->count)
        draw_wave(v);
}

/* ---- the page ---- */

void sea_page_draw(viewer *v)
{
    const scene_water *water = &v->document.values.water;
    const bool windy = sea_of(water) == SEA_OF_WIND || (sea_of(water) == SEA_OF_SPECTRUM && water->spectrum.settings.kind != SPECTRUM_BUOY);
    static const char *const form[] = {"water.amplitude", "water.choppiness", NULL};
    draw_kind(v);
    draw_sea(v);
    panel_controls(v, form);
    panel_control(v, windy && water->foam.share == 0 ? "water.foam.amount" : "water.foam.share");
    panel_control(v, "water.foam.persistence");
    draw_plot(v);
    if (ui_header("Swell", water->swell.count > 0))
        draw_swells(v);
    if (ui_header("Single waves", sea_of(water) == SEA_OF_WAVES))
        draw_list(v);
}
