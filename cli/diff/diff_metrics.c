/* SPDX-License-Identifier: MIT */
/* Adds the frames of `mangata diff` to the metrics of clips, and prints the scores. */
#include "cli/diff/diff_metrics.h"

#include <math.h>
#include <stdio.h>

#include "image/metrics_noise.h"

/* The key of a metric in JSON, such as "hdr_flip" for "hdr-flip" of the command line. */
static const char *json_key(clip_metric metric)
{
    static const char *const keys[CLIP_METRICS] = {
        [CLIP_RMSE] = "rmse",
        [CLIP_RELATIVE_RMSE] = "relative_rmse",
        [CLIP_ENERGY] = "energy",
        [CLIP_FLIP] = "flip",
        [CLIP_HDR_FLIP] = "hdr_flip",
        [CLIP_SSIM] = "ssim",
        [CLIP_YEE] = "yee",
        [CLIP_FLICKER] = "flicker",
        [CLIP_FLICKER_POWER] = "flicker_power",
        [CLIP_FLICKER_RATIO] = "flicker_ratio",
        [CLIP_FLICKER_BRIGHT] = "flicker_bright",
        [CLIP_FLICKER_GLINTS] = "flicker_glints",
        [CLIP_FLICKER_SIZES] = "flicker_sizes",
    };
    return keys[metric];
}

static bool is_wanted(const diff_metrics *m, int metric) { return m->wanted.metrics >> metric & 1; }

/* Scores as JSON. NaN and infinities, which JSON does not have, become null. */
static json_t *scores_to_json(const diff_metrics *m, const clip_scores *scores)
{
    json_t *object = json_object();
    for (int i = 0; i < CLIP_METRICS; i++)
        if (is_wanted(m, i))
            json_object_set_new(object, json_key((clip_metric)i), isfinite(scores->values[i]) ? json_real(scores->values[i]) : json_null());
    return object;
}

static int failure(const file_error *error)
{
    return error->status == FILE_ARGUMENT ? console_error(EXIT_CODE_FAILED, "%s", error->text) : console_file_error(error);
}

static int add_noise(diff_metrics *m, const float_image *b, const float_image *b2, uint64_t left_out)
{
    float_image mean;
    file_error error;
    if (!m->noise && clip_metrics_create(&m->noise, &m->wanted, &error) != FILE_OK)
        return console_file_error(&error);
    if (noise_mean(&mean, b, b2, &error) != FILE_OK)
        return failure(&error);
    clip_metrics_leave_out(m->noise, left_out);
    const file_status status = clip_metrics_add(m->noise, b, &mean, NULL, NULL, &error);
    float_image_free(&mean);
    return status == FILE_OK ? EXIT_CODE_OK : failure(&error);
}

int diff_metrics_add(diff_metrics *m, uint32_t number, const diff_frame *frame, diff_maps *maps)
{
    const float_image *a = &frame->images[0], *b = &frame->images[1];
    clip_frame result;
    file_error error;
    if (!m->wanted.metrics)
        return EXIT_CODE_OK;
    if (!m->clip) {
        m->wanted.width = a->width;
        m->wanted.height = a->height;
        m->wanted.channels = a->channels;
        if (clip_metrics_create(&m->clip, &m->wanted, &error) != FILE_OK)
            return console_file_error(&error);
        m->per_frame = json_array();
    }
    int code = diff_maps_prepare(maps, (size_t)a->width * a->height);
    if (code != EXIT_CODE_OK)
        return code;
    clip_metrics_leave_out(m->clip, frame->left_out);
    if (clip_metrics_add(m->clip, a, b, &maps->pixels, &result, &error) != FILE_OK)
        return failure(&error);
    code = diff_maps_write(maps, number, a->width, a->height, &result.scores);
    if (code != EXIT_CODE_OK)
        return code;
    json_t *object = scores_to_json(m, &result.scores);
    json_object_set_new(object, "frame", json_integer(number));
    if (json_array_append_new(m->per_frame, object) != 0)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    return frame->count == 3 ? add_noise(m, b, &frame->images[2], frame->left_out) : EXIT_CODE_OK;
}

static int get_scores(const diff_metrics *m, clip_scores *scores)
{
    file_error error;
    return clip_metrics_scores(m->clip, scores, &error) == FILE_OK ? EXIT_CODE_OK : console_file_error(&error);
}

/* The noise floors, all NaN without a second reference. */
static int get_floors(const diff_metrics *m, clip_scores *floors)
{
    file_error error;
    for (int i = 0; i < CLIP_METRICS; i++)
        floors->values[i] = NAN;
    return !m->noise || clip_metrics_noise(m->noise, floors, &error) == FILE_OK ? EXIT_CODE_OK : console_file_error(&error);
}

double diff_metrics_floor(const diff_metrics *m, clip_metric metric)
{
    clip_scores floors;
    file_error error;
    const bool known = m->noise && is_wanted(m, metric) && clip_metrics_noise(m->noise, &floors, &error) == FILE_OK;
    return known ? floors.values[metric] : NAN;
}

int diff_metrics_report(diff_metrics *m, json_t *report)
{
    clip_scores scores, floors;
    if (!m->clip)
        return EXIT_CODE_OK;
    int code = get_scores(m, &scores);
    if (code == EXIT_CODE_OK)
        code = get_floors(m, &floors);
    if (code != EXIT_CODE_OK)
        return code;
    json_t *reasons = json_object();
    for (int i = 0; i < CLIP_METRICS; i++) {
        const char *missing = clip_metrics_missing(m->clip, (clip_metric)i);
        if (missing)
            json_object_set_new(reasons, json_key((clip_metric)i), console_json_text(missing));
    }
    json_object_set_new(report, "metrics", scores_to_json(m, &scores));
    if (m->noise)
        json_object_set_new(report, "noise_floors", scores_to_json(m, &floors));
    json_object_set_new(report, "unavailable", reasons);
    json_object_set_new(report, "per_frame", m->per_frame);
    if (clip_metrics_glint_threshold(m->clip) > 0)
        json_object_set_new(report, "glint_threshold", json_real(clip_metrics_glint_threshold(m->clip)));
    m->per_frame = NULL;
    return EXIT_CODE_OK;
}

int diff_metrics_print(const diff_metrics *m)
{
    clip_scores scores, floors;
    if (!m->clip)
        return EXIT_CODE_OK;
    int code = get_scores(m, &scores);
    if (code == EXIT_CODE_OK)
        code = get_floors(m, &floors);
    for (int i = CLIP_FLIP; i < CLIP_METRICS && code == EXIT_CODE_OK; i++) {
        const char *missing = clip_metrics_missing(m->clip, (clip_metric)i);
        if (missing) {
            printf("%-15sunavailable: %s\n", clip_metric_name((clip_metric)i), missing);
        } else if (is_wanted(m, i)) {
            printf("%-15s%.6g", clip_metric_name((clip_metric)i), scores.values[i]);
            if (isfinite(floors.values[i]))
                printf("; noise floor %.6g", floors.values[i]);
            putchar('\n');
        }
    }
    return code;
}

void diff_metrics_free(diff_metrics *m)
{
    clip_metrics_free(m->clip);
    clip_metrics_free(m->noise);
    json_decref(m->per_frame);
    *m = (diff_metrics){.clip = NULL};
}
