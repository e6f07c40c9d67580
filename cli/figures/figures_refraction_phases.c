/* SPDX-License-Identifier: MIT */
/* The effect of each phase: seen from under water (Fig. 4), at the borders (Fig. 7), behind other objects (Figs. 8 and 9). */
#include <math.h>

#include "cli/figures/figures_refraction.h"

enum { GAP = 14, TOP = 34, BELOW = 62 };

/* ---- Fig. 4 ---- */

void refraction_below(refraction_figures *r)
{
    enum { ACROSS = 430 };
    static const refraction_cell cells[] = {{VIEW_BELOW, SHOWN_TWO_PHASE, PANEL_PICTURE, 0, 0, "(a) two-phase", NULL},
                                            {VIEW_BELOW, SHOWN_TWO_PHASE, PANEL_ARTEFACTS, 0, 1, "artefacts of (a)", ""},
                                            {VIEW_BELOW, SHOWN_SCREEN_SPACE, PANEL_PICTURE, 1, 0, "(b) screen space", NULL},
                                            {VIEW_BELOW, SHOWN_SCREEN_SPACE, PANEL_ARTEFACTS, 1, 1, "artefacts of (b)", ""},
                                            {VIEW_BELOW, SHOWN_RAY, PANEL_PICTURE, 2, 0, "truth", "rays through the waves as they are"},
                                            {VIEW_BELOW, SHOWN_OFF, PANEL_PICTURE, 2, 1, "no refraction", NULL}};
    const refraction_panel p = {.view = VIEW_BELOW, .x = GAP, .y = TOP, .across = ACROSS};
    const double tall = refraction_panel_height(r, &p);
    figures_job *f = r->figures;
    svg sheet;
    if (!figures_sheet(f, &sheet, 3 * ACROSS + 4 * GAP, TOP + 2 * (tall + BELOW)))
        return;
    refraction_cells_put(r, &sheet, &p, cells, sizeof cells / sizeof *cells, GAP, tall + BELOW);
    figures_section(f, "liu-fig4", "Fig. 4: from under the water");
    fputs("<p class=\"published\">Published: (a) both phases are right from below, (b) screen space misses what the depth buffer does not hold: rays "
          "bend far, and most of the world above lies outside of the picture.</p>\n"
          "<p>Our pool hall from below. All that is above shows inside Snell's window, 48.6° about the vertical; outside of it the surface mirrors "
          "the pool. Screen space loses what straight lines of sight do not show, at the picture's borders above all, and finds sky there. It is "
          "less wrong here than the paper has it: our baseline has what lies beyond the surface in a buffer of its own, which one depth buffer of a "
          "game does not hold. Other errors stand at the window's rim, where rays lie flat.</p>\n",
          f->page);
    figures_plate(f, &sheet, "liu-fig4", "The pool hall from under the water by two methods, with their artefacts");
    figures_section_end(f);
    figures_check(f, "Liu Fig. 4: RMSE of two-phase over that of screen space, from below",
                  r->scores[VIEW_BELOW][SHOWN_TWO_PHASE].rmse / r->scores[VIEW_BELOW][SHOWN_SCREEN_SPACE].rmse, 0, 1);
}

/* ---- Fig. 7 ---- */

/* Computes the fraction of artefacts in a band along the picture's border, an eighth of the height wide. */
static int border_artefacts(refraction_figures *r, refraction_method method, double *share)
{
    refraction_pair pair;
    const int code = refraction_pair_read(r, VIEW_BORDER, refraction_picture(method), refraction_picture(SHOWN_RAY), &pair);
    if (code != EXIT_CODE_OK)
        return code;
    const uint32_t width = pair.mask.width, height = pair.mask.height, band = height / 8 > 1 ? height / 8 : 1;
    size_t artefacts = 0, water = 0;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const size_t i = (size_t)y * width + x;
            if ((x >= band && x + band < width && y >= band && y + band < height) || !(pair.mask.pixels[i] >= 0.999f))
                continue;
            water++;
            artefacts += refraction_pair_difference(&pair, i) > ARTEFACT;
        }
    refraction_pair_free(&pair);
    *share = water ? (double)artefacts / (double)water : 0;
    return EXIT_CODE_OK;
}

void refraction_border(refraction_figures *r)
{
    enum { ACROSS = 430 };
    static const refraction_cell wholes[] = {{VIEW_BORDER, SHOWN_LIU, PANEL_PICTURE, 0, 0, "(a) Liu et al., as printed: clamped", NULL},
                                             {VIEW_BORDER, SHOWN_LIU, PANEL_ARTEFACTS, 1, 0, "(b) its artefacts", "red: off by more than 32 of 255"},
                                             {VIEW_BORDER, SHOWN_TWO_PHASE, PANEL_ARTEFACTS, 2, 0, "(c) artefacts of two-phase: a guard band", NULL}};
    static const refraction_cell parts[] = {{VIEW_BORDER, SHOWN_LIU, PANEL_PICTURE, 0, 0, "Liu et al. at the lower border", ""},
                                            {VIEW_BORDER, SHOWN_TWO_PHASE, PANEL_PICTURE, 1, 0, "two-phase", ""},
                                            {VIEW_BORDER, SHOWN_RAY, PANEL_PICTURE, 2, 0, "truth", ""}};
    const refraction_panel p = {.view = VIEW_BORDER, .x = GAP, .y = TOP, .across = ACROSS};
    refraction_panel part = {.view = VIEW_BORDER, .x = GAP, .across = ACROSS, .left = 0.4, .top = 0.78, .width = 0.32, .height = 0.22};
    figures_job *f = r->figures;
    double clamped = 0, guarded = 0;
    svg sheet;
    f->code = border_artefacts(r, SHOWN_LIU, &clamped);
    if (figures_good(f))
        f->code = border_artefacts(r, SHOWN_TWO_PHASE, &guarded);
    part.y = TOP + refraction_panel_height(r, &p) + BELOW;
    if (!figures_sheet(f, &sheet, 3 * ACROSS + 4 * GAP, part.y + refraction_panel_height(r, &part) + GAP))
        return;
    refraction_cells_put(r, &sheet, &p, wholes, sizeof wholes / sizeof *wholes, GAP, 0);
    refraction_panel_mark(r, &sheet, &p, &part);
    refraction_cells_put(r, &sheet, &part, parts, sizeof parts / sizeof *parts, GAP, 0);
    figures_section(f, "liu-fig7", "Fig. 7: at the borders of the picture");
    fprintf(f->page,
            "<p class=\"published\">Published: (a) a rendering by both phases, where pixels that are sent out of the screen take the colour at its "
            "border; (b) these, in red: a thin seam that is hard to notice.</p>\n"
            "<p>The pool from 65° above, waves of slope 0.1. What is red in (b) is more than the border: the printed rotation of the camera's ray "
            "deflects it by the whole tilt of the surface, of which Snell's law leaves a quarter when one looks straight down. (c) draws a margin "
            "around the picture and needs no clamp. Along the border, an eighth of the height wide, artefacts are %.1f%% of the water by (a) and "
            "%.1f%% by (c).</p>\n",
            100 * clamped, 100 * guarded);
    figures_plate(f, &sheet, "liu-fig7", "Artefacts at the borders of the picture");
    figures_section_end(f);
    figures_check(f, "Liu Fig. 7: artefacts along the border, two-phase over Liu et al. as printed", guarded / clamped, 0, 1);
    json_object_set_new(f->result, "liu_fig7_border_artefacts", json_pack("{s:f, s:f}", "liu", clamped, "two-phase", guarded));
}

/* ---- Figs. 8 and 9 ---- */

void refraction_occlusion(refraction_figures *r)
{
    enum { ACROSS = 430 };
    static const refraction_cell cells[] = {{VIEW_WAVES, SHOWN_NARROW, PANEL_PICTURE, 0, 0, "(a) the narrow phase alone", "the whole picture: Fig. 9"},
                                            {VIEW_WAVES, SHOWN_TWO_PHASE, PANEL_PICTURE, 1, 0, "(b) two-phase", ""},
                                            {VIEW_WAVES, SHOWN_RAY, PANEL_PICTURE, 2, 0, "truth", ""}};
    const refraction_panel p = {.view = VIEW_WAVES, .x = GAP, .y = TOP, .across = ACROSS, .left = 0.34, .top = 0.48, .width = 0.34, .height = 0.42};
    figures_job *f = r->figures;
    svg sheet;
    if (!figures_sheet(f, &sheet, 3 * ACROSS + 4 * GAP, TOP + refraction_panel_height(r, &p) + 36))
        return;
    refraction_cells_put(r, &sheet, &p, cells, sizeof cells / sizeof *cells, GAP, 0);
    figures_section(f, "liu-fig8", "Fig. 8: what hides behind other things");
    fputs("<p class=\"published\">Published: two sketches. With the narrow phase alone the refracted ray should meet what another thing hides in the "
          "picture, and takes that thing's colour; after the broad phase it is in the picture.</p>\n"
          "<p>The same as pictures. (a) The buffer holds what straight lines of sight meet: a step from there to where refraction has put things is "
          "as long as the things, so their outlines break, double and stand in the wrong place. (b) After the broad phase the step is as long as the "
          "waves are high.</p>\n",
          f->page);
    figures_plate(f, &sheet, "liu-fig8", "The bunny and a ball by the narrow phase alone and by both");
    figures_section_end(f);
}

void refraction_narrow(refraction_figures *r)
{
    enum { ACROSS = 430 };
    static const refraction_cell cells[] = {{VIEW_WAVES, SHOWN_TWO_PHASE, PANEL_PICTURE, 0, 0, "(a) two-phase", NULL},
                                            {VIEW_WAVES, SHOWN_NARROW, PANEL_PICTURE, 1, 0, "(b) the narrow phase alone", NULL},
                                            {VIEW_WAVES, SHOWN_NARROW, PANEL_ARTEFACTS, 2, 0, "(c) artefacts of (b)", NULL},
                                            {VIEW_WAVES, SHOWN_TWO_PHASE, PANEL_ARTEFACTS, 0, 1, "artefacts of (a)", NULL},
                                            {VIEW_WAVES, SHOWN_BROAD, PANEL_ARTEFACTS, 1, 1, "artefacts of the broad phase alone", NULL},
                                            {VIEW_WAVES, SHOWN_LIU, PANEL_ARTEFACTS, 2, 1, "artefacts of Liu et al., as printed", NULL}};
    const refraction_panel p = {.view = VIEW_WAVES, .x = GAP, .y = TOP, .across = ACROSS};
    const double tall = refraction_panel_height(r, &p);
    figures_job *f = r->figures;
    svg sheet;
    if (!figures_sheet(f, &sheet, 3 * ACROSS + 4 * GAP, TOP + 2 * (tall + BELOW)))
        return;
    refraction_cells_put(r, &sheet, &p, cells, sizeof cells / sizeof *cells, GAP, tall + BELOW);
    const refraction_score *s = r->scores[VIEW_WAVES];
    figures_section(f, "liu-fig9", "Fig. 9: the narrow phase alone");
    fprintf(f->page,
            "<p class=\"published\">Published: (a) both phases, (b) the narrow phase alone, (c) what is wrong in (b), outlines above all.</p>\n"
            "<p>The pool with waves of slope 0.05. Artefacts are %.1f%% of the water by both phases of ours, %.1f%% by the narrow phase alone, %.1f%% by "
            "the broad phase alone, %.1f%% by the paper's two phases as printed, whose second phase rotates the camera's ray too far to gain on the "
            "broad phase.</p>\n",
            100 * s[SHOWN_TWO_PHASE].artefacts, 100 * s[SHOWN_NARROW].artefacts, 100 * s[SHOWN_BROAD].artefacts, 100 * s[SHOWN_LIU].artefacts);
    figures_plate(f, &sheet, "liu-fig9", "Both phases, the narrow phase alone, and artefacts");
    figures_section_end(f);
    figures_check(f, "Liu Fig. 9: RMSE of the narrow phase alone over that of two-phase", s[SHOWN_NARROW].rmse / s[SHOWN_TWO_PHASE].rmse, 1, INFINITY);
    figures_check(f, "Liu Fig. 9: RMSE of the broad phase alone over that of two-phase", s[SHOWN_BROAD].rmse / s[SHOWN_TWO_PHASE].rmse, 1, INFINITY);
    figures_check(f, "Liu Fig. 9: RMSE of Liu et al. as printed over that of two-phase", s[SHOWN_LIU].rmse / s[SHOWN_TWO_PHASE].rmse, 1, INFINITY);
}
