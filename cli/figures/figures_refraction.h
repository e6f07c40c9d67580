/* SPDX-License-Identifier: MIT */
/* The figures of Liu, Han and Fei 2020 while they are made: views of the scenes with objects, their pictures and scores. */
#ifndef MANGATA_CLI_FIGURES_FIGURES_REFRACTION_H
#define MANGATA_CLI_FIGURES_FIGURES_REFRACTION_H

#include "cli/figures/figures_job.h"

/* A file with a camera, waves and triangles of its own. The last two are timed, all others drawn. */
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

/* SHOWN_RAY: what methods are scored against, a ray through the middle of every pixel. From TIMED_TRUTH on: without reflections, for times. */
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

/* The exposure of what is scored: sunlit tiles are bright, not white. */
enum { REFRACTION_STOPS_DOWN = 4 };

/* Pixels whose displayed colour is off by more, 0 to 255, in some channel are artefacts. */
enum { ARTEFACT = 32 };

/* Of the radiance that comes through the surface, sRGB-encoded, on whole pixels of water. NaN: not measured. */
typedef struct refraction_score {
    double rmse, many;      /* 0 … 255: against one ray in the same place, against many over the pixel */
    double artefacts;       /* fraction of the pixels of water */
    double ssim, flip, yee; /* of the frame, black where no water; Yee's of Figs. 10 and 11 alone, since it takes a program of its own */
} refraction_score;

typedef struct refraction_figures {
    figures_job *figures;
    compare_request renders;
    compare_job *compare;
    char paths[REFRACTION_VIEWS][4300];
    size_t place[REFRACTION_VIEWS]; /* of the scene in the comparison; COMPARE_SCENES: not wanted */
    const char *overrides[REFRACTION_VIEWS][8];
    char rock[64]; /* override of the pool that lacks its bunny; "" where it has it */
    refraction_score scores[REFRACTION_VIEWS][REFRACTION_METHODS];
} refraction_figures;

/* Loads and checks the views; `folder` holds the scenes. Prints errors and returns the exit code; figures_refraction_close() follows in every
 * case. */
int figures_refraction_open(figures_job *f, const char *folder);
void figures_refraction_close(figures_job *f);

/* Renders, measures, and writes the part of the page; prints errors and leaves the exit code with the job. */
void figures_refraction(figures_job *f);

/* ---- shared by the makers ---- */

/* The place of a view's scene, and the number of its picture: SHOWN_RAY's is one ray a pixel, COMPARE_REFERENCE many. */
const compare_scene *refraction_scene(const refraction_figures *r, refraction_view view);
size_t refraction_picture(refraction_method method);

/* What comes through the surface as displayed, black where no water, of a picture and of the path-traced reference. Returns an exit code; the caller frees both. */
typedef struct refraction_pair {
    float_image image[2], mask;
    uint64_t left_out; /* pixels without water, or with some */
} refraction_pair;
int refraction_pair_read(refraction_figures *r, refraction_view view, size_t picture, size_t truth, refraction_pair *out);
void refraction_pair_free(refraction_pair *pair);

/* How far a pixel of the pair, by its place, is off in the worst channel, 0 to 255. */
double refraction_pair_difference(const refraction_pair *pair, size_t pixel);

void refraction_measure(refraction_figures *r); /* figures_refraction_scores.c */

/* ---- figures_refraction_panels.c ---- */

/* A part of a view, `across` units wide, at a place on the sheet; fractions of the whole, all zero: the whole. */
typedef struct refraction_panel {
    refraction_view view;
    double x, y, across;
    double left, top, width, height;
} refraction_panel;

typedef enum refraction_kind {
    PANEL_PICTURE,    /* as `mangata render` shows it */
    PANEL_DIFFERENCE, /* from the path-traced reference: white none, red ARTEFACT, black three times that; grey where no water */
    PANEL_ARTEFACTS   /* the same as red pixels over the grey picture */
} refraction_kind;

/* Panels of a plate, each so many columns right of and rows below the first. */
typedef struct refraction_cell {
    refraction_view view;
    refraction_method method; /* SHOWN_RAY: the path-traced reference, of many rays */
    refraction_kind kind;
    int column, row;
    const char *title, *text; /* NULL: its scores */
} refraction_cell;

double refraction_panel_height(const refraction_figures *r, const refraction_panel *p);

/* `title` stands above the panel and names its letter, `text` below. */
void refraction_panel_put(refraction_figures *r, svg *sheet, const refraction_panel *p, refraction_kind kind, size_t picture, const char *title,
                          const char *text);

/* A step right is the panel's width and `gap`, a step down `row`. */
void refraction_cells_put(refraction_figures *r, svg *sheet, const refraction_panel *first, const refraction_cell *cells, size_t count, double gap, double row);

/* "RMSE 3.1, artefacts 0.4%". */
typedef struct refraction_score_text {
    char text[96];
} refraction_score_text;
refraction_score_text refraction_score_print(const refraction_figures *r, refraction_view view, refraction_method method);

/* Where on the view `whole` the panel's part is: a frame around it. */
void refraction_panel_mark(const refraction_figures *r, svg *sheet, const refraction_panel *whole, const refraction_panel *part);

/* ---- the makers; each prints its errors and leaves the exit code with the job ---- */

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

/* DIR/refraction.md, which standard output gets as well, and the same in figures.json. */
void refraction_write_table(refraction_figures *r);

#endif
