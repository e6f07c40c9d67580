/* SPDX-License-Identifier: MIT */
/* The methods beside the path-traced reference, on flat water (Fig. 10) and on waves (Fig. 11): pictures, differences and scores. */
#include <math.h>

#include "cli/figures/figures_refraction.h"

enum { PANELS = 4, ACROSS = 320, GAP = 12, TOP = 34, ROW = 44 };

/* The path-traced reference, then the three methods of the paper. */
static const refraction_method panels[PANELS] = {SHOWN_RAY, SHOWN_TWO_PHASE, SHOWN_SCREEN_SPACE, SHOWN_DISTANCE_FIELD};

/* Draws a column: the picture, an enlarged part with bunny, ball and shadow, and the difference, one below the other. */
static void put_column(refraction_figures *r, svg *sheet, refraction_view view, size_t column)
{
    const refraction_method method = panels[column];
    const size_t picture = column ? refraction_picture(method) : COMPARE_REFERENCE;
    const double x = GAP + (ACROSS + GAP) * (double)column;
    const refraction_panel whole = {.view = view, .x = x, .y = TOP, .across = ACROSS};
    refraction_panel part = {.view = view, .x = x, .across = ACROSS, .left = 0.34, .top = 0.48, .width = 0.34, .height = 0.42};
    refraction_panel last = whole;
    char title[64];
    part.y = whole.y + refraction_panel_height(r, &whole) + 12;
    last.y = part.y + refraction_panel_height(r, &part) + 30;
    snprintf(title, sizeof title, "(%c) %s", "abcd"[column], column ? refraction_methods[method].title : "truth");
    refraction_panel_put(r, sheet, &whole, PANEL_PICTURE, picture, title, "");
    if (column == 0)
        refraction_panel_mark(r, sheet, &whole, &part);
    refraction_panel_put(r, sheet, &part, PANEL_PICTURE, picture, "", "");
    if (column)
        refraction_panel_put(r, sheet, &last, PANEL_DIFFERENCE, picture, "", refraction_score_print(r, view, method).text);
    if (column)
        return;
    static const char *const key[] = {"Differences from one ray a pixel,", "what comes through the surface only:", "white none, red 32 of 255,",
                                      "black 96 and more; grey no water."};
    for (size_t i = 0; i < sizeof key / sizeof *key; i++)
        svg_text(sheet, x, last.y + 20 + 20 * (double)i, 13, SVG_LEFT, "", "%s", key[i]);
}

static void put_number(FILE *page, const char *format, double value, bool best)
{
    fprintf(page, "<td%s>", best ? " class=\"best\"" : "");
    if (isfinite(value))
        fprintf(page, format, value);
    else
        fputs("–", page);
    fputs("</td>", page);
}

static void put_table(refraction_figures *r, refraction_view view)
{
    FILE *page = r->figures->page;
    const refraction_score *scores = r->scores[view];
    refraction_method best = SHOWN_TWO_PHASE;
    for (int m = 0; m < SHOWN_RAY; m++)
        best = scores[m].rmse < scores[best].rmse ? (refraction_method)m : best;
    fprintf(page,
            "<table><tr><th></th><th>RMSE, same ray</th><th>RMSE, %u × %u rays</th><th>artefacts, %%</th><th>SSIM</th><th>FLIP</th><th>Yee, failing "
            "%%</th></tr>\n",
            r->figures->request->refraction_samples, r->figures->request->refraction_samples);
    for (int m = 0; m <= SHOWN_RAY; m++) {
        const refraction_score *s = &scores[m];
        const bool is_best = (int)best == m;
        fprintf(page, "<tr><td>%s</td>", refraction_methods[m].title);
        put_number(page, "%.2f", s->rmse, is_best);
        put_number(page, "%.2f", s->many, false);
        put_number(page, "%.2f", 100 * s->artefacts, false);
        put_number(page, "%.4f", s->ssim, false);
        put_number(page, "%.4f", s->flip, false);
        put_number(page, "%.2f", 100 * s->yee, false);
        fputs("</tr>\n", page);
    }
    fputs("</table>\n<p>The last row is what one ray through the middle of a pixel differs from many by.</p>\n", page);
}

static void make(refraction_figures *r, refraction_view view, const char *name, const char *title, const char *text)
{
    const refraction_panel whole = {.view = view, .across = ACROSS};
    const refraction_panel part = {.view = view, .across = ACROSS, .left = 0.34, .top = 0.48, .width = 0.34, .height = 0.42};
    figures_job *f = r->figures;
    const refraction_score *s = r->scores[view];
    char claim[160];
    svg sheet;
    if (!figures_sheet(f, &sheet, PANELS * ACROSS + (PANELS + 1) * GAP,
                       TOP + 2 * refraction_panel_height(r, &whole) + refraction_panel_height(r, &part) + ROW + 26))
        return;
    for (size_t i = 0; i < PANELS; i++)
        put_column(r, &sheet, view, i);
    figures_section(f, name, title);
    fputs(text, f->page);
    figures_plate(f, &sheet, name, "The truth and three methods, with their differences");
    put_table(r, view);
    figures_section_end(f);
    for (int m = SHOWN_SCREEN_SPACE; m <= SHOWN_DISTANCE_FIELD; m++) {
        snprintf(claim, sizeof claim, "Liu %s: RMSE of two-phase over that of %s", view == VIEW_FLAT ? "Fig. 10" : "Fig. 11", refraction_methods[m].title);
        figures_check(f, claim, s[SHOWN_TWO_PHASE].rmse / s[m].rmse, 0, 1);
    }
    snprintf(claim, sizeof claim, "Liu %s: RMSE of hybrid over that of two-phase", view == VIEW_FLAT ? "Fig. 10" : "Fig. 11");
    figures_check(f, claim, s[SHOWN_HYBRID].rmse / s[SHOWN_TWO_PHASE].rmse, 0, 1.02);
}

void refraction_flat(refraction_figures *r)
{
    make(r, VIEW_FLAT, "liu-fig10", "Fig. 10: the methods on flat water",
         "<p class=\"published\">Published: the truth, both phases, screen space and the distance field on flat water, each with a map of "
         "Yee's perceptual difference: the two phases are the nearest to the truth; no values.</p>\n"
         "<p>Here the same. On flat water the broad phase is exact but for triangles and pixels. Screen space lacks what other things hide "
         "from straight lines of sight, behind the bunny and the ball; the distance field's voxels round off edges, so the waterline, steps "
         "and shadows' rims differ.</p>\n");
}

void refraction_waves(refraction_figures *r)
{
    make(r, VIEW_WAVES, "liu-fig11", "Fig. 11: the methods on waves",
         "<p class=\"published\">Published: the same on a corrugated surface; the two phases are the nearest again; no values.</p>\n"
         "<p>Here with waves of slope 0.05 (rms). What is left of two-phase's error lies along outlines and the rims of shadows, where a "
         "fraction of a pixel shows, and where waves show what the flat surface hides; hybrid traces these pixels.</p>\n");
}
