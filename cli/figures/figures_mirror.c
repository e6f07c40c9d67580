/* SPDX-License-Identifier: MIT */
/* Fig. 20: the error of mapping a Gaussian of slopes to the light plane with a single Jacobian, as surfaces over the slopes' variances. */
#include <math.h>
#include <stdlib.h>

#include "cli/figures/figures_job.h"
#include "reference/equations.h"
#include "reference/linear_mirror.h"

static const double pi = 3.14159265358979323846;

/* SIDE variances of slope along x and along z: 0.004, 0.008, …, which are deviations from 0.06 to 0.22. RINGS and SPOKES give the places of lights. */
enum { SIDE = 12, RINGS = 3, SPOKES = 8 };
static const double variance_step = 0.004, disk_degrees = 2;

/* Errors for each pair of variances: index x, then z. */
typedef struct error_field {
    double value[SIDE][SIDE];
    double mean, most;
} error_field;

/* The direction to the eye, in the x–y plane at an elevation in degrees. Slopes along x then lie in the plane of view, slopes along z across it. */
static void view_direction(double degrees, double direction[3])
{
    const double elevation = degrees * pi / 180;
    direction[0] = -cos(elevation);
    direction[1] = sin(elevation);
    direction[2] = 0;
}

/* The error that the paper plots, according to its text: the distance of the densities, with the light where flat water mirrors it. It is the mean over
 * elevations of the eye from `lowest` to `highest` degrees. */
static double density_error(const slope_law *law, double lowest, double highest)
{
    double sum = 0;
    int views = 0;
    for (double degrees = lowest; degrees <= highest; degrees += 10, views++) {
        double to_eye[3], light[3];
        view_direction(degrees, to_eye);
        mirror_direction(to_eye, law->mean, light);
        sum += linear_density_error(to_eye, light, law);
    }
    return sum / views;
}

/* The error at low variance along x and high variance along z, divided by that at the reverse. */
static double lopsidedness(double lowest, double highest)
{
    const double low = variance_step, high = variance_step * SIDE;
    const slope_law across = {{0, 0}, {low, 0, high}}, along = {{0, 0}, {high, 0, low}};
    return density_error(&across, lowest, highest) / density_error(&along, lowest, highest);
}

/* The error that matters to a renderer: that of the fraction of slopes that mirror the light. The lights are placed where the distribution of slopes mirrors
 * them. Each error is the mean absolute error divided by the mean fraction. errors[0] uses the Jacobian at the mean slope, errors[1] that at the slope that
 * mirrors the light's centre. */
static void share_errors(const slope_law *law, double errors[2])
{
    double sums[2] = {0, 0}, exact = 0;
    const double radius = tan(disk_degrees * pi / 180);
    for (int view = 1; view <= 8; view++)
        for (int place = 0; place < RINGS * SPOKES; place++) {
            /* Each place is the middle of an equal part of the Gaussian's mass. */
            const double away = sqrt(-2 * log(1 - (place / SPOKES + 0.5) / RINGS)), around = 2 * pi * (place % SPOKES + 0.5) / SPOKES;
            const double slope[2] = {away * cos(around) * sqrt(law->covariance[0]), away * sin(around) * sqrt(law->covariance[2])};
            double to_eye[3], light[3];
            view_direction(10 * view, to_eye);
            mirror_direction(to_eye, slope, light);
            if (light[1] < 0.02)
                continue; /* the light is at or below the horizon */
            const double share = mirror_disk_fraction(to_eye, light, law, radius);
            exact += share;
            sums[0] += fabs(linear_disk_fraction(to_eye, light, law, radius, law->mean) - share);
            sums[1] += fabs(linear_disk_fraction(to_eye, light, law, radius, slope) - share);
        }
    for (int i = 0; i < 2; i++)
        errors[i] = sums[i] / exact;
}

static void measure(figures_job *f, error_field fields[3])
{
    for (int x = 0; x < SIDE && figures_good(f); x++) {
        for (int z = 0; z < SIDE; z++) {
            const slope_law law = {{0, 0}, {variance_step * (x + 1), 0, variance_step * (z + 1)}};
            double shares[2];
            share_errors(&law, shares);
            fields[0].value[x][z] = density_error(&law, 30, 60);
            fields[1].value[x][z] = shares[0];
            fields[2].value[x][z] = shares[1];
            for (int i = 0; i < 3; i++) {
                fields[i].mean += fields[i].value[x][z] / (SIDE * SIDE);
                fields[i].most = fmax(fields[i].most, fields[i].value[x][z]);
            }
        }
        figures_step(f);
    }
}

/* ---- surfaces, seen from above the corner of large variances ---- */

typedef struct view_box {
    double x, y, half, rise, tall, top; /* place of the back corner; step of a cell to the right and down; height of a value `top` */
} view_box;

static void project(const view_box *b, double x, double z, double value, double out[2])
{
    out[0] = b->x + (x - z) * b->half;
    out[1] = b->y + (x + z) * b->rise - b->tall * value / b->top;
}

static void draw_edge(svg *s, const view_box *b, double x0, double z0, double v0, double x1, double z1, double v1, const char *color)
{
    double from[2], to[2];
    project(b, x0, z0, v0, from);
    project(b, x1, z1, v1, to);
    svg_line(s, from[0], from[1], to[0], to[1], color, 1);
}

static void draw_axes(svg *s, const view_box *b, double step)
{
    const double last = SIDE - 1;
    double at[2];
    for (double v = 0; v <= b->top * 1.0001; v += step) {
        draw_edge(s, b, 0, last, v, 0, 0, v, "#ddd");
        draw_edge(s, b, 0, 0, v, last, 0, v, "#ddd");
        project(b, 0, last, v, at);
        svg_text(s, at[0] - 6, at[1] + 4, 11, SVG_RIGHT, "", "%g", v);
    }
    draw_edge(s, b, 0, last, 0, 0, last, b->top, "#222");
    draw_edge(s, b, 0, last, 0, last, last, 0, "#222");
    draw_edge(s, b, last, 0, 0, last, last, 0, "#222");
    for (int i = 3; i < SIDE; i += 4) {
        project(b, i, last, 0, at);
        svg_text(s, at[0] - 6, at[1] + 16, 11, SVG_RIGHT, "", "%g", variance_step * (i + 1));
        project(b, last, i, 0, at);
        svg_text(s, at[0] + 6, at[1] + 16, 11, SVG_LEFT, "", "%g", variance_step * (i + 1));
    }
    project(b, last * 0.45, last, 0, at);
    svg_text(s, at[0] - 62, at[1] + 40, 12, SVG_MIDDLE, "", "variance along x");
    project(b, last, last * 0.45, 0, at);
    svg_text(s, at[0] + 62, at[1] + 40, 12, SVG_MIDDLE, "", "variance along z");
}

static void draw_surface(svg *s, const view_box *b, const error_field *field)
{
    /* Cells are drawn from the back to the front. */
    for (int far = 0; far <= 2 * (SIDE - 2); far++)
        for (int x = 0; x < SIDE - 1; x++) {
            const int z = far - x;
            if (z < 0 || z >= SIDE - 1)
                continue;
            static const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            double points[8], mean = 0;
            for (int c = 0; c < 4; c++) {
                const double value = field->value[x + corners[c][0]][z + corners[c][1]];
                project(b, x + corners[c][0], z + corners[c][1], value, points + 2 * c);
                mean += value / 4;
            }
            svg_polygon(s, points, 4, svg_ramp(mean / b->top).text);
        }
}

static void draw(figures_job *f, const error_field fields[3])
{
    static const char *const titles[3] = {"(a) distance of the densities", "(b) light's share, Jacobian at the mean slope",
                                          "(c) light's share, Jacobian at the mirror slope"};
    static const char *const notes[3] = {"as published, Jacobian at the mean slope", "as published", "as mangata has it, same scale"};
    svg sheet;
    if (!figures_sheet(f, &sheet, 1320, 460))
        return;
    for (int i = 0; i < 3; i++) {
        const double most = fields[i == 2 ? 1 : i].most, step = most > 1 ? 0.5 : most > 0.4 ? 0.2 : most > 0.2 ? 0.1 : 0.05;
        const view_box box = {.x = 222 + 440 * i, .y = 260, .half = 14, .rise = 6.2, .tall = 190, .top = step * ceil(most / step)};
        svg_text(&sheet, box.x, 26, 13, SVG_MIDDLE, "font-weight=\"bold\"", "%s", titles[i]);
        svg_text(&sheet, box.x, 44, 12, SVG_MIDDLE, "", "%s: mean %.2g, largest %.2g", notes[i], fields[i].mean, fields[i].most);
        draw_axes(&sheet, &box, step);
        draw_surface(&sheet, &box, &fields[i]);
    }
    figures_plate(f, &sheet, "fig20", "Relative error of the linear map over slope variances");
}

static json_t *field_json(const error_field *field)
{
    json_t *rows = json_array();
    for (int x = 0; x < SIDE; x++) {
        json_t *row = json_array();
        for (int z = 0; z < SIDE; z++)
            json_array_append_new(row, json_real(field->value[x][z]));
        json_array_append_new(rows, row);
    }
    return json_pack("{s:f, s:f, s:o}", "mean", field->mean, "largest", field->most, "by_variance_x_then_z", rows);
}

void figures_mirror(figures_job *f)
{
    error_field *fields = calloc(3, sizeof *fields);
    if (!fields) {
        f->code = figures_no_memory();
        return;
    }
    figures_steps(f, SIDE);
    measure(f, fields);
    if (figures_good(f)) {
        const error_field *d = &fields[0];
        const int last = SIDE - 1;
        figures_section(f, "fig20", "Fig. 20: relative error of the linear map from slopes to reflections");
        fputs("<p class=\"published\">Published: relative error between the approximate and the sampled distribution of reflections over the "
              "slopes' variances along x and z, mean over view directions between the x and the y axis; larger where the variance along x is low "
              "and that along z high, and where both are high. No values are printed.</p>\n",
              f->page);
        fprintf(f->page,
                "<p>(a) is that measure: the integral of the absolute difference of both densities on the light plane, mean over views 30° to 60° "
                "up in the x–y plane. For flatter views the lopsidedness turns round (at 10° and 20° low x with high z has %.2f of the error of "
                "the reverse, at 30° to 60° %.2f). (b) and (c) are what a renderer needs: the share of slopes that show a light of %g° radius, "
                "wherever the slopes' distribution puts one; mean absolute error over the mean share. (b) takes the published Jacobian at the "
                "slopes' mean, (c) the one at the slope that mirrors the light's centre; views 10° to 80° up.</p>\n",
                lopsidedness(10, 20), lopsidedness(30, 60), disk_degrees);
        draw(f, fields);
        figures_check(f, "Fig. 20: error at low x and high z variance over that at high x and low z", d->value[0][last] / d->value[last][0], 1, INFINITY);
        figures_check(f, "Fig. 20: error at both variances high over that at both low", d->value[last][last] / d->value[0][0], 1, INFINITY);
        figures_check(f, "Fig. 20: error of the light's share with the Jacobian at the mirror slope over that at the mean slope",
                      fields[2].mean / fields[1].mean, 0, 0.1);
        json_object_set_new(f->result, "fig20",
                            json_pack("{s:o, s:o, s:o}", "density_at_mean", field_json(&fields[0]), "share_at_mean", field_json(&fields[1]), "share_at_mirror",
                                      field_json(&fields[2])));
        figures_section_end(f);
    }
    free(fields);
}
