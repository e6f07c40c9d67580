/* SPDX-License-Identifier: MIT */
/* Writing of SVG sheets. */
#include "cli/common/svg.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

#include "cli/common/markup.h"
#include "cli/common/memory_text.h"

bool svg_start(svg *s, double width, double height)
{
    *s = (svg){.stream = NULL};
    s->stream = open_memstream(&s->text, &s->size);
    if (!s->stream)
        return false;
    fprintf(s->stream,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\" font-family=\"DejaVu Sans, Helvetica, "
            "Arial, sans-serif\">\n",
            width, height, width, height);
    svg_box(s, 0, 0, width, height, "#fff", "none");
    return true;
}

char *svg_finish(svg *s, size_t *size)
{
    fputs("</svg>\n", s->stream);
    if (!memory_text_finish(s->stream, &s->text))
        return NULL;
    *size = s->size;
    return s->text;
}

void svg_text(svg *s, double x, double y, double size, svg_anchor anchor, const char *style, const char *format, ...)
{
    static const char *const anchors[] = {"start", "middle", "end"};
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fprintf(s->stream, "<text x=\"%g\" y=\"%g\" font-size=\"%g\" text-anchor=\"%s\" %s>", x, y, size, anchors[anchor], style);
    markup_escape(s->stream, text);
    fputs("</text>\n", s->stream);
}

void svg_text_up(svg *s, double x, double y, double size, const char *text)
{
    fprintf(s->stream, "<text transform=\"translate(%g %g) rotate(-90)\" font-size=\"%g\" text-anchor=\"middle\">", x, y, size);
    markup_escape(s->stream, text);
    fputs("</text>\n", s->stream);
}

void svg_line(svg *s, double x0, double y0, double x1, double y1, const char *color, double width)
{
    fprintf(s->stream, "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\" stroke-width=\"%g\"/>\n", x0, y0, x1, y1, color, width);
}

void svg_box(svg *s, double x, double y, double width, double height, const char *fill, const char *stroke)
{
    fprintf(s->stream, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\" stroke=\"%s\"/>\n", x, y, width, height, fill, stroke);
}

void svg_curve(svg *s, const double *points, size_t count, const char *color, double width, const char *dash)
{
    bool pen = false;
    fputs("<path d=\"", s->stream);
    for (size_t i = 0; i < count; i++) {
        const bool finite = isfinite(points[2 * i]) && isfinite(points[2 * i + 1]);
        if (finite)
            fprintf(s->stream, "%c%.2f %.2f", pen ? 'L' : 'M', points[2 * i], points[2 * i + 1]);
        pen = finite;
    }
    fprintf(s->stream, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"%g\" stroke-dasharray=\"%s\" stroke-linejoin=\"round\"/>\n", color, width,
            dash[0] ? dash : "none");
}

void svg_polygon(svg *s, const double *points, size_t count, const char *fill)
{
    fputs("<polygon points=\"", s->stream);
    for (size_t i = 0; i < count; i++)
        fprintf(s->stream, "%.2f,%.2f ", points[2 * i], points[2 * i + 1]);
    fprintf(s->stream, "\" fill=\"%s\" stroke=\"#222\" stroke-width=\".4\" stroke-linejoin=\"round\"/>\n", fill);
}

bool svg_picture(svg *s, double x, double y, double width, double height, const uint8_t *png, size_t png_size, uint32_t picture_width, uint32_t picture_height,
                 svg_crop crop)
{
    size_t length = 0;
    char *text = base64_text(png, png_size, &length);
    if (!text)
        return false;
    fprintf(s->stream,
            "<svg x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" viewBox=\"%g %g %g %g\" preserveAspectRatio=\"none\"><image width=\"%u\" "
            "height=\"%u\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"data:image/png;base64,",
            x, y, width, height, crop.x, crop.y, crop.width, crop.height, picture_width, picture_height);
    fwrite(text, 1, length, s->stream);
    fputs("\"/></svg>\n", s->stream);
    free(text);
    return true;
}

svg_color svg_ramp(double t)
{
    static const double stops[][3] = {{44, 22, 92}, {50, 74, 140}, {38, 122, 142}, {40, 166, 126}, {126, 202, 80}, {250, 228, 42}};
    enum { LAST = sizeof stops / sizeof stops[0] - 1 };
    const double at = fmin(fmax(t, 0), 1) * LAST;
    const int i = at < LAST ? (int)at : LAST - 1;
    int rgb[3];
    svg_color color;
    for (int c = 0; c < 3; c++)
        rgb[c] = (int)lrint(stops[i][c] + (at - i) * (stops[i + 1][c] - stops[i][c]));
    snprintf(color.text, sizeof color.text, "#%02x%02x%02x", rgb[0] & 255, rgb[1] & 255, rgb[2] & 255);
    return color;
}
