/* SPDX-License-Identifier: MIT */
/* The command line of one `mangata render` or `mangata merge`. Strings are borrowed from it. */
#ifndef MANGATA_CLI_RENDER_RENDER_REQUEST_H
#define MANGATA_CLI_RENDER_RENDER_REQUEST_H

#include "cli/common/context_options.h"
#include "cli/common/frames.h"
#include "cli/render/render_exr.h"
#include "image/picture.h"
#include "image/video.h"
#include "params/names.h"
#include "cli/common/progress.h"
#include "cli/common/quality_options.h"

typedef struct render_request {
    console out;
    const char *scene_path;
    const char *output;
    picture_format format; /* format of `output` */
    frame_path path;       /* `output` as a pattern of paths */

    scene_changes changes;
    frame_list frames;       /* empty: not given */
    work_shard shard;        /* shard of these frames */
    uint64_t crop[4];        /* x, y, width, height; 0: not given */
    quality_options options; /* options of quality as given */
    mgt_quality quality;     /* the scene's quality changed by `options`; set after the scene is loaded */
    context_options context;
    mgt_layer layers[LAYER_COUNT];
    size_t layer_count;
    exr_choice exr;
    struct {
        video_codec codec;
        int crf; /* constant rate factor */
        bool crf_given;
    } film;

    /* mangata merge: the files of sums, as given and as patterns of paths. */
    const char **part_paths;
    frame_path *parts;
    size_t part_count;

    double checkpoint; /* seconds between checkpoints; 0: no checkpoints */
    bool overwrite, skip_existing, dry_run, stamp;
    progress_mode progress;
} render_request;

/* Whether the output is one file for all frames. */
static inline bool render_is_film(const render_request *request)
{
    return request->format == PICTURE_MP4 || request->format == PICTURE_MOV || request->format == PICTURE_Y4M;
}

/* Renders. Fills in defaults of the request from the scene. Prints errors and returns the exit code. */
int render_job_run(render_request *request);

#endif
