/* SPDX-License-Identifier: MIT
 * Compares two pictures with brute force, in a thread of low priority. It renders references of two successive frames sample by sample, and meanwhile repeatedly
 * computes the error, FLIP and flicker of both pictures against them. */
#ifndef MANGATA_VIEWER_PICTURE_JUDGE_H
#define MANGATA_VIEWER_PICTURE_JUDGE_H

#include "viewer/picture/display.h"

struct scene_models;

enum { JUDGE_FRAMES = 2 };

/* What is to be judged. Sizes of both frames are the same. */
typedef struct judge_order {
    mgt_scene frames[JUDGE_FRAMES]; /* the scene at t and one frame later; the first one's waves are copied and used for both; quality is not read */
    mgt_quality quality[SIDE_COUNT];
    struct scene_models *models; /* models of the frames' objects, shared while they are needed; NULL: there are none */
} judge_order;

/* Scores over displayed values, which are in [0, 1]. The noise of the references has been subtracted from error and flicker. */
typedef struct judge_scores {
    double error;   /* root mean square error against the reference of t */
    double flip;    /* mean FLIP against the reference of t */
    double flicker; /* root mean square error of the change from frame to frame, against the references' change */
} judge_scores;

typedef struct judgement {
    judge_scores sides[SIDE_COUNT];
    double noise;            /* root mean square error of the reference of t; smaller errors of pictures cannot be measured yet */
    double step_noise;       /* root mean square error of the references' change from frame to frame */
    uint32_t samples, total; /* samples of each reference: taken so far, and wanted */
} judgement;

typedef struct judge judge;

/* Creates a judge with a context by `desc`. It calls `wake` on its thread when there are new scores. Returns NULL on failure, with the reason in `error`. */
judge *judge_create(const mgt_context_desc *desc, void (*wake)(void), char *error, size_t error_size);
void judge_destroy(judge *j); /* NULL is allowed */

/* Begins with another order. Stops the work on the former one at once. */
void judge_post(judge *j, const judge_order *order);

/* Stops the work at once. */
void judge_stop(judge *j);

/* Takes the newest scores of the last order. Returns false if there are none since the last call. `problem`, which may be NULL, then gets the text of a failure,
 * or "". */
bool judge_take(judge *j, judgement *out, char *problem, size_t problem_size);

#endif
