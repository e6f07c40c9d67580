/* SPDX-License-Identifier: MIT */
/* Measures the kept pictures of every method against the reference's, frame by frame. */
#include "cli/compare/compare_scores.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"

const score_column score_columns[] = {
    {KIND_COVERAGE, CLIP_RMSE, "coverage.rmse", "RMSE", "coverage: root mean square of the error, whole frames", 0, true},
    {KIND_COVERAGE, CLIP_RELATIVE_RMSE, "coverage.relrmse", "relative RMSE", "coverage: RMSE over the root mean square of the reference", 0, true},
    {KIND_COVERAGE, CLIP_ENERGY, "coverage.energy", "energy", "coverage: mean over the reference's mean; 1 is right", 1, true},
    {KIND_COVERAGE, CLIP_FLICKER, "coverage.flicker", "flicker",
     "coverage: root mean square of the difference between the method's frame steps and the reference's", 0, true},
    {KIND_COVERAGE, CLIP_FLICKER_POWER, "coverage.flicker-power", "flicker power", "coverage: mean over pixels of the difference of temporal power", 0, false},
    {KIND_COVERAGE, CLIP_FLICKER_RATIO, "coverage.flicker-ratio", "flicker ratio",
     "coverage: temporal power over the reference's; below 1 too calm, above 1 too restless", 1, true},
    {KIND_COVERAGE, CLIP_FLICKER_BRIGHT, "coverage.flicker-bright", "bright pixels",
     "coverage: distance of the histograms over frames of how many pixels are bright", 0, false},
    {KIND_COVERAGE, CLIP_FLICKER_GLINTS, "coverage.flicker-glints", "glints", "coverage: distance of the histograms over frames of how many glints there are",
     0, false},
    {KIND_COVERAGE, CLIP_FLICKER_SIZES, "coverage.flicker-sizes", "glint sizes", "coverage: distance of the histograms of the glints' sizes", 0, false},
    {KIND_DISPLAYED, CLIP_RMSE, "displayed.rmse", "displayed RMSE", "displayed colour (sRGB, 0 to 1): root mean square of the error", 0, true},
    {KIND_DISPLAYED, CLIP_FLIP, "displayed.flip", "FLIP", "displayed colour: mean FLIP, 0 to 1", 0, true},
    {KIND_LIGHT, CLIP_HDR_FLIP, "light.hdr-flip", "HDR-FLIP", "scene-linear colour: mean HDR-FLIP, 0 to 1", 0, true},
    {KIND_DISPLAYED, CLIP_SSIM, "displayed.ssim", "SSIM", "displayed colour: mean structural similarity; 1 is equal", 1, false},
    {KIND_DISPLAYED, CLIP_YEE, "displayed.yee", "Yee",
     "displayed colour: share of pixels that fail Yee's perceptual test by idiff, which minds hue more than brightness", 0, false},
    {KIND_DISPLAYED, CLIP_FLICKER, "displayed.flicker", "displayed flicker", "displayed colour: flicker as above", 0, false},
};
const size_t score_column_count = sizeof score_columns / sizeof score_columns[0];

bool score_wanted(const compare_request *request, const score_column *column)
{
    const bool flicker = (CLIP_ALL_FLICKER >> column->metric & 1) != 0;
    return (request->metrics >> column->metric & 1) && !(flicker && frame_list_length(&request->frames) < 2);
}

double score_of(const compare_result *result, const score_column *column) { return result->clip[column->kind].values[column->metric]; }

double score_of_frame(const compare_result *result, const score_column *column, size_t frame)
{
    return result->frames[column->kind][frame].values[column->metric];
}

const char *score_missing(const compare_job *job, const score_column *column)
{
    for (size_t s = 0; s < job->request->scene_count; s++)
        for (size_t m = 0; m < job->request->method_count; m++)
            if (!isnan(score_of(&job->scenes[s].results[m], column)))
                return NULL;
    const char *why = job->missing[column->kind][column->metric];
    return why[0] ? why : "it is not defined here";
}

double score_mean(const compare_job *job, size_t method, const score_column *column)
{
    double sum = 0;
    for (size_t s = 0; s < job->request->scene_count; s++)
        sum += score_of(&job->scenes[s].results[method], column);
    return sum / (double)job->request->scene_count;
}

double score_pooled(const compare_job *job, size_t method, const score_column *column)
{
    double sum = 0;
    for (size_t s = 0; s < job->request->scene_count; s++) {
        const double score = score_of(&job->scenes[s].results[method], column);
        sum += score * score;
    }
    return sqrt(sum / (double)job->request->scene_count);
}

static uint32_t metrics_of_kind(const compare_request *request, compare_kind kind)
{
    uint32_t set = 0;
    for (size_t c = 0; c < score_column_count; c++)
        if (score_columns[c].kind == kind && score_wanted(request, &score_columns[c]))
            set |= 1u << score_columns[c].metric;
    return set;
}

static void free_frames(float_image frames[COMPARE_KINDS])
{
    for (int k = 0; k < COMPARE_KINDS; k++)
        float_image_free(&frames[k]);
}

int compare_display(compare_job *job, const mgt_scene *view, const float_image *light, uint8_t **rgba)
{
    *rgba = calloc((size_t)light->width * light->height, 4);
    if (!*rgba)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    const mgt_target target = target_of(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, *rgba);
    const mgt_status status = mgt_display(job->context, view, light->pixels, &target);
    if (status == MGT_OK)
        return EXIT_CODE_OK;
    free(*rgba);
    *rgba = NULL;
    return *interrupt_flag() ? compare_stopped(job) : console_library_error(job->context, status);
}

/* Displayed colour as a file of 8 bits would hold it, 0 … 1. */
static int display(compare_job *job, const compare_scene *scene, size_t frame, const float_image *light, float_image *displayed)
{
    const size_t values = 3 * (size_t)light->width * light->height;
    uint8_t *bytes;
    mgt_scene view;
    if (!compare_frame_scene(job, scene, COMPARE_REFERENCE, frame, &view))
        return EXIT_CODE_BAD_INPUT;
    int code = compare_display(job, &view, light, &bytes);
    if (code != EXIT_CODE_OK)
        return code;
    *displayed = (float_image){light->width, light->height, 3, calloc(values, sizeof(float))};
    if (!displayed->pixels)
        code = console_error(EXIT_CODE_FAILED, "out of memory");
    for (size_t i = 0; i < values && code == EXIT_CODE_OK; i++)
        displayed->pixels[i] = (float)bytes[i / 3 * 4 + i % 3] / 255;
    free(bytes);
    return code;
}

static int read_frame(compare_job *job, const compare_scene *scene, size_t picture, size_t frame, float_image out[COMPARE_KINDS])
{
    char path[COMPARE_PATH];
    file_error error;
    if (!compare_picture_path(job, scene, picture, frame, path))
        return EXIT_CODE_USAGE;
    if (picture_read(&out[KIND_COVERAGE], path, "coverage", &error) != FILE_OK || picture_read(&out[KIND_LIGHT], path, "color", &error) != FILE_OK)
        return compare_file_failure(job, &error);
    return metrics_of_kind(job->request, KIND_DISPLAYED) ? display(job, scene, frame, &out[KIND_LIGHT], &out[KIND_DISPLAYED]) : EXIT_CODE_OK;
}

/* The metrics of one scene: a row of kinds for each method; NULL where a kind has nothing to measure. */
typedef struct measuring {
    clip_metrics *metrics[COMPARE_METHODS][COMPARE_KINDS];
} measuring;

static int start(compare_job *job, const compare_scene *scene, measuring *state)
{
    for (size_t m = 0; m < job->request->method_count; m++)
        for (int k = 0; k < COMPARE_KINDS; k++) {
            const clip_metrics_desc desc = {.width = scene->width,
                                            .height = scene->height,
                                            .channels = k == KIND_COVERAGE ? 1 : 3,
                                            .metrics = metrics_of_kind(job->request, (compare_kind)k),
                                            .srgb_encoded = k == KIND_DISPLAYED};
            file_error error;
            if (desc.metrics && clip_metrics_create(&state->metrics[m][k], &desc, &error) != FILE_OK)
                return compare_file_failure(job, &error);
        }
    return EXIT_CODE_OK;
}

static int add_method_frame(compare_job *job, compare_scene *scene, measuring *state, size_t method, size_t frame, const float_image reference[COMPARE_KINDS])
{
    float_image images[COMPARE_KINDS] = {{0}};
    int code = read_frame(job, scene, method + 1, frame, images);
    for (int k = 0; k < COMPARE_KINDS && code == EXIT_CODE_OK; k++) {
        clip_frame scores;
        file_error error;
        if (!state->metrics[method][k])
            continue;
        if (clip_metrics_add(state->metrics[method][k], &images[k], &reference[k], NULL, &scores, &error) != FILE_OK)
            code = compare_file_failure(job, &error);
        else
            scene->results[method].frames[k][frame] = scores.scores;
    }
    free_frames(images);
    return code;
}

static int add_frame(compare_job *job, compare_scene *scene, measuring *state, size_t frame)
{
    float_image reference[COMPARE_KINDS] = {{0}};
    int code = read_frame(job, scene, COMPARE_REFERENCE, frame, reference);
    for (size_t m = 0; m < job->request->method_count && code == EXIT_CODE_OK; m++) {
        code = *interrupt_flag() ? compare_stopped(job) : add_method_frame(job, scene, state, m, frame, reference);
        job->progress.frames_done++;
        progress_update(&job->progress, 0);
    }
    free_frames(reference);
    return code;
}

static int take_scores(compare_job *job, compare_scene *scene, const measuring *state)
{
    for (size_t m = 0; m < job->request->method_count; m++)
        for (int k = 0; k < COMPARE_KINDS; k++) {
            file_error error;
            if (!state->metrics[m][k])
                continue;
            if (clip_metrics_scores(state->metrics[m][k], &scene->results[m].clip[k], &error) != FILE_OK)
                return compare_file_failure(job, &error);
            for (size_t c = 0; c < score_column_count; c++) {
                const score_column *column = &score_columns[c];
                const bool asked = (int)column->kind == k && score_wanted(job->request, column);
                const char *why = asked ? clip_metrics_missing(state->metrics[m][k], column->metric) : NULL;
                if (why)
                    snprintf(job->missing[k][column->metric], sizeof job->missing[k][column->metric], "%s", why);
            }
        }
    return EXIT_CODE_OK;
}

static clip_scores no_scores(void)
{
    clip_scores scores;
    for (int i = 0; i < CLIP_METRICS; i++)
        scores.values[i] = NAN;
    return scores;
}

static int make_room(compare_job *job, compare_scene *scene)
{
    for (size_t m = 0; m < job->request->method_count; m++)
        for (int k = 0; k < COMPARE_KINDS; k++) {
            compare_result *result = &scene->results[m];
            result->frames[k] = calloc(job->frame_count, sizeof *result->frames[k]);
            if (!result->frames[k])
                return console_error(EXIT_CODE_FAILED, "out of memory");
            result->clip[k] = no_scores();
            for (size_t f = 0; f < job->frame_count; f++)
                result->frames[k][f] = no_scores();
        }
    return EXIT_CODE_OK;
}

int compare_measure(compare_job *job)
{
    int code = EXIT_CODE_OK;
    measuring *state = calloc(1, sizeof *state);
    if (!state)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    job->progress = progress_start(job->request->progress, job->request->scene_count * job->frame_count * job->request->method_count);
    for (size_t s = 0; s < job->request->scene_count && code == EXIT_CODE_OK; s++) {
        compare_scene *scene = &job->scenes[s];
        code = make_room(job, scene);
        if (code == EXIT_CODE_OK)
            code = start(job, scene, state);
        for (size_t f = 0; f < job->frame_count && code == EXIT_CODE_OK; f++)
            code = add_frame(job, scene, state, f);
        if (code == EXIT_CODE_OK)
            code = take_scores(job, scene, state);
        for (size_t m = 0; m < job->request->method_count; m++)
            for (int k = 0; k < COMPARE_KINDS; k++) {
                clip_metrics_free(state->metrics[m][k]);
                state->metrics[m][k] = NULL;
            }
    }
    progress_clear(&job->progress);
    free(state);
    return code;
}
