/* SPDX-License-Identifier: MIT */
/* The columns of a comparison: which metric of which kind of picture, and how it is called. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_SCORES_H
#define MANGATA_CLI_COMPARE_COMPARE_SCORES_H

#include "cli/compare/compare_job.h"

typedef struct score_column {
    compare_kind kind;
    int metric; /* clip_metric or truth_score */
    const char *key, *title, *help;
    double best; /* the value of a perfect method */
    bool main;   /* among those that a first look needs */
} score_column;

extern const score_column score_columns[];
extern const size_t score_column_count;

/* Whether the request asks for the column. */
bool score_wanted(const compare_request *request, const score_column *column);

double score_of(const compare_result *result, const score_column *column);
double score_of_frame(const compare_result *result, const score_column *column, size_t frame);

/* How far the reference's own noise moves the score, in its units; NaN: not known. `scene` NULL: of the mean over scenes. */
double score_noise(const compare_job *job, const compare_scene *scene, const score_column *column);

/* A floor itself, to two digits. */
number_text score_noise_text(double noise);

/* The method nearest to the best value, where it is nearer than every other by more than the noise floor; -1: none is. `scene` NULL: by the means over
 * scenes. */
int score_winner(const compare_job *job, const compare_scene *scene, const score_column *column);
/* Whether there is no winner though two methods or more have a score. */
bool score_tied(const compare_job *job, const compare_scene *scene, const score_column *column);
/* A line that names where methods are tied, among main columns alone or among all; "" where there is no such place; NULL when memory runs out. The
 * caller frees it. */
char *score_ties_text(const compare_job *job, bool main_alone);

/* Why no method has a score on any scene; NULL where one has. */
const char *score_missing(const compare_job *job, const score_column *column);

/* Mean over the scenes; NaN where one has none. */
double score_mean(const compare_job *job, size_t method, const score_column *column);

/* Root mean square over the scenes, of RMSE and flicker: the score of all frames as one clip, for scenes of one size. */
double score_pooled(const compare_job *job, size_t method, const score_column *column);

#endif
