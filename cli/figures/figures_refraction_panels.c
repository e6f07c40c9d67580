/* SPDX-License-Identifier: MIT */
/* Panels of the plates of refraction: parts of pictures, their differences from the path-traced reference, and their artefacts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/figures/figures_refraction.h"

static const char *const kind_names[] = {[PANEL_PICTURE] = "", [PANEL_DIFFERENCE] = "-difference", [PANEL_ARTEFACTS] = "-artefacts"};

static svg_crop panel_crop(const refraction_figures *r, const refraction_panel *p)
{
    const compare_scene *s = refraction_scene(r, p->view);
    if (p->width == 0)
        return (svg_crop){0, 0, s->width, s->height};
    return (svg_crop){floor(p->left * s->width), floor(p->top * s->height), fmax(floor(p->width * s->width), 1), fmax(floor(p->height * s->height), 1)};
}

double refraction_panel_height(const refraction_figures *r, const refraction_panel *p)
{
    const svg_crop crop = panel_crop(r, p);
    return p->across * crop.height / crop.width;
}

/* The colour of a difference: white over red to black, or grey where there is no water. */
static void difference_pixel(uint8_t rgba[4], double difference, bool water)
{
    const double t = difference / ARTEFACT, red = t < 1 ? 1 : fmax(1 - (t - 1) / 2, 0), other = fmax(1 - t, 0);
    const uint8_t pixel[4] = {(uint8_t)lrint(255 * red), (uint8_t)lrint(255 * other), (uint8_t)lrint(255 * other), 255};
    const uint8_t land[4] = {225, 225, 225, 255};
    memcpy(rgba, water ? pixel : land, 4);
}

/* Makes a pixel red if it is an artefact, otherwise pale and grey, so that red stands out. */
static void artefact_pixel(uint8_t rgba[4], bool artefact)
{
    const double grey = 0.299 * rgba[0] + 0.587 * rgba[1] + 0.114 * rgba[2];
    const uint8_t pale = (uint8_t)lrint(0.6 * grey + 0.4 * 255);
    const uint8_t pixel[4] = {artefact ? 225 : pale, artefact ? 0 : pale, artefact ? 20 : pale, 255};
    memcpy(rgba, pixel, 4);
}

static int paint(refraction_figures *r, refraction_view view, refraction_kind kind, size_t picture, uint8_t *rgba)
{
    refraction_pair pair;
    const int code = refraction_pair_read(r, view, picture, refraction_picture(SHOWN_RAY), &pair);
    if (code != EXIT_CODE_OK)
        return code;
    const size_t pixels = (size_t)pair.mask.width * pair.mask.height;
    for (size_t i = 0; i < pixels; i++) {
        const double difference = refraction_pair_difference(&pair, i);
        if (kind == PANEL_DIFFERENCE)
            difference_pixel(rgba + 4 * i, difference, pair.mask.pixels[i] >= 0.999f);
        else
            artefact_pixel(rgba + 4 * i, difference > ARTEFACT);
    }
    refraction_pair_free(&pair);
    return EXIT_CODE_OK;
}

void refraction_panel_put(refraction_figures *r, svg *sheet, const refraction_panel *p, refraction_kind kind, size_t picture, const char *title,
                          const char *text)
{
    const compare_scene *s = refraction_scene(r, p->view);
    const svg_crop crop = panel_crop(r, p);
    const double tall = refraction_panel_height(r, p);
    uint8_t *rgba = NULL;
    char name[200];
    figures_job *f = r->figures;
    if (figures_good(f))
        f->code = figures_display(r->compare, r->place[p->view], picture, 0, 0, &rgba);
    if (figures_good(f) && kind != PANEL_PICTURE)
        f->code = paint(r, p->view, kind, picture, rgba);
    snprintf(name, sizeof name, "%s-%s%s", s->name, picture == COMPARE_REFERENCE ? "truth" : r->renders.methods[picture - 1].file, kind_names[kind]);
    figures_embed(f, sheet, name, rgba, s->width, s->height, crop, p->x, p->y, p->across, tall);
    free(rgba);
    if (kind == PANEL_DIFFERENCE)
        svg_box(sheet, p->x, p->y, p->across, tall, "none", "#bbb");
    svg_text(sheet, p->x, p->y - 8, 14, SVG_LEFT, "font-weight=\"bold\"", "%s", title);
    svg_text(sheet, p->x, p->y + tall + 16, 12, SVG_LEFT, "", "%s", text);
}

void refraction_cells_put(refraction_figures *r, svg *sheet, const refraction_panel *first, const refraction_cell *cells, size_t count, double gap, double row)
{
    for (size_t i = 0; i < count && figures_good(r->figures); i++) {
        const refraction_cell *c = &cells[i];
        const size_t picture = c->method == SHOWN_RAY ? COMPARE_REFERENCE : refraction_picture(c->method);
        refraction_panel p = *first;
        p.view = c->view;
        p.x += (p.across + gap) * c->column;
        p.y += row * c->row;
        refraction_panel_put(r, sheet, &p, c->kind, picture, c->title, c->text ? c->text : refraction_score_print(r, c->view, c->method).text);
    }
}

void refraction_panel_mark(const refraction_figures *r, svg *sheet, const refraction_panel *whole, const refraction_panel *part)
{
    const compare_scene *s = refraction_scene(r, whole->view);
    const svg_crop crop = panel_crop(r, part);
    const double scale = whole->across / s->width;
    svg_box(sheet, whole->x + crop.x * scale, whole->y + crop.y * scale, crop.width * scale, crop.height * scale, "none", "#e69f00");
}
