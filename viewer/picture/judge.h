/* SPDX-License-Identifier: MIT
 * Two pictures against brute force, in a thread of low priority: references of two frames that follow each other are gathered sample by sample, and the
 * error, FLIP and flicker of both pictures against them are told again and again. */
#ifndef MANGATA_VIEWER_PICTURE_JUDGE_H
#define MANGATA_VIEWER_PICTURE_JUDGE_H

#include "viewer/picture/display.h"

struct scene_models;

enum { JUDGE_FRAMES = 2 };

/* What is to be judged. Sizes of both frames are the same. */
typedef struct judge_order {
    mgt_scene frames[JUDGE_FRAMES]; /* as seen at t and a frame later; their waves are copied, those of the first for both; quality is not read */
    mgt_quality quality[SIDE_COUNT];
    struct scene_models *models; /* that the frames' objects belong to, kept while they are needed; NULL: none */
} judge_order;

/* Of displayed values, 0 to 1. Noise of the references is taken out of error and flicker. */
typedef struct judge_scores {
    double error;   /* root mean square against the reference of t */
    double flip;    /* mean FLIP of the same */
    double flicker; /* root mean square of the step from frame to frame against the references' step */
} judge_scores;

typedef struct judgement {
    judge_scores sides[SIDE_COUNT];
    double noise;            /* root mean square error that the reference of t still has; an error below it is not known yet */
    double step_noise;       /* the same of the references' step */
    uint32_t samples, total; /* of each reference, taken and wanted */
} judgement;

typedef struct judge judge;

/* `desc`: the machine's part of its context. `wake` is called on its thread when there is something to take. NULL on failure, with the reason in `error`. */
judge *judge_create(const mgt_context_desc *desc, void (*wake)(void), char *error, size_t error_size);
void judge_destroy(judge *j); /* NULL is allowed */

/* Begins with another order; what was under way ends at once. */
void judge_post(judge *j, const judge_order *order);

/* Ends what is under way at once. */
void judge_stop(judge *j);

/* The newest figures since the last order. False where there are none, or none since the last call; *problem (may be NULL) is then the text of a failure or "". */
bool judge_take(judge *j, judgement *out, char *problem, size_t problem_size);

#endif
