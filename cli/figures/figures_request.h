/* SPDX-License-Identifier: MIT */
/* What one `mangata figures` was asked to do. */
#ifndef MANGATA_CLI_FIGURES_FIGURES_REQUEST_H
#define MANGATA_CLI_FIGURES_FIGURES_REQUEST_H

#include "cli/common/context_options.h"
#include "cli/common/frames.h"
#include "cli/common/progress.h"

/* Of Podee et al. 2021, then of Liu et al. 2020. */
typedef enum figure_id {
    FIGURE_TABLE1,
    FIGURE_11,
    FIGURE_12,
    FIGURE_13,
    FIGURE_14,
    FIGURE_15,
    FIGURE_16,
    FIGURE_17,
    FIGURE_18,
    FIGURE_20,
    FIGURE_21,
    FIGURES_PODEE,
    FIGURE_LIU_4 = FIGURES_PODEE,
    FIGURE_LIU_7,
    FIGURE_LIU_8,
    FIGURE_LIU_9,
    FIGURE_LIU_10,
    FIGURE_LIU_11,
    FIGURE_LIU_TABLE3,
    FIGURE_LIU_12,
    FIGURE_LIU_13,
    FIGURE_LIU_14,
    FIGURE_LIU_15,
    FIGURES
} figure_id;

typedef struct figures_request {
    console out;
    const char *folder;
    const char *scenes; /* the folder of the standard scenes; NULL: look for it */
    uint32_t wanted;    /* bits 1u << figure_id */
    scene_changes changes;
    bool size_given;
    mgt_quality reference;
    uint32_t refraction_samples; /* of pictures of traced refraction */
    frame_list frames;
    work_shard shard; /* of all pictures */
    uint64_t time_runs;
    context_options context;
    progress_mode progress;
    bool check;
    char **arguments; /* as given, for the page */
    int argument_count;
} figures_request;

/* Renders what is missing, measures, and writes plates and page; prints errors and returns the exit code. */
int figures_run(const figures_request *request);

#endif
