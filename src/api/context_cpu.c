/* SPDX-License-Identifier: MIT
 * Calls that the CPU serves with every backend. */
#include <float.h>

#include "api/context.h"
#include "api/structs.h"
#include "base/exact_sum.h"
#include "frame/targets.h"
#include "params/methods.h"

mgt_status cpu_state(mgt_context *context, void **state)
{
    if (context->backend == &cpu_backend) {
        *state = context->state;
        return MGT_OK;
    }
    mgt_status status = MGT_OK;
    if (!context->cpu) {
        mgt_context_info unused = {0};
        status = cpu_backend.create(&context->cpu, &context->desc, &context->report, &unused);
    }
    *state = context->cpu;
    return status;
}

/* Checks the radiance of a whole image. */
static mgt_status check_radiance(const reporter *r, const float *radiance, const mgt_image *image)
{
    const size_t count = 3 * (size_t)image->width * image->height;
    for (size_t i = 0; i < count; i++)
        if (!(radiance[i] >= 0 && radiance[i] <= FLT_MAX))
            return report_error(r, MGT_ERROR_ARGUMENT, "display.radiance", "mgt_display: the radiance of pixel %zu, %zu is %g; allowed is a number from 0",
                                i / 3 % image->width, i / 3 / image->width, (double)radiance[i]);
    return MGT_OK;
}

static mgt_status display(mgt_context *context, const mgt_scene *scene, const float *radiance, const mgt_target *target)
{
    void *state = NULL;
    mgt_scene own;
    mgt_target own_target;
    mgt_status status = scene_take(&context->report, &own, scene);
    if (status == MGT_OK)
        status = targets_take(&context->report, &own, &own_target, target, 1);
    if (status == MGT_OK && (!radiance || own_target.format != MGT_FORMAT_RGBA8_SRGB))
        status = report_error(&context->report, MGT_ERROR_ARGUMENT, "display.target", "mgt_display: %s",
                              radiance ? "the target's format must be MGT_FORMAT_RGBA8_SRGB" : "radiance is NULL");
    if (status == MGT_OK)
        status = check_radiance(&context->report, radiance, &own.image);
    if (status == MGT_OK)
        status = cpu_state(context, &state);
    return status == MGT_OK ? cpu_display(state, &context->report, &own, radiance, &own_target) : status;
}

mgt_status mgt_display(mgt_context *context, const mgt_scene *scene, const float *radiance, const mgt_target *target)
{
    return context_enter(context) ? context_leave(context, display(context, scene, radiance, target)) : MGT_ERROR_ARGUMENT;
}

static mgt_status exposure(mgt_context *context, const mgt_scene *scene, double *stops)
{
    void *state = NULL;
    mgt_scene own;
    mgt_status status = scene_take(&context->report, &own, scene);
    if (status == MGT_OK && !stops)
        status = report_error(&context->report, MGT_ERROR_ARGUMENT, "exposure.stops", "mgt_exposure: stops is NULL");
    if (status == MGT_OK)
        status = cpu_state(context, &state);
    return status == MGT_OK ? cpu_exposure(state, &context->report, &own, stops) : status;
}

mgt_status mgt_exposure(mgt_context *context, const mgt_scene *scene, double *stops)
{
    return context_enter(context) ? context_leave(context, exposure(context, scene, stops)) : MGT_ERROR_ARGUMENT;
}

/* Takes and checks a scene whose method must have sums, and moves it to sea level. */
static mgt_status take_summed(mgt_context *context, const mgt_scene *scene, const uint64_t *sums, mgt_scene *own)
{
    const reporter *r = &context->report;
    const mgt_status status = scene_take(r, own, scene);
    if (status != MGT_OK)
        return status;
    if (!sums)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.sums", "the sums are NULL");
    if (quality_range(&own->quality) == 0)
        return report_error(r, MGT_ERROR_UNSUPPORTED, "render.sums",
                            "method %s has no sums of samples; reference, ssaa, and adaptive by podee with sample_slots have",
                            mgt_method_name(own->quality.method));
    if (context->backend == &gl_backend)
        announce_cpu(context, own->quality.method, "sums of samples are made");
    return scene_ready(r, own);
}

static mgt_status sum_samples(mgt_context *context, const mgt_scene *scene, uint64_t *sums)
{
    void *state = NULL;
    mgt_scene own;
    mgt_status status = take_summed(context, scene, sums, &own);
    if (status != MGT_OK || context->backend == &null_backend)
        return status;
    status = cpu_state(context, &state);
    return status == MGT_OK ? cpu_sum(state, &context->report, &own, sums) : status;
}

mgt_status mgt_sum_samples(mgt_context *context, const mgt_scene *scene, uint64_t *sums)
{
    return context_enter(context) ? context_leave(context, sum_samples(context, scene, sums)) : MGT_ERROR_ARGUMENT;
}

void mgt_sums_add(uint64_t *sums, const uint64_t *more, size_t pixels)
{
    for (size_t i = 0; sums && more && i < pixels * EXACT_COUNT; i++)
        exact_add(sums + 2 * i, exact_load(more + 2 * i));
}

/* Checks that the sums can be those of as many samples as the scene's range has. */
static mgt_status check_sums(const reporter *r, const uint64_t *sums, const mgt_scene *scene)
{
    const region area = image_region(&scene->image);
    const size_t pixels = (size_t)area.width * area.height;
    const mgt_quality *q = &scene->quality;
    const uint64_t samples = q->sample_count ? q->sample_count : quality_range(q) - q->sample_first;
    for (size_t i = 0; i < pixels; i++)
        if (!exact_sums_fit(sums + i * 2 * EXACT_COUNT, samples))
            return report_error(r, MGT_ERROR_ARGUMENT, "render.sums", "the sums of pixel %zu, %zu are not those of %llu samples", i % area.width,
                                i / area.width, (unsigned long long)samples);
    return MGT_OK;
}

static mgt_status render_sums(mgt_context *context, const mgt_scene *scene, const uint64_t *sums, const mgt_target *targets, size_t count)
{
    void *state = NULL;
    mgt_scene own;
    mgt_target own_targets[MOST_TARGETS];
    const reporter *r = &context->report;
    mgt_status status = take_summed(context, scene, sums, &own);
    if (status == MGT_OK)
        status = targets_take(r, &own, own_targets, targets, count);
    if (status == MGT_OK)
        status = check_sums(r, sums, &own);
    if (status == MGT_OK && context->backend == &null_backend)
        return null_backend.render(NULL, r, &own, own_targets, count);
    if (status == MGT_OK)
        status = cpu_state(context, &state);
    return status == MGT_OK ? cpu_render_sums(state, r, &own, sums, own_targets, count) : status;
}

mgt_status mgt_render_sums(mgt_context *context, const mgt_scene *scene, const uint64_t *sums, const mgt_target *targets, size_t count)
{
    return context_enter(context) ? context_leave(context, render_sums(context, scene, sums, targets, count)) : MGT_ERROR_ARGUMENT;
}

static mgt_status inspect_pixel(mgt_context *context, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info)
{
    void *state = NULL;
    mgt_scene own;
    mgt_pixel_info own_info = {0};
    const reporter *r = &context->report;
    mgt_status status = scene_take(r, &own, scene);
    if (status != MGT_OK)
        return status;
    if (x >= own.image.width || y >= own.image.height)
        return report_error(r, MGT_ERROR_ARGUMENT, "inspect.pixel", "pixel %u, %u lies outside the image of %u x %u pixels", x, y, own.image.width,
                            own.image.height);
    status = cpu_state(context, &state);
    if (status != MGT_OK)
        return status;
    scene_to_sea_level(&own);
    status = cpu_inspect(state, r, &own, x, y, &own_info);
    return status == MGT_OK ? struct_give(r, &pixel_info_kind, &own_info, info) : status;
}

mgt_status mgt_inspect_pixel(mgt_context *context, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info)
{
    return context_enter(context) ? context_leave(context, inspect_pixel(context, scene, x, y, info)) : MGT_ERROR_ARGUMENT;
}
