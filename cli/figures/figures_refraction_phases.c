/* SPDX-License-Identifier: MIT */
/* What each phase is for: from under the water (Fig. 4), at the borders (Fig. 7), behind other things (Figs. 8 and 9). */
#include <math.h>

#include "cli/figures/figures_refraction.h"

enum { GAP = 14, TOP = 34, BELOW = 62 };

/* ---- Fig. 4 ---- */

int refraction_below(refraction_figures *r)
{
    enum { ACROSS = 430 };
    static const refraction_method methods[] = {SHOWN_TWO_PHASE, SHOWN_SCREEN_SPACE};
    static const char *const titles[] = {"(a) two-phase", "(b) screen space"};
    refraction_panel p = {.view = VIEW_BELOW, .y = TOP, .across = ACROSS};
    const double tall = refraction_panel_height(r, &p);
    figures_job *f = r->figures;
    svg sheet;
    int code = EXIT_CODE_OK;
    if (!svg_start(&sheet, 3 * ACROSS + 4 * GAP, TOP + 2 * (tall + BELOW)))
        return figures_no_memory();
    for (size_t i = 0; i < 2 && code == EXIT_CODE_OK; i++) {
        p.x = GAP + (ACROSS + GAP) * (double)i;
        p.y = TOP;
        code = refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, refraction_picture(methods[i]), titles[i],
                                    refraction_score_print(r, VIEW_BELOW, methods[i]).text);
        p.y = TOP + tall + BELOW;
        if (code == EXIT_CODE_OK)
            code = refraction_panel_put(r, &sheet, &p, PANEL_ARTEFACTS, refraction_picture(methods[i]), i ? "artefacts of (b)" : "artefacts of (a)", "");
    }
    p.x = GAP + 2 * (ACROSS + GAP);
    p.y = TOP;
    if (code == EXIT_CODE_OK)
        code = refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, COMPARE_REFERENCE, "truth", "rays through the waves as they are");
    p.y = TOP + tall + BELOW;
    if (code == EXIT_CODE_OK)
        code = refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, refraction_picture(SHOWN_OFF), "no refraction",
                                    refraction_score_print(r, VIEW_BELOW, SHOWN_OFF).text);
    figures_section(f, "liu-fig4", "Fig. 4: from under the water");
    fputs("<p class=\"published\">Published: (a) both phases are right from below, (b) screen space misses what the depth buffer does not hold: rays "
          "bend far, and most of the world above lies outside of the picture.</p>\n"
          "<p>Our pool hall from below. All that is above shows inside Snell's window, 48.6° about the vertical; outside of it the surface mirrors "
          "the pool. Screen space loses what straight lines of sight do not show, at the picture's borders above all, and finds sky there. It is "
          "less wrong here than the paper has it: our baseline has what lies beyond the surface in a buffer of its own, which one depth buffer of a "
          "game does not hold. Other errors stand at the window's rim, where rays lie flat.</p>\n",
          f->page);
    code = figures_plate(f, &sheet, "liu-fig4", "The pool hall from under the water by two methods, with their artefacts", code);
    figures_section_end(f);
    figures_check(f, "Liu Fig. 4: RMSE of two-phase over that of screen space, from below",
                  r->scores[VIEW_BELOW][SHOWN_TWO_PHASE].rmse / r->scores[VIEW_BELOW][SHOWN_SCREEN_SPACE].rmse, 0, 1);
    return code;
}

/* ---- Fig. 7 ---- */

/* Share of a band of pixels along the picture's border that are artefacts; the band is an eighth of the height wide. */
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

int refraction_border(refraction_figures *r)
{
    enum { ACROSS = 430 };
    refraction_panel p = {.view = VIEW_BORDER, .x = GAP, .y = TOP, .across = ACROSS};
    refraction_panel part = {.view = VIEW_BORDER, .x = GAP, .across = ACROSS, .left = 0.4, .top = 0.78, .width = 0.32, .height = 0.22};
    const double tall = refraction_panel_height(r, &p), zoom = refraction_panel_height(r, &part);
    figures_job *f = r->figures;
    double clamped = 0, guarded = 0;
    svg sheet;
    int code = border_artefacts(r, SHOWN_LIU, &clamped);
    if (code == EXIT_CODE_OK)
        code = border_artefacts(r, SHOWN_TWO_PHASE, &guarded);
    if (code != EXIT_CODE_OK)
        return code;
    part.y = TOP + tall + BELOW;
    if (!svg_start(&sheet, 3 * ACROSS + 4 * GAP, part.y + zoom + GAP))
        return figures_no_memory();
    code = refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, refraction_picture(SHOWN_LIU), "(a) Liu et al., as printed: clamped",
                                refraction_score_print(r, VIEW_BORDER, SHOWN_LIU).text);
    p.x += ACROSS + GAP;
    if (code == EXIT_CODE_OK)
        code = refraction_panel_put(r, &sheet, &p, PANEL_ARTEFACTS, refraction_picture(SHOWN_LIU), "(b) its artefacts", "red: off by more than 32 of 255");
    p.x += ACROSS + GAP;
    if (code == EXIT_CODE_OK)
        code = refraction_panel_put(r, &sheet, &p, PANEL_ARTEFACTS, refraction_picture(SHOWN_TWO_PHASE), "(c) artefacts of two-phase: a guard band",
                                    refraction_score_print(r, VIEW_BORDER, SHOWN_TWO_PHASE).text);
    refraction_panel_mark(r, &sheet, &(refraction_panel){.view = VIEW_BORDER, .x = GAP, .y = TOP, .across = ACROSS}, &part);
    static const char *const titles[] = {"Liu et al. at the lower border", "two-phase", "truth"};
    const size_t pictures[] = {refraction_picture(SHOWN_LIU), refraction_picture(SHOWN_TWO_PHASE), COMPARE_REFERENCE};
    for (size_t i = 0; i < 3 && code == EXIT_CODE_OK; i++, part.x += ACROSS + GAP)
        code = refraction_panel_put(r, &sheet, &part, PANEL_PICTURE, pictures[i], titles[i], "");
    figures_section(f, "liu-fig7", "Fig. 7: at the borders of the picture");
    fprintf(f->page,
            "<p class=\"published\">Published: (a) a rendering by both phases, where pixels that are sent out of the screen take the colour at its "
            "border; (b) these, in red: a thin seam that is hard to notice.</p>\n"
            "<p>The pool from 65° above, waves of slope 0.1. What is red in (b) is more than the border: the printed rotation of the camera's ray "
            "deflects it by the whole tilt of the surface, of which Snell's law leaves a quarter when one looks straight down. (c) draws a margin "
            "around the picture and needs no clamp. Along the border, an eighth of the height wide, artefacts are %.1f%% of the water by (a) and "
            "%.1f%% by (c).</p>\n",
            100 * clamped, 100 * guarded);
    code = figures_plate(f, &sheet, "liu-fig7", "Artefacts at the borders of the picture", code);
    figures_section_end(f);
    figures_check(f, "Liu Fig. 7: artefacts along the border, two-phase over Liu et al. as printed", guarded / clamped, 0, 1);
    json_object_set_new(f->result, "liu_fig7_border_artefacts", json_pack("{s:f, s:f}", "liu", clamped, "two-phase", guarded));
    return code;
}

/* ---- Figs. 8 and 9 ---- */

int refraction_occlusion(refraction_figures *r)
{
    enum { ACROSS = 430 };
    refraction_panel p = {.view = VIEW_WAVES, .x = GAP, .y = TOP, .across = ACROSS, .left = 0.34, .top = 0.48, .width = 0.34, .height = 0.42};
    const double tall = refraction_panel_height(r, &p);
    figures_job *f = r->figures;
    svg sheet;
    if (!svg_start(&sheet, 3 * ACROSS + 4 * GAP, TOP + tall + 36))
        return figures_no_memory();
    int code = refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, refraction_picture(SHOWN_NARROW), "(a) the narrow phase alone", "the whole picture: Fig. 9");
    p.x += ACROSS + GAP;
    if (code == EXIT_CODE_OK)
        code = refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, refraction_picture(SHOWN_TWO_PHASE), "(b) two-phase", "");
    p.x += ACROSS + GAP;
    if (code == EXIT_CODE_OK)
        code = refraction_panel_put(r, &sheet, &p, PANEL_PICTURE, COMPARE_REFERENCE, "truth", "");
    figures_section(f, "liu-fig8", "Fig. 8: what hides behind other things");
    fputs("<p class=\"published\">Published: two sketches. With the narrow phase alone the refracted ray should meet what another thing hides in the "
          "picture, and takes that thing's colour; after the broad phase it is in the picture.</p>\n"
          "<p>The same as pictures. (a) The buffer holds what straight lines of sight meet: a step from there to where refraction has put things is "
          "as long as the things, so their outlines break, double and stand in the wrong place. (b) After the broad phase the step is as long as the "
          "waves are high.</p>\n",
          f->page);
    code = figures_plate(f, &sheet, "liu-fig8", "The bunny and a ball by the narrow phase alone and by both", code);
    figures_section_end(f);
    return code;
}

int refraction_narrow(refraction_figures *r)
{
    enum { ACROSS = 430 };
    refraction_panel p = {.view = VIEW_WAVES, .x = GAP, .y = TOP, .across = ACROSS};
    const double tall = refraction_panel_height(r, &p);
    figures_job *f = r->figures;
    svg sheet;
    if (!svg_start(&sheet, 3 * ACROSS + 4 * GAP, TOP + 2 * (tall + BELOW)))
        return figures_no_memory();
    static const struct {
        refraction_method method;
        refraction_kind kind;
        int column, row;
        const char *title;
    } cells[] = {{SHOWN_TWO_PHASE, PANEL_PICTURE, 0, 0, "(a) two-phase"},
                 {SHOWN_NARROW, PANEL_PICTURE, 1, 0, "(b) the narrow phase alone"},
                 {SHOWN_NARROW, PANEL_ARTEFACTS, 2, 0, "(c) artefacts of (b)"},
                 {SHOWN_TWO_PHASE, PANEL_ARTEFACTS, 0, 1, "artefacts of (a)"},
                 {SHOWN_BROAD, PANEL_ARTEFACTS, 1, 1, "artefacts of the broad phase alone"},
                 {SHOWN_LIU, PANEL_ARTEFACTS, 2, 1, "artefacts of Liu et al., as printed"}};
    int code = EXIT_CODE_OK;
    for (size_t i = 0; i < sizeof cells / sizeof *cells && code == EXIT_CODE_OK; i++) {
        p.x = GAP + (ACROSS + GAP) * (double)cells[i].column;
        p.y = TOP + (tall + BELOW) * (double)cells[i].row;
        code = refraction_panel_put(r, &sheet, &p, cells[i].kind, refraction_picture(cells[i].method), cells[i].title,
                                    refraction_score_print(r, VIEW_WAVES, cells[i].method).text);
    }
    const refraction_score *s = r->scores[VIEW_WAVES];
    figures_section(f, "liu-fig9", "Fig. 9: the narrow phase alone");
    fprintf(f->page,
            "<p class=\"published\">Published: (a) both phases, (b) the narrow phase alone, (c) what is wrong in (b), outlines above all.</p>\n"
            "<p>The pool with waves of slope 0.05. Artefacts are %.1f%% of the water by both phases of ours, %.1f%% by the narrow phase alone, %.1f%% by "
            "the broad phase alone, %.1f%% by the paper's two phases as printed, whose second phase rotates the camera's ray too far to gain on the "
            "broad phase.</p>\n",
            100 * s[SHOWN_TWO_PHASE].artefacts, 100 * s[SHOWN_NARROW].artefacts, 100 * s[SHOWN_BROAD].artefacts, 100 * s[SHOWN_LIU].artefacts);
    code = figures_plate(f, &sheet, "liu-fig9", "Both phases, the narrow phase alone, and artefacts", code);
    figures_section_end(f);
    figures_check(f, "Liu Fig. 9: RMSE of the narrow phase alone over that of two-phase", s[SHOWN_NARROW].rmse / s[SHOWN_TWO_PHASE].rmse, 1, INFINITY);
    figures_check(f, "Liu Fig. 9: RMSE of the broad phase alone over that of two-phase", s[SHOWN_BROAD].rmse / s[SHOWN_TWO_PHASE].rmse, 1, INFINITY);
    figures_check(f, "Liu Fig. 9: RMSE of Liu et al. as printed over that of two-phase", s[SHOWN_LIU].rmse / s[SHOWN_TWO_PHASE].rmse, 1, INFINITY);
    return code;
}
