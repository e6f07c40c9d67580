/* SPDX-License-Identifier: MIT
 * What only the CPU does, whatever a context renders with. */
#include "api/context.h"
#include "api/structs.h"
#include "frame/targets.h"

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

mgt_status mgt_display(mgt_context *context, const mgt_scene *scene, const float *radiance, const mgt_target *target)
{
    void *state = NULL;
    mgt_scene own;
    mgt_target own_target;
    if (!context)
        return MGT_ERROR_ARGUMENT;
    context->error[0] = 0;
    mgt_status status = scene_take(&context->report, &own, scene);
    if (status == MGT_OK)
        status = targets_take(&context->report, &own, &own_target, target, 1);
    if (status == MGT_OK && (!radiance || own_target.format != MGT_FORMAT_RGBA8_SRGB))
        status = report_error(&context->report, MGT_ERROR_ARGUMENT, "display.target", "mgt_display: %s",
                              radiance ? "the target's format must be MGT_FORMAT_RGBA8_SRGB" : "radiance is NULL");
    if (status == MGT_OK)
        status = cpu_state(context, &state);
    return status == MGT_OK ? cpu_display(state, &context->report, &own, radiance, &own_target) : status;
}

mgt_status mgt_inspect_pixel(mgt_context *context, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info)
{
    void *state = NULL;
    mgt_scene own;
    mgt_pixel_info own_info = {0};
    if (!context)
        return MGT_ERROR_ARGUMENT;
    context->error[0] = 0;
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
