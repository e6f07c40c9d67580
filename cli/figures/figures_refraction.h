/* SPDX-License-Identifier: MIT */
/* The figures of Liu, Han and Fei 2020: views of the scenes with objects, their pictures and scores. */
#ifndef MANGATA_CLI_FIGURES_FIGURES_REFRACTION_H
#define MANGATA_CLI_FIGURES_FIGURES_REFRACTION_H

#include "cli/figures/figures_job.h"

/* Views: a scene's file with a camera, waves and number of triangles of its own. The last two are timed, the others rendered. */
typedef enum refraction_view {
    VIEW_BELOW,
    VIEW_BORDER,
    VIEW_FLAT,
    VIEW_WAVES,
    VIEW_DENSE,
    VIEW_SPARSE,
    VIEW_CALM,
    VIEW_ROUGH,
    VIEW_ROUGHER,
    VIEW_STEEP,
    VIEW_ASIDE,
    VIEW_GRAZING,
    VIEW_SHORE,
    VIEW_HULL,
    VIEW_DIVER,
    VIEW_SPEED_16K,
    VIEW_SPEED_128K,
    REFRACTION_VIEWS
} refraction_view;

/* Methods. The others are scored against SHOWN_RAY, which is path-traced with one ray through the centre of every pixel. Those from TIMED_TRUTH on render no
 * reflections, and are timed. */
typedef enum refraction_method {
    SHOWN_TWO_PHASE,
    SHOWN_HYBRID,
    SHOWN_LIU,
    SHOWN_BROAD,
    SHOWN_NARROW,
    SHOWN_SCREEN_SPACE,
    SHOWN_DISTANCE_FIELD,
    SHOWN_OFF,
    SHOWN_RAY,
    SHOWN_WHOLE,
    SHOWN_WHOLE_BROAD,
    TIMED_TRUTH,
    TIMED_TWO_PHASE,
    TIMED_HYBRID,
    TIMED_LIU,
    TIMED_SCREEN_SPACE,
    TIMED_DISTANCE_FIELD,
    TIMED_OFF,
    REFRACTION_METHODS
} refraction_method;

extern const figure_method_text refraction_methods[REFRACTION_METHODS];

/* Pictures are scored at an exposure that many stops below the scene's, at which sunlit tiles are bright but not white. */
enum { REFRACTION_STOPS_DOWN = 4 };

/* A pixel is an artefact if a channel of its displayed colour, 0 to 255, is off by more than this. */
enum { ARTEFACT = 32 };

/* Scores of the displayed radiance that comes through the surface, over pixels that are all water. NaN: not measured. */
typedef struct refraction_score {
    double rmse, many;      /* RMSE, 0 to 255, against one path-traced ray through the pixel's centre, and against many over the pixel */
    double artefacts;       /* fraction of these pixels */
    double ssim, flip, yee; /* of the whole frame, black where there is no water; yee, which needs another program, for Figs. 10 and 11 alone */
} refraction_score;

typedef struct refraction_figures {
    figures_job *figures; /* borrowed */
    compare_request renders;
    compare_job *compare;
    char paths[REFRACTION_VIEWS][4300];
    size_t place[REFRACTION_VIEWS]; /* index of the view's scene in the comparison; COMPARE_SCENES: the view is not needed */
    const char *overrides[REFRACTION_VIEWS][8];
    char rock[64]; /* override that replaces the bunny of the pool, if its model is missing; "": it is not */
    refraction_score scores[REFRACTION_VIEWS][REFRACTION_METHODS];
} refraction_figures;

/* Loads and checks the views of the scenes in `folder`. Prints errors and returns an exit code. figures_refraction_close() must be called in every case. */
int figures_refraction_open(figures_job *f, const char *folder);
void figures_refraction_close(figures_job *f);

/* Renders, measures, and writes this part of the page. Prints errors and sets the job's exit code. */
void figures_refraction(figures_job *f);

/* ---- for the functions that make figures ---- */

/* A view's scene, and the number of a method's picture. The picture of SHOWN_RAY has one ray per pixel, that of COMPARE_REFERENCE many. */
const compare_scene *refraction_scene(const refraction_figures *r, refraction_view view);
size_t refraction_picture(refraction_method method);

/* A picture and the path-traced reference: displayed radiance that comes through the surface, in [0, 1], black where there is no water. */
typedef struct refraction_pair {
    float_image image[2], mask;
    uint64_t left_out; /* number of pixels that are not all water */
} refraction_pair;
/* Reads a pair; `truth` is the number of the reference's picture. Prints errors and returns an exit code. The caller frees the pair, which holds nothing after
 * an error. */
int refraction_pair_read(refraction_figures *r, refraction_view view, size_t picture, size_t truth, refraction_pair *out);
void refraction_pair_free(refraction_pair *pair);

/* The difference between both pictures at a pixel's index, 0 to 255, in the channel in which it is greatest. */
double refraction_pair_difference(const refraction_pair *pair, size_t pixel);

/* Fills r->scores. figures_refraction_scores.c */
void refraction_measure(refraction_figures *r);

/* ---- figures_refraction_panels.c ---- */

/* A part of a view on the sheet, `across` units wide, with its upper left corner at (x, y). The part is given in fractions of the picture. All zero: the whole
 * picture. */
typedef struct refraction_panel {
    refraction_view view;
    double x, y, across;
    double left, top, width, height;
} refraction_panel;

typedef enum refraction_kind {
    PANEL_PICTURE,    /* the picture as `mangata render` writes it */
    PANEL_DIFFERENCE, /* difference from the path-traced reference: white is none, red is ARTEFACT, black three times that; grey where there is no water */
    PANEL_ARTEFACTS   /* artefacts as red pixels over the picture in grey */
} refraction_kind;

/* A panel of a plate, at a column and a row that count from 0. */
typedef struct refraction_cell {
    refraction_view view;
    refraction_method method; /* SHOWN_RAY: the path-traced reference of many rays is shown */
    refraction_kind kind;
    int column, row;
    const char *title, *text; /* title above the panel, and text below it; text NULL: the scores */
} refraction_cell;

/* Height of a panel, units of the sheet. */
double refraction_panel_height(const refraction_figures *r, const refraction_panel *p);

/* Draws a panel of picture number `picture`, with `title` above it and `text` below. */
void refraction_panel_put(refraction_figures *r, svg *sheet, const refraction_panel *p, refraction_kind kind, size_t picture, const char *title,
                          const char *text);

/* Draws the panels of a plate. `first` is that of column 0 and row 0. A column is as wide as the panel and `gap`, a row is `row` high. */
void refraction_cells_put(refraction_figures *r, svg *sheet, const refraction_panel *first, const refraction_cell *cells, size_t count, double gap, double row);

/* The scores of a method in a view as text: "RMSE 3.1, artefacts 0.4%". */
typedef struct refraction_score_text {
    char text[96];
} refraction_score_text;
refraction_score_text refraction_score_print(const refraction_figures *r, refraction_view view, refraction_method method);

/* Draws a frame around the part that `part` shows on the panel `whole`. */
void refraction_panel_mark(const refraction_figures *r, svg *sheet, const refraction_panel *whole, const refraction_panel *part);

/* ---- the functions that make figures; each prints its errors and sets the job's exit code ---- */

void refraction_below(refraction_figures *r);     /* figures_refraction_phases.c: Fig. 4 */
void refraction_border(refraction_figures *r);    /* Fig. 7 */
void refraction_occlusion(refraction_figures *r); /* Fig. 8 */
void refraction_narrow(refraction_figures *r);    /* Fig. 9 */
void refraction_flat(refraction_figures *r);      /* figures_refraction_baselines.c: Fig. 10 */
void refraction_waves(refraction_figures *r);     /* Fig. 11 */
void refraction_speed(refraction_figures *r);     /* figures_refraction_speed.c: Table 3 */
void refraction_density(refraction_figures *r);   /* figures_refraction_views.c: Fig. 12 */
void refraction_angles(refraction_figures *r);    /* Fig. 13 */
void refraction_outdoors(refraction_figures *r);  /* Fig. 14 */
void refraction_diver(refraction_figures *r);     /* Fig. 15 */

/* Writes the scores to DIR/refraction.md, to refraction_table for standard output, and to figures.json. */
void refraction_write_table(refraction_figures *r);

#endif
