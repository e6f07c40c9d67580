/* SPDX-License-Identifier: MIT
 * Contexts: creation, information, errors, and mgt_render(). */
#include <stdlib.h>

#include "api/context.h"
#include "api/structs.h"
#include "api/supports.h"
#include "api/validate.h"
#include "frame/targets.h"

/* MGT_BACKEND_AUTO: creates OpenGL if it is hardware, else the CPU. Logs the choice and its reason. */
static mgt_status create_auto(mgt_context *c, const mgt_context_desc *desc, const reporter *r)
{
    const reporter quiet = {.error = r->error};
    mgt_status status = gl_backend.create(&c->state, desc, &quiet, &c->info);
    if (status == MGT_OK && !c->info.software) {
        c->backend = &gl_backend;
        report(r, MGT_LOG_INFO, "context.backend", "%s renders", c->info.renderer);
        return MGT_OK;
    }
    if (status == MGT_OK) {
        gl_backend.destroy(c->state);
        report(r, MGT_LOG_INFO, "context.backend", "the CPU renders: OpenGL here is software itself (%s)", c->info.renderer);
    } else {
        report(r, MGT_LOG_INFO, "context.backend", "the CPU renders: %s", r->error);
    }
    r->error[0] = 0;
    c->state = NULL;
    c->info = (mgt_context_info){.struct_size = sizeof c->info};
    return cpu_backend.create(&c->state, desc, r, &c->info);
}

mgt_status mgt_context_create(mgt_context **context, const mgt_context_desc *desc)
{
    reporter early = creation_reporter();
    mgt_context_desc own;
    if (context)
        *context = NULL;
    mgt_status status = struct_take(&early, &context_desc_kind, &own, desc ? desc : context_desc_kind.defaults, 1);
    if (status != MGT_OK)
        return status;
    early.log = own.log, early.log_user = own.log_user;
    if (!context)
        return report_error(&early, MGT_ERROR_ARGUMENT, "context.create", "mgt_context_create: the pointer to fill is NULL");
    status = validate_desc(&early, &own);
    if (status != MGT_OK)
        return status;

    mgt_context *c = calloc(1, sizeof *c);
    if (!c)
        return report_error(&early, MGT_ERROR_MEMORY, "context.create", "out of memory");
    c->desc = own;
    c->report = (reporter){own.log, own.log_user, c->error};
    c->backend = own.backend == MGT_BACKEND_NULL ? &null_backend : own.backend == MGT_BACKEND_GL ? &gl_backend : &cpu_backend;
    c->info.struct_size = sizeof c->info;
    if (own.backend == MGT_BACKEND_AUTO)
        status = create_auto(c, &own, &early);
    else
        status = c->backend->create(&c->state, &own, &early, &c->info);
    if (status != MGT_OK) {
        free(c);
        return status;
    }
    *context = c;
    return MGT_OK;
}

void mgt_context_destroy(mgt_context *context)
{
    if (!context)
        return;
    context->backend->destroy(context->state);
    cpu_backend.destroy(context->cpu);
    free(context);
}

bool context_enter(mgt_context *context)
{
    if (!context || atomic_exchange(&context->busy, true))
        return false;
    context->error[0] = 0;
    return true;
}

mgt_status context_leave(mgt_context *context, mgt_status status)
{
    atomic_store(&context->busy, false);
    return status;
}

const char *mgt_last_error(const mgt_context *context) { return context ? context->error : creation_error_text(); }

mgt_status mgt_context_get_info(const mgt_context *context, mgt_context_info *info)
{
    return context ? struct_give(&context->report, &context_info_kind, &context->info, info) : MGT_ERROR_ARGUMENT;
}

void announce_cpu(mgt_context *context, mgt_method method, const char *lacks)
{
    const uint32_t bit = 1u << method;
    if (!(context->told_of_cpu & bit))
        report(&context->report, context->desc.backend == MGT_BACKEND_AUTO ? MGT_LOG_INFO : MGT_LOG_WARNING, "render.cpu",
               "the CPU renders this frame by method %s: %s on the CPU alone", mgt_method_name(method), lacks);
    context->told_of_cpu |= bit;
}

/* Renders on the CPU a scene that OpenGL does not support. */
static mgt_status render_instead(mgt_context *context, const mgt_scene *own, const mgt_target *targets, size_t count, const char *lacks)
{
    void *state = NULL;
    announce_cpu(context, own->quality.method, lacks);
    const mgt_status status = cpu_state(context, &state);
    return status == MGT_OK ? cpu_backend.render(state, &context->report, own, targets, count) : status;
}

mgt_status scene_ready(const reporter *r, mgt_scene *own)
{
    scene_to_sea_level(own);
    if (method_draws(own))
        return MGT_OK;
    return report_error(
        r, MGT_ERROR_UNSUPPORTED, "render.method",
        "method %s computes the water's surface alone, no objects and no camera under water; ssaa with refraction truth traces them by brute force",
        mgt_method_name(own->quality.method));
}

mgt_status mgt_scene_check(mgt_context *context, const mgt_scene *scene)
{
    if (!context)
        return MGT_ERROR_ARGUMENT;
    context->error[0] = 0;
    mgt_scene own;
    const mgt_status status = scene_take(&context->report, &own, scene);
    return status == MGT_OK ? scene_ready(&context->report, &own) : status;
}

static mgt_status render_frame(mgt_context *context, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    mgt_scene own;
    mgt_target own_targets[MOST_TARGETS];
    mgt_status status = scene_take(&context->report, &own, scene);
    if (status == MGT_OK)
        status = targets_take(&context->report, &own, own_targets, targets, count);
    if (status != MGT_OK)
        return status;
    status = scene_ready(&context->report, &own);
    if (status != MGT_OK)
        return status;
    const char *lacks = NULL;
    for (size_t i = 0; i < count && !lacks && context->backend == &gl_backend; i++)
        lacks = gl_lacks_layer(&own, own_targets[i].layer);
    return lacks ? render_instead(context, &own, own_targets, count, lacks)
                 : context->backend->render(context->state, &context->report, &own, own_targets, count);
}

mgt_status mgt_render(mgt_context *context, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    return context_enter(context) ? context_leave(context, render_frame(context, scene, targets, count)) : MGT_ERROR_ARGUMENT;
}
