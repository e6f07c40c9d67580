/* SPDX-License-Identifier: MIT */
/* Sheets of SVG with text, shapes and embedded pictures. A sheet refers to no other file. The reader's program chooses the font. */
#ifndef MANGATA_CLI_COMMON_SVG_H
#define MANGATA_CLI_COMMON_SVG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A sheet in work. Lengths are in user units, with y down. Colours are those of SVG, such as "#222" or "none". */
typedef struct svg {
    FILE *stream;
    char *text;
    size_t size;
} svg;

/* Starts a white sheet. False: out of memory. */
bool svg_start(svg *s, double width, double height);

/* Ends the sheet and returns its text, which the caller frees. NULL: memory has run out, now or before. */
char *svg_finish(svg *s, size_t *size);

typedef enum svg_anchor { SVG_LEFT, SVG_MIDDLE, SVG_RIGHT } svg_anchor;

/* Draws a line of text with its baseline at y and its anchor at x. `size` is the font size. `style` is "" or further attributes, such as
 * "font-weight='bold'". */
void svg_text(svg *s, double x, double y, double size, svg_anchor anchor, const char *style, const char *format, ...) __attribute__((format(printf, 7, 8)));

/* Draws a line of text that runs upwards, centred on (x, y). */
void svg_text_up(svg *s, double x, double y, double size, const char *text);

void svg_line(svg *s, double x0, double y0, double x1, double y1, const char *color, double width);
void svg_box(svg *s, double x, double y, double width, double height, const char *fill, const char *stroke);

/* Draws a polyline of `count` points x, y. `dash` is a stroke-dasharray; "": a solid line. The line is broken at points that are not finite. */
void svg_curve(svg *s, const double *points, size_t count, const char *color, double width, const char *dash);

/* Draws a filled polygon of `count` points x, y with a thin outline. */
void svg_polygon(svg *s, const double *points, size_t count, const char *fill);

/* Part of a picture. */
typedef struct svg_crop {
    double x, y, width, height; /* pixels */
} svg_crop;

/* Embeds the part `crop` of a PNG of picture_width × picture_height pixels, stretched to width × height units. False: out of memory. */
bool svg_picture(svg *s, double x, double y, double width, double height, const uint8_t *png, size_t png_size, uint32_t picture_width, uint32_t picture_height,
                 svg_crop crop);

/* The colour "#rrggbb" at t, clamped to [0, 1], on a ramp from dark blue over green to yellow. Equal steps of t look equally large. */
typedef struct svg_color {
    char text[8];
} svg_color;
svg_color svg_ramp(double t);

#endif
