/* SPDX-License-Identifier: MIT */
/* The figures while they are made: pictures and scores of the scenes, the page, the claims. */
#ifndef MANGATA_CLI_FIGURES_FIGURES_JOB_H
#define MANGATA_CLI_FIGURES_FIGURES_JOB_H

#include "cli/compare/compare_job.h"
#include "cli/figures/figures_request.h"
#include "cli/common/svg.h"

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

/* Stops above a scene's own exposure at which displayed colour is scored. */
extern const double figure_stops[FIGURE_EXPOSURES];

/* The exposure of the plates. */
enum { FIGURE_SHOWN = 2 };

extern const char *const figure_scenes[FIGURE_SCENES];

typedef struct figure_method_text {
    const char *spec;  /* as method_spec_parse() reads it */
    const char *title; /* for plates */
} figure_method_text;
extern const figure_method_text figure_methods[FIGURE_METHODS];

/* Of all frames against the reference. */
typedef struct figure_score {
    double rmse, kept;                  /* coverage: RMSE, sum over the reference's */
    double displayed[FIGURE_EXPOSURES]; /* RMSE of sRGB-encoded colour after glare and tone mapping, 0 … 1 */
    double half[2], excess[2];          /* the same at FIGURE_SHOWN above and below the middle row; how much of its square is too bright */
} figure_score;

typedef struct figures_job {
    const figures_request *request;
    compare_request renders;
    compare_job *compare;
    char folder[4200]; /* of the scenes; "" where none are needed */
    char scene_paths[FIGURE_SCENES][4300];
    size_t picture[FIGURE_METHODS]; /* its number in the comparison; 0: not wanted */
    figure_score scores[FIGURE_SCENES][FIGURE_METHODS];
    struct refraction_figures *refraction; /* NULL where none of them is wanted */
    char *refraction_table;                /* as Markdown; NULL where none of it is wanted */
    FILE *page;                            /* the sections so far */
    json_t *result, *checks;
    uint32_t failed; /* checks */
    int code;        /* exit code of the first failure; the makers' functions do nothing after it */
} figures_job;

static inline bool figures_good(const figures_job *f) { return f->code == EXIT_CODE_OK; }

bool figure_wanted(const figures_job *f, figure_id id);

/* Any figure of one paper or the other. */
bool figures_podee_wanted(const figures_job *f);
bool figures_liu_wanted(const figures_job *f);

/* ---- for the makers of figures: figures_page.c, figures_job.c ---- */

/* A section of the page, and the end of it. What stands between is HTML by the maker. */
void figures_section(figures_job *f, const char *name, const char *title);
void figures_section_end(figures_job *f);

/* Ends the sheet, writes it as DIR/NAME.svg and shows it in the page; after a failure drops it. */
void figures_plate(figures_job *f, svg *sheet, const char *name, const char *description);

/* A number, or null where it is not finite. */
json_t *figures_number(double value);

/* A claim of the page: `value` is from `least` to `most`. */
void figures_check(figures_job *f, const char *claim, double value, double least, double most);

/* Displayed colour of a kept picture, `stops` brighter than the scene asks for: 4 bytes a pixel, the caller frees them. */
int figures_display(compare_job *job, size_t scene, size_t picture, size_t frame, double stops, uint8_t **rgba);

/* Writes a text of its own memory, NULL where that ran out, as DIR/NAME. */
void figures_write(figures_job *f, const char *name, char *text);

/* Starts a sheet. False, with the job's code, when memory runs out. */
bool figures_sheet(figures_job *f, svg *sheet, double width, double height);

/* A kept picture's part on the sheet, at the exposure of the plates; `scale` units a pixel. */
void figures_put(figures_job *f, svg *sheet, size_t scene, size_t picture, const svg_crop *crop, double x, double y, double scale);

/* Writes a PNG as DIR/pictures/NAME.png and embeds `crop` of it in the sheet. */
void figures_embed(figures_job *f, svg *sheet, const char *name, const uint8_t *rgba, uint32_t width, uint32_t height, svg_crop crop, double x, double y,
                   double shown_width, double shown_height);

/* The part of a picture that holds the glitter: the middle third, from above the horizon down. */
svg_crop figures_glitter_crop(uint32_t width, uint32_t height);

/* Progress over `steps`; a signal becomes the job's code. */
void figures_steps(figures_job *f, uint64_t steps);
void figures_step(figures_job *f);

int figures_no_memory(void);

/* Writes DIR/index.html around the sections. */
void figures_write_page(figures_job *f, const char *sections);

/* ---- the makers; each prints its errors and leaves the exit code with the job ---- */

void figures_measure(figures_job *f);            /* figures_scores.c: fills `scores` */
void figures_table1(figures_job *f);             /* figures_table.c */
char *figures_table1_text(const figures_job *f); /* as Markdown */
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
