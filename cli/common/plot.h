/* SPDX-License-Identifier: MIT */
/* Axes, curves and bars on an SVG sheet. */
#ifndef MANGATA_CLI_COMMON_PLOT_H
#define MANGATA_CLI_COMMON_PLOT_H

#include "cli/common/svg.h"

typedef struct plot_axis {
    const char *label;
    double low, high;
    bool logarithmic;
    double step; /* of the ticks of a linear axis, 0: none; a logarithmic one has them at 1, 2 and 5 times the powers of ten, or at those alone */
} plot_axis;

typedef struct plot {
    double x, y, width, height; /* of the field between the axes */
    plot_axis across, up;
    const char *title;
} plot;

void plot_frame(svg *s, const plot *p);

/* Places on the sheet. */
double plot_x(const plot *p, double value);
double plot_y(const plot *p, double value);

/* Values outside the field are cut off. */
void plot_curve(svg *s, const plot *p, const double *x, const double *y, size_t count, const char *color, const char *dash);

/* A line of the legend, the first in row 0, from (x, y) down. */
void plot_key(svg *s, double x, double y, int row, const char *color, const char *dash, const char *text);

/* Colours that colour-blind readers can distinguish too; index modulo 8. */
const char *plot_color(size_t index);

#endif
