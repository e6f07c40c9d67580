/* SPDX-License-Identifier: MIT
 * Everything over the picture: divider, errors, timings, legend, keys and log. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/picture/palette.h"
#include "viewer/app/panels.h"
#include "params/methods.h"
#include "cli/common/progress.h"

static const uint32_t white = 0xdde2eaff, faint = 0x8891a0ff, accent = 0xedc778ff, shade = 0x0a0d13c8, red = 0x5a1f1aee;

/* Height of the text, window coordinates. */
static float unit_of(const viewer *v) { return 13.5f * v->ui_scale; }

/* ---- divider ---- */

static void draw_label(float x, float y, const char *text, float unit)
{
    const float width = ui_text_width(text) + unit;
    ui_draw_box(UI_LAYER_BEHIND, (ui_rect){x, y, width, 1.7f * unit}, shade, 4);
    ui_draw_text(UI_LAYER_BEHIND, x + 0.5f * unit, y + 0.3f * unit, white, text);
}

static void side_label(const viewer *v, int side, char *text, size_t size)
{
    const mgt_quality q = quality_restricted(&v->settings.sides[side]);
    const picture *p = &v->render.pictures[side];
    const int used = snprintf(text, size, "%c  %s", side == SIDE_A ? 'A' : 'B', method_name(&q).text);
    if (method_is_sampled(q.method) && p->samples < p->samples_total)
        snprintf(text + used, size - (size_t)used, "  %.0f%%", 100.0 * (double)p->samples / (double)p->samples_total);
}

static void draw_divider(const viewer *v)
{
    const ui_rect *p = &v->place.place;
    const float unit = unit_of(v), x = p->x + (float)v->settings.view.wipe * p->width, middle = p->y + p->height / 2;
    char a[64], b[64];
    side_label(v, SIDE_A, a, sizeof a);
    side_label(v, SIDE_B, b, sizeof b);
    if (v->settings.view.compare == COMPARE_DIFFERENCE) {
        char both[160];
        snprintf(both, sizeof both, "%s   -   %s   times %.3g", a, b, v->settings.view.difference_scale);
        draw_label(p->x + unit, p->y + unit, both, unit);
        return;
    }
    ui_clip_begin(UI_LAYER_BEHIND, *p);
    ui_draw_line(UI_LAYER_BEHIND, x, p->y, x, p->y + p->height, 0x00000090, 3);
    ui_draw_line(UI_LAYER_BEHIND, x, p->y, x, p->y + p->height, accent, 1);
    ui_draw_disk(UI_LAYER_BEHIND, x, middle, 0.75f * unit, shade);
    ui_draw_circle(UI_LAYER_BEHIND, x, middle, 0.75f * unit, accent, 1.5f);
    ui_draw_line(UI_LAYER_BEHIND, x - 0.2f * unit, middle - 0.3f * unit, x - 0.2f * unit, middle + 0.3f * unit, accent, 1.5f);
    ui_draw_line(UI_LAYER_BEHIND, x + 0.2f * unit, middle - 0.3f * unit, x + 0.2f * unit, middle + 0.3f * unit, accent, 1.5f);
    draw_label(x - ui_text_width(a) - 2 * unit, p->y + unit, a, unit);
    draw_label(x + unit, p->y + unit, b, unit);
    judging_draw(v, x, p->y + 3 * unit, unit);
    ui_clip_end(UI_LAYER_BEHIND);
}

/* ---- errors and messages ---- */

/* Draws a line in the middle of the picture at `y`. Returns the y of the next one. */
static float draw_notice(const viewer *v, const notice *n, float y)
{
    const float unit = unit_of(v), width = ui_text_width(n->text) + 2 * unit;
    const ui_rect *room = &v->place.room;
    const float shown = fminf(width, room->width - 2 * unit), x = (room->width - shown) / 2;
    ui_draw_box(UI_LAYER_ABOVE, (ui_rect){x, y, shown, 2 * unit}, n->is_error ? red : shade, 5);
    ui_clip_begin(UI_LAYER_ABOVE, (ui_rect){x + unit, y, shown - 2 * unit + 1, 2 * unit});
    ui_draw_text(UI_LAYER_ABOVE, x + unit, y + 0.45f * unit, white, n->text);
    ui_clip_end(UI_LAYER_ABOVE);
    return y + 2.4f * unit;
}

static void draw_notices(viewer *v)
{
    float y = (v->settings.view.compare == COMPARE_OFF ? 1 : 3.4f) * unit_of(v);
    const notice *const all[] = {&v->scene_error, &v->shader_error, &v->render_error};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i]->text[0])
            y = draw_notice(v, all[i], y);
    if (v->message.until > seconds_now())
        y = draw_notice(v, &v->message, y);
    if (v->progress[0]) {
        notice n = {0};
        snprintf(n.text, sizeof n.text, "%s", v->progress);
        draw_notice(v, &n, y);
    }
}

/* ---- legend ---- */

static void tick(float x, float y, const char *text) { ui_draw_text(UI_LAYER_BEHIND, x - ui_text_width(text) / 2, y, white, text); }

static void draw_bar(ui_rect bar, palette_kind kind)
{
    enum { STEPS = 96 };
    for (int i = 0; i < STEPS; i++) {
        const ui_rect step = {bar.x + bar.width * (float)i / STEPS, bar.y, bar.width / STEPS + 1, bar.height};
        ui_draw_box(UI_LAYER_BEHIND, step, palette_color(kind, (i + 0.5) / STEPS), 0);
    }
}

static void draw_normal_legend(ui_rect box, float unit, double end)
{
    const float x = box.x + 3 * unit, y = box.y + 4.4f * unit, radius = 2 * unit;
    enum { RINGS = 8, RAYS = 24 };
    char text[32];
    snprintf(text, sizeof text, "rim: leans %.3g", end);
    for (int i = RINGS; i > 0; i--)
        for (int j = 0; j < RAYS; j++) {
            const double lean = (double)i / RINGS, angle = 2 * 3.14159265358979 * j / RAYS;
            const double to[2] = {lean * sin(angle), -lean * cos(angle)};
            ui_draw_disk(UI_LAYER_BEHIND, x + radius * (float)to[0], y + radius * (float)to[1], 0.34f * unit, palette_lean(to[0], to[1]));
        }
    ui_draw_text(UI_LAYER_BEHIND, box.x + 6.2f * unit, y - 1.6f * unit, white, text);
    ui_draw_text(UI_LAYER_BEHIND, box.x + 6.2f * unit, y - 0.4f * unit, faint, "up: -z (north)");
    ui_draw_text(UI_LAYER_BEHIND, box.x + 6.2f * unit, y + 0.8f * unit, faint, "right: +x (east)");
}

static const char *layer_meaning(mgt_layer layer)
{
    switch (layer) {
    case MGT_LAYER_COVERAGE:
        return ", fraction that mirrors the light";
    case MGT_LAYER_MASK:
        return ", fraction that is water";
    case MGT_LAYER_DEPTH:
        return ", metres along the ray";
    case MGT_LAYER_NORMAL:
        return ", horizontal part";
    case MGT_LAYER_FOAM:
        return ", fraction that foam covers";
    case MGT_LAYER_SAMPLES:
    case MGT_LAYER_IMPORTANCE:
    case MGT_LAYER_DETAIL:
    case MGT_LAYER_REFRACTION:
    case MGT_LAYER_REFRACTION_ERROR:
    case MGT_LAYER_COLOR:
        break;
    }
    return "";
}

static void draw_legend(const viewer *v)
{
    const mgt_layer layer = (mgt_layer)v->settings.view.layer;
    const bool difference = v->settings.view.compare == COMPARE_DIFFERENCE;
    if (!v->settings.panel.legend || (layer == MGT_LAYER_COLOR && !difference))
        return;
    const float unit = unit_of(v), bottom = v->settings.panel.shown ? 5 : 1;
    const bool wheel = layer == MGT_LAYER_NORMAL && !difference;
    const float height = wheel ? 7.4f * unit : 4.6f * unit;
    const ui_rect box = {v->place.room.x + unit, v->place.room.height - height - bottom * unit, 17 * unit, height};
    const ui_rect bar = {box.x + 1.4f * unit, box.y + 1.9f * unit, box.width - 2.8f * unit, 0.9f * unit};
    char title[64], low[32], middle[32], high[32];
    ui_draw_box(UI_LAYER_BEHIND, box, shade, 5);
    if (difference) {
        const double end = 1 / v->settings.view.difference_scale;
        const bool scalar = layer != MGT_LAYER_COLOR && layer != MGT_LAYER_NORMAL;
        snprintf(title, sizeof title, "%s: A - B%s", layer_choices[layer], scalar ? "" : " around grey");
        snprintf(low, sizeof low, "%.3g", -end);
        snprintf(high, sizeof high, "+%.3g", end);
        snprintf(middle, sizeof middle, "0");
        if (scalar)
            draw_bar(bar, PALETTE_DIFFERENCE);
        for (int i = 0; i < 64 && !scalar; i++)
            ui_draw_box(UI_LAYER_BEHIND, (ui_rect){bar.x + bar.width * (float)i / 64, bar.y, bar.width / 64 + 1, bar.height},
                        (uint32_t)(i * 4) * 0x01010100u | 0xff, 0);
    } else {
        const double end = layer == MGT_LAYER_COVERAGE ? v->settings.view.coverage_end : 1;
        const view_settings *s = &v->settings.view;
        const double near_depth = fmin(s->near_depth, s->far_depth), far_depth = fmax(s->near_depth, s->far_depth);
        snprintf(title, sizeof title, "%s%s", layer_choices[layer], layer_meaning(layer));
        snprintf(low, sizeof low, "%.6g", layer == MGT_LAYER_DEPTH ? near_depth : 0.0);
        snprintf(middle, sizeof middle, "%.6g", layer == MGT_LAYER_DEPTH ? sqrt(near_depth * far_depth) : 0.5 * end);
        snprintf(high, sizeof high, "%.6g", layer == MGT_LAYER_DEPTH ? far_depth : end);
        if (wheel)
            draw_normal_legend(box, unit, v->settings.view.lean_end);
        else
            draw_bar(bar, PALETTE_AMOUNT);
    }
    ui_draw_text(UI_LAYER_BEHIND, box.x + unit, box.y + 0.4f * unit, faint, title);
    if (wheel)
        return;
    tick(bar.x, bar.y + 1.2f * unit, low);
    tick(bar.x + bar.width / 2, bar.y + 1.2f * unit, middle);
    tick(bar.x + bar.width, bar.y + 1.2f * unit, high);
}

/* ---- timings ---- */

/* Draws the times of the last frames from left to right, up to `most` milliseconds, with lines at 60 and 30 frames a second. */
static void draw_graph(const timing_ring *t, float most)
{
    const ui_rect box = ui_canvas("graph", 5 * ui_font_size());
    float points[2 * TIMING_FRAMES];
    ui_draw_box(UI_LAYER_WINDOW, box, 0x10141cff, 3);
    for (int i = 0; i < 2; i++) {
        const float y = box.y + box.height * (1 - (i == 0 ? 16.67f : 33.33f) / most);
        if (y > box.y)
            ui_draw_line(UI_LAYER_WINDOW, box.x, y, box.x + box.width, y, 0x3a4454ff, 1);
    }
    for (int i = 0; i < t->count; i++) {
        points[2 * i] = box.x + box.width * (float)(i + TIMING_FRAMES - t->count) / (TIMING_FRAMES - 1);
        points[2 * i + 1] = box.y + box.height * (1 - fminf(timing_at(t, i) / most, 1));
    }
    ui_draw_polyline(UI_LAYER_WINDOW, points, t->count, accent, 1.5f, false);
}

static void draw_histogram(const timing_ring *t, float most)
{
    enum { BINS = 32 };
    int bins[BINS] = {0}, top = 1;
    const ui_rect box = ui_canvas("histogram", 3.5f * ui_font_size());
    ui_draw_box(UI_LAYER_WINDOW, box, 0x10141cff, 3);
    for (int i = 0; i < t->count; i++) {
        const int bin = (int)(t->ms[i] / most * BINS);
        bins[bin < BINS ? bin : BINS - 1]++;
    }
    for (int i = 0; i < BINS; i++)
        top = bins[i] > top ? bins[i] : top;
    for (int i = 0; i < BINS; i++) {
        const float height = box.height * (float)bins[i] / (float)top;
        const ui_rect bar = {box.x + box.width * (float)i / BINS + 1, box.y + box.height - height, box.width / BINS - 1, height};
        ui_draw_box(UI_LAYER_WINDOW, bar, 0x6f8fb8ff, 0);
    }
}

static void draw_timings(viewer *v)
{
    const timings *t = &v->timings;
    const float unit = unit_of(v), width = 24 * unit;
    char text[128];
    float most = 20;
    for (int i = 0; i < t->render.count; i++)
        most = fmaxf(most, 1.1f * t->render.ms[i]);
    if (ui_panel_begin("timings", (ui_rect){unit, 4 * unit, width, 0}, UI_PANEL_GLASS | UI_PANEL_FITS)) {
        snprintf(text, sizeof text, "render %.1f ms, window %.1f ms (medians)", (double)timing_median(&t->render), (double)timing_median(&t->window));
        ui_text(UI_TONE_NORMAL, text);
        draw_graph(&t->render, most);
        draw_histogram(&t->render, most);
        snprintf(text, sizeof text, "0 to %.0f ms, last %d frames", (double)most, t->render.count);
        ui_text(UI_TONE_FAINT, text);
        for (size_t i = 0; i < t->pass_count; i++) {
            snprintf(text, sizeof text, "%-12s %8.3f ms", t->passes[i].name, 1e3 * t->passes[i].seconds);
            ui_text(UI_TONE_FAINT, text);
        }
    }
    ui_panel_end();
}

/* ---- keys, log ---- */

static void draw_key(const key_help *help, float left, float unit)
{
    if (left > 0)
        ui_same_line(left);
    ui_text(UI_TONE_ACCENT, help->keys);
    ui_same_line(left + 7.5f * unit);
    ui_text(UI_TONE_NORMAL, help->what);
}

static void draw_keys(viewer *v)
{
    const float unit = unit_of(v), column = 27 * unit, window = v->place.room.width + panels_width(v);
    const size_t columns = window > 2 * column ? 2 : 1, rows = (key_help_count + columns - 1) / columns;
    const float width = fminf((float)columns * column, window), height = fminf(((float)rows + 2) * 1.8f * unit, v->place.room.height - 2 * unit);
    const float left = fmaxf(fminf((v->place.room.width - width) / 2, window - width), 0);
    const ui_rect place = {left, (v->place.room.height - height) / 2, width, height};
    if (ui_panel_begin("keys", place, UI_PANEL_SCROLLS)) {
        ui_text(UI_TONE_ACCENT, "Keys and pointer");
        for (size_t row = 0; row < rows; row++)
            for (size_t i = row; i < key_help_count; i += rows)
                draw_key(&key_helps[i], i == row ? 0 : column + 0.5f * unit, unit);
    }
    ui_panel_end();
}

static void draw_log(viewer *v)
{
    const float unit = unit_of(v);
    const ui_rect place = {unit, v->place.room.height - 18 * unit, v->place.room.width - 2 * unit, 12 * unit};
    if (ui_panel_begin("log", place, UI_PANEL_GLASS | UI_PANEL_SCROLLS))
        for (int i = 0; i < v->journal.count; i++)
            ui_text_wrapped(UI_TONE_NORMAL, v->journal.lines[(v->journal.next - 1 - i + LOG_LINES) % LOG_LINES]);
    ui_panel_end();
}

/* Draws in the corner which key shows the list of keys. */
static void draw_hint(const viewer *v)
{
    static const char text[] = "?  keys";
    const float unit = unit_of(v), width = ui_text_width(text) + unit;
    const ui_rect *room = &v->place.room;
    draw_label(room->x + room->width - width - unit, room->y + unit, text, unit);
}

void overlays_draw(viewer *v)
{
    if (!v->settings.panel.keys && !v->settings.panel.inspector)
        draw_hint(v);
    if (v->settings.view.compare != COMPARE_OFF)
        draw_divider(v);
    draw_legend(v);
    if (v->settings.panel.timings)
        draw_timings(v);
    if (v->settings.panel.inspector)
        inspector_draw(v);
    if (v->settings.panel.log)
        draw_log(v);
    if (v->settings.panel.keys)
        draw_keys(v);
    dialog_draw(v);
    draw_notices(v);
}
