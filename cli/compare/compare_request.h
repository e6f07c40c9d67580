/* SPDX-License-Identifier: MIT */
/* The command line of one `mangata compare`. Strings are borrowed from it. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_REQUEST_H
#define MANGATA_CLI_COMPARE_COMPARE_REQUEST_H

#include "cli/common/context_options.h"
#include "cli/common/frames.h"
#include "cli/common/method_spec.h"
#include "params/names.h"
#include "cli/common/progress.h"
#include "image/metrics_truth.h"

enum { COMPARE_METHODS = 32, COMPARE_SCENES = 64, COMPARE_GATES = 64, COMPARE_FRAMES = 100000 };

/* A limit of --max-rmse or --max-flicker for a method's error of coverage over all scenes, taken as one clip. */
typedef struct compare_gate {
    size_t method; /* index of the method */
    bool flicker;  /* true: the flicker is limited; false: the RMSE */
    double limit;
} compare_gate;

/* A view of a scene's file. All zero: the file as it is, rendered and timed by all methods. */
typedef struct compare_view {
    const char *name;             /* name of the scene in the report; NULL: the file's name */
    const char *const *overrides; /* KEY=VALUE, applied after the request's changes */
    size_t override_count;
    uint32_t methods; /* bits 1u << index of the methods that render it; 0: all */
    bool untimed;     /* it is not timed */
    bool only_timed;  /* it is timed, but no pictures are kept. Run i renders frame i, so that a moving camera leaves nothing to reuse */
} compare_view;

typedef struct compare_request {
    console out;
    const char *folder; /* of the report */
    bool overwrite;     /* files of the report are written even where they are another's */
    const char *scene_paths[COMPARE_SCENES];
    compare_view views[COMPARE_SCENES];
    size_t scene_count;
    scene_changes changes;
    method_spec methods[COMPARE_METHODS];
    const char *external[COMPARE_METHODS]; /* path of an external method's pictures, see compare_external.h; NULL: the method is rendered */
    size_t method_count;
    mgt_quality reference; /* its method, samples and seed are used */
    bool halved;           /* the reference is the mean of two halves with different seeds, each of half the time samples, whose number must be even */
    frame_list frames;
    work_shard shard;              /* shard of all pictures. If it has a count, pictures are only rendered */
    mgt_layer layers[LAYER_COUNT]; /* layers that pictures have besides colour and coverage */
    size_t layer_count;
    uint32_t metrics;       /* set of metrics: bits 1u << clip_metric */
    truth_words truth;      /* scores against the halves; all off unless `halved` */
    uint64_t time_runs;     /* runs that are timed; 0: none */
    bool memory;            /* memory is measured, too, where time is */
    uint64_t picture_bytes; /* largest size of the pictures in the page */
    context_options context;
    compare_gate gates[COMPARE_GATES];
    size_t gate_count;
    progress_mode progress;
    char **arguments; /* the command line, for the page */
    int argument_count;
} compare_request;

/* Renders the pictures that do not exist, measures, and writes the report. Prints errors and returns the exit code. */
int compare_run(const compare_request *request);

#endif
