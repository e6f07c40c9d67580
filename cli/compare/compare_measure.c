/* SPDX-License-Identifier: MIT */
/* Measures the pictures of every method against those of the reference and its halves, frame by frame. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/compare/compare_scores.h"
#include "cli/common/interrupt.h"
#include "cli/common/truth_json.h"
#include "image/image_metrics.h"

static uint32_t metrics_of_kind(const compare_request *request, compare_kind kind)
{
    uint32_t set = 0;
    for (size_t c = 0; c < score_column_count; c++)
        if (score_columns[c].kind == kind && score_columns[c].metric < CLIP_METRICS && score_wanted(request, &score_columns[c]))
            set |= 1u << score_columns[c].metric;
    return set;
}

static bool shows_displayed(const compare_request *request) { return metrics_of_kind(request, KIND_DISPLAYED) || request->truth.specks; }

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

/* Converts light to displayed colour in [0, 1], rounded to 8 bits. */
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
    int code = compare_read_layer(job, scene, picture, frame, "coverage", &out[KIND_COVERAGE]);
    if (code == EXIT_CODE_OK)
        code = compare_read_layer(job, scene, picture, frame, "color", &out[KIND_LIGHT]);
    return code == EXIT_CODE_OK && shows_displayed(job->request) ? display(job, scene, frame, &out[KIND_LIGHT], &out[KIND_DISPLAYED]) : code;
}

/* The metrics of a scene, for each method and kind of picture. NULL: the kind has no metrics. */
typedef struct measuring {
    clip_metrics *metrics[COMPARE_METHODS][COMPARE_KINDS];
    truth_metrics truth[COMPARE_METHODS][COMPARE_KINDS];
    clip_metrics *noise[COMPARE_KINDS]; /* of a half of the reference against the whole reference */
} measuring;

/* The pictures of a frame that methods are compared with. */
typedef struct truth_pictures {
    float_image reference[COMPARE_KINDS], halves[2][COMPARE_KINDS];
} truth_pictures;

static int create_metrics(compare_job *job, const compare_scene *scene, compare_kind kind, clip_metrics **metrics)
{
    const clip_metrics_desc desc = {.width = scene->width,
                                    .height = scene->height,
                                    .channels = kind == KIND_COVERAGE ? 1 : 3,
                                    .metrics = metrics_of_kind(job->request, kind),
                                    .srgb_encoded = kind == KIND_DISPLAYED};
    file_error error;
    return !desc.metrics || clip_metrics_create(metrics, &desc, &error) == FILE_OK ? EXIT_CODE_OK : compare_file_failure(job, &error);
}

static int start(compare_job *job, const compare_scene *scene, measuring *state)
{
    const compare_request *r = job->request;
    int code = EXIT_CODE_OK;
    for (int k = 0; k < COMPARE_KINDS && code == EXIT_CODE_OK; k++) {
        for (size_t m = 0; m < r->method_count && code == EXIT_CODE_OK; m++) {
            code = create_metrics(job, scene, (compare_kind)k, &state->metrics[m][k]);
            state->truth[m][k] = (truth_metrics){.wants = {.texture = k == KIND_LIGHT && r->truth.texture, .specks = k == KIND_DISPLAYED && r->truth.specks},
                                                 .srgb_encoded = k == KIND_DISPLAYED};
        }
        if (code == EXIT_CODE_OK && r->halved)
            code = create_metrics(job, scene, (compare_kind)k, &state->noise[k]);
    }
    return code;
}

/* Whether truth metrics are needed for a kind. Coverage always needs them for its RMSE without noise, which costs little. */
static bool measures_truth(const truth_metrics *truth, int kind) { return kind == KIND_COVERAGE || truth->wants.texture || truth->wants.specks; }

static bool lacks(const compare_result *result, int kind) { return kind == KIND_COVERAGE ? result->lacks_coverage : result->lacks_color; }

static uint64_t count_mismatches(const float_image *a, const float_image *b)
{
    const size_t values = (size_t)a->width * a->height * a->channels;
    uint64_t count = 0;
    for (size_t i = 0; i < values; i++)
        count += !image_values_comparable(a->pixels[i], b->pixels[i]);
    return count;
}

/* Counts the values of a frame that no score can be made of. */
static void look_for_mismatches(compare_result *result, size_t frame, const float_image images[COMPARE_KINDS], const float_image reference[COMPARE_KINDS])
{
    static const compare_kind kinds[] = {KIND_COVERAGE, KIND_LIGHT}; /* displayed colour is made of light */
    for (int i = 0; i < 2; i++) {
        const compare_kind kind = kinds[i];
        const uint64_t count = lacks(result, kind) ? 0 : count_mismatches(&images[kind], &reference[kind]);
        result->mismatches[frame] += count;
        result->unscored[kind] |= count > 0;
        result->unscored[KIND_DISPLAYED] |= kind == KIND_LIGHT && count > 0;
    }
}

static int add_method_frame(compare_job *job, compare_scene *scene, measuring *state, size_t method, size_t frame, const truth_pictures *truth)
{
    float_image images[COMPARE_KINDS] = {{0}};
    compare_result *result = &scene->results[method];
    int code = read_frame(job, scene, method + 1, frame, images);
    if (code == EXIT_CODE_OK)
        look_for_mismatches(result, frame, images, truth->reference);
    const bool scored = code == EXIT_CODE_OK && !result->mismatches[frame] && !(frame > 0 && result->mismatches[frame - 1]); /* flicker is of both frames */
    for (int k = 0; k < COMPARE_KINDS && code == EXIT_CODE_OK; k++) {
        if (lacks(result, k))
            continue;
        const float_image trio[] = {images[k], truth->halves[0][k], truth->halves[1][k]};
        const truth_frame against = {.images = trio, .count = 3};
        clip_frame scores;
        file_error error;
        if (state->metrics[method][k]) {
            if (clip_metrics_add(state->metrics[method][k], &images[k], &truth->reference[k], NULL, &scores, &error) != FILE_OK)
                code = compare_file_failure(job, &error);
            else if (scored)
                result->frames[k][frame] = scores.scores;
        }
        if (code == EXIT_CODE_OK && job->request->halved && measures_truth(&state->truth[method][k], k) &&
            truth_metrics_add(&state->truth[method][k], &against, &error) != FILE_OK)
            code = compare_file_failure(job, &error);
    }
    free_frames(images);
    return code;
}

static bool is_black(const float_image *image)
{
    const size_t values = image->pixels ? (size_t)image->width * image->height * image->channels : 0;
    size_t i = 0;
    while (i < values && image->pixels[i] == 0)
        i++;
    return i == values;
}

static int read_truth(compare_job *job, compare_scene *scene, size_t frame, measuring *state, truth_pictures *truth)
{
    int code = read_frame(job, scene, COMPARE_REFERENCE, frame, truth->reference);
    for (int k = 0; k < COMPARE_KINDS && code == EXIT_CODE_OK; k++)
        scene->black[k] = (frame == 0 || scene->black[k]) && is_black(&truth->reference[k]);
    for (size_t half = 0; half < 2 && job->request->halved && code == EXIT_CODE_OK; half++)
        code = read_frame(job, scene, COMPARE_HALF + half, frame, truth->halves[half]);
    for (int k = 0; k < COMPARE_KINDS && code == EXIT_CODE_OK; k++) {
        file_error error;
        if (state->noise[k] && clip_metrics_add(state->noise[k], &truth->halves[0][k], &truth->reference[k], NULL, NULL, &error) != FILE_OK)
            code = compare_file_failure(job, &error);
    }
    return code;
}

static int add_frame(compare_job *job, compare_scene *scene, measuring *state, size_t frame)
{
    truth_pictures truth = {.reference = {{0}}};
    int code = read_truth(job, scene, frame, state, &truth);
    for (size_t m = 0; m < job->request->method_count && code == EXIT_CODE_OK; m++) {
        code = *interrupt_flag() ? compare_stopped(job) : add_method_frame(job, scene, state, m, frame, &truth);
        job->progress.frames_done++;
        progress_update(&job->progress, 0);
    }
    free_frames(truth.reference);
    free_frames(truth.halves[0]);
    free_frames(truth.halves[1]);
    return code;
}

static void take_texture(compare_job *job, compare_result *result, const truth_metrics *truth)
{
    const char *missing = truth_metrics_texture_missing(truth);
    result->texture = truth_texture_json(truth);
    if (missing) {
        for (int i = TRUTH_CORRELATION; i <= TRUTH_MEAN_GREATEST; i++)
            snprintf(job->missing[KIND_LIGHT][i], sizeof job->missing[KIND_LIGHT][i], "%s", missing);
        return;
    }
    const texture_summary both[] = {texture_summarize(truth->bands), texture_summarize_noise(truth->bands)};
    for (int i = 0; i < 2; i++) {
        const texture_summary *s = &both[i];
        const double values[] = {s->correlation_mean, s->correlation_least, s->contrast_least, s->contrast_greatest, s->mean_least, s->mean_greatest};
        memcpy(i ? result->truth_noise : result->truth, values, sizeof values);
    }
}

static void take_specks(compare_result *result, const truth_metrics *truth)
{
    const speck_figures figures = truth_metrics_specks(truth);
    result->specks = truth_specks_json(truth);
    result->truth[TRUTH_SPECKS - CLIP_METRICS] = figures.excess_share;
    result->truth_noise[TRUTH_SPECKS - CLIP_METRICS] = figures.reference_share;
}

static void take_truth(compare_job *job, compare_result *result, const truth_metrics truth[COMPARE_KINDS])
{
    if (!job->request->halved)
        return;
    if (!result->lacks_coverage && !result->unscored[KIND_COVERAGE])
        result->noiseless_rmse = noise_sums_rmse(&truth[KIND_COVERAGE].noise);
    if (result->lacks_color || result->unscored[KIND_LIGHT])
        return;
    if (job->request->truth.texture)
        take_texture(job, result, &truth[KIND_LIGHT]);
    if (job->request->truth.specks)
        take_specks(result, &truth[KIND_DISPLAYED]);
}

static void take_missing(compare_job *job, int kind, const clip_metrics *metrics)
{
    for (size_t c = 0; c < score_column_count; c++) {
        const score_column *column = &score_columns[c];
        const bool asked = (int)column->kind == kind && column->metric < CLIP_METRICS && score_wanted(job->request, column);
        const char *why = asked ? clip_metrics_missing(metrics, (clip_metric)column->metric) : NULL;
        if (why)
            snprintf(job->missing[kind][column->metric], sizeof job->missing[kind][column->metric], "%s", why);
    }
}

/* Notes why a method has no scores of a kind, which explains the dashes in its row. */
static void note_lack(compare_job *job, int kind, const char *name, bool absent)
{
    const char *layer = kind == KIND_COVERAGE ? "coverage" : "color";
    for (int i = 0; i < COMPARE_METRICS; i++)
        snprintf(job->missing[kind][i], sizeof job->missing[kind][i], absent ? "%s has no %s" : "%s has values of %s that are infinite or not a number", name,
                 layer);
}

static int take_scores(compare_job *job, compare_scene *scene, const measuring *state)
{
    file_error error;
    for (int k = 0; k < COMPARE_KINDS; k++) {
        for (size_t m = 0; m < job->request->method_count; m++) {
            const bool lacking = lacks(&scene->results[m], k), unscored = lacking || scene->results[m].unscored[k];
            if (unscored)
                note_lack(job, k, job->request->methods[m].name, lacking);
            if (!state->metrics[m][k] || unscored)
                continue;
            if (clip_metrics_scores(state->metrics[m][k], &scene->results[m].clip[k], &error) != FILE_OK)
                return compare_file_failure(job, &error);
            take_missing(job, k, state->metrics[m][k]);
        }
        if (state->noise[k] && clip_metrics_noise(state->noise[k], &scene->noise[k], &error) != FILE_OK)
            return compare_file_failure(job, &error);
    }
    for (size_t m = 0; m < job->request->method_count; m++)
        take_truth(job, &scene->results[m], state->truth[m]);
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
    for (int k = 0; k < COMPARE_KINDS; k++) {
        scene->noise[k] = no_scores();
        for (size_t m = 0; m < job->request->method_count; m++) {
            compare_result *result = &scene->results[m];
            result->frames[k] = calloc(job->frame_count, sizeof *result->frames[k]);
            if (!result->frames[k])
                return console_error(EXIT_CODE_FAILED, "out of memory");
            result->clip[k] = no_scores();
            for (size_t f = 0; f < job->frame_count; f++)
                result->frames[k][f] = no_scores();
        }
    }
    for (size_t m = 0; m < job->request->method_count; m++) {
        compare_result *result = &scene->results[m];
        result->mismatches = calloc(job->frame_count, sizeof *result->mismatches);
        if (!result->mismatches)
            return console_error(EXIT_CODE_FAILED, "out of memory");
        result->noiseless_rmse = NAN;
        for (int i = 0; i < TRUTH_SCORES; i++)
            result->truth[i] = result->truth_noise[i] = NAN;
    }
    return EXIT_CODE_OK;
}

static void finish_scene(measuring *state, size_t methods)
{
    for (int k = 0; k < COMPARE_KINDS; k++) {
        for (size_t m = 0; m < methods; m++) {
            clip_metrics_free(state->metrics[m][k]);
            truth_metrics_free(&state->truth[m][k]);
        }
        clip_metrics_free(state->noise[k]);
    }
    *state = (measuring){.noise = {NULL}};
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
        finish_scene(state, job->request->method_count);
    }
    progress_clear(&job->progress);
    free(state);
    return code;
}
