/* SPDX-License-Identifier: MIT
 * The pixel inspector: the numbers of one pixel, and a plot of the path of its mirrored view over the light's disk. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "viewer/app/panels.h"

/* Computes a pixel of the full-size picture by mgt_inspect_pixel(). False: it failed, and v->render_error may say why. */
static bool look_into(viewer *v, uint32_t x, uint32_t y, mgt_pixel_info *info)
{
    shot now;
    mgt_context *context = viewer_tools(v);
    if (!context || !viewer_take_shot(v, &now))
        return false;
    now.scene.image = (mgt_image){.width = v->place.width, .height = v->place.height};
    *info = (mgt_pixel_info){.struct_size = sizeof *info};
    if (mgt_inspect_pixel(context, &now.scene, x, y, info) == MGT_OK)
        return true;
    snprintf(v->render_error.text, sizeof v->render_error.text, "%s", mgt_last_error(context));
    return false;
}

void viewer_inspect(viewer *v)
{
    inspection *seen = &v->inspection;
    const inspect_settings *at = &v->settings.inspect;
    const uint32_t x = at->x < v->place.width ? at->x : v->place.width - 1, y = at->y < v->place.height ? at->y : v->place.height - 1;
    if (seen->valid && seen->x == x && seen->y == y && seen->serial == v->render.serial)
        return;
    seen->valid = look_into(v, x, y, &seen->info);
    seen->x = x;
    seen->y = y;
    seen->serial = v->render.serial;
}

static uint32_t pixel_at(double fraction, uint32_t side) { return (uint32_t)fmin(fmax(floor(fraction * side), 0), side - 1); }

bool viewer_point_at(viewer *v, const double at[2], double point[3], double middle[2])
{
    const uint32_t x = pixel_at(at[0], v->place.width), y = pixel_at(at[1], v->place.height);
    mgt_pixel_info info;
    middle[0] = (x + 0.5) / v->place.width;
    middle[1] = (y + 0.5) / v->place.height;
    if (!look_into(v, x, y, &info) || !(info.water > 0) || !isfinite(info.distance))
        return false;
    memcpy(point, info.position, sizeof info.position);
    return true;
}

/* ---- the plot ---- */

/* The mapping of the light plane to the canvas. */
typedef struct plot {
    ui_rect box;
    double scale;     /* window coordinates per unit of the light plane */
    double center[2]; /* point of the light plane at the canvas's centre */
} plot;

/* Window x of coordinate e, whose axis points to the left, as for an observer who looks at the light. */
static float plot_x(const plot *p, double e) { return p->box.x + p->box.width / 2 - (float)((e - p->center[0]) * p->scale); }

static float plot_y(const plot *p, double f) { return p->box.y + p->box.height / 2 - (float)((f - p->center[1]) * p->scale); }

/* Draws the ellipse at `n` standard deviations of a Gaussian. */
static void draw_ellipse(const plot *p, const double covariance[3], const double middle[2], double n, uint32_t color)
{
    enum { STEPS = 48 };
    float points[2 * STEPS];
    const double a = sqrt(fmax(covariance[0], 0)), b = a > 0 ? covariance[1] / a : 0, c = sqrt(fmax(covariance[2] - b * b, 0));
    for (int i = 0; i < STEPS; i++) {
        const double angle = 2 * 3.14159265358979323846 * i / STEPS;
        points[2 * i] = plot_x(p, middle[0] + n * a * cos(angle));
        points[2 * i + 1] = plot_y(p, middle[1] + n * (b * cos(angle) + c * sin(angle)));
    }
    ui_draw_polyline(UI_LAYER_WINDOW, points, STEPS, color, 1.2f, true);
}

static void draw_plot(const mgt_pixel_info *info)
{
    const uint32_t sun = 0xedc77855, sun_edge = 0xedc778ff, path = 0xff9d6bff, near_color = 0x8fb9e6ff, far_color = 0x8fb9e670;
    plot p = {.box = ui_canvas("light plane", 11 * ui_font_size())};
    const double middle[2] = {(info->path[0][0] + info->path[1][0]) / 2, (info->path[0][1] + info->path[1][1]) / 2};
    const double half[2] = {fabs(info->path[1][0] - info->path[0][0]) / 2, fabs(info->path[1][1] - info->path[0][1]) / 2};
    /* The plot shows the disk, and two standard deviations around the path. */
    const double spread = 2 * sqrt(fmax(fmax(info->covariance[0], info->covariance[2]), 0)), radius = 1.3 * info->light_radius;
    double need = 0;
    for (int i = 0; i < 2; i++) {
        const double low = fmin(middle[i] - half[i] - spread, -radius), high = fmax(middle[i] + half[i] + spread, radius);
        p.center[i] = (low + high) / 2;
        const double side = (double)(i == 0 ? p.box.width : p.box.height);
        need = fmax(need, (high - low) / side);
    }
    p.scale = 1 / fmax(need, 1e-9);
    ui_draw_box(UI_LAYER_WINDOW, p.box, 0x0a0d13ff, 3);
    ui_clip_begin(UI_LAYER_WINDOW, p.box);
    ui_draw_line(UI_LAYER_WINDOW, p.box.x, plot_y(&p, 0), p.box.x + p.box.width, plot_y(&p, 0), 0x2a3342ff, 1);
    ui_draw_line(UI_LAYER_WINDOW, plot_x(&p, 0), p.box.y, plot_x(&p, 0), p.box.y + p.box.height, 0x2a3342ff, 1);
    const float r = fmaxf((float)(info->light_radius * p.scale), 1.5f);
    ui_draw_disk(UI_LAYER_WINDOW, plot_x(&p, 0), plot_y(&p, 0), r, sun);
    ui_draw_circle(UI_LAYER_WINDOW, plot_x(&p, 0), plot_y(&p, 0), r, sun_edge, 1.2f);
    draw_ellipse(&p, info->covariance, middle, 1, near_color);
    draw_ellipse(&p, info->covariance, middle, 2, far_color);
    const float open[2] = {plot_x(&p, info->path[0][0]), plot_y(&p, info->path[0][1])};
    const float close[2] = {plot_x(&p, info->path[1][0]), plot_y(&p, info->path[1][1])};
    ui_draw_line(UI_LAYER_WINDOW, open[0], open[1], close[0], close[1], path, 2);
    ui_draw_disk(UI_LAYER_WINDOW, close[0], close[1], 3, path);
    ui_clip_end(UI_LAYER_WINDOW);
}

/* ---- the panel ---- */

static void row(const char *name, const char *format, double a, double b, double c)
{
    char text[128];
    ui_text(UI_TONE_FAINT, name);
    ui_same_line(7.5f * ui_font_size());
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    snprintf(text, sizeof text, format, a, b, c);
#pragma GCC diagnostic pop
    ui_text(UI_TONE_NORMAL, text);
}

static void draw_numbers(const mgt_pixel_info *i)
{
    row("water", "%.4f", i->water, 0, 0);
    row("coverage", "%.6f", i->coverage, 0, 0);
    row("radiance", "%.4g  %.4g  %.4g", i->radiance[0], i->radiance[1], i->radiance[2]);
    row("position", "%.2f  %.3f  %.2f m", i->position[0], i->position[1], i->position[2]);
    row("distance", "%.2f m", i->distance, 0, 0);
    row("slope, open", "%+.5f  %+.5f", i->slope_open[0], i->slope_open[1], 0);
    row("slope, close", "%+.5f  %+.5f", i->slope_close[0], i->slope_close[1], 0);
    row("mirror slope", "%+.5f  %+.5f", i->mirror_slope[0], i->mirror_slope[1], 0);
    row("unresolved", "%.3e  %.3e  %.3e", i->unresolved[0], i->unresolved[1], i->unresolved[2]);
    row("bend", "%.3e  %.3e  %.3e", i->bend[0], i->bend[1], i->bend[2]);
    row("waves", "%.0f resolved, %.0f mixed, %.0f filtered", i->resolved, i->mixed, i->filtered);
}

void inspector_draw(viewer *v)
{
    char title[64];
    const float unit = 13.5f * v->ui_scale, width = 24 * unit;
    const ui_rect *p = &v->place.place;
    viewer_inspect(v);
    const inspection *seen = &v->inspection;
    const ui_rect place = {v->place.room.width - width - unit, 4 * unit, width, 0};
    if (ui_panel_begin("inspector", place, UI_PANEL_GLASS | UI_PANEL_FITS)) {
        snprintf(title, sizeof title, "Pixel %u, %u", seen->x, seen->y);
        ui_text(UI_TONE_ACCENT, title);
        if (!seen->valid)
            ui_text(UI_TONE_FAINT, "nothing is known of it");
        else
            draw_numbers(&seen->info);
        if (seen->valid && seen->info.light_radius > 0) {
            draw_plot(&seen->info);
            ui_text(UI_TONE_FAINT, "path of the mirrored view over the light");
        }
    }
    ui_panel_end();
    if (!seen->valid || v->settings.view.zoom > 1)
        return;
    const float x = p->x + p->width * ((float)seen->x + 0.5f) / (float)v->place.width;
    const float y = p->y + p->height * ((float)seen->y + 0.5f) / (float)v->place.height;
    ui_draw_circle(UI_LAYER_BEHIND, x, y, 7, 0x000000b0, 3);
    ui_draw_circle(UI_LAYER_BEHIND, x, y, 7, 0xedc778ff, 1.2f);
}
