/* SPDX-License-Identifier: MIT
 * The functions of mangata/gl.h: checks of their arguments, then the backend. */
#include "core/context.h"
#include "core/validate.h"

mgt_gl_view mgt_gl_view_defaults(void)
{
    mgt_gl_view view = {.struct_size = sizeof view};
    for (int i = 0; i < 4; i++)
        view.view[5 * i] = view.projection[5 * i] = view.view_open[5 * i] = 1;
    return view;
}

mgt_gl_texture mgt_gl_texture_defaults(void) { return (mgt_gl_texture){.struct_size = sizeof(mgt_gl_texture), .layer = MGT_LAYER_COLOR}; }

static mgt_status check_backend(mgt_context *context, const char *function)
{
    if (!context)
        return MGT_ERROR_ARGUMENT;
    context->error[0] = 0;
    if (context->backend->render_views)
        return MGT_OK;
    return report_error(&context->report, MGT_ERROR_UNAVAILABLE, "gl.context", "%s needs a context of the OpenGL backend", function);
}

static mgt_status check_count(const reporter *r, const char *id, const char *what, const void *first, size_t count)
{
    if (first && count >= 1 && count <= 16)
        return MGT_OK;
    return report_error(r, MGT_ERROR_ARGUMENT, id, "%zu %s; allowed is 1 to 16 and a pointer to them", count, what);
}

mgt_status mgt_gl_render_textures(mgt_context *context, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count)
{
    mgt_status status = check_backend(context, "mgt_gl_render_textures");
    if (status != MGT_OK)
        return status;
    const reporter *r = &context->report;
    status = validate_scene(r, scene);
    if (status == MGT_OK)
        status = check_count(r, "render.texture", "textures", textures, count);
    for (size_t i = 0; i < count && status == MGT_OK; i++) {
        if (textures[i].struct_size != sizeof *textures)
            status = report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: struct_size is %zu, this library knows %zu", i,
                                  textures[i].struct_size, sizeof *textures);
        else if ((int)textures[i].layer < 0 || (int)textures[i].layer > MGT_LAYER_NORMAL)
            status = report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: layer %d does not exist", i, (int)textures[i].layer);
    }
    if (status != MGT_OK)
        return status;
    const mgt_scene ours = scene_at_sea_level(scene);
    return context->backend->render_textures(context->state, r, &ours, textures, count);
}

mgt_status mgt_gl_render_views(mgt_context *context, const mgt_scene *scene, const mgt_gl_view *views, size_t count)
{
    mgt_status status = check_backend(context, "mgt_gl_render_views");
    if (status != MGT_OK)
        return status;
    const reporter *r = &context->report;
    if (!scene || scene->struct_size != sizeof *scene)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.scene", "the scene is NULL, or its struct_size is not the one that this library knows");
    status = check_count(r, "render.view", "views", views, count);
    for (size_t i = 0; i < count && status == MGT_OK; i++) {
        if (views[i].struct_size != sizeof *views)
            status = report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: struct_size is %zu, this library knows %zu", i, views[i].struct_size,
                                  sizeof *views);
        else if ((int)views[i].color < 0 || (int)views[i].color > MGT_GL_COLOR_DISPLAY)
            status = report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: color is %d, which names no kind of colour", i, (int)views[i].color);
    }
    return status == MGT_OK ? context->backend->render_views(context->state, r, scene, views, count) : status;
}

size_t mgt_gl_get_timings(const mgt_context *context, mgt_gl_timing *timings, size_t capacity)
{
    if (!context || !context->backend->get_timings)
        return 0;
    return context->backend->get_timings(context->state, timings, timings ? capacity : 0);
}

mgt_status mgt_gl_set_sources(mgt_context *context, const mgt_gl_source *sources, size_t count)
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
