/* SPDX-License-Identifier: MIT
 * What only the CPU does, whatever a context renders with. */
#include "core/context.h"
#include "core/validate.h"

/* The CPU backend's state: the context's own, or a second one of a single thread beside another backend. */
static mgt_status cpu_state(mgt_context *context, void **state)
{
    if (context->backend == &cpu_backend) {
        *state = context->state;
        return MGT_OK;
    }
    mgt_status status = MGT_OK;
    if (!context->cpu) {
        mgt_context_desc desc = mgt_context_desc_defaults();
        mgt_context_info unused = {0};
        desc.threads = 1;
        status = cpu_backend.create(&context->cpu, &desc, &context->report, &unused);
    }
    *state = context->cpu;
    return status;
}

mgt_status mgt_display(mgt_context *context, const mgt_scene *scene, const float *radiance, const mgt_target *target)
{
    void *state = NULL;
    if (!context)
        return MGT_ERROR_ARGUMENT;
    context->error[0] = 0;
    mgt_status status = validate_scene(&context->report, scene);
    if (status == MGT_OK)
        status = validate_targets(&context->report, scene, target, 1);
    if (status == MGT_OK && (!radiance || target->format != MGT_FORMAT_RGBA8_SRGB))
        status = report_error(&context->report, MGT_ERROR_ARGUMENT, "display.target", "mgt_display: %s",
                              radiance ? "the target's format must be MGT_FORMAT_RGBA8_SRGB" : "radiance is NULL");
    if (status == MGT_OK)
        status = cpu_state(context, &state);
    return status == MGT_OK ? cpu_display(state, &context->report, scene, radiance, target) : status;
}

mgt_status mgt_inspect_pixel(mgt_context *context, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info)
{
    void *state = NULL;
    if (!context)
        return MGT_ERROR_ARGUMENT;
    context->error[0] = 0;
    mgt_status status = validate_scene(&context->report, scene);
    if (status != MGT_OK)
        return status;
    if (!info || info->struct_size != sizeof *info)
        return report_error(&context->report, MGT_ERROR_ARGUMENT, "inspect.info", "mgt_inspect_pixel: %s",
                            info ? "mgt_pixel_info.struct_size is not one that this library knows" : "info is NULL");
    if (x >= scene->image.width || y >= scene->image.height)
        return report_error(&context->report, MGT_ERROR_ARGUMENT, "inspect.pixel", "pixel %u, %u lies outside the image of %u x %u pixels", x, y,
                            scene->image.width, scene->image.height);
    status = cpu_state(context, &state);
    if (status != MGT_OK)
        return status;
    const mgt_scene ours = scene_at_sea_level(scene);
    return cpu_inspect(state, &context->report, &ours, x, y, info);
}
