/* SPDX-License-Identifier: MIT */
/* The state of a render, and functions that its parts share. */
#ifndef MANGATA_CLI_RENDER_RENDER_JOB_H
#define MANGATA_CLI_RENDER_RENDER_JOB_H

#include "cli/render/render_frame.h"
#include "cli/render/render_record.h"
#include "image/sums_file.h"

typedef struct render_job {
    render_request *request;
    scene_file *scene;
    char *canonical; /* the scene's canonical text; owned */
    mgt_context *context;
    mgt_context_info info;
    frame_buffer buffer;
    render_crypto *crypto; /* NULL: not requested */
    mgt_image image;       /* size and crop of every frame */
    uint32_t last_frame;   /* of the request, whichever shard has it */
    output_options output;
    progress progress;
    double before, share;        /* fractions of a frame's progress: before the current call into the library, and of that call */
    uint64_t rendered, skipped;  /* numbers of frames */
    uint64_t lost;               /* number of files whose frames were rendered, but that another process has finished meanwhile; they count as skipped */
    double seconds, least, most; /* rendering time of all frames, of the fastest and of the slowest frame */
    json_t *files;               /* list of the files, with --json; NULL: not requested */
    uint64_t *sums;              /* sums of the frame, if pictures are made of sums; NULL: they are not */
    bool unsaved;                /* it has been noted that a checkpoint cannot be written */
    sums_ranges ranges;          /* samples that `sums` or the parts of a merge hold */
} render_job;

enum { JOB_PATH = 4600 };

/* Prints that a signal has stopped the render. Returns the signal's exit code. */
int render_job_stopped(const render_job *job);

/* Handles the status of a call into the library for a frame: prints its error, or that a signal has stopped it. Returns an exit code. */
int render_job_ended(render_job *job, uint32_t frame, mgt_status status);

/* Prints an error of a file, or that a signal has stopped the render. Returns an exit code. */
int render_job_file_failure(render_job *job, const file_error *error);

/* Writes the path of a frame to `path`. `given` is the pattern as text, for the message that the path is too long. Returns an exit code. */
int render_job_path(const frame_path *pattern, const char *given, uint32_t frame, char path[JOB_PATH]);

#endif
