/* SPDX-License-Identifier: MIT */
/* What one `mangata compare` was asked to do. */
#ifndef MANGATA_TOOLS_COMPARE_REQUEST_H
#define MANGATA_TOOLS_COMPARE_REQUEST_H

#include "console.h"
#include "context_options.h"
#include "frames.h"
#include "method_spec.h"
#include "progress.h"

enum { COMPARE_METHODS = 32, COMPARE_SCENES = 64, COMPARE_GATES = 64 };

/* --max-rmse, --max-flicker: a limit of one method's error of coverage over all scenes, scored as one clip. */
typedef struct compare_gate {
    size_t method; /* its place among the methods */
    bool flicker;
    double limit;
} compare_gate;

typedef struct compare_request {
    console out;
    const char *folder;
    const char *scene_paths[COMPARE_SCENES];
    size_t scene_count;
    const char **overrides; /* --set and --size, in order; owned by the caller */
    size_t override_count;
    method_spec methods[COMPARE_METHODS];
    size_t method_count;
    mgt_quality reference;
    frame_list frames;
    uint32_t metrics; /* set of clip_metric */
    uint64_t time_runs;
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
