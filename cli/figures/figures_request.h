/* SPDX-License-Identifier: MIT */
/* The command line of one `mangata figures`. Strings are borrowed from it. */
#ifndef MANGATA_CLI_FIGURES_FIGURES_REQUEST_H
#define MANGATA_CLI_FIGURES_FIGURES_REQUEST_H

#include "cli/common/context_options.h"
#include "cli/common/frames.h"
#include "cli/common/progress.h"

/* The figures and tables of Podee et al. 2021, then those of Liu et al. 2020. */
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
    const char *folder; /* of the page */
    bool overwrite;     /* files are written even where they are another's */
    const char *scenes; /* folder of the standard scenes; NULL: it is searched for */
    uint32_t wanted;    /* bits 1u << figure_id */
    scene_changes changes;
    bool size_given;             /* --size is given */
    mgt_quality reference;       /* quality of the reference of Podee et al. */
    uint32_t refraction_samples; /* rays per side of a pixel of path-traced pictures */
    frame_list frames;
    work_shard shard;   /* shard of all pictures; if it has a count, pictures are only rendered */
    uint64_t time_runs; /* runs that are timed; 0: none */
    context_options context;
    progress_mode progress;
    bool check;       /* a claim that does not hold is an error */
    char **arguments; /* the command line, for the page */
    int argument_count;
} figures_request;

/* Renders the pictures that do not exist, measures, and writes the plates and the page. Prints errors and returns an exit code. */
int figures_run(const figures_request *request);

#endif
