/* SPDX-License-Identifier: MIT */
/* One render on its way. */
#ifndef MANGATA_CLI_RENDER_RENDER_JOB_H
#define MANGATA_CLI_RENDER_RENDER_JOB_H

#include "cli/render/render_frame.h"
#include "cli/render/render_record.h"
#include "image/sums_file.h"

typedef struct render_job {
    render_request *request;
    scene_file *scene;
    char *canonical;
    mgt_context *context;
    mgt_context_info info;
    frame_buffer buffer;
    render_crypto *crypto; /* NULL: not asked for */
    mgt_image image;       /* of every frame, with the crop */
    output_options output;
    progress progress;
    double before, share; /* of a frame's progress: done before this call into the library, and this call's own */
    uint64_t rendered, skipped;
    double seconds, least, most; /* of rendering alone */
    json_t *files;               /* with --json */
    uint64_t *sums;              /* of the frame, where pictures are made of sums; NULL: they are not */
    sums_ranges ranges;          /* the samples that they hold, or that a merge's parts hold */
} render_job;

enum { JOB_PATH = 4600 };

/* Says that a signal has stopped the render; its exit code. */
int render_job_stopped(const render_job *job);

/* What a call into the library for a frame ended with: prints its error, or that a signal has stopped it. An exit code. */
int render_job_ended(render_job *job, uint32_t frame, mgt_status status);

/* Prints an error of a file and returns its exit code. */
int render_job_file_failure(render_job *job, const file_error *error);

/* Prints the output's path, or a part's, for a frame; else says that it is too long. An exit code. */
int render_job_path(const frame_path *pattern, const char *given, uint32_t frame, char path[JOB_PATH]);

#endif
