/* SPDX-License-Identifier: MIT */
/* Plates and plots as SVG: text set by whoever shows it, pictures embedded, nothing fetched from elsewhere. */
#ifndef MANGATA_CLI_COMMON_SVG_H
#define MANGATA_CLI_COMMON_SVG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Lengths in user units, y down. */
typedef struct svg {
    FILE *stream;
    char *text;
    size_t size;
} svg;

/* A white sheet. False when memory runs out. */
bool svg_start(svg *s, double width, double height);

/* Ends the sheet; the text belongs to the caller. NULL when memory ran out. */
char *svg_finish(svg *s, size_t *size);

typedef enum svg_anchor { SVG_LEFT, SVG_MIDDLE, SVG_RIGHT } svg_anchor;

/* One line of text on the base line y. `style`: "" or further attributes, such as "font-weight='bold'". */
void svg_text(svg *s, double x, double y, double size, svg_anchor anchor, const char *style, const char *format, ...) __attribute__((format(printf, 7, 8)));

/* The same upwards, centred on (x, y). */
void svg_text_up(svg *s, double x, double y, double size, const char *text);

void svg_line(svg *s, double x0, double y0, double x1, double y1, const char *color, double width);
void svg_box(svg *s, double x, double y, double width, double height, const char *fill, const char *stroke);

/* A polyline of `count` points x, y; `dash` as stroke-dasharray, "" for a whole line. Points that are not finite break it. */
void svg_curve(svg *s, const double *points, size_t count, const char *color, double width, const char *dash);

/* A filled polygon with a hairline. */
void svg_polygon(svg *s, const double *points, size_t count, const char *fill);

/* Part of a picture, every pixel a square. */
typedef struct svg_crop {
    double x, y, width, height; /* in pixels */
} svg_crop;

/* Embeds a PNG of `picture_width` x `picture_height` pixels. False when memory runs out. */
bool svg_picture(svg *s, double x, double y, double width, double height, const uint8_t *png, size_t png_size, uint32_t picture_width, uint32_t picture_height,
                 svg_crop crop);

/* "#rrggbb" of t in [0, 1] on a ramp from dark blue by green to yellow, equal steps looking alike. */
typedef struct svg_color {
    char text[8];
} svg_color;
svg_color svg_ramp(double t);

#endif
