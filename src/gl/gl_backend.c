/* SPDX-License-Identifier: MIT
 * The OpenGL backend: its contexts, and mgt_render(), which reads the layers back. */
#include "gl/gl_backend.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame_waves.h"
#include "frame/targets.h"
#include "frame/whole_frame.h"

/* ---- contexts ---- */

static mgt_status check_lost(const gl_backend_state *s, const reporter *r)
{
    return s->renderer->gl.GetGraphicsResetStatus() == GL_NO_ERROR ? MGT_OK : gl_report_lost(r);
}

/* Our own context. */
static mgt_status enter_own(gl_backend_state *s, gl_scope *scope, const reporter *r)
{
    mgt_status status = gl_egl_enter(s->egl, &scope->egl, r);
    if (status != MGT_OK)
        return status;
    status = check_lost(s, r);
    if (status != MGT_OK)
        gl_egl_leave(s->egl, &scope->egl);
    return status;
}

/* A lost context answers no questions about its state. */
static mgt_status enter_host(gl_backend_state *s, gl_scope *scope, const reporter *r)
{
    mgt_status status = check_lost(s, r);
    if (status == MGT_OK && gl_clear_errors(&s->renderer->gl, r))
        status = gl_report_lost(r);
    if (status != MGT_OK)
        return status;
    gl_host_state_save(&s->renderer->gl, &scope->host);
    s->renderer->host = &scope->host;
    return MGT_OK;
}

mgt_status gl_enter(gl_backend_state *s, gl_scope *scope, const reporter *r)
{
    *scope = (gl_scope){0}; /* the context may be lost at any time, and then nothing is written */
    const mgt_status status = s->egl ? enter_own(s, scope, r) : enter_host(s, scope, r);
    if (status != MGT_OK)
        return status;
    gl_timers_frame(&s->renderer->gl, &s->renderer->timers);
    return MGT_OK;
}

mgt_status gl_leave(gl_backend_state *s, const gl_scope *scope, mgt_status status, const reporter *r)
{
    if (status == MGT_OK)
        status = check_lost(s, r);
    if (s->egl) {
        gl_egl_leave(s->egl, &scope->egl);
        return status;
    }
    s->renderer->host = NULL;
    gl_host_state_restore(&s->renderer->gl, &scope->host);
    const mgt_status ended = status == MGT_OK ? gl_check(&s->renderer->gl, "restore", r) : status;
    return ended;
}

static void APIENTRY forward_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length, const GLchar *text, const void *user)
{
    (void)id, (void)length;
    const gl_backend_state *s = user;
    const mgt_log_level level = type == GL_DEBUG_TYPE_ERROR ? MGT_LOG_WARNING : MGT_LOG_DEBUG;
    /* gl_programs.c reports messages of the compiler, and messages of the application are the backend's own debug groups. */
    if (source != GL_DEBUG_SOURCE_SHADER_COMPILER && source != GL_DEBUG_SOURCE_APPLICATION && severity != GL_DEBUG_SEVERITY_NOTIFICATION)
        report(&s->report, level, "gl.message", "%s", text);
}

static void fill_info(const gl_renderer *g, mgt_context_info *info)
{
    const char *renderer = (const char *)g->gl.GetString(GL_RENDERER), *version = (const char *)g->gl.GetString(GL_VERSION);
    info->backend = MGT_BACKEND_GL;
    info->isa = MGT_ISA_AUTO;
    info->lanes = 1;
    info->threads = 1;
    snprintf(info->renderer, sizeof info->renderer, "%s, OpenGL %s", renderer ? renderer : "unknown", version ? version : "");
    info->software = g->limits.software;
}

static void gl_destroy(void *state)
{
    gl_backend_state *s = state;
    if (!s)
        return;
    gl_scope scope;
    const reporter silent = {.error = (char[REPORTER_TEXT]){0}};
    const bool entered = s->renderer && (!s->egl || gl_egl_enter(s->egl, &scope.egl, &silent) == MGT_OK);
    if (entered) {
        gl_buffer_free(&s->renderer->gl, &s->transfer);
        gl_renderer_destroy(s->renderer);
        if (s->egl)
            gl_egl_leave(s->egl, &scope.egl);
    }
    gl_egl_destroy(s->egl);
    free(s);
}

/* Creates the renderer in the current context. */
static mgt_status create_renderer(gl_backend_state *s, const reporter *r, mgt_context_info *info)
{
    const mgt_gl_get_proc get_proc = s->desc.gl_get_proc ? s->desc.gl_get_proc : gl_egl_get_proc;
    const mgt_status status = gl_renderer_create(&s->renderer, get_proc, r);
    if (status != MGT_OK)
        return status;
    s->renderer->threads = s->desc.threads;
    const gl_api *gl = &s->renderer->gl;
    if (s->egl) {
        gl->Enable(GL_DEBUG_OUTPUT);
        gl->DebugMessageCallback(forward_message, s);
    }
    fill_info(s->renderer, info);
    return MGT_OK;
}

static mgt_status gl_create(void **state, const mgt_context_desc *desc, const reporter *r, mgt_context_info *info)
{
    gl_backend_state *s = calloc(1, sizeof *s);
    if (!s)
        return report_error(r, MGT_ERROR_MEMORY, "context.create", "out of memory");
    s->desc = *desc;
    s->report = (reporter){.log = desc->log, .log_user = desc->log_user};
    mgt_status status = MGT_OK;
    gl_egl_scope scope;
    if (!desc->gl_get_proc) {
        status = gl_egl_create(&s->egl, desc->gl_device, r);
        if (status == MGT_OK)
            status = gl_egl_enter(s->egl, &scope, r);
    }
    if (status == MGT_OK) {
        status = create_renderer(s, r, info);
        if (s->egl)
            gl_egl_leave(s->egl, &scope);
    }
    if (status != MGT_OK) {
        gl_destroy(s);
        return status;
    }
    if (info->software && desc->backend == MGT_BACKEND_GL)
        report(r, MGT_LOG_INFO, "context.software", "OpenGL here is software: %s; the CPU backend is faster", info->renderer);
    *state = s;
    return MGT_OK;
}

/* ---- reading back ---- */

/* Largest number of bytes that are read back at once, unless a row has more. */
static const size_t transfer_bytes = (size_t)16 << 20;

/* The image that holds a layer, and how OpenGL reads it back. */
typedef struct layer_source {
    const gl_image *image;
    GLenum format, type;
} layer_source;

static layer_source source_of(const gl_renderer *g, const mgt_target *target)
{
    const gl_layers *l = &g->layers;
    const GLenum channels = target->format == MGT_FORMAT_RGBA32F ? GL_RGBA : GL_RGB;
    if (target->format == MGT_FORMAT_RGBA8_SRGB)
        return (layer_source){&l->display, GL_RGBA, GL_UNSIGNED_BYTE};
    switch (target->layer) {
    case MGT_LAYER_COVERAGE:
        return (layer_source){&l->coverage, GL_RED, GL_FLOAT};
    case MGT_LAYER_MASK:
        return (layer_source){&l->water, GL_RED, GL_FLOAT};
    case MGT_LAYER_DEPTH:
        return (layer_source){&l->depth, GL_RED, GL_FLOAT};
    case MGT_LAYER_NORMAL:
        return (layer_source){&l->normal, channels, GL_FLOAT};
    case MGT_LAYER_SAMPLES:
        return (layer_source){&l->samples, GL_RED, GL_FLOAT};
    case MGT_LAYER_IMPORTANCE:
        return (layer_source){&l->importance, GL_RED, GL_FLOAT};
    case MGT_LAYER_DETAIL:
        return (layer_source){&l->detail, GL_RED, GL_FLOAT};
    case MGT_LAYER_COLOR:
        break;
    case MGT_LAYER_REFRACTION:
        return (layer_source){&g->refraction.seen.body, channels, GL_FLOAT};
    case MGT_LAYER_REFRACTION_ERROR:
        return (layer_source){&g->refraction.seen.error, GL_RED, GL_FLOAT};
    case MGT_LAYER_FOAM:
        return (layer_source){&l->foam, GL_RED, GL_FLOAT};
    }
    return (layer_source){&l->color, channels, GL_FLOAT};
}

/* Reads back the layer of a target. `area` is the part of the image that the layers hold, `crop` the part of it that is read. */
static mgt_status read_target(gl_backend_state *s, const mgt_target *target, const region *area, const region *crop, const reporter *r)
{
    const gl_api *gl = &s->renderer->gl;
    const layer_source source = source_of(s->renderer, target);
    const size_t row = format_size(target->format) * crop->width;
    const uint32_t rows = transfer_bytes / row > 0 ? (uint32_t)(transfer_bytes / row) : 1;
    mgt_status status = gl_buffer_reserve(gl, &s->transfer, row * (rows < crop->height ? rows : crop->height), GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT, r);
    for (uint32_t y = 0; y < crop->height && status == MGT_OK; y += rows) {
        const uint32_t count = crop->height - y < rows ? crop->height - y : rows;
        const size_t size = row * count;
        gl->BindBuffer(GL_PIXEL_PACK_BUFFER, s->transfer.name);
        gl->GetTextureSubImage(source.image->name, 0, (GLint)(crop->x - area->x), (GLint)(crop->y - area->y + y), 0, (GLsizei)crop->width, (GLsizei)count, 1,
                               source.format, source.type, (GLsizei)s->transfer.size, NULL);
        gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        const char *pixels = gl->MapNamedBufferRange(s->transfer.name, 0, (GLsizeiptr)size, GL_MAP_READ_BIT);
        if (!pixels)
            return gl_check(gl, "readback", r) == MGT_OK ? report_error(r, MGT_ERROR_MEMORY, "gl.memory", "OpenGL cannot map %zu bytes", size)
                                                         : MGT_ERROR_MEMORY;
        for (uint32_t i = 0; i < count; i++)
            memcpy(target_row(target, crop, y + i), pixels + row * i, row);
        gl->UnmapNamedBuffer(s->transfer.name);
        status = gl_check(gl, "readback", r);
    }
    return status;
}

/* ---- mgt_render ---- */

/* The camera of a job of mgt_render(): see gl_camera_at. `user` is its frame. A camera before the shutter opens is one of method taa. */
static camera_rays scene_camera_at(const void *user, double share)
{
    const frame *f = user;
    if (share >= 0)
        return camera_at(f, share);
    const mgt_camera camera = taa_camera(f->scene, 1 - share);
    const camera_rays rays = camera_rays_of(&camera, f->scene->image.width, f->scene->image.height);
    return rays_above(f, &rays);
}

void layer_wants_add(layer_wants *w, mgt_layer layer, bool display)
{
    w->color |= layer == MGT_LAYER_COLOR;
    w->pixels |= layer <= MGT_LAYER_MASK;
    w->depth |= layer == MGT_LAYER_DEPTH;
    w->normal |= layer == MGT_LAYER_NORMAL;
    w->foam |= layer == MGT_LAYER_FOAM;
    w->display |= display;
    w->spent |= layer >= MGT_LAYER_SAMPLES && layer <= MGT_LAYER_DETAIL;
}

mgt_status gl_layers_render(gl_backend_state *s, const reporter *r, const mgt_scene *scene, const layer_wants *wants, bool report_progress, region *area)
{
    mgt_status status = gl_frame_begin(s->renderer, scene, r);
    if (status != MGT_OK)
        return status;
    frame *const f = &s->renderer->frame;
    frame_make(scene, s->renderer->sky, wants->color, f);
    *area = image_region(&scene->image);
    if ((wants->display && scene->post.glare > 0) || method_of(scene->quality.method)->way == METHOD_PASS)
        *area = (region){0, 0, scene->image.width, scene->image.height};
    const bool adapts = method_of(scene->quality.method)->pass == METHOD_PASS_ADAPTIVE;
    const gl_job job = {
        .frame = f,
        .camera_at = scene_camera_at,
        .camera_user = f,
        .area = *area,
        .wants_pixels = wants->pixels || (wants->spent && adapts),
        .wants_depth = wants->depth,
        .wants_normal = wants->normal,
        .wants_foam = wants->foam,
        .background = true,
        .progress = report_progress ? s->desc.progress : NULL,
        .progress_user = s->desc.progress_user,
    };
    status = gl_frame_render(s->renderer, &job, r);
    if (status == MGT_OK && wants->spent && !adapts)
        status = gl_spent_fill(s->renderer, area, &scene->quality, r);
    return status == MGT_OK && wants->display ? gl_display_render(s->renderer, f, area, r) : status;
}

static mgt_status render_entered(gl_backend_state *s, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    layer_wants wants = {0};
    for (size_t i = 0; i < count; i++)
        layer_wants_add(&wants, targets[i].layer, targets[i].format == MGT_FORMAT_RGBA8_SRGB);
    region area;
    const region crop = image_region(&scene->image);
    mgt_status status = gl_layers_render(s, r, scene, &wants, true, &area);
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        status = read_target(s, &targets[i], &area, &crop, r);
    return status;
}

static mgt_status gl_render(void *state, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    gl_backend_state *s = state;
    gl_scope scope;
    mgt_status status = gl_enter(s, &scope, r);
    if (status != MGT_OK)
        return status;
    status = render_entered(s, r, scene, targets, count);
    return gl_leave(s, &scope, status, r);
}

/* ---- sources and timings ---- */

static mgt_status gl_set_sources(void *state, const reporter *r, const mgt_gl_source *sources, size_t count)
{
    gl_backend_state *s = state;
    for (size_t i = 0; i < count; i++)
        if (!gl_text_exists(sources[i].name))
            return report_error(r, MGT_ERROR_ARGUMENT, "gl.sources", "source %zu: there is no file \"%s\" to replace", i, sources[i].name);
    gl_scope scope;
    mgt_status status = gl_enter(s, &scope, r);
    if (status != MGT_OK)
        return status;
    status = gl_programs_replace(&s->renderer->programs, sources, count, r);
    return gl_leave(s, &scope, status, r);
}

static size_t gl_get_timings(const void *state, mgt_gl_timing *timings, size_t capacity)
{
    const gl_timers *t = &((const gl_backend_state *)state)->renderer->timers;
    for (size_t i = 0; i < t->count && i < capacity; i++)
        timings[i] = t->timings[i];
    return t->count;
}

const backend_functions gl_backend = {
    .create = gl_create,
    .destroy = gl_destroy,
    .render = gl_render,
    .render_textures = gl_render_textures,
    .render_views = gl_render_views,
    .set_sources = gl_set_sources,
    .get_timings = gl_get_timings,
};
