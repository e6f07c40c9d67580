/* SPDX-License-Identifier: MIT */
/* Timed renders of every method. The methods take turns, so that a change of the machine's speed affects all of them. Times are kept in
 * DIR/frames/SCENE/times.json, so that a comparison that is continued does not measure again. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/compare/compare_external.h"
#include "cli/common/interrupt.h"
#include "cli/common/memory_text.h"
#include "cli/common/memory_use.h"
#include "cli/common/sha256.h"

static bool is_timed(const compare_job *job, const compare_scene *scene, size_t method)
{
    return !scene->view->untimed && compare_draws(scene, method + 1) && !compare_is_external(job->request, method);
}

/* A hash of everything that the times depend on, except the machine. False: out of memory. */
static bool times_key(const compare_job *job, const compare_scene *scene, sha256_text *key)
{
    const compare_request *r = job->request;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return false;
    fprintf(stream, "%s\n%s\nframe %u\nruns %u\nbackend %d isa %d threads %u renderer %s\n", mgt_version(), scene->canonical, compare_frame_number(job, 0),
            (unsigned)r->time_runs, (int)job->info.backend, (int)job->info.isa, job->info.threads, job->info.renderer);
    if (scene->view->only_timed)
        fputs("frames in turn\n", stream);
    if (r->memory)
        fputs("memory\n", stream);
    for (size_t m = 0; m < r->method_count; m++)
        if (is_timed(job, scene, m)) {
            fprintf(stream, "%s seed %llu\n", r->methods[m].name, (unsigned long long)r->methods[m].quality.seed);
            quality_write(stream, &scene->methods[m], "%s %s\n");
        }
    if (!memory_text_finish(stream, &text))
        return false;
    *key = sha256(text, size);
    free(text);
    return true;
}

static bool times_path(const compare_job *job, const compare_scene *scene, char path[COMPARE_PATH])
{
    char name[96];
    snprintf(name, sizeof name, "frames/%s/times.json", scene->name);
    return compare_file_path(job, name, path);
}

/* Reads the times from their file. False: there are none with this key. */
static bool read_times(const compare_job *job, compare_scene *scene, const char *path, const sha256_text *key)
{
    json_error_t error;
    json_t *root = json_load_file(path, 0, &error);
    const char *recorded = json_string_value(json_object_get(root, "key"));
    bool found = recorded && strcmp(recorded, key->text) == 0;
    for (size_t m = 0; m < job->request->method_count && found; m++) {
        if (!is_timed(job, scene, m))
            continue;
        const char *name = job->request->methods[m].name;
        json_t *list = json_object_get(json_object_get(root, "seconds"), name), *memory = json_object_get(json_object_get(root, "memory"), name);
        const size_t count = json_array_size(list);
        double *seconds = calloc(count ? count : 1, sizeof *seconds);
        found = seconds && count == job->request->time_runs;
        for (size_t i = 0; found && i < count; i++)
            seconds[i] = json_number_value(json_array_get(list, i));
        if (found)
            scene->results[m].time = number_spread_of(seconds, count);
        scene->results[m].memory = json_is_number(memory) ? json_number_value(memory) : NAN;
        free(seconds);
    }
    json_decref(root);
    return found;
}

static int write_times(compare_job *job, const compare_scene *scene, const char *path, const sha256_text *key, const double *seconds)
{
    const size_t runs = (size_t)job->request->time_runs;
    json_t *lists = json_object(), *memory = json_object();
    for (size_t m = 0; m < job->request->method_count; m++) {
        const char *name = job->request->methods[m].name;
        if (!is_timed(job, scene, m))
            continue;
        json_t *list = json_array();
        for (size_t i = 0; i < runs; i++)
            json_array_append_new(list, json_real(seconds[m * runs + i]));
        json_object_set_new(lists, name, list);
        if (isfinite(scene->results[m].memory))
            json_object_set_new(memory, name, json_real(scene->results[m].memory));
    }
    json_t *root = json_pack("{s:s, s:I, s:o, s:o}", "key", key->text, "frame", (json_int_t)compare_frame_number(job, 0), "seconds", lists, "memory", memory);
    char *text = root ? json_dumps(root, JSON_INDENT(1) | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(root);
    const int code = text ? compare_write_text(job, path, text, strlen(text)) : console_error(EXIT_CODE_FAILED, "out of memory");
    free(text);
    return code;
}

static int render_once(compare_job *job, mgt_context *context, const mgt_scene *view, const mgt_target *target, double *seconds)
{
    const double start = seconds_now();
    const mgt_status status = mgt_render(context, view, target, 1);
    *seconds = seconds_now() - start;
    if (status == MGT_CANCELLED || *interrupt_flag())
        return compare_stopped(job);
    return status == MGT_OK ? EXIT_CODE_OK : console_library_error(context, status);
}

/* Renders run number `run` of a method. The caller does not count run 0. */
static int time_once(compare_job *job, const compare_scene *scene, size_t method, size_t run, const mgt_target *target, double *seconds)
{
    const uint32_t number = compare_frame_number(job, 0) + (scene->view->only_timed ? (uint32_t)run : 0);
    mgt_scene view;
    if (!compare_number_scene(scene, method + 1, number, &view))
        return EXIT_CODE_BAD_INPUT;
    progress_frame(&job->progress, number);
    const int code = render_once(job, job->context, &view, target, seconds);
    job->progress.frames_done++;
    return code;
}

static int measure_memory(compare_job *job, compare_scene *scene, const mgt_target *target)
{
    int code = EXIT_CODE_OK;
    for (size_t m = 0; m < job->request->method_count && code == EXIT_CODE_OK; m++) {
        mgt_context *context = NULL;
        mgt_context_info info;
        mgt_scene view;
        double unused;
        if (!is_timed(job, scene, m))
            continue;
        if (!compare_frame_scene(job, scene, m + 1, 0, &view))
            return EXIT_CODE_BAD_INPUT;
        const double before = memory_use_begin();
        code = context_open(&job->request->context, &job->request->out, interrupt_keep_going, NULL, &context, &info);
        if (code == EXIT_CODE_OK)
            code = render_once(job, context, &view, target, &unused);
        scene->results[m].memory = memory_use_peak() - before;
        mgt_context_destroy(context);
    }
    return code;
}

static int time_scene(compare_job *job, compare_scene *scene, const char *path, const sha256_text *key)
{
    const size_t runs = (size_t)job->request->time_runs, methods = job->request->method_count;
    const mgt_target target = target_of(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, calloc((size_t)scene->width * scene->height, 3 * sizeof(float)));
    double *seconds = calloc(methods * runs, sizeof *seconds), unused;
    int code = target.pixels && seconds ? EXIT_CODE_OK : console_error(EXIT_CODE_FAILED, "out of memory");
    /* Run 0 builds tables and touches memory. It is not counted. */
    for (size_t run = 0; run <= runs; run++)
        for (size_t m = 0; m < methods && code == EXIT_CODE_OK; m++)
            if (is_timed(job, scene, m))
                code = time_once(job, scene, m, run, &target, run ? &seconds[m * runs + run - 1] : &unused);
    if (code == EXIT_CODE_OK && job->request->memory)
        code = measure_memory(job, scene, &target);
    if (code == EXIT_CODE_OK)
        code = write_times(job, scene, path, key, seconds);
    for (size_t m = 0; m < methods && code == EXIT_CODE_OK; m++)
        if (is_timed(job, scene, m))
            scene->results[m].time = number_spread_of(seconds + m * runs, runs);
    free(seconds);
    free(target.pixels);
    return code;
}

int compare_time_methods(compare_job *job)
{
    const compare_request *r = job->request;
    int code = EXIT_CODE_OK;
    uint64_t timed = 0;
    for (size_t s = 0; s < r->scene_count; s++)
        for (size_t m = 0; m < r->method_count; m++) {
            job->scenes[s].results[m].time = number_spread_of(NULL, 0);
            job->scenes[s].results[m].memory = NAN;
            timed += is_timed(job, &job->scenes[s], m);
        }
    if (r->time_runs == 0)
        return EXIT_CODE_OK;
    job->progress = progress_start(r->progress, timed * (r->time_runs + 1));
    for (size_t s = 0; s < r->scene_count && code == EXIT_CODE_OK; s++) {
        char path[COMPARE_PATH];
        sha256_text key;
        if (job->scenes[s].view->untimed)
            continue;
        if (!times_path(job, &job->scenes[s], path))
            code = EXIT_CODE_USAGE;
        else if (!times_key(job, &job->scenes[s], &key))
            code = console_error(EXIT_CODE_FAILED, "out of memory");
        else if (!read_times(job, &job->scenes[s], path, &key))
            code = time_scene(job, &job->scenes[s], path, &key);
    }
    progress_clear(&job->progress);
    return code;
}
