/* SPDX-License-Identifier: MIT */
/* What one `mangata render` was asked to do. */
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
    picture_format format; /* of output */
    frame_path path;       /* the same output, taken apart */

    scene_changes changes;
    frame_list frames;       /* none: not given */
    work_shard shard;        /* of these frames */
    uint64_t crop[4];        /* x, y, width, height; 0: not given */
    quality_options options; /* of quality, as given */
    mgt_quality quality;     /* with those of the scene, once it is loaded */
    context_options context;
    mgt_layer layers[LAYER_COUNT];
    size_t layer_count;
    exr_choice exr;
    struct {
        video_codec codec;
        int crf;
        bool crf_given;
    } film;

    /* Of mangata merge: files of sums, as given and taken apart. */
    const char **part_paths;
    frame_path *parts;
    size_t part_count;

    double checkpoint; /* seconds between checkpoints; 0: none */
    bool overwrite, skip_existing, stamp;
    progress_mode progress;
} render_request;

/* True when the output is one file for all frames. */
static inline bool render_is_film(const render_request *request)
{
    return request->format == PICTURE_MP4 || request->format == PICTURE_MOV || request->format == PICTURE_Y4M;
}

/* Renders; prints errors and returns the exit code. Takes the request, since defaults are filled in from the scene. */
int render_job_run(render_request *request);

#endif
