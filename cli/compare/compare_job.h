/* SPDX-License-Identifier: MIT */
/* One comparison while it runs: scenes, pictures in the report's folder, times and scores. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_JOB_H
#define MANGATA_CLI_COMPARE_COMPARE_JOB_H

#include <jansson.h>

#include "cli/compare/compare_request.h"
#include "cli/common/numbers.h"
#include "image/metrics_clip.h"
#include "cli/render/render_request.h"

/* The pictures that are measured. */
typedef enum compare_kind {
    KIND_COVERAGE = 0, /* 1 channel, linear */
    KIND_DISPLAYED,    /* 3 channels, after exposure, glare and tone mapping, sRGB-encoded */
    KIND_LIGHT,        /* 3 channels, scene-linear radiance */
    COMPARE_KINDS
} compare_kind;

/* Scores beyond those of clip_metric: of a clip, against the two halves of the reference. */
typedef enum truth_score {
    TRUTH_CORRELATION = CLIP_METRICS, /* mean over the bands of texture */
    TRUTH_CORRELATION_LEAST,
    TRUTH_CONTRAST_LEAST,
    TRUTH_CONTRAST_GREATEST,
    TRUTH_MEAN_LEAST,
    TRUTH_MEAN_GREATEST,
    TRUTH_SPECKS, /* fraction of the pixels further off than the halves are from each other */
    COMPARE_METRICS
} truth_score;
enum { TRUTH_SCORES = COMPARE_METRICS - CLIP_METRICS };

/* A method on a scene. */
typedef struct compare_result {
    bool lacks_coverage, lacks_color; /* its pictures, of another program, hold no such layer */
    number_spread time;               /* seconds of one frame; all NaN: not measured */
    double memory;                    /* bytes that a frame takes at its peak, in a context of its own; NaN: not measured */
    clip_scores clip[COMPARE_KINDS];
    clip_scores *frames[COMPARE_KINDS]; /* one a frame */
    double truth[TRUTH_SCORES];         /* from TRUTH_CORRELATION on; NaN: not measured, not defined */
    double truth_noise[TRUTH_SCORES];   /* the noise floor of each */
    double noiseless_rmse;              /* of coverage; NaN without halves */
    json_t *texture, *specks;           /* as in mangata diff; NULL: not measured */
} compare_result;

typedef struct compare_scene {
    const char *path;
    const compare_view *view;
    char name[64]; /* the file's, without folder and extension, each once */
    scene_file *file;
    char *canonical;
    uint32_t width, height;
    mgt_quality *methods;             /* one a method: the request's, over the scene's quality */
    mgt_quality reference;            /* the request's; objects are seen through the waves as they are */
    mgt_quality halves[2];            /* where the reference has them: its own, of half the time samples, seeds in sequence */
    bool black_sky;                   /* colour holds nothing that coverage does not */
    double reference_seconds;         /* of a frame, on average; NaN: not known */
    compare_result *results;          /* one a method */
    clip_scores noise[COMPARE_KINDS]; /* the reference's noise floor in each score; NaN without halves */
} compare_scene;

typedef struct compare_job {
    const compare_request *request;
    mgt_context *context;
    mgt_context_info info;
    output_options output;
    progress progress;
    compare_scene scenes[COMPARE_SCENES]; /* request->scene_count of them */
    size_t frame_count;
    double part_first, part_share;                     /* of the picture in work: where the render that runs begins, and its fraction */
    uint64_t rendered, kept;                           /* pictures */
    char missing[COMPARE_KINDS][COMPARE_METRICS][160]; /* why a metric has no score; "" where it has */
} compare_job;

enum { COMPARE_PATH = 4600 };

/* Pictures are numbered 0: the reference, m + 1: method m; then the reference's halves. */
enum { COMPARE_REFERENCE = 0, COMPARE_HALF = COMPARE_METHODS + 1 };

const char *compare_picture_name(const compare_job *job, size_t picture);
const mgt_quality *compare_picture_quality(const compare_scene *scene, size_t picture);
uint32_t compare_frame_number(const compare_job *job, size_t frame);

/* Where the picture is kept, and a file DIR/NAME of the report. False, with the error printed, when the path is too long. */
bool compare_picture_path(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, char path[COMPARE_PATH]);
bool compare_file_path(const compare_job *job, const char *name, char path[COMPARE_PATH]);

/* Reads "coverage" or "color" of a picture; zeros where a method of others has none. An exit code. */
int compare_read_layer(compare_job *job, const compare_scene *scene, size_t picture, size_t frame, const char *layer, float_image *image);

/* Whether the picture is one of the scene's view. */
bool compare_draws(const compare_scene *scene, size_t picture);

/* The frame as the picture shows it, by its place in the list or by its number. False, with the error printed, when its camera is not a legal one. */
bool compare_frame_scene(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, mgt_scene *out);
bool compare_number_scene(const compare_scene *scene, size_t picture, uint32_t number, mgt_scene *out);

/* Prints and returns the exit codes of a failed file and of a signal. */
int compare_file_failure(compare_job *job, const file_error *error);
int compare_stopped(compare_job *job);

/* Reports that a shard's pictures are drawn; returns EXIT_CODE_OK. */
int compare_shard_done(const compare_job *job);

/* Replaces a file whole; returns the exit code. */
int compare_write_text(compare_job *job, const char *path, const char *text, size_t size);

/* From a job of zeros: loads the scenes, opens the context, checks every frame of every method, and makes the folder, in which the file `page`
 * must be writable. Prints errors and returns the exit code; compare_close() follows in every case. */
int compare_open(compare_job *job, const compare_request *request, const char *page);
void compare_close(compare_job *job);

/* The steps after it, in order; each prints its errors and returns the exit code. */
int compare_render(compare_job *job); /* compare_images.c: the pictures that are not there yet */
/* Linear light as it is displayed: 4 bytes a pixel, which the caller frees; NULL after a failure. compare_measure.c */
int compare_display(compare_job *job, const mgt_scene *view, const float_image *light, uint8_t **rgba);

int compare_time_methods(compare_job *job); /* compare_time.c */
int compare_measure(compare_job *job);      /* compare_measure.c */

#endif
