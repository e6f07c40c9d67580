/* SPDX-License-Identifier: MIT
 * The rendering thread. The last order waits in a mailbox, and the last picture of each side in a slot. */
#define _POSIX_C_SOURCE 200809L
#include "viewer/picture/render_worker.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/context_options.h"
#include "cli/common/progress.h"
#include "params/methods.h"
#include "scene/scene_models.h"
#include "viewer/picture/strata.h"

enum { ERROR_SIZE = 512 };

/* Sums of a picture over the samples that have been taken. */
typedef struct accumulation {
    double *sums;
    float *sample, *mean; /* 3 or 1 numbers per pixel */
    size_t capacity;      /* room of each array, numbers */
    uint64_t taken, total;
} accumulation;

struct render_worker {
    pthread_t thread;
    bool started, refines;
    void (*wake)(void);
    mgt_context *context;
    mgt_context_info info;

    pthread_mutex_t lock; /* protects the members up to `error` */
    pthread_cond_t posted;
    bool quit, has_order, busy;
    render_order order;
    mgt_wave waves[MGT_MAX_WAVES];
    picture ready[SIDE_COUNT];
    bool is_ready[SIDE_COUNT];
    char error[ERROR_SIZE];

    atomic_bool stop; /* the current call of mgt_render() shall end */

    /* members that only the thread uses */
    render_order current;
    mgt_wave current_waves[MGT_MAX_WAVES];
    picture drawn[SIDE_COUNT];
    accumulation sums[SIDE_COUNT];
};

void picture_free(picture *p)
{
    free(p->pixels);
    *p = (picture){0};
}

/* ---- memory ---- */

/* Numbers per pixel of a layer. */
static uint32_t floats_of(mgt_layer layer) { return layer == MGT_LAYER_COLOR || layer == MGT_LAYER_NORMAL ? 3 : 1; }

static bool reserve_picture(picture *p, mgt_layer layer, uint32_t width, uint32_t height)
{
    const size_t bytes = (size_t)width * height * (layer == MGT_LAYER_COLOR ? 4 : sizeof(float) * floats_of(layer));
    if (bytes > p->capacity) {
        free(p->pixels);
        p->pixels = malloc(bytes);
        p->capacity = p->pixels ? bytes : 0;
    }
    p->layer = layer;
    p->width = width;
    p->height = height;
    return p->pixels != NULL;
}

static void free_accumulation(accumulation *a)
{
    free(a->sums);
    free(a->sample);
    free(a->mean);
    *a = (accumulation){0};
}

static bool reserve_accumulation(accumulation *a, size_t count)
{
    if (count > a->capacity) {
        free_accumulation(a);
        a->sums = malloc(count * sizeof *a->sums);
        a->sample = malloc(count * sizeof *a->sample);
        a->mean = malloc(count * sizeof *a->mean);
        if (!a->sums || !a->sample || !a->mean) {
            free_accumulation(a);
            return false;
        }
        a->capacity = count;
    }
    memset(a->sums, 0, count * sizeof *a->sums);
    return true;
}

/* ---- one side ---- */

/* Keeps an error for render_worker_take_error(). */
static void fail(render_worker *w, const char *text)
{
    pthread_mutex_lock(&w->lock);
    snprintf(w->error, sizeof w->error, "%s", text);
    pthread_mutex_unlock(&w->lock);
    w->wake();
}

/* Puts the picture of a side that has been drawn into its slot. */
static void publish(render_worker *w, int side)
{
    pthread_mutex_lock(&w->lock);
    const picture old = w->ready[side];
    w->ready[side] = w->drawn[side];
    w->drawn[side] = old;
    w->is_ready[side] = true;
    pthread_mutex_unlock(&w->lock);
    w->wake();
}

/* Renders the layer into `pixels`. False: it was cancelled, or it has failed, which is kept as an error. */
static bool render(render_worker *w, const mgt_scene *scene, mgt_format format, void *pixels)
{
    const mgt_target target = target_of(w->current.layer, format, pixels);
    const mgt_status status = mgt_render(w->context, scene, &target, 1);
    if (status != MGT_OK && status != MGT_CANCELLED)
        fail(w, mgt_last_error(w->context));
    return status == MGT_OK;
}

static mgt_format float_format(mgt_layer layer) { return floats_of(layer) == 3 ? MGT_FORMAT_RGB32F : MGT_FORMAT_R32F; }

/* Renders a side without samples, and publishes it. */
static void render_once(render_worker *w, int side)
{
    const render_order *o = &w->current;
    picture *p = &w->drawn[side];
    mgt_scene scene = o->scene;
    scene.quality = o->quality[side];
    if (!reserve_picture(p, o->layer, scene.image.width, scene.image.height)) {
        fail(w, "out of memory");
        return;
    }
    const double start = seconds_now();
    if (!render(w, &scene, o->layer == MGT_LAYER_COLOR ? MGT_FORMAT_RGBA8_SRGB : float_format(o->layer), p->pixels))
        return;
    p->serial = o->serial;
    p->seconds = seconds_now() - start;
    p->samples = p->samples_total = 1;
    publish(w, side);
}

/* ---- refinement ---- */

/* Whether the layer is a mean over samples: light and areas are. Depth and normal are those of an instant, and are rendered once. */
static bool layer_refines(mgt_layer layer) { return layer <= MGT_LAYER_MASK; }

static bool side_refines(const render_order *o, int side) { return o->wanted[side] && method_is_sampled(o->quality[side].method); }

/* Empties the sums of a side. False: out of memory. */
static bool begin_refinement(render_worker *w, int side)
{
    const render_order *o = &w->current;
    const mgt_quality *q = &o->quality[side];
    accumulation *a = &w->sums[side];
    const size_t count = (size_t)o->scene.image.width * o->scene.image.height * floats_of(o->layer);
    if (!reserve_accumulation(a, count)) {
        fail(w, "out of memory");
        return false;
    }
    a->taken = 0;
    a->total = layer_refines(o->layer) ? (uint64_t)q->spatial_samples * q->spatial_samples * q->time_samples : 1;
    return true;
}

static void add_sample(accumulation *a, size_t count)
{
    a->taken++;
    for (size_t i = 0; i < count; i++) {
        a->sums[i] += (double)a->sample[i];
        a->mean[i] = (float)(a->sums[i] / (double)a->taken);
    }
}

/* Adds a sample to a side and publishes its mean. False: the side cannot be refined further. */
static bool refine(render_worker *w, int side)
{
    const render_order *o = &w->current;
    accumulation *a = &w->sums[side];
    picture *p = &w->drawn[side];
    mgt_scene scene = o->scene;
    const size_t count = (size_t)scene.image.width * scene.image.height * floats_of(o->layer);
    const double start = seconds_now();
    scene.quality = o->quality[side];
    if (layer_refines(o->layer)) {
        scene.quality.sample_first = stratum_at(a->taken, a->total);
        scene.quality.sample_count = 1;
    }
    if (!render(w, &scene, float_format(o->layer), a->sample))
        return false;
    add_sample(a, count);
    if (!reserve_picture(p, o->layer, scene.image.width, scene.image.height)) {
        fail(w, "out of memory");
        return false;
    }
    if (o->layer == MGT_LAYER_COLOR) {
        mgt_target target;
        mgt_target_init(&target, sizeof target);
        target.pixels = p->pixels;
        const mgt_status status = mgt_display(w->context, &scene, a->mean, &target);
        if (status != MGT_OK) {
            fail(w, mgt_last_error(w->context));
            return false;
        }
    } else {
        memcpy(p->pixels, a->mean, count * sizeof *a->mean);
    }
    p->serial = o->serial;
    p->seconds = seconds_now() - start;
    p->samples = a->taken;
    p->samples_total = a->total;
    publish(w, side);
    return true;
}

static bool has_newer_order(render_worker *w)
{
    pthread_mutex_lock(&w->lock);
    const bool newer = w->has_order || w->quit;
    pthread_mutex_unlock(&w->lock);
    return newer;
}

/* Refines the sides in turn. The first sample of each side is finished even if a new order comes, so that something is shown while things move. */
static void run_refinement(render_worker *w)
{
    bool going[SIDE_COUNT];
    for (int side = 0; side < SIDE_COUNT; side++)
        going[side] = side_refines(&w->current, side) && begin_refinement(w, side);
    for (bool any = true, first = true; any && (first || !has_newer_order(w)); first = false) {
        any = false;
        for (int side = 0; side < SIDE_COUNT; side++) {
            if (!going[side] || (!first && has_newer_order(w)))
                continue;
            going[side] = refine(w, side) && w->sums[side].taken < w->sums[side].total;
            any |= going[side];
        }
    }
}

/* ---- the thread ---- */

static void *run(void *argument)
{
    render_worker *w = argument;
    pthread_mutex_lock(&w->lock);
    while (!w->quit) {
        if (!w->has_order) {
            w->busy = false;
            pthread_cond_wait(&w->posted, &w->lock);
            continue;
        }
        scene_models_release(w->current.models);
        w->current = w->order;
        w->order.models = NULL;
        memcpy(w->current_waves, w->waves, w->order.scene.water.wave_count * sizeof *w->waves);
        w->current.scene.water.waves = w->current_waves;
        w->has_order = false;
        w->busy = true;
        atomic_store(&w->stop, false);
        pthread_mutex_unlock(&w->lock);
        if (w->refines)
            run_refinement(w);
        else
            for (int side = 0; side < SIDE_COUNT; side++)
                if (w->current.wanted[side] && !side_refines(&w->current, side))
                    render_once(w, side);
        pthread_mutex_lock(&w->lock);
    }
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

static bool on_progress(void *user, double fraction)
{
    (void)fraction;
    const render_worker *w = user;
    return !atomic_load(&w->stop);
}

render_worker *render_worker_create(const mgt_context_desc *desc, bool refines, void (*wake)(void), char *error, size_t error_size)
{
    render_worker *w = calloc(1, sizeof *w);
    if (!w) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    w->refines = refines;
    w->wake = wake;
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->posted, NULL);
    mgt_context_desc own = *desc;
    own.progress = on_progress;
    own.progress_user = w;
    const mgt_status status = mgt_context_create(&w->context, &own);
    if (status == MGT_OK) {
        w->info.struct_size = sizeof w->info;
        mgt_context_get_info(w->context, &w->info);
        w->started = pthread_create(&w->thread, NULL, run, w) == 0;
    }
    if (w->started)
        return w;
    snprintf(error, error_size, "%s", status == MGT_OK ? "the rendering thread cannot be started" : mgt_last_error(NULL));
    render_worker_destroy(w);
    return NULL;
}

void render_worker_destroy(render_worker *w)
{
    if (!w)
        return;
    pthread_mutex_lock(&w->lock);
    w->quit = true;
    atomic_store(&w->stop, true);
    pthread_cond_signal(&w->posted);
    pthread_mutex_unlock(&w->lock);
    if (w->started)
        pthread_join(w->thread, NULL);
    mgt_context_destroy(w->context);
    scene_models_release(w->order.models);
    scene_models_release(w->current.models);
    for (int side = 0; side < SIDE_COUNT; side++) {
        picture_free(&w->ready[side]);
        picture_free(&w->drawn[side]);
        free_accumulation(&w->sums[side]);
    }
    pthread_cond_destroy(&w->posted);
    pthread_mutex_destroy(&w->lock);
    free(w);
}

/* ---- calls of the main thread ---- */

void render_worker_post(render_worker *w, const render_order *order)
{
    pthread_mutex_lock(&w->lock);
    if (w->busy && w->current.interruptible)
        atomic_store(&w->stop, true);
    scene_models_release(w->order.models);
    w->order = *order;
    scene_models_share(w->order.models);
    memcpy(w->waves, order->scene.water.waves, order->scene.water.wave_count * sizeof *w->waves);
    w->has_order = true;
    pthread_cond_signal(&w->posted);
    pthread_mutex_unlock(&w->lock);
}

bool render_worker_take(render_worker *w, int side, picture *p)
{
    pthread_mutex_lock(&w->lock);
    const bool ready = w->is_ready[side];
    if (ready) {
        const picture old = *p;
        *p = w->ready[side];
        w->ready[side] = old;
        w->is_ready[side] = false;
    }
    pthread_mutex_unlock(&w->lock);
    return ready;
}

bool render_worker_take_error(render_worker *w, char *text, size_t size)
{
    pthread_mutex_lock(&w->lock);
    const bool failed = w->error[0] != 0;
    if (failed)
        snprintf(text, size, "%s", w->error);
    w->error[0] = 0;
    pthread_mutex_unlock(&w->lock);
    return failed;
}

bool render_worker_is_idle(render_worker *w)
{
    pthread_mutex_lock(&w->lock);
    bool idle = !w->has_order && !w->busy && !w->error[0];
    for (int side = 0; side < SIDE_COUNT; side++)
        idle &= !w->is_ready[side];
    pthread_mutex_unlock(&w->lock);
    return idle;
}

mgt_context_info render_worker_info(const render_worker *w) { return w->info; }
