/* SPDX-License-Identifier: MIT
 * The functions of mangata/gl.h. They check their arguments and call the backend. */
#include "api/context.h"
#include "api/structs.h"
#include "api/supports.h"
#include "api/validate.h"
#include "frame/targets.h"

static mgt_status check_backend(mgt_context *context, const char *function)
{
    if (context->backend->render_views)
        return MGT_OK;
    return report_error(&context->report, MGT_ERROR_UNAVAILABLE, "gl.context", "%s needs a context of the OpenGL backend", function);
}

/* Members without a meaning yet: what they hold could mean something to a later version. */
static mgt_status check_reserved(const reporter *r, const char *id, const char *what, size_t index, const void *member, size_t size)
{
    const uint8_t *bytes = member;
    for (size_t i = 0; i < size; i++)
        if (bytes[i])
            return report_error(r, MGT_ERROR_ARGUMENT, id, "%s %zu: byte %zu of reserved is %u; allowed is 0", what, index, i, bytes[i]);
    return MGT_OK;
}

static mgt_status render_textures(mgt_context *context, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count)
{
    mgt_status status = check_backend(context, "mgt_gl_render_textures");
    if (status != MGT_OK)
        return status;
    const reporter *r = &context->report;
    mgt_scene own;
    mgt_gl_texture own_textures[MOST_TARGETS];
    status = scene_take(r, &own, scene);
    if (status == MGT_OK)
        status = struct_take(r, &gl_texture_kind, own_textures, textures, count);
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        status = check_reserved(r, "render.texture", "texture", i, &own_textures[i].reserved, sizeof own_textures[i].reserved);
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        if (((int)own_textures[i].layer < 0 || (int)own_textures[i].layer > MGT_LAYER_DETAIL) && own_textures[i].layer != MGT_LAYER_FOAM)
            status = report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: layer %d does not exist", i, (int)own_textures[i].layer);
    if (status != MGT_OK)
        return status;
    scene_to_sea_level(&own);
    if (gl_lacks(&own))
        return report_error(r, MGT_ERROR_UNSUPPORTED, "render.texture", "%s on the CPU alone: use mgt_render()", gl_lacks(&own));
    return context->backend->render_textures(context->state, r, &own, own_textures, count);
}

mgt_status mgt_gl_render_textures(mgt_context *context, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count)
{
    return context_enter(context) ? context_leave(context, render_textures(context, scene, textures, count)) : MGT_ERROR_ARGUMENT;
}

/* Checks out->view, which is set, and fills the other members. */
static mgt_status check_view(const reporter *r, const mgt_scene *scene, size_t index, checked_view *out)
{
    const mgt_gl_view *view = out->view;
    if (view->width == 0 || view->height == 0 || view->width > MGT_MAX_IMAGE_SIDE || view->height > MGT_MAX_IMAGE_SIDE)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: %u x %u pixels; allowed is 1 to %d each way", index, view->width, view->height,
                            MGT_MAX_IMAGE_SIDE);
    const char *wrong = view_rays_of(view, view->view, &out->close);
    if (!wrong && scene->camera_moves)
        wrong = view_rays_of(view, view->view_open, &out->open);
    if (wrong)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: %s", index, wrong);
    out->scene = *scene;
    out->scene.image = (mgt_image){.width = view->width, .height = view->height};
    out->scene.camera = view_camera(&out->close.rays, view->width, view->height);
    if (scene->camera_moves)
        out->scene.camera_open = view_camera(&out->open.rays, view->width, view->height);
    const mgt_status status = validate_scene(r, &out->scene);
    scene_to_sea_level(&out->scene);
    out->close.rays.position[1] -= scene->water.level;
    out->open.rays.position[1] -= scene->water.level;
    if (status == MGT_OK && gl_lacks(&out->scene))
        return report_error(r, MGT_ERROR_UNSUPPORTED, "render.view", "%s on the CPU alone: use mgt_render()", gl_lacks(&out->scene));
    return status;
}

static mgt_status render_views(mgt_context *context, const mgt_scene *scene, const mgt_gl_view *views, size_t count)
{
    mgt_status status = check_backend(context, "mgt_gl_render_views");
    if (status != MGT_OK)
        return status;
    const reporter *r = &context->report;
    mgt_scene own;
    mgt_gl_view own_views[MOST_TARGETS];
    status = struct_take(r, &scene_kind, &own, scene, 1);
    if (status == MGT_OK)
        status = struct_take(r, &gl_view_kind, own_views, views, count);
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        status = check_reserved(r, "render.view", "view", i, own_views[i].reserved, sizeof own_views[i].reserved);
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        if ((int)own_views[i].color < 0 || (int)own_views[i].color > MGT_GL_COLOR_DISPLAY)
            status = report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: color is %d, which names no kind of colour", i, (int)own_views[i].color);
    checked_view checked[MOST_TARGETS];
    for (size_t i = 0; i < count && status == MGT_OK; i++) {
        checked[i] = (checked_view){.view = &own_views[i]};
        status = check_view(r, &own, i, &checked[i]);
    }
    return status == MGT_OK ? context->backend->render_views(context->state, r, checked, count) : status;
}

mgt_status mgt_gl_render_views(mgt_context *context, const mgt_scene *scene, const mgt_gl_view *views, size_t count)
{
    return context_enter(context) ? context_leave(context, render_views(context, scene, views, count)) : MGT_ERROR_ARGUMENT;
}

size_t mgt_gl_get_timings(const mgt_context *context, mgt_gl_timing *timings, size_t capacity)
{
    if (!context || !context->backend->get_timings)
        return 0;
    return context->backend->get_timings(context->state, timings, timings ? capacity : 0);
}

static mgt_status set_sources(mgt_context *context, const mgt_gl_source *sources, size_t count)
{
    mgt_status status = check_backend(context, "mgt_gl_set_sources");
    if (status != MGT_OK)
        return status;
    const reporter *r = &context->report;
    if (count > 0 && !sources)
        return report_error(r, MGT_ERROR_ARGUMENT, "gl.sources", "sources is NULL although count is %zu", count);
    for (size_t i = 0; i < count; i++)
        if (!sources[i].name || !sources[i].text)
            return report_error(r, MGT_ERROR_ARGUMENT, "gl.sources", "source %zu: name or text is NULL", i);
    return context->backend->set_sources(context->state, r, sources, count);
}

mgt_status mgt_gl_set_sources(mgt_context *context, const mgt_gl_source *sources, size_t count)
{
    return context_enter(context) ? context_leave(context, set_sources(context, sources, count)) : MGT_ERROR_ARGUMENT;
}
