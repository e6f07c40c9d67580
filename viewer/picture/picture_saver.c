/* SPDX-License-Identifier: MIT
 * The thread that renders and saves a picture. Everything but the atomics belongs to the main thread while `state` is SAVER_IDLE, and to the saving thread
 * while it is SAVER_BUSY. */
#include "viewer/picture/picture_saver.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/context_options.h"
#include "image/picture.h"
#include "scene/scene_models.h"

enum { PATH_SIZE = 512, ERROR_SIZE = 512 };

struct picture_saver {
    mgt_context_desc desc;
    void (*wake)(void);
    pthread_t thread;
    bool started;
    mgt_context *context; /* created for the first picture */
    mgt_scene scene;
    mgt_wave waves[MGT_MAX_WAVES];
    scene_models *models; /* a share of the models of `scene` */
    char path[PATH_SIZE];
    char error[ERROR_SIZE]; /* written before `state` */
    atomic_int state;       /* picture_saver_state */
    atomic_bool stop;       /* rendering shall end */
    _Atomic double fraction;
};

/* ---- files ---- */

enum { EXR_LAYERS = 5 };

static bool write_exr(mgt_context *context, const mgt_scene *scene, const char *path, const output_options *options, char *error, size_t error_size)
{
    const size_t pixels = (size_t)scene->image.width * scene->image.height;
    mgt_target targets[EXR_LAYERS];
    picture_layer layers[EXR_LAYERS] = {0};
    float *memory = malloc(pixels * 9 * sizeof *memory), *next = memory;
    file_error problem = {0};
    bool good = memory != NULL;
    for (int i = 0; i < EXR_LAYERS && good; i++) {
        const uint32_t channels = mgt_layer_channels((mgt_layer)i);
        targets[i] = target_of((mgt_layer)i, channels == 3 ? MGT_FORMAT_RGB32F : MGT_FORMAT_R32F, next);
        layers[i] = (picture_layer){.name = mgt_layer_name((mgt_layer)i), .channels = channels, .pixels = next};
        next += channels * pixels;
    }
    if (!good)
        snprintf(error, error_size, "out of memory");
    if (good && mgt_render(context, scene, targets, EXR_LAYERS) != MGT_OK) {
        snprintf(error, error_size, "%s", mgt_last_error(context));
        good = false;
    }
    if (good && picture_write_exr(path, scene->image.width, scene->image.height, layers, EXR_LAYERS, NULL, options, &problem) != FILE_OK) {
        snprintf(error, error_size, "%s", problem.text);
        good = false;
    }
    free(memory);
    return good;
}

static bool write_png(mgt_context *context, const mgt_scene *scene, const char *path, const output_options *options, char *error, size_t error_size)
{
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    file_error problem = {0};
    bool good = (target.pixels = malloc((size_t)scene->image.width * scene->image.height * 4)) != NULL;
    if (!good)
        snprintf(error, error_size, "out of memory");
    if (good && mgt_render(context, scene, &target, 1) != MGT_OK) {
        snprintf(error, error_size, "%s", mgt_last_error(context));
        good = false;
    }
    if (good && picture_write_png(path, scene->image.width, scene->image.height, target.pixels, 0, NULL, options, &problem) != FILE_OK) {
        snprintf(error, error_size, "%s", problem.text);
        good = false;
    }
    free(target.pixels);
    return good;
}

/* ---- the thread ---- */

static bool on_progress(void *user, double fraction)
{
    picture_saver *s = user;
    atomic_store(&s->fraction, fraction);
    return !atomic_load(&s->stop);
}

static bool save(picture_saver *s)
{
    const output_options options = {.overwrite = true};
    mgt_context_desc desc = s->desc;
    desc.progress = on_progress;
    desc.progress_user = s;
    if (!s->context && mgt_context_create(&s->context, &desc) != MGT_OK) {
        snprintf(s->error, sizeof s->error, "%s", mgt_last_error(NULL));
        return false;
    }
    const bool exr = picture_format_of(s->path) == PICTURE_EXR;
    return (exr ? write_exr : write_png)(s->context, &s->scene, s->path, &options, s->error, sizeof s->error);
}

static void *run(void *argument)
{
    picture_saver *s = argument;
    atomic_store(&s->state, save(s) ? SAVER_SAVED : SAVER_FAILED);
    s->wake();
    return NULL;
}

picture_saver *picture_saver_create(const mgt_context_desc *desc, void (*wake)(void))
{
    picture_saver *s = calloc(1, sizeof *s);
    if (s) {
        s->desc = *desc;
        s->wake = wake;
    }
    return s;
}

static void join(picture_saver *s)
{
    if (s->started)
        pthread_join(s->thread, NULL);
    s->started = false;
}

void picture_saver_destroy(picture_saver *s)
{
    if (!s)
        return;
    atomic_store(&s->stop, true);
    join(s);
    mgt_context_destroy(s->context);
    scene_models_release(s->models);
    free(s);
}

bool picture_saver_start(picture_saver *s, const mgt_scene *scene, scene_models *models, const char *path, char *error, size_t error_size)
{
    const output_options options = {.overwrite = true};
    const picture_format format = picture_format_of(path);
    file_error problem;
    if (format != PICTURE_PNG && format != PICTURE_EXR) {
        snprintf(error, error_size, "%s: the name must end in .png or .exr", path);
        return false;
    }
    if (atomic_load(&s->state) != SAVER_IDLE) {
        snprintf(error, error_size, "%s is still being saved", s->path);
        return false;
    }
    if (strlen(path) >= sizeof s->path) {
        snprintf(error, error_size, "the name of the picture is too long");
        return false;
    }
    if (output_file_check(path, &options, &problem) != FILE_OK) {
        snprintf(error, error_size, "%s", problem.text);
        return false;
    }
    s->scene = *scene;
    memcpy(s->waves, scene->water.waves, scene->water.wave_count * sizeof *s->waves);
    s->scene.water.waves = s->waves;
    scene_models_release(s->models);
    s->models = scene_models_share(models);
    snprintf(s->path, sizeof s->path, "%s", path);
    atomic_store(&s->fraction, 0);
    atomic_store(&s->state, SAVER_BUSY);
    s->started = pthread_create(&s->thread, NULL, run, s) == 0;
    if (s->started)
        return true;
    atomic_store(&s->state, SAVER_IDLE);
    snprintf(error, error_size, "the saving thread cannot be started");
    return false;
}

picture_saver_state picture_saver_poll(picture_saver *s, char *text, size_t size, double *fraction)
{
    const picture_saver_state state = (picture_saver_state)atomic_load(&s->state);
    *fraction = atomic_load(&s->fraction);
    if (state == SAVER_IDLE)
        return state;
    snprintf(text, size, "%s", state == SAVER_FAILED ? s->error : s->path);
    if (state != SAVER_BUSY) {
        join(s);
        atomic_store(&s->state, SAVER_IDLE);
    }
    return state;
}
