/* SPDX-License-Identifier: MIT */
/* The columns of a comparison. Each is a metric of a kind of picture. A NaN is a score that was not measured or is not defined. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_SCORES_H
#define MANGATA_CLI_COMPARE_COMPARE_SCORES_H

#include "cli/compare/compare_job.h"

typedef struct score_column {
    compare_kind kind;
    int metric;                     /* clip_metric or truth_score */
    const char *key, *title, *help; /* name in files, title of the column, explanation */
    double best;                    /* the value of a perfect method */
    bool main;                      /* the column is one of the main ones, which are shown first */
} score_column;

extern const score_column score_columns[];
extern const size_t score_column_count;

/* Whether the request asks for the column. */
bool score_wanted(const compare_request *request, const score_column *column);

/* The score of a method over all frames of a scene, and of one frame. */
double score_of(const compare_result *result, const score_column *column);
double score_of_frame(const compare_result *result, const score_column *column, size_t frame);

/* The noise floor of a score: how much the reference's noise changes it, in units of the score. NaN: not known. `scene` NULL: that of the mean over scenes. */
double score_noise(const compare_job *job, const compare_scene *scene, const score_column *column);

/* A noise floor with two digits. */
number_text score_noise_text(double noise);

/* The method whose score is nearest to the best value. It must be nearer than all others by more than the noise floor; -1: none is. `scene` NULL: by the means
 * over scenes. One method alone with a score does not win, nor does any where the reference shows nothing. */
int score_winner(const compare_job *job, const compare_scene *scene, const score_column *column);

/* A line that names the scenes and columns in which methods are tied. `main_alone`: only main columns. The caller frees it. "": there is no tie. NULL: out of
 * memory. */
char *score_ties_text(const compare_job *job, bool main_alone);

/* A sentence that names the scenes, and kinds of pictures, whose reference is black. The caller frees it. "": there are none. NULL: out of memory. */
char *score_black_text(const compare_job *job);

/* The pictures of a method that hold values which are infinite or not a number in one picture only, and how many: "NAME: such values in FILE (NUMBER), …".
 * The caller frees it. "": there are none. NULL: out of memory. */
char *score_mismatches_text(const compare_job *job, size_t method);

/* Why no method has a score on any scene; NULL: one has. */
const char *score_missing(const compare_job *job, const score_column *column);

/* The mean of a method's scores over the scenes; NaN: it has none on one of them. */
double score_mean(const compare_job *job, size_t method, const score_column *column);

/* The root mean square of a method's scores over the scenes. For RMSE and flicker of scenes of one size it is the score of all frames as one clip. */
double score_pooled(const compare_job *job, size_t method, const score_column *column);

#endif
