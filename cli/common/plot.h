/* SPDX-License-Identifier: MIT */
/* Axes, curves and a legend on an SVG sheet. */
#ifndef MANGATA_CLI_COMMON_PLOT_H
#define MANGATA_CLI_COMMON_PLOT_H

#include "cli/common/svg.h"

typedef struct plot_axis {
    const char *label;
    double low, high;
    bool logarithmic;
    double step; /* distance of ticks on a linear axis; 0: none. A logarithmic axis has ticks at 1, 2 and 5 times powers of ten */
} plot_axis;

typedef struct plot {
    double x, y, width, height; /* the field between the axes, units of the sheet */
    plot_axis across, up;       /* the x axis and the y axis */
    const char *title;
} plot;

/* Draws axes, ticks, labels and title. */
void plot_frame(svg *s, const plot *p);

/* Convert a value on an axis to a place on the sheet. */
double plot_x(const plot *p, double value);
double plot_y(const plot *p, double value);

/* Draws a curve through `count` points. Points outside of the field are left out. `dash` as in svg_curve(). */
void plot_curve(svg *s, const plot *p, const double *x, const double *y, size_t count, const char *color, const char *dash);

/* Draws line `row` of a legend that begins at (x, y); rows count from 0. */
void plot_key(svg *s, double x, double y, int row, const char *color, const char *dash, const char *text);

/* Colour number index modulo 8 of a set that colour-blind readers can distinguish, too. */
const char *plot_color(size_t index);

#endif
