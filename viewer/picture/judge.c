/* SPDX-License-Identifier: MIT
 * The thread that compares two sides with brute force. */
#define _GNU_SOURCE
#include "viewer/picture/judge.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "image/metrics_color.h"
#include "image/metrics_flip.h"
#include "image/metrics_noise.h"
#include "params/methods.h"
#include "params/options.h"
#include "scene/scene_models.h"
#include "viewer/picture/strata.h"

/* A sample of a half is one of STRATA strata. TOTAL is the number of samples of both halves together. */
enum { ERROR_SIZE = 512, SPATIAL = 2, TIME_SAMPLES = 4, STRATA = SPATIAL * SPATIAL * TIME_SAMPLES, HALVES = 2, TOTAL = 1024, LOW_PRIORITY = 10 };

/* A reference in two independent halves: for each half the sum of linear light over its samples, and its displayed values in [0, 1]. */
typedef struct reference_sums {
    double *sums[HALVES];
    float *displayed[HALVES];
} reference_sums;

struct judge {
    pthread_t thread;
    bool started;
    mgt_context_desc desc;
    void (*wake)(void);

    pthread_mutex_t lock; /* protects the members up to `error` */
    pthread_cond_t posted;
    bool quit, has_order;
    judge_order order;
    mgt_wave waves[MGT_MAX_WAVES];
    judgement found;
    bool has_found;
    char error[ERROR_SIZE];

    atomic_bool stop; /* the work on the current order shall end */

    /* members that only the thread uses */
    mgt_context *context;
    judge_order current;
    mgt_wave current_waves[MGT_MAX_WAVES];
    size_t values;                          /* number of values of a picture, 3 per pixel */
    float *sides[SIDE_COUNT][JUDGE_FRAMES]; /* displayed values in [0, 1] */
    reference_sums references[JUDGE_FRAMES];
    float *light, *steps[1 + HALVES]; /* scratch: linear light; steps of a side and of both halves */
    uint8_t *bytes;                   /* scratch: a displayed picture */
};

/* ---- memory ---- */

static void free_pictures(judge *j)
{
    for (int f = 0; f < JUDGE_FRAMES; f++) {
        for (int s = 0; s < SIDE_COUNT; s++) {
            free(j->sides[s][f]);
            j->sides[s][f] = NULL;
        }
        for (int h = 0; h < HALVES; h++) {
            free(j->references[f].sums[h]);
            free(j->references[f].displayed[h]);
        }
        j->references[f] = (reference_sums){0};
    }
    for (int i = 0; i < 1 + HALVES; i++) {
        free(j->steps[i]);
        j->steps[i] = NULL;
    }
    free(j->light);
    free(j->bytes);
    j->light = NULL;
    j->bytes = NULL;
    j->values = 0;
}

static bool reserve(judge *j, size_t values)
{
    bool good = true;
    free_pictures(j);
    for (int f = 0; f < JUDGE_FRAMES; f++) {
        for (int s = 0; s < SIDE_COUNT; s++)
            good &= (j->sides[s][f] = malloc(values * sizeof(float))) != NULL;
        for (int h = 0; h < HALVES; h++) {
            good &= (j->references[f].sums[h] = calloc(values, sizeof(double))) != NULL;
            good &= (j->references[f].displayed[h] = malloc(values * sizeof(float))) != NULL;
        }
    }
    for (int i = 0; i < 1 + HALVES; i++)
        good &= (j->steps[i] = malloc(values * sizeof(float))) != NULL;
    good &= (j->light = malloc(values * sizeof(float))) != NULL;
    good &= (j->bytes = malloc(values / 3 * 4)) != NULL;
    if (!good)
        free_pictures(j);
    else
        j->values = values;
    return good;
}

/* ---- pictures ---- */

/* Keeps an error for judge_take(). Returns false. */
static bool fail(judge *j, const char *text)
{
    pthread_mutex_lock(&j->lock);
    snprintf(j->error, sizeof j->error, "%s", text);
    pthread_mutex_unlock(&j->lock);
    j->wake();
    return false;
}

static bool is_stopped(const judge *j) { return atomic_load(&j->stop); }

/* Whether rendering has succeeded. A failure is kept as an error; one that was stopped is not. */
static bool done(judge *j, mgt_status status) { return status == MGT_OK || (status != MGT_CANCELLED && fail(j, mgt_last_error(j->context))); }

static void take_bytes(const judge *j, float *displayed)
{
    for (size_t p = 0; p < j->values / 3; p++)
        for (int c = 0; c < 3; c++)
            displayed[3 * p + (size_t)c] = (float)j->bytes[4 * p + (size_t)c] / 255;
}

static bool render_side(judge *j, int side, int frame)
{
    mgt_scene scene = j->current.frames[frame];
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.pixels = j->bytes;
    scene.quality = j->current.quality[side];
    if (!done(j, mgt_render(j->context, &scene, &target, 1)))
        return false;
    take_bytes(j, j->sides[side][frame]);
    return true;
}

static mgt_quality reference_quality(void)
{
    mgt_quality q = quality_defaults();
    method_from_name("reference", &q);
    q.spatial_samples = SPATIAL;
    q.time_samples = TIME_SAMPLES;
    return q;
}

/* Adds a sample to a frame's reference, to the halves in turn. Each half takes all strata with a seed of its own before it takes the next seed. So the errors
 * of the halves are independent, which they would not be if each half took other strata. */
static bool add_sample(judge *j, int frame, uint32_t index)
{
    const uint32_t half = index % HALVES, place = index / HALVES;
    mgt_scene scene = j->current.frames[frame];
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.format = MGT_FORMAT_RGB32F;
    target.pixels = j->light;
    scene.quality = reference_quality();
    scene.quality.seed = 1 + half + HALVES * (place / STRATA);
    scene.quality.sample_first = stratum_at(place % STRATA + half * STRATA / 3, STRATA);
    scene.quality.sample_count = 1;
    if (!done(j, mgt_render(j->context, &scene, &target, 1)))
        return false;
    double *sums = j->references[frame].sums[half];
    for (size_t i = 0; i < j->values; i++)
        sums[i] += (double)j->light[i];
    return true;
}

/* Computes the displayed values of a half. `samples` is the number of samples of both halves. */
static bool display_half(judge *j, int frame, int half, uint32_t samples)
{
    const reference_sums *r = &j->references[frame];
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.pixels = j->bytes;
    for (size_t i = 0; i < j->values; i++)
        j->light[i] = (float)(r->sums[half][i] / (samples / HALVES));
    if (!done(j, mgt_display(j->context, &j->current.frames[frame], j->light, &target)))
        return false;
    take_bytes(j, r->displayed[half]);
    return true;
}

/* ---- figures ---- */

static float_image image_of(const judge *j, float *pixels)
{
    return (float_image){.width = j->current.frames[0].image.width, .height = j->current.frames[0].image.height, .channels = 3, .pixels = pixels};
}

/* Adds up the differences of picture `a` from a reference with the halves `b` and `b2`. */
static bool compare(const judge *j, float *a, float *b, float *b2, noise_sums *sums, file_error *error)
{
    const float_image images[3] = {image_of(j, a), image_of(j, b), image_of(j, b2)};
    *sums = (noise_sums){0};
    return noise_sums_add(sums, images, NULL, error) == FILE_OK;
}

/* Computes the step from a frame to the next one. */
static void step_of(float *out, const float *later, const float *first, size_t count)
{
    for (size_t i = 0; i < count; i++)
        out[i] = later[i] - first[i];
}

/* FLIP of a side's first frame against the mean of both halves. FLIP takes linear light, so both are decoded into scratch memory. */
static double flip_of(judge *j, flip *f, const float *side)
{
    const reference_sums *r = &j->references[0];
    for (size_t i = 0; i < j->values; i++) {
        j->steps[0][i] = color_srgb_decode(side[i]);
        j->steps[1][i] = color_srgb_decode((r->displayed[0][i] + r->displayed[1][i]) / 2);
    }
    return flip_ldr(f, (flip_picture){j->steps[0], 3}, (flip_picture){j->steps[1], 3}, NULL);
}

/* Computes the figures of both sides and publishes them, unless the order has been stopped. False: it was stopped, or it has failed. */
static bool measure(judge *j, flip *f, uint32_t samples)
{
    judgement found = {.samples = samples, .total = TOTAL};
    file_error error;
    noise_sums sums;
    for (int frame = 0; frame < JUDGE_FRAMES; frame++)
        for (int half = 0; half < HALVES; half++)
            if (!display_half(j, frame, half, samples))
                return false;
    for (int s = 0; s < SIDE_COUNT; s++) {
        float *const *r = j->references[0].displayed;
        if (is_stopped(j))
            return false;
        found.sides[s].flip = flip_of(j, f, j->sides[s][0]);
        if (!compare(j, j->sides[s][0], r[0], r[1], &sums, &error))
            return fail(j, error.text);
        found.sides[s].error = noise_sums_rmse(&sums);
        found.noise = noise_sums_floor(&sums);
        step_of(j->steps[0], j->sides[s][1], j->sides[s][0], j->values);
        for (int h = 0; h < HALVES; h++)
            step_of(j->steps[1 + h], j->references[1].displayed[h], r[h], j->values);
        if (!compare(j, j->steps[0], j->steps[1], j->steps[2], &sums, &error))
            return fail(j, error.text);
        found.sides[s].flicker = noise_sums_rmse(&sums);
        found.step_noise = noise_sums_floor(&sums);
    }
    pthread_mutex_lock(&j->lock);
    const bool stands = !j->has_order && !is_stopped(j);
    if (stands) {
        j->found = found;
        j->has_found = true;
    }
    pthread_mutex_unlock(&j->lock);
    j->wake();
    return stands;
}

/* Judges the current order. Figures are computed whenever the number of samples has doubled. */
static void judge_order_of_thread(judge *j)
{
    const mgt_image *image = &j->current.frames[0].image;
    file_error error;
    flip *f = NULL;
    if (!reserve(j, (size_t)image->width * image->height * 3)) {
        fail(j, "out of memory");
        return;
    }
    if (flip_create(&f, image->width, image->height, FLIP_PIXELS_PER_DEGREE, &error) != FILE_OK) {
        fail(j, error.text);
        return;
    }
    bool good = true;
    for (int s = 0; s < SIDE_COUNT && good; s++)
        for (int frame = 0; frame < JUDGE_FRAMES && good; frame++)
            good = render_side(j, s, frame);
    for (uint32_t taken = 0; good && taken < TOTAL;) {
        for (int frame = 0; frame < JUDGE_FRAMES && good; frame++)
            good = add_sample(j, frame, taken);
        taken++;
        if (good && taken >= HALVES && (taken & (taken - 1)) == 0)
            good = measure(j, f, taken);
    }
    flip_free(f);
    free_pictures(j);
}

/* ---- the thread ---- */

static bool on_progress(void *user, double fraction)
{
    (void)fraction;
    const judge *j = user;
    return !is_stopped(j);
}

static bool open_context(judge *j)
{
    mgt_context_desc desc = j->desc;
    desc.progress = on_progress;
    desc.progress_user = j;
    return j->context || mgt_context_create(&j->context, &desc) == MGT_OK || fail(j, mgt_last_error(NULL));
}

static void *run(void *argument)
{
    judge *j = argument;
    setpriority(PRIO_PROCESS, (id_t)gettid(), LOW_PRIORITY); /* of this thread, and of those that its context starts */
    pthread_mutex_lock(&j->lock);
    while (!j->quit) {
        if (!j->has_order) {
            pthread_cond_wait(&j->posted, &j->lock);
            continue;
        }
        j->current = j->order;
        j->order.models = NULL; /* the thread owns them now */
        memcpy(j->current_waves, j->waves, j->current.frames[0].water.wave_count * sizeof *j->waves);
        for (int frame = 0; frame < JUDGE_FRAMES; frame++)
            j->current.frames[frame].water.waves = j->current_waves;
        j->has_order = false;
        atomic_store(&j->stop, false);
        pthread_mutex_unlock(&j->lock);
        if (open_context(j))
            judge_order_of_thread(j);
        scene_models_release(j->current.models);
        pthread_mutex_lock(&j->lock);
    }
    pthread_mutex_unlock(&j->lock);
    return NULL;
}

judge *judge_create(const mgt_context_desc *desc, void (*wake)(void), char *error, size_t error_size)
{
    judge *j = calloc(1, sizeof *j);
    if (!j) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    j->desc = *desc;
    j->wake = wake;
    pthread_mutex_init(&j->lock, NULL);
    pthread_cond_init(&j->posted, NULL);
    j->started = pthread_create(&j->thread, NULL, run, j) == 0;
    if (j->started)
        return j;
    snprintf(error, error_size, "the judging thread cannot be started");
    judge_destroy(j);
    return NULL;
}

void judge_destroy(judge *j)
{
    if (!j)
        return;
    pthread_mutex_lock(&j->lock);
    j->quit = true;
    atomic_store(&j->stop, true);
    pthread_cond_signal(&j->posted);
    pthread_mutex_unlock(&j->lock);
    if (j->started)
        pthread_join(j->thread, NULL);
    mgt_context_destroy(j->context);
    scene_models_release(j->order.models);
    pthread_cond_destroy(&j->posted);
    pthread_mutex_destroy(&j->lock);
    free(j);
}

/* ---- calls of the main thread ---- */

/* Stops the work, and drops the order, the figures and the error. The lock must be held. */
static void forget(judge *j)
{
    atomic_store(&j->stop, true);
    scene_models_release(j->order.models);
    j->order.models = NULL;
    j->has_order = j->has_found = false;
    j->error[0] = 0;
}

void judge_post(judge *j, const judge_order *order)
{
    pthread_mutex_lock(&j->lock);
    forget(j);
    j->order = *order;
    j->order.models = scene_models_share(order->models);
    if (order->frames[0].water.wave_count > 0)
        memcpy(j->waves, order->frames[0].water.waves, order->frames[0].water.wave_count * sizeof *j->waves);
    j->has_order = true;
    pthread_cond_signal(&j->posted);
    pthread_mutex_unlock(&j->lock);
}

void judge_stop(judge *j)
{
    pthread_mutex_lock(&j->lock);
    forget(j);
    pthread_mutex_unlock(&j->lock);
}

bool judge_take(judge *j, judgement *out, char *problem, size_t problem_size)
{
    pthread_mutex_lock(&j->lock);
    const bool found = j->has_found;
    if (found)
        *out = j->found;
    j->has_found = false;
    if (problem)
        snprintf(problem, problem_size, "%s", j->error);
    j->error[0] = 0;
    pthread_mutex_unlock(&j->lock);
    return found;
}
