/* SPDX-License-Identifier: MIT */
/* The state of `mangata figures`: pictures and scores of the scenes, the page, the claims. */
#ifndef MANGATA_CLI_FIGURES_FIGURES_JOB_H
#define MANGATA_CLI_FIGURES_FIGURES_JOB_H

#include "cli/compare/compare_job.h"
#include "cli/figures/figures_request.h"
#include "cli/common/svg.h"

/* The methods of the figures. FIGURE_KERNELS_n is podee-pixel with n circular kernels; FIGURE_HARD is podee-uniform without a transition between resolved and
 * filtered waves. */
typedef enum figure_method {
    FIGURE_NONE,
    FIGURE_MSAA32,
    FIGURE_LEAN,
    FIGURE_UNIFORM,
    FIGURE_PIXEL,
    FIGURE_MANGATA,
    FIGURE_KERNELS_1,
    FIGURE_KERNELS_3,
    FIGURE_KERNELS_5,
    FIGURE_KERNELS_9,
    FIGURE_FELINE,
    FIGURE_RIEMANN,
    FIGURE_HARD,
    FIGURE_METHODS
} figure_method;

enum { FIGURE_SCENES = 4, FIGURE_EXPOSURES = 4 };

/* Exposures at which displayed colour is scored, in stops above the scene's own. */
extern const double figure_stops[FIGURE_EXPOSURES];

/* Index of the exposure at which plates show pictures. */
enum { FIGURE_SHOWN = 2 };

/* Names of the scenes' files without ending. */
extern const char *const figure_scenes[FIGURE_SCENES];

typedef struct figure_method_text {
    const char *spec;  /* text for method_spec_parse() */
    const char *title; /* name of the method in plates */
} figure_method_text;
extern const figure_method_text figure_methods[FIGURE_METHODS];

/* Scores of a method over all frames against the reference. */
typedef struct figure_score {
    double rmse, kept;                  /* coverage: the RMSE, and the sum divided by the reference's sum */
    double displayed[FIGURE_EXPOSURES]; /* RMSE of displayed colour, in [0, 1], at each exposure */
    double half[2], excess[2];          /* the same at FIGURE_SHOWN above and below the middle row; fraction of its square from values too bright */
} figure_score;

typedef struct figures_job {
    const figures_request *request;
    compare_request renders; /* the pictures that the figures of Podee et al. need */
    compare_job *compare;
    char folder[4200]; /* folder of the scenes; "": none are needed */
    char scene_paths[FIGURE_SCENES][4300];
    size_t picture[FIGURE_METHODS]; /* number of the method's picture in the comparison; 0: it is not needed */
    figure_score scores[FIGURE_SCENES][FIGURE_METHODS];
    struct refraction_figures *refraction; /* the figures of Liu et al.; NULL: none of them is wanted */
    char *refraction_table;                /* their table as Markdown, owned; NULL: none of it is wanted */
    FILE *page;                            /* stream of the page's sections */
    json_t *result, *checks;               /* contents of figures.json, and its list of claims */
    uint32_t failed;                       /* number of claims that do not hold */
    int code;                              /* exit code of the first error. Functions do nothing after it */
} figures_job;

/* Whether there has been no error. */
static inline bool figures_good(const figures_job *f) { return f->code == EXIT_CODE_OK; }

/* The texts that are written, and how they begin; see compare_open(). */
extern const compare_output figures_outputs[];

/* Whether the request wants a figure. */
bool figure_wanted(const figures_job *f, figure_id id);

/* Whether the request wants any figure of Podee et al. */
bool figures_podee_wanted(const figures_job *f);

/* ---- for the functions that make figures: figures_page.c, figures_job.c ---- */

/* Begin and end a section of the page. Between them the caller writes HTML to f->page. `name` is the section's anchor. */
void figures_section(figures_job *f, const char *name, const char *title);
void figures_section_end(figures_job *f);

/* Ends the sheet, writes it as DIR/NAME.svg and shows it in the page. After an error the sheet is only freed. */
void figures_plate(figures_job *f, svg *sheet, const char *name, const char *description);

/* A JSON number, or null if the value is not finite. */
json_t *figures_number(double value);

/* Adds a claim to the page: that `value` is within [least, most]. An infinite limit is none. */
void figures_check(figures_job *f, const char *claim, double value, double least, double most);

/* Displayed RGBA of a picture, 4 bytes per pixel, `stops` brighter than by the scene's exposure. The caller frees *rgba, which is NULL after an error. Returns
 * an exit code; errors are printed. */
int figures_display(compare_job *job, size_t scene, size_t picture, size_t frame, double stops, uint8_t **rgba);

/* Writes a text as DIR/NAME and frees it. NULL stands for a text for which memory has run out. */
void figures_write(figures_job *f, const char *name, char *text);

/* Starts a sheet. False: memory has run out, or there has been an error before. */
bool figures_sheet(figures_job *f, svg *sheet, double width, double height);

/* Draws a part of the first frame of a picture on the sheet at the exposure of plates, `scale` units per pixel. */
void figures_put(figures_job *f, svg *sheet, size_t scene, size_t picture, const svg_crop *crop, double x, double y, double scale);

/* Writes width × height pixels of RGBA as DIR/pictures/NAME.png, and embeds the part `crop` of it in the sheet. */
void figures_embed(figures_job *f, svg *sheet, const char *name, const uint8_t *rgba, uint32_t width, uint32_t height, svg_crop crop, double x, double y,
                   double shown_width, double shown_height);

/* The part of a picture that shows the glitter: the middle third of the width, from above the horizon down. */
svg_crop figures_glitter_crop(uint32_t width, uint32_t height);

/* Start progress over `steps` steps, and report one of them. If a signal has come, figures_step() sets the job's exit code. */
void figures_steps(figures_job *f, uint64_t steps);
void figures_step(figures_job *f);

/* Prints that memory has run out. Returns its exit code. */
int figures_no_memory(void);

/* Writes DIR/index.html, which contains the sections. */
void figures_write_page(figures_job *f, const char *sections);

/* ---- the functions that make figures; each prints its errors and sets the job's exit code ---- */

void figures_measure(figures_job *f);            /* figures_scores.c: fills f->scores */
void figures_table1(figures_job *f);             /* figures_table.c */
char *figures_table1_text(const figures_job *f); /* the table as Markdown, which the caller frees; NULL: out of memory */
void figures_bars(figures_job *f);               /* Fig. 18 */
void figures_transition(figures_job *f);         /* figures_pictures.c: Fig. 11 */
void figures_scene_views(figures_job *f);        /* Fig. 12 */
void figures_simple(figures_job *f);             /* Fig. 13 */
void figures_smooth(figures_job *f);             /* Fig. 14 */
void figures_medium(figures_job *f);             /* Fig. 15 */
void figures_high(figures_job *f);               /* Fig. 16 */
void figures_kernels(figures_job *f);            /* figures_kernels.c: Fig. 17 */
void figures_fits(figures_job *f);               /* figures_fits.c: Fig. 21 */
void figures_mirror(figures_job *f);             /* figures_mirror.c: Fig. 20 */

#endif
