/* SPDX-License-Identifier: MIT */
/* Axes and curves. */
#include "cli/common/plot.h"

#include <math.h>
#include <stdlib.h>

static double fraction(const plot_axis *axis, double value)
{
    return axis->logarithmic ? log(value / axis->low) / log(axis->high / axis->low) : (value - axis->low) / (axis->high - axis->low);
}

double plot_x(const plot *p, double value) { return p->x + p->width * fraction(&p->across, value); }

double plot_y(const plot *p, double value) { return p->y + p->height * (1 - fraction(&p->up, value)); }

static void tick(svg *s, const plot *p, bool across, double value, bool label)
{
    const double at = across ? plot_x(p, value) : plot_y(p, value);
    if (across) {
        svg_line(s, at, p->y, at, p->y + p->height, "#e4e4e4", 1);
        if (label)
            svg_text(s, at, p->y + p->height + 16, 11, SVG_MIDDLE, "", "%g", value);
    } else {
        svg_line(s, p->x, at, p->x + p->width, at, "#e4e4e4", 1);
        if (label)
            svg_text(s, p->x - 6, at + 4, 11, SVG_RIGHT, "", "%g", value);
    }
}

static void ticks(svg *s, const plot *p, bool across)
{
    const plot_axis *axis = across ? &p->across : &p->up;
    const double slack = 1e-9 * (axis->high - axis->low);
    if (!axis->logarithmic) {
        for (double k = ceil((axis->low - slack) / axis->step); axis->step > 0 && k * axis->step <= axis->high + slack; k++)
            tick(s, p, across, k == 0 ? 0 : k * axis->step, true);
        return;
    }
    static const double steps[] = {1, 2, 5};
    const bool all = log10(axis->high / axis->low) < 2.5;
    for (int decade = (int)floor(log10(axis->low)); decade <= (int)ceil(log10(axis->high)); decade++)
        for (int i = 0; i < 3; i++) {
            const double value = steps[i] * pow(10, decade);
            if (value >= axis->low - slack && value <= axis->high + slack)
                tick(s, p, across, value, all || i == 0);
        }
}

void plot_frame(svg *s, const plot *p)
{
    ticks(s, p, true);
    ticks(s, p, false);
    svg_box(s, p->x, p->y, p->width, p->height, "none", "#222");
    svg_text(s, p->x + p->width / 2, p->y - 10, 13, SVG_MIDDLE, "font-weight=\"bold\"", "%s", p->title);
    svg_text(s, p->x + p->width / 2, p->y + p->height + 36, 12, SVG_MIDDLE, "", "%s", p->across.label);
    svg_text_up(s, p->x - 56, p->y + p->height / 2, 12, p->up.label);
}

void plot_curve(svg *s, const plot *p, const double *x, const double *y, size_t count, const char *color, const char *dash)
{
    double *points = calloc(count ? count : 1, 2 * sizeof *points);
    if (!points)
        return;
    for (size_t i = 0; i < count; i++) {
        const double at = fraction(&p->up, y[i]), along = fraction(&p->across, x[i]);
        const bool inside = at >= -1e-9 && at <= 1 + 1e-9 && along >= -1e-9 && along <= 1 + 1e-9;
        points[2 * i] = inside ? plot_x(p, x[i]) : NAN;
        points[2 * i + 1] = inside ? plot_y(p, y[i]) : NAN;
    }
    svg_curve(s, points, count, color, 2, dash);
    free(points);
}

void plot_key(svg *s, double x, double y, int row, const char *color, const char *dash, const char *text)
{
    const double at = y + 18 * row;
    const double points[] = {x, at, x + 26, at};
    svg_curve(s, points, 2, color, 2.5, dash);
    svg_text(s, x + 33, at + 4, 11.5, SVG_LEFT, "", "%s", text);
}

const char *plot_color(size_t index)
{
    static const char *const colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222", "#8a8a00"};
    return colors[index % (sizeof colors / sizeof colors[0])];
}
