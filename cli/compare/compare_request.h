/* SPDX-License-Identifier: MIT */
/* What one `mangata compare` was asked to do. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_REQUEST_H
#define MANGATA_CLI_COMPARE_COMPARE_REQUEST_H

#include "cli/common/context_options.h"
#include "cli/common/frames.h"
#include "cli/common/method_spec.h"
#include "params/names.h"
#include "cli/common/progress.h"
#include "image/metrics_truth.h"

enum { COMPARE_METHODS = 32, COMPARE_SCENES = 64, COMPARE_GATES = 64 };

/* --max-rmse, --max-flicker: a limit of one method's error of coverage over all scenes, scored as one clip. */
typedef struct compare_gate {
    size_t method; /* its place among the methods */
    bool flicker;
    double limit;
} compare_gate;

/* A scene as one of several views of its file. All zero: the file as it is, drawn and timed by all methods. */
typedef struct compare_view {
    const char *name;             /* instead of the file's */
    const char *const *overrides; /* after the request's */
    size_t override_count;
    uint32_t methods; /* bits 1u << place of those that draw it; 0: all */
    bool untimed;
    bool only_timed; /* no pictures; and run i shows frame i, so that a moving camera leaves nothing to use again */
} compare_view;

typedef struct compare_request {
    console out;
    const char *folder;
    const char *scene_paths[COMPARE_SCENES];
    compare_view views[COMPARE_SCENES];
    size_t scene_count;
    scene_changes changes;
    method_spec methods[COMPARE_METHODS];
    const char *external[COMPARE_METHODS]; /* where a method's pictures are, of which nothing is rendered; NULL: it is ours */
    size_t method_count;
    mgt_quality reference;
    bool halved; /* the reference is the mean of two halves with seeds of their own, of half as many time samples each, which must be even */
    frame_list frames;
    work_shard shard;              /* part of all pictures; with a count, they are drawn and nothing is measured */
    mgt_layer layers[LAYER_COUNT]; /* that pictures keep besides colour and coverage */
    size_t layer_count;
    uint32_t metrics;  /* set of clip_metric */
    truth_words truth; /* measured against the halves; none unless `halved` */
    uint64_t time_runs;
    bool memory;            /* measured as well, where times are */
    uint64_t picture_bytes; /* of the page: how much its pictures may take */
    context_options context;
    compare_gate gates[COMPARE_GATES];
    size_t gate_count;
    progress_mode progress;
    char **arguments; /* as given, for the page */
    int argument_count;
} compare_request;

/* Renders what is missing, measures, and writes the report; prints errors and returns the exit code. */
int compare_run(const compare_request *request);

#endif
