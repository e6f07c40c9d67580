/* SPDX-License-Identifier: MIT */
/* Fewer triangles (Fig. 12), higher waves and other angles (Fig. 13), outdoor scenes (Fig. 14), a diver's view (Fig. 15). */
#include <math.h>

#include "cli/figures/figures_refraction.h"

enum { GAP = 14, TOP = 34, UNDER = 62 };

/* ---- Fig. 12 ---- */

void refraction_density(refraction_figures *r)
{
    enum { ACROSS = 650 };
    static const refraction_cell cells[] = {{VIEW_DENSE, SHOWN_WHOLE_BROAD, PANEL_PICTURE, 0, 0, "(a) walls and floor of 2000 triangles", NULL},
                                            {VIEW_SPARSE, SHOWN_WHOLE_BROAD, PANEL_PICTURE, 1, 0, "(b) of 30 triangles", NULL},
                                            {VIEW_SPARSE, SHOWN_BROAD, PANEL_PICTURE, 0, 1, "(c) of 30, split until right to 0.1 pixel", NULL},
                                            {VIEW_SPARSE, SHOWN_RAY, PANEL_PICTURE, 1, 1, "truth", ""}};
    const refraction_panel p = {.view = VIEW_DENSE, .x = GAP, .y = TOP, .across = ACROSS};
    const double tall = refraction_panel_height(r, &p);
    figures_job *f = r->figures;
    svg sheet;
    if (!figures_sheet(f, &sheet, 2 * ACROSS + 3 * GAP, TOP + 2 * (tall + UNDER) - 20))
        return;
    refraction_cells_put(r, &sheet, &p, cells, sizeof cells / sizeof *cells, GAP, tall + UNDER);
    const double whole = r->scores[VIEW_SPARSE][SHOWN_WHOLE_BROAD].rmse, split = r->scores[VIEW_SPARSE][SHOWN_BROAD].rmse;
    figures_section(f, "liu-fig12", "Fig. 12: density of vertices");
    fprintf(f->page,
            "<p class=\"published\">Published: the pool with 1093 vertices is right, with 98 the bunny sinks into the floor; tessellation is "
            "recommended.</p>\n"
            "<p>The broad phase alone on flat water. The floor's vertices are lifted as they should be, but between them a flat triangle stands "
            "where the image of the floor is curved, and the finely meshed bunny and ball sink into it: (b), RMSE %.1f. Splitting triangles where "
            "they are off by more than a tenth of a pixel, which is the default, makes (c) of the same 30: RMSE %.1f; 2000 triangles as they are "
            "have %.1f (a). The second phase of two-phase works with true places and mends most of it even without splitting: RMSE %.1f with 30 "
            "whole triangles, %.1f split.</p>\n",
            whole, split, r->scores[VIEW_DENSE][SHOWN_WHOLE_BROAD].rmse, r->scores[VIEW_SPARSE][SHOWN_WHOLE].rmse,
            r->scores[VIEW_SPARSE][SHOWN_TWO_PHASE].rmse);
    figures_plate(f, &sheet, "liu-fig12", "The pool with many and few triangles, whole and split");
    figures_section_end(f);
    figures_check(f, "Liu Fig. 12: RMSE of the broad phase with few triangles split over that with the same ones whole", split / whole, 0, 0.5);
    figures_check(f, "Liu Fig. 12: the same of both phases", r->scores[VIEW_SPARSE][SHOWN_TWO_PHASE].rmse / r->scores[VIEW_SPARSE][SHOWN_WHOLE].rmse, 0, 1);
}

/* ---- Fig. 13 ---- */

void refraction_angles(refraction_figures *r)
{
    enum { ACROSS = 320 };
    static const struct {
        refraction_view view;
        const char *title;
    } cells[] = {{VIEW_CALM, "(a) slope 0.025"},
                 {VIEW_WAVES, "(b) slope 0.05"},
                 {VIEW_ROUGH, "(c) slope 0.1"},
                 {VIEW_ROUGHER, "(d) slope 0.2"},
                 {VIEW_STEEP, "(e) as (c), 65° down"},
                 {VIEW_ROUGH, "(f) as (c), 30°"},
                 {VIEW_ASIDE, "(g) as (c), from the side"},
                 {VIEW_GRAZING, "(h) as (c), 12°"}};
    enum { CELLS = sizeof cells / sizeof *cells };
    figures_job *f = r->figures;
    refraction_panel p = {.view = VIEW_WAVES, .across = ACROSS};
    const double tall = refraction_panel_height(r, &p);
    json_t *json = json_array();
    svg sheet;
    if (!figures_sheet(f, &sheet, 4 * ACROSS + 5 * GAP, TOP + 4 * tall + 2 * 80))
        return;
    for (size_t i = 0; i < CELLS && figures_good(f); i++) {
        p.view = cells[i].view;
        p.x = GAP + (ACROSS + GAP) * (double)(i % 4);
        p.y = TOP + (2 * tall + 80) * (double)(i / 4);
        refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, refraction_picture(SHOWN_TWO_PHASE), cells[i].title, "");
        p.y += tall + 6;
        refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, COMPARE_REFERENCE, "", refraction_score_print(r, p.view, SHOWN_TWO_PHASE).text);
        json_array_append_new(json, json_pack("{s:s, s:o}", "view", cells[i].title, "rmse", figures_number(r->scores[p.view][SHOWN_TWO_PHASE].rmse)));
    }
    json_object_set_new(f->result, "liu_fig13", json);
    figures_section(f, "liu-fig13", "Fig. 13: amplitudes and angles");
    fputs("<p class=\"published\">Published: the pool with higher and higher waves (a)–(d), and (c) from other angles (e)–(h), all by the paper's "
          "method; stable.</p>\n"
          "<p>The upper picture of each pair is by two-phase, the lower the truth. Errors grow with the waves: one pixel shows what a steep surface "
          "spreads over many, and more of it was hidden when the surface was flat.</p>\n",
          f->page);
    figures_plate(f, &sheet, "liu-fig13", "The pool with four amplitudes and from four angles");
    figures_section_end(f);
    figures_check(f, "Liu Fig. 13: RMSE of two-phase at slope 0.2", r->scores[VIEW_ROUGHER][SHOWN_TWO_PHASE].rmse, 0, 10);
}

/* ---- Figs. 14 and 15 ---- */

/* Draws a row of a part: two-phase, screen space, no refraction, and the path-traced reference. `letters` "": without titles. */
static void put_row(refraction_figures *r, svg *sheet, refraction_panel p, const char *letters)
{
    static const refraction_method methods[] = {SHOWN_TWO_PHASE, SHOWN_SCREEN_SPACE, SHOWN_OFF, SHOWN_RAY};
    for (size_t i = 0; i < 4; i++) {
        char title[64] = "truth";
        if (i < 3)
            snprintf(title, sizeof title, "(%c) %s", letters[0] ? letters[i] : ' ', refraction_methods[methods[i]].title);
        refraction_panel_put(r, sheet, &p, PANEL_PICTURE, i < 3 ? refraction_picture(methods[i]) : COMPARE_REFERENCE, letters[0] ? title : "",
                             i < 3 && letters[0] ? refraction_score_print(r, p.view, methods[i]).text : "");
        p.x += p.across + GAP;
    }
}

static void check_view(refraction_figures *r, const char *figure, refraction_view view, const char *name)
{
    char claim[160];
    snprintf(claim, sizeof claim, "Liu %s, %s: RMSE of two-phase over that of screen space", figure, name);
    figures_check(r->figures, claim, r->scores[view][SHOWN_TWO_PHASE].rmse / r->scores[view][SHOWN_SCREEN_SPACE].rmse, 0, 1);
}

enum { ACROSS = 320 };

/* Starts a sheet for two rows, with `between` units between them and `below` units below, and draws the upper row. False: out of memory. */
static bool start_rows(refraction_figures *r, svg *sheet, const refraction_panel *upper, refraction_panel *lower, double between, double below)
{
    lower->y = TOP + refraction_panel_height(r, upper) + between;
    if (!figures_sheet(r->figures, sheet, 4 * ACROSS + 5 * GAP, lower->y + refraction_panel_height(r, lower) + below))
        return false;
    put_row(r, sheet, *upper, "abc");
    return true;
}

void refraction_outdoors(refraction_figures *r)
{
    const refraction_panel shore = {.view = VIEW_SHORE, .x = GAP, .y = TOP, .across = ACROSS, .left = 0.1, .top = 0.25, .width = 0.6, .height = 0.75};
    refraction_panel hull = {.view = VIEW_HULL, .x = GAP, .across = ACROSS, .left = 0.05, .top = 0.25, .width = 0.65, .height = 0.75};
    figures_job *f = r->figures;
    svg sheet;
    if (!start_rows(r, &sheet, &shore, &hull, UNDER, 30))
        return;
    put_row(r, &sheet, hull, "def");
    figures_section(f, "liu-fig14", "Fig. 14: outdoors");
    fputs("<p class=\"published\">Published: a game's outdoor scene (a) by the paper's method, (b) by the usual screen-space approach, whose "
          "refracted parts are wrong.</p>\n"
          "<p>A sandbank with rocks (a)–(c), and a boat at anchor (d)–(f). Without refraction the bottom lies too deep and the boat's shadow too far "
          "from the boat. Screen space finds nothing where the boat hides the ground from straight lines of sight and below the picture's lower "
          "border, and shows deep water there.</p>\n",
          f->page);
    figures_plate(f, &sheet, "liu-fig14", "A shore and a boat by three methods and the truth");
    figures_section_end(f);
    check_view(r, "Fig. 14", VIEW_SHORE, "shore");
    check_view(r, "Fig. 14", VIEW_HULL, "boat");
}

void refraction_diver(refraction_figures *r)
{
    const refraction_panel p = {.view = VIEW_DIVER, .x = GAP, .y = TOP, .across = ACROSS};
    refraction_panel part = {.view = VIEW_DIVER, .x = GAP, .across = ACROSS, .left = 0.3, .top = 0, .width = 0.45, .height = 0.45};
    figures_job *f = r->figures;
    svg sheet;
    if (!start_rows(r, &sheet, &p, &part, 30, GAP))
        return;
    refraction_panel_mark(r, &sheet, &p, &part);
    put_row(r, &sheet, part, "");
    figures_section(f, "liu-fig15", "Fig. 15: a diver's view");
    fputs("<p class=\"published\">Published: from under water (a) what stands above is where it should be, (b) it is missing in the screen-space "
          "approach.</p>\n"
          "<p>A pool hall with pillars, beams and lamps, its upper part larger below. The whole hall shows inside Snell's window; outside of it the "
          "basin is mirrored.</p>\n",
          f->page);
    figures_plate(f, &sheet, "liu-fig15", "The pool hall from under water by three methods and the truth");
    figures_section_end(f);
    check_view(r, "Fig. 15", VIEW_DIVER, "pool hall from below");
}
