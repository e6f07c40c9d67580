/* SPDX-License-Identifier: MIT */
/* The state of a comparison: scenes, pictures in the report's folder, times and scores. Functions that return int print their errors and return an exit
 * code. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_JOB_H
#define MANGATA_CLI_COMPARE_COMPARE_JOB_H

#include <jansson.h>

#include "cli/compare/compare_request.h"
#include "cli/common/numbers.h"
#include "image/metrics_clip.h"
#include "cli/render/render_request.h"

/* The kinds of pictures that are measured. */
typedef enum compare_kind {
    KIND_COVERAGE = 0, /* 1 channel, linear */
    KIND_DISPLAYED,    /* 3 channels, after exposure, glare and tone mapping, sRGB-encoded */
    KIND_LIGHT,        /* 3 channels, scene-linear radiance */
    COMPARE_KINDS
} compare_kind;

/* Scores besides those of clip_metric: of all frames, against the two halves of the reference. */
typedef enum truth_score {
    TRUTH_CORRELATION = CLIP_METRICS, /* mean over the bands of texture */
    TRUTH_CORRELATION_LEAST,
    TRUTH_CONTRAST_LEAST,
    TRUTH_CONTRAST_GREATEST,
    TRUTH_MEAN_LEAST,
    TRUTH_MEAN_GREATEST,
    TRUTH_SPECKS, /* fraction of pixels that are specks, beyond that of one half against the other */
    COMPARE_METRICS
} truth_score;
enum { TRUTH_SCORES = COMPARE_METRICS - CLIP_METRICS };

/* The results of a method on a scene. */
typedef struct compare_result {
    bool lacks_coverage, lacks_color;   /* the pictures of an external method do not hold that layer */
    number_spread time;                 /* seconds of one frame; all NaN: not measured */
    double memory;                      /* largest number of bytes for a frame in a context of its own; NaN: not measured */
    clip_scores clip[COMPARE_KINDS];    /* scores of all frames together */
    clip_scores *frames[COMPARE_KINDS]; /* scores of each frame; owned */
    double truth[TRUTH_SCORES];         /* index: truth_score − TRUTH_CORRELATION; NaN: not measured or not defined */
    double truth_noise[TRUTH_SCORES];   /* noise floors of these scores */
    double noiseless_rmse;              /* RMSE of coverage without the reference's noise; NaN: the reference has no halves */
    uint64_t *mismatches;               /* for each frame the number of values that are infinite or NaN in its picture or the reference's alone; owned */
    bool unscored[COMPARE_KINDS];       /* some of these values are of that kind, so it has no scores */
    json_t *texture, *specks;           /* as in mangata diff, owned; NULL: not measured */
} compare_result;

/* A scene of the comparison. */
typedef struct compare_scene {
    const char *path;
    const compare_view *view;
    char name[64]; /* name of the file without folder and ending, or of the view; unique in the report */
    scene_file *file;
    char *canonical; /* the scene's canonical text; owned */
    uint32_t width, height;
    mgt_quality *methods;             /* for each method the scene's quality, changed by the method's options; owned */
    mgt_quality reference;            /* of the reference; ssaa where there is more to see than the surface, objects by refraction truth */
    mgt_quality halves[2];            /* of the halves, if the request wants them: half the reference's samples, and successive seeds */
    bool black_sky;                   /* the sky is black, so colour shows nothing that coverage does not show */
    double reference_seconds;         /* mean rendering time of a frame; NaN: not known */
    compare_result *results;          /* for each method; owned */
    clip_scores noise[COMPARE_KINDS]; /* noise floors of the reference; NaN: it has no halves */
    bool black[COMPARE_KINDS];        /* the reference has nothing but 0 there in all frames, so that no method can be told to be the best */
} compare_scene;

typedef struct compare_job {
    const compare_request *request;
    mgt_context *context;
    mgt_context_info info;
    output_options output;
    progress progress;
    compare_scene scenes[COMPARE_SCENES]; /* request->scene_count of them */
    size_t frame_count;
    double part_first, part_share;                     /* fractions of the current picture's progress: before the current render, and of that render */
    uint64_t rendered, kept;                           /* numbers of pictures that were rendered, and that existed */
    char missing[COMPARE_KINDS][COMPARE_METRICS][160]; /* why a metric has no score; "": it has */
} compare_job;

enum { COMPARE_PATH = 4600 };

/* Numbers of pictures: COMPARE_REFERENCE, then m + 1 for method m, then COMPARE_HALF and COMPARE_HALF + 1 for the halves of the reference. */
enum { COMPARE_REFERENCE = 0, COMPARE_HALF = COMPARE_METHODS + 1 };

/* The name and the quality of a picture, and the scene's number of frame `frame` of the comparison. */
const char *compare_picture_name(const compare_job *job, size_t picture);
const mgt_quality *compare_picture_quality(const compare_scene *scene, size_t picture);
uint32_t compare_frame_number(const compare_job *job, size_t frame);

/* Write the path of a picture and of a file DIR/NAME of the report to `path`. False: it is too long, which is printed. */
bool compare_picture_path(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, char path[COMPARE_PATH]);
bool compare_file_path(const compare_job *job, const char *name, char path[COMPARE_PATH]);

/* Reads layer "coverage" or "color" of a picture. A layer that an external method lacks is all zero. The caller frees the image. */
int compare_read_layer(compare_job *job, const compare_scene *scene, size_t picture, size_t frame, const char *layer, float_image *image);

/* Whether the scene's view has the picture. */
bool compare_draws(const compare_scene *scene, size_t picture);

/* The scene of a picture's frame, by its place in the comparison or by the scene's number. False: its camera is not valid, which is printed. */
bool compare_frame_scene(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, mgt_scene *out);
bool compare_number_scene(const compare_scene *scene, size_t picture, uint32_t number, mgt_scene *out);

/* Print a failure of a file, and that a signal has stopped the comparison. Return its exit code. */
int compare_file_failure(compare_job *job, const file_error *error);
int compare_stopped(compare_job *job);

/* Prints that the pictures of the shard have been rendered. */
int compare_shard_done(const compare_job *job);

/* Writes a file. An existing file is replaced only by a complete one. */
int compare_write_text(compare_job *job, const char *path, const char *text, size_t size);

/* A file of the report, and a text within its first 2048 bytes that only the command that makes the report writes. */
typedef struct compare_output {
    const char *name, *mark;
} compare_output;

/* Fills a job that is all zero: loads the scenes, opens the context, checks every frame of every method, and makes the folder, in which the files of `outputs`,
 * of which the last has no name, must be writable and nobody's own. compare_close() must be called in every case. */
int compare_open(compare_job *job, const compare_request *request, const compare_output *outputs);
void compare_close(compare_job *job);

/* The steps of a comparison after that, in order. */
int compare_render(compare_job *job); /* compare_images.c: renders the pictures that do not exist yet */
/* Converts linear light to displayed RGBA, 4 bytes per pixel, by the exposure, glare and tone map of `view`. The caller frees *rgba, which is NULL after an
 * error. compare_measure.c */
int compare_display(compare_job *job, const mgt_scene *view, const float_image *light, uint8_t **rgba);

int compare_time_methods(compare_job *job); /* compare_time.c */
int compare_measure(compare_job *job);      /* compare_measure.c */

#endif
