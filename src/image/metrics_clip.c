/* SPDX-License-Identifier: MIT */
/* One frame after another: makes what each metric asks for of the values given, and gathers the scores. */
#include "image/metrics_clip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/metrics_color.h"
#include "image/metrics_flicker.h"
#include "image/metrics_flip.h"
#include "image/metrics_ssim.h"
#include "image/metrics_yee.h"
#include "image/picture_formats.h"

enum {
    NEED_GLINTS = 1u << CLIP_FLICKER_BRIGHT | 1u << CLIP_FLICKER_GLINTS | 1u << CLIP_FLICKER_SIZES,
    NEED_FLIP = 1u << CLIP_FLIP | 1u << CLIP_HDR_FLIP,
    NEED_LUMINANCE = NEED_GLINTS | 1u << CLIP_SSIM,
    NEED_LIGHT = NEED_LUMINANCE | NEED_FLIP | 1u << CLIP_YEE
};

#define RELATIVE_FLOOR 0.01

struct clip_metrics {
    clip_metrics_desc desc;
    size_t pixels;
    image_metrics sums;
    uint64_t left_out;           /* pixels of each frame that do not count */
    bool incomparable;           /* values of the last frame were not comparable */
    double totals[CLIP_METRICS]; /* sums over frames of what is a mean over frames */
    flip *flip;
    flicker *flicker;
    float *values[2];    /* as given, finite */
    float *light[2];     /* linear; the same memory as values where those are linear */
    float *luminance[2]; /* of light */
    float *encoded[2];   /* luminance as SSIM sees it: sRGB-encoded, 0 … 1 */
    float *ssim_buffers;
    float *screen[2]; /* 3 channels, linear, 0 … 1, for Yee's test */
    file_error yee_error;
};

/* ---- names ---- */

static const char *const names[CLIP_METRICS] = {
    [CLIP_RMSE] = "rmse",
    [CLIP_RELATIVE_RMSE] = "relrmse",
    [CLIP_ENERGY] = "energy",
    [CLIP_FLIP] = "flip",
    [CLIP_HDR_FLIP] = "hdr-flip",
    [CLIP_SSIM] = "ssim",
    [CLIP_YEE] = "yee",
    [CLIP_FLICKER] = "flicker",
    [CLIP_FLICKER_POWER] = "flicker-power",
    [CLIP_FLICKER_RATIO] = "flicker-ratio",
    [CLIP_FLICKER_BRIGHT] = "flicker-bright",
    [CLIP_FLICKER_GLINTS] = "flicker-glints",
    [CLIP_FLICKER_SIZES] = "flicker-sizes",
};

const char clip_metric_words[] = "rmse, relrmse, energy, flip, hdr-flip, ssim, yee, flicker (all of its kinds), flicker-power, flicker-ratio, "
                                 "flicker-bright, flicker-glints, flicker-sizes";

const clip_metric clip_mapped[CLIP_MAPPED] = {CLIP_RMSE, CLIP_RELATIVE_RMSE, CLIP_FLIP, CLIP_HDR_FLIP, CLIP_SSIM, CLIP_FLICKER};

const char *clip_metric_name(clip_metric metric) { return names[metric]; }

static uint32_t metrics_of_word(const char *word, size_t length)
{
    for (int m = 0; m < CLIP_METRICS; m++)
        if (strlen(names[m]) == length && memcmp(names[m], word, length) == 0)
            return m == CLIP_FLICKER ? CLIP_ALL_FLICKER : 1u << m;
    return 0;
}

bool clip_metrics_parse(const char *list, uint32_t *metrics)
{
    uint32_t set = 0;
    for (;;) {
        const size_t length = strcspn(list, ",");
        const uint32_t word = metrics_of_word(list, length);
        if (!word)
            return false;
        set |= word;
        if (!list[length])
            break;
        list += length + 1;
    }
    *metrics = set;
    return true;
}

/* ---- making and freeing ---- */

static file_status check_desc(const clip_metrics_desc *d, file_error *error)
{
    if (d->width < 1 || d->height < 1 || d->width > PICTURE_SIDE_MAX || d->height > PICTURE_SIDE_MAX)
        return file_error_set(error, FILE_ARGUMENT, "a clip of %u x %u pixels; allowed: sides of 1 to %d", d->width, d->height, PICTURE_SIDE_MAX);
    if (d->channels != 1 && d->channels != 3)
        return file_error_set(error, FILE_ARGUMENT, "a clip of %u channels; allowed: 1 or 3", d->channels);
    if (d->metrics & ~(uint32_t)CLIP_ALL_METRICS)
        return file_error_set(error, FILE_ARGUMENT, "unknown metrics %#x", d->metrics & ~(uint32_t)CLIP_ALL_METRICS);
    if (!(d->pixels_per_degree == 0 || (d->pixels_per_degree >= 4 && d->pixels_per_degree <= 400)))
        return file_error_set(error, FILE_ARGUMENT, "%g pixels per degree; allowed: 4 to 400", d->pixels_per_degree);
    if (!(d->glint_threshold >= 0 && isfinite(d->glint_threshold)))
        return file_error_set(error, FILE_ARGUMENT, "a glint threshold of %g; allowed: a number from 0", d->glint_threshold);
    if (d->exposures > FLIP_EXPOSURES_MAX)
        return file_error_set(error, FILE_ARGUMENT, "%u exposures; allowed: 1 to %d", d->exposures, FLIP_EXPOSURES_MAX);
    if (d->fixed_exposures && !(fabs(d->first_exposure) <= 100 && fabs(d->last_exposure) <= 100 && d->first_exposure <= d->last_exposure))
        return file_error_set(error, FILE_ARGUMENT, "exposures from %g to %g stops; allowed: -100 to 100, rising", d->first_exposure, d->last_exposure);
    return FILE_OK;
}

/* `count` floats for each of A and B; false when memory ran out. */
static bool make_pair(float *pair[2], size_t count)
{
    pair[0] = malloc(count * sizeof(float));
    pair[1] = malloc(count * sizeof(float));
    return pair[0] && pair[1];
}

static bool make_buffers(clip_metrics *m)
{
    const uint32_t set = m->desc.metrics;
    const size_t values = m->pixels * m->desc.channels;
    bool made = true;
    if (set & (NEED_LIGHT | CLIP_ALL_FLICKER))
        made = made && make_pair(m->values, values);
    if (set & NEED_LIGHT && m->desc.srgb_encoded)
        made = made && make_pair(m->light, values);
    if (set & NEED_LUMINANCE)
        made = made && make_pair(m->luminance, m->pixels);
    if (set & 1u << CLIP_SSIM) {
        made = made && make_pair(m->encoded, m->pixels);
        m->ssim_buffers = malloc(m->pixels * SSIM_BUFFERS * sizeof(float));
        made = made && m->ssim_buffers;
    }
    if (set & 1u << CLIP_YEE)
        made = made && make_pair(m->screen, m->pixels * 3);
    return made;
}

file_status clip_metrics_create(clip_metrics **result, const clip_metrics_desc *desc, file_error *error)
{
    *result = NULL;
    file_status status = check_desc(desc, error);
    if (status != FILE_OK)
        return status;
    clip_metrics *m = calloc(1, sizeof *m);
    if (!m)
        return file_error_set(error, FILE_MEMORY, "out of memory for metrics");
    m->desc = *desc;
    m->pixels = (size_t)desc->width * desc->height;
    if (m->desc.pixels_per_degree == 0)
        m->desc.pixels_per_degree = FLIP_PIXELS_PER_DEGREE;
    if (desc->metrics & NEED_FLIP && (status = flip_create(&m->flip, desc->width, desc->height, m->desc.pixels_per_degree, error)) != FILE_OK)
        goto fail;
    if (desc->metrics & CLIP_ALL_FLICKER && (status = flicker_create(&m->flicker, desc->width, desc->height, desc->channels, error)) != FILE_OK)
        goto fail;
    if (!make_buffers(m)) {
        status = file_error_set(error, FILE_MEMORY, "out of memory for metrics of %u x %u pixels", desc->width, desc->height);
        goto fail;
    }
    *result = m;
    return FILE_OK;
fail:
    clip_metrics_free(m);
    return status;
}

void clip_metrics_free(clip_metrics *m)
{
    if (!m)
        return;
    for (int i = 0; i < 2; i++) {
        free(m->values[i]);
        free(m->light[i]);
        free(m->luminance[i]);
        free(m->encoded[i]);
        free(m->screen[i]);
    }
    free(m->ssim_buffers);
    flip_free(m->flip);
    flicker_free(m->flicker);
    free(m);
}

/* ---- a frame ---- */

static bool measures(const clip_metrics *m, clip_metric metric) { return m->desc.metrics >> metric & 1; }

static const float *light_of(const clip_metrics *m, int side) { return m->light[side] ? m->light[side] : m->values[side]; }

/* Everything that is looked at but the sums, for A (0) or B (1). */
static void prepare_side(clip_metrics *m, const float_image *image, int side)
{
    const uint32_t channels = m->desc.channels;
    if (!m->values[side])
        return;
    for (size_t v = 0; v < m->pixels * channels; v++)
        m->values[side][v] = isfinite(image->pixels[v]) ? image->pixels[v] : 0.0f;
    if (m->light[side])
        for (size_t v = 0; v < m->pixels * channels; v++)
            m->light[side][v] = color_srgb_decode(m->values[side][v]);
    const float *light = light_of(m, side);
    for (size_t i = 0; i < m->pixels; i++, light += channels) {
        if (m->luminance[side])
            m->luminance[side][i] = color_luminance(light, channels);
        if (m->encoded[side])
            m->encoded[side][i] = color_srgb_encode(color_clamp(m->luminance[side][i]));
        if (m->screen[side])
            for (uint32_t c = 0; c < 3; c++)
                m->screen[side][3 * i + c] = color_clamp(light[channels == 1 ? 0 : c]);
    }
}

static void score_sums(const clip_metrics *m, const image_metrics *sums, clip_scores *scores)
{
    if (measures(m, CLIP_RMSE))
        scores->values[CLIP_RMSE] = image_metrics_rmse(sums);
    if (measures(m, CLIP_RELATIVE_RMSE))
        scores->values[CLIP_RELATIVE_RMSE] = image_metrics_relative_rmse(sums);
    if (measures(m, CLIP_ENERGY))
        scores->values[CLIP_ENERGY] = image_metrics_mean_ratio(sums);
}

static void error_map(const clip_metrics *m, const float_image *a, const float_image *b, float *map)
{
    const uint32_t channels = m->desc.channels;
    for (size_t i = 0; i < m->pixels; i++) {
        double sum = 0;
        for (size_t v = i * channels; v < (i + 1) * channels; v++) {
            const double difference = isfinite(a->pixels[v]) && isfinite(b->pixels[v]) ? (double)a->pixels[v] - (double)b->pixels[v] : 0;
            sum += difference * difference / channels;
        }
        map[i] = (float)sqrt(sum);
    }
}

/* `map` holds the errors; the floor keeps dark pixels from counting without bound. */
static void to_relative(const clip_metrics *m, const image_metrics *sums, const float_image *b, float *map)
{
    const uint32_t channels = m->desc.channels;
    const double mean = sums->values ? sums->sum_b_squared / (double)sums->values : 0;
    for (size_t i = 0; i < m->pixels && mean > 0; i++) {
        double own = 0;
        for (size_t v = i * channels; v < (i + 1) * channels; v++)
            own += isfinite(b->pixels[v]) ? (double)b->pixels[v] * b->pixels[v] / channels : 0;
        map[i] = (float)(map[i] / sqrt(own + RELATIVE_FLOOR * RELATIVE_FLOOR * mean));
    }
}

static double hdr_flip(clip_metrics *m, flip_picture a, flip_picture b, float *map)
{
    const clip_metrics_desc *d = &m->desc;
    flip_exposures exposures = {d->first_exposure, d->last_exposure, 0};
    if (!d->fixed_exposures)
        exposures = flip_exposures_of(m->flip, b);
    else
        exposures.count = (uint32_t)fmin(fmax(ceil(exposures.last - exposures.first), 2), FLIP_EXPOSURES_MAX);
    if (d->exposures)
        exposures.count = d->exposures;
    return flip_hdr(m->flip, a, b, &exposures, map);
}

static void score_ssim(clip_metrics *m, float *map, clip_scores *scores)
{
    scores->values[CLIP_SSIM] = ssim_mean(m->encoded[0], m->encoded[1], m->desc.width, m->desc.height, map, m->ssim_buffers);
    for (size_t i = 0; map && i < m->pixels; i++)
        map[i] = 1.0f - map[i];
}

/* Once it has failed it is not tried again. */
static void score_yee(clip_metrics *m, clip_scores *scores)
{
    double share = 0;
    if (m->yee_error.status == FILE_OK &&
        yee_failures(&share, m->screen[0], m->screen[1], m->desc.width, m->desc.height, m->desc.idiff, &m->yee_error) == FILE_OK)
        scores->values[CLIP_YEE] = share;
}

static void score_step(const clip_metrics *m, const flicker_step *step, clip_frame *frame)
{
    const double values[] = {step->error, step->power, step->ratio, fabs((double)step->bright[0] - step->bright[1]) / fmax(step->bright[1], 1),
                             fabs((double)step->glints[0] - step->glints[1]) / fmax(step->glints[1], 1)};
    for (int i = 0; i < 5; i++)
        if (measures(m, (clip_metric)(CLIP_FLICKER + i)))
            frame->scores.values[CLIP_FLICKER + i] = values[i];
    memcpy(frame->bright, step->bright, sizeof frame->bright);
    memcpy(frame->glints, step->glints, sizeof frame->glints);
}

static clip_scores no_scores(void)
{
    clip_scores scores;
    for (int i = 0; i < CLIP_METRICS; i++)
        scores.values[i] = NAN;
    return scores;
}

static int descending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x < y) - (x > y);
}

/* Half of the luminance that a thousandth of the pixels exceed: a few outliers, or the light itself in view, do not set it. */
static file_status choose_threshold(clip_metrics *m, file_error *error)
{
    float *sorted = malloc(m->pixels * sizeof *sorted);
    if (!sorted)
        return file_error_set(error, FILE_MEMORY, "out of memory for metrics");
    memcpy(sorted, m->luminance[1], m->pixels * sizeof *sorted);
    qsort(sorted, m->pixels, sizeof *sorted, descending);
    const float exceeded = sorted[m->pixels / 1000];
    m->desc.glint_threshold = exceeded > 0 ? 0.5 * exceeded : 0.5;
    free(sorted);
    return FILE_OK;
}

static file_status add_flicker(clip_metrics *m, float *map, clip_frame *frame, file_error *error)
{
    const bool glints = m->desc.metrics & NEED_GLINTS;
    file_status status = FILE_OK;
    if (glints && m->desc.glint_threshold == 0 && (status = choose_threshold(m, error)) != FILE_OK)
        return status;
    const flicker_input input = {{m->values[0], m->values[1]},
                                 {glints ? m->luminance[0] : NULL, glints ? m->luminance[1] : NULL},
                                 (float)m->desc.glint_threshold};
    flicker_step step;
    status = flicker_add(m->flicker, &input, map, &step, error);
    if (status == FILE_OK)
        score_step(m, &step, frame);
    return status;
}

/* Takes back what was made of values that are not comparable. A flicker score is of a frame and the one before. */
static void withhold(clip_metrics *m, const image_metrics *sums, const float_image *a, const float_image *b, float *const *map, clip_scores *scores)
{
    const bool before = m->incomparable;
    m->incomparable = sums->mismatches > 0;
    for (int i = CLIP_FLIP; i < CLIP_METRICS; i++)
        if (m->incomparable || (before && i >= CLIP_FLICKER))
            scores->values[i] = NAN;
    for (size_t v = 0; m->incomparable && v < m->pixels * m->desc.channels; v++)
        for (int i = 0; i < CLIP_MAPPED && !image_values_comparable(a->pixels[v], b->pixels[v]); i++)
            if (measures(m, clip_mapped[i]) && map[clip_mapped[i]])
                map[clip_mapped[i]][v / m->desc.channels] = NAN;
}

static file_status check_frame(const clip_metrics *m, const float_image *image, file_error *error)
{
    if (image->width == m->desc.width && image->height == m->desc.height && image->channels == m->desc.channels)
        return FILE_OK;
    return file_error_set(error, FILE_ARGUMENT, "a frame of %u x %u pixels and %u channels in a clip of %u x %u and %u", image->width, image->height,
                          image->channels, m->desc.width, m->desc.height, m->desc.channels);
}

file_status clip_metrics_add(clip_metrics *m, const float_image *a, const float_image *b, const clip_maps *maps, clip_frame *frame, file_error *error)
{
    const clip_maps no_maps = {{NULL}};
    clip_frame result = {.scores = no_scores()};
    file_status status = check_frame(m, a, error);
    if (status == FILE_OK)
        status = check_frame(m, b, error);
    if (status != FILE_OK)
        return status;
    float *const *const map = maps ? maps->maps : no_maps.maps;
    prepare_side(m, a, 0);
    prepare_side(m, b, 1);
    /* The only part that can fail comes first, so that a frame is added whole or not at all. */
    if (m->flicker && (status = add_flicker(m, measures(m, CLIP_FLICKER) ? map[CLIP_FLICKER] : NULL, &result, error)) != FILE_OK)
        return status;
    image_metrics sums = {0};
    image_metrics_add(&sums, a, b, error);
    image_metrics_add(&m->sums, a, b, error);
    sums.values -= m->left_out * m->desc.channels;
    m->sums.values -= m->left_out * m->desc.channels;
    score_sums(m, &sums, &result.scores);
    if (measures(m, CLIP_RMSE) && map[CLIP_RMSE])
        error_map(m, a, b, map[CLIP_RMSE]);
    if (measures(m, CLIP_RELATIVE_RMSE) && map[CLIP_RELATIVE_RMSE]) {
        error_map(m, a, b, map[CLIP_RELATIVE_RMSE]);
        to_relative(m, &sums, b, map[CLIP_RELATIVE_RMSE]);
    }
    const flip_picture light[2] = {{light_of(m, 0), m->desc.channels}, {light_of(m, 1), m->desc.channels}};
    if (measures(m, CLIP_FLIP))
        result.scores.values[CLIP_FLIP] = flip_ldr(m->flip, light[0], light[1], map[CLIP_FLIP]);
    if (measures(m, CLIP_HDR_FLIP))
        result.scores.values[CLIP_HDR_FLIP] = hdr_flip(m, light[0], light[1], map[CLIP_HDR_FLIP]);
    if (measures(m, CLIP_SSIM))
        score_ssim(m, map[CLIP_SSIM], &result.scores);
    if (measures(m, CLIP_YEE))
        score_yee(m, &result.scores);
    withhold(m, &sums, a, b, map, &result.scores);
    for (int i = CLIP_FLIP; i <= CLIP_YEE; i++)
        m->totals[i] += result.scores.values[i];
    if (frame)
        *frame = result;
    return FILE_OK;
}

/* ---- the clip ---- */

void clip_metrics_leave_out(clip_metrics *m, uint64_t pixels) { m->left_out = pixels; }

file_status clip_metrics_scores(const clip_metrics *m, clip_scores *scores, file_error *error)
{
    *scores = no_scores();
    if (m->sums.frames == 0)
        return FILE_OK;
    score_sums(m, &m->sums, scores);
    for (int i = CLIP_FLIP; i <= CLIP_YEE; i++)
        if (measures(m, (clip_metric)i))
            scores->values[i] = m->totals[i] / (double)m->sums.frames;
    if (!m->flicker)
        return FILE_OK;
    flicker_scores flickers;
    const file_status status = flicker_measure(m->flicker, &flickers, error);
    const double values[] = {flickers.error, flickers.power, flickers.ratio, flickers.bright, flickers.glints, flickers.sizes};
    for (int i = CLIP_FLICKER; i < CLIP_METRICS; i++)
        if (measures(m, (clip_metric)i) && m->sums.mismatches == 0)
            scores->values[i] = values[i - CLIP_FLICKER];
    return status;
}

double clip_metric_best(clip_metric metric) { return metric == CLIP_ENERGY || metric == CLIP_SSIM || metric == CLIP_FLICKER_RATIO ? 1 : 0; }

file_status clip_metrics_noise(const clip_metrics *m, clip_scores *floors, file_error *error)
{
    const file_status status = clip_metrics_scores(m, floors, error);
    for (int i = 0; i < CLIP_METRICS; i++)
        floors->values[i] = fabs(floors->values[i] - clip_metric_best((clip_metric)i));
    if (measures(m, CLIP_ENERGY))
        floors->values[CLIP_ENERGY] = m->sums.sum_b != 0 ? sqrt(m->sums.sum_difference_squared) / fabs(m->sums.sum_b) : NAN;
    return status;
}

const char *clip_metrics_missing(const clip_metrics *m, clip_metric metric)
{
    clip_scores scores;
    if (!measures(m, metric) || clip_metrics_scores(m, &scores, NULL) != FILE_OK || !isnan(scores.values[metric]))
        return NULL;
    if (m->sums.frames == 0)
        return "no frame was measured";
    if (m->sums.mismatches > 0)
        return image_mismatch_text;
    if (metric == CLIP_YEE)
        return m->yee_error.text;
    return metric < CLIP_FLICKER_BRIGHT ? "flicker needs two frames" : "no pixel is above the glint threshold";
}

const image_metrics *clip_metrics_sums(const clip_metrics *m) { return &m->sums; }

double clip_metrics_glint_threshold(const clip_metrics *m) { return m->desc.glint_threshold; }
