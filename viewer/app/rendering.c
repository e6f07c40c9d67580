/* SPDX-License-Identifier: MIT
 * Decides what is rendered, by which renderer and at which size. Workers get orders, OpenGL renders straight into textures. */
#include <GLFW/glfw3.h>

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/common/memory_text.h"
#include "cli/common/progress.h"
#include "params/methods.h"
#include "params/scene_rows.h"
#include "scene/scene_models.h"
#include "viewer/app/viewer.h"

/* Frames a second that moving pictures shall have, seconds after the last change until the picture counts as still, and the least fraction of the full size. */
static const double moving_rate = 30, still_after = 0.25, least_scale = 0.2;

/* ---- start and end ---- */

static void on_log(void *user, mgt_log_level level, const char *id, const char *text)
{
    viewer *v = user;
    if (level == MGT_LOG_WARNING || level == MGT_LOG_INFO)
        viewer_log(v, "%s [%s]", text, id);
}

static void wake(void) { glfwPostEmptyEvent(); }

mgt_context_desc viewer_cpu_desc(const viewer *v)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.isa = v->request->context.isa;
    desc.threads = v->request->context.threads;
    return desc;
}

/* Starts OpenGL in the window's context. False: `why` says why it is not used. */
static bool start_gl(viewer *v, char *why, size_t size)
{
    mgt_context_desc desc = viewer_cpu_desc(v);
    desc.backend = MGT_BACKEND_GL;
    desc.gl_get_proc = glfwGetProcAddress;
    if (v->request->context.backend == MGT_BACKEND_GL) { /* if it is only tried, its failure is reported with another line */
        desc.log = on_log;
        desc.log_user = v;
    }
    if (!v->gl_functions.TexStorage2D || mgt_context_create(&v->render.gl, &desc) != MGT_OK) {
        snprintf(why, size, "%s", v->gl_functions.TexStorage2D ? mgt_last_error(NULL) : "the window's OpenGL is older than 4.5");
        return false;
    }
    v->render.info.struct_size = sizeof v->render.info;
    mgt_context_get_info(v->render.gl, &v->render.info);
    if (v->request->context.backend != MGT_BACKEND_AUTO || !v->render.info.software)
        return true;
    snprintf(why, size, "OpenGL here is a software rasteriser (%s)", v->render.info.renderer);
    mgt_context_destroy(v->render.gl);
    v->render.gl = NULL;
    return false;
}

static bool start_live(viewer *v, char *why, size_t size)
{
    const mgt_context_desc desc = viewer_cpu_desc(v);
    v->render.live = render_worker_create(&desc, false, wake, why, size);
    if (v->render.live)
        v->render.info = render_worker_info(v->render.live);
    return v->render.live != NULL;
}

bool viewer_start_rendering(viewer *v)
{
    char why[VIEWER_TEXT] = "";
    const mgt_context_desc desc = viewer_cpu_desc(v);
    v->render.refining = render_worker_create(&desc, true, wake, why, sizeof why);
    bool good = v->render.refining != NULL;
    if (good && v->request->context.backend != MGT_BACKEND_CPU) {
        good = start_gl(v, why, sizeof why);
        if (!good && v->request->context.backend == MGT_BACKEND_AUTO)
            viewer_report(v, false, "the CPU renders: %s", why);
    }
    if (v->render.refining && !v->render.gl && v->request->context.backend != MGT_BACKEND_GL)
        good = start_live(v, why, sizeof why);
    if (!good)
        v->exit_code = console_error(EXIT_CODE_UNAVAILABLE, "%s", why);
    return good;
}

void viewer_stop_rendering(viewer *v)
{
    render_worker_destroy(v->render.live);
    render_worker_destroy(v->render.refining);
    mgt_context_destroy(v->render.gl);
    mgt_context_destroy(v->render.tools);
    for (int side = 0; side < SIDE_COUNT; side++)
        picture_free(&v->render.pictures[side]);
    scene_models_release(v->render.ordered.models);
    v->render = (renderers){0};
}

mgt_context *viewer_tools(viewer *v)
{
    mgt_context_desc desc = viewer_cpu_desc(v);
    desc.threads = 1;
    if (!v->render.tools && mgt_context_create(&v->render.tools, &desc) != MGT_OK)
        viewer_report(v, true, "%s", mgt_last_error(NULL));
    return v->render.tools;
}

/* ---- size ---- */

/* The fraction of each side at which moving pictures are estimated to have moving_rate. */
static double moving_scale(const viewer *v)
{
    const double pixels = (double)v->place.width * v->place.height, seconds = v->render.seconds_per_pixel * pixels;
    if (!(seconds > 0))
        return v->render.gl ? 1 : 0.5; /* not measured yet */
    return fmin(fmax(sqrt(0.8 / (moving_rate * seconds)), least_scale), 1);
}

/* The fraction of each side at which the settings want the picture. */
static double wanted_scale(const viewer *v, bool moving)
{
    switch ((resolution_mode)v->settings.view.resolution) {
    case RESOLUTION_FULL:
        return 1;
    case RESOLUTION_HALF:
        return 1 / 2.0;
    case RESOLUTION_THIRD:
        return 1 / 3.0;
    case RESOLUTION_QUARTER:
        return 1 / 4.0;
    case RESOLUTION_AUTO:
        break;
    }
    return moving ? moving_scale(v) : 1;
}

/* The scale at which the picture fits into a texture of the window, at most `scale`. */
static double fitting_scale(const viewer *v, double scale)
{
    const uint32_t side = v->place.width > v->place.height ? v->place.width : v->place.height;
    return fmin(scale, (double)display_most_side(v->display) / side);
}

/* Pixels of a scaled side. The scale has steps of an eighth, so that sizes do not change from frame to frame. */
static uint32_t scaled(uint32_t side, double scale)
{
    const double stepped = scale < 1 && scale > least_scale ? fmax(floor(scale * 8) / 8, least_scale) : scale;
    const double pixels = ceil(side * stepped);
    return pixels > 1 ? (uint32_t)pixels : 1;
}

/* ---- orders ---- */

/* Whether two shots show the same scene. */
static bool same_shot(const shot *a, const shot *b)
{
    const mgt_scene *s = &a->scene, *t = &b->scene;
    bool same = fields_equal(scene_rows, s, t) && (!s->camera_moves || fields_equal(camera_rows, &s->camera_open, &t->camera_open)) &&
                s->post.auto_exposure == t->post.auto_exposure && s->objects == t->objects && s->water.wave_count == t->water.wave_count;
    for (size_t i = 0; i < s->water.wave_count && same; i++)
        same = fields_equal(wave_rows, &a->waves[i], &b->waves[i]);
    return same;
}

/* Copies a shot with a share of its models. Releases those that `to` has had. */
static void copy_shot(shot *to, const shot *from)
{
    scene_models_release(to->models);
    to->models = scene_models_share(from->models);
    to->scene = from->scene;
    memcpy(to->waves, from->waves, from->scene.water.wave_count * sizeof *to->waves);
    to->scene.water.waves = to->waves;
}

static bool side_refines(const mgt_quality *q) { return method_is_sampled(q->method); }

/* The order for what the settings ask for, still without a scene. */
static render_order order_of(const viewer *v)
{
    render_order o = {.serial = v->render.serial, .layer = (mgt_layer)v->settings.view.layer};
    o.wanted[SIDE_A] = true;
    o.wanted[SIDE_B] = v->settings.view.compare != COMPARE_OFF;
    for (int side = 0; side < SIDE_COUNT; side++)
        o.quality[side] = quality_restricted(&v->settings.sides[side]);
    return o;
}

/* Whether two orders ask for the same layer, sides and qualities. */
static bool same_wishes(const render_order *a, const render_order *b)
{
    bool same = a->layer == b->layer && a->wanted[SIDE_B] == b->wanted[SIDE_B];
    for (int side = 0; side < SIDE_COUNT; side++)
        same &= !a->wanted[side] || fields_equal(quality_fields, &a->quality[side], &b->quality[side]);
    return same;
}

void viewer_lose_gl(viewer *v, const char *why)
{
    char problem[VIEWER_TEXT];
    if (!v->render.gl)
        return;
    viewer_report(v, true, "OpenGL gave up, the CPU renders: %s", why);
    mgt_context_destroy(v->render.gl);
    v->render.gl = NULL;
    if (!start_live(v, problem, sizeof problem))
        viewer_report(v, true, "%s", problem);
    v->render.last.serial = 0;
}

static void count_seconds(viewer *v, double seconds, uint32_t width, uint32_t height)
{
    const double per_pixel = seconds / ((double)width * height);
    v->render.seconds_per_pixel = v->render.seconds_per_pixel > 0 ? 0.7 * v->render.seconds_per_pixel + 0.3 * per_pixel : per_pixel;
    timing_add(&v->timings.render, seconds);
}

/* Renders sides without samples into their textures. If OpenGL fails for good, the CPU takes over. */
static void render_gl(viewer *v, const render_order *o)
{
    for (int side = 0; side < SIDE_COUNT && v->render.gl; side++) {
        if (!o->wanted[side] || side_refines(&o->quality[side]))
            continue;
        mgt_scene scene = o->scene;
        mgt_gl_texture texture;
        mgt_gl_texture_init(&texture, sizeof texture);
        scene.quality = o->quality[side];
        texture.layer = o->layer;
        texture.texture = display_texture(v->display, side, o->layer, scene.image.width, scene.image.height);
        const mgt_status status = mgt_gl_render_textures(v->render.gl, &scene, &texture, 1);
        if (status == MGT_OK)
            v->render.shown[side] = o->serial;
        else if (status == MGT_ERROR_SCENE || status == MGT_ERROR_UNSUPPORTED || status == MGT_ERROR_ARGUMENT)
            snprintf(v->render_error.text, sizeof v->render_error.text, "%s", mgt_last_error(v->render.gl));
        else
            viewer_lose_gl(v, mgt_last_error(v->render.gl));
    }
    if (!v->render.gl)
        return;
    v->timings.pass_count = mgt_gl_get_timings(v->render.gl, v->timings.passes, PASS_COUNT);
    v->timings.pass_count = v->timings.pass_count < PASS_COUNT ? v->timings.pass_count : PASS_COUNT;
    double sum = 0;
    for (size_t i = 0; i < v->timings.pass_count; i++)
        sum += v->timings.passes[i].seconds;
    if (sum > 0)
        count_seconds(v, sum, o->scene.image.width, o->scene.image.height);
}

/* Gives an order to all renderers that it concerns. */
static void post(viewer *v, render_order *o)
{
    bool live = false, refining = false;
    for (int side = 0; side < SIDE_COUNT; side++)
        if (o->wanted[side])
            *(side_refines(&o->quality[side]) ? &refining : &live) = true;
    v->render_error.text[0] = 0;
    if (live && v->render.gl)
        render_gl(v, o);
    else if (live && v->render.live)
        render_worker_post(v->render.live, o);
    /* The worker also gets an order that needs no refinement, because it must stop what it is doing. */
    if (refining || side_refines(&v->render.last.quality[SIDE_A]) || side_refines(&v->render.last.quality[SIDE_B]))
        render_worker_post(v->render.refining, o);
}

static bool worker_is_behind(const viewer *v) { return v->render.live && !render_worker_is_idle(v->render.live); }

/* Gives a new order if what is shown or its size has changed. */
static void order(viewer *v)
{
    shot now;
    if (!viewer_take_shot(v, &now))
        return;
    const double time = seconds_now();
    render_order o = order_of(v);
    const bool changed = v->render.last.serial == 0 || !same_wishes(&o, &v->render.last) || !same_shot(&now, &v->render.ordered);
    if (changed)
        v->render.changed_at = v->render.last.serial == 0 ? -1 : time;
    const bool moving = time - v->render.changed_at < still_after;
    const double wanted = wanted_scale(v, moving), scale = fitting_scale(v, wanted);
    o.scene = now.scene;
    o.scene.image = (mgt_image){.width = scaled(v->place.width, scale), .height = scaled(v->place.height, scale)};
    const mgt_image *old = &v->render.last.scene.image;
    const bool resized = o.scene.image.width != old->width || o.scene.image.height != old->height;
    /* While something moves, a frame is ordered after the one before it is done. A change of size alone waits until nothing moves. */
    if (!changed && (!resized || (moving && v->settings.view.resolution == RESOLUTION_AUTO && v->render.reduced)))
        return;
    v->render.behind = changed && moving && worker_is_behind(v) && !v->render.last.interruptible;
    if (v->render.behind)
        return;
    o.serial = ++v->render.serial;
    o.interruptible = !moving;
    copy_shot(&v->render.ordered, &now);
    o.scene.water.waves = v->render.ordered.waves;
    o.models = v->render.ordered.models;
    v->render.reduced = wanted < 1 && v->settings.view.resolution == RESOLUTION_AUTO;
    const bool by_gl = v->render.gl != NULL;
    post(v, &o);
    v->render.last = o;
    if (by_gl && !v->render.gl) /* OpenGL has given up on this order: the worker gets one of its own */
        v->render.last.serial = 0;
}

/* ---- results ---- */

/* Takes the pictures of a worker into textures, and its error. */
static void take(viewer *v, render_worker *w, bool refines)
{
    char text[VIEWER_TEXT];
    for (int side = 0; w && side < SIDE_COUNT; side++) {
        picture *p = &v->render.pictures[side];
        if (!v->render.last.wanted[side] || side_refines(&v->render.last.quality[side]) != refines || !render_worker_take(w, side, p))
            continue;
        if (p->layer != v->render.last.layer)
            continue;
        display_upload(v->display, side, p->layer, p->width, p->height, p->pixels);
        v->render.shown[side] = p->serial;
        if (!refines)
            count_seconds(v, p->seconds, p->width, p->height);
    }
    if (w && render_worker_take_error(w, text, sizeof text)) {
        snprintf(v->render_error.text, sizeof v->render_error.text, "%s", text);
        v->render_error.is_error = true;
        viewer_log(v, "%s", text);
    }
}

/* ---- kernel files of --shaders ---- */

/* The files of a folder that replace texts of the library. `stamp` is a number that changes if one of them changes. */
typedef struct shader_files {
    mgt_gl_source *sources; /* room for as many as the library has; use_shader_files() reads their texts */
    char (*paths)[1024];
    size_t count, room;
    int64_t stamp;
} shader_files;

/* The library's own string that equals `name`; NULL: the library has no text of that name. */
static const char *library_name(const char *name)
{
    const char *known;
    for (size_t i = 0; (known = mgt_gl_source_name(i)); i++)
        if (strcmp(known, name) == 0)
            return known;
    return NULL;
}

static void add_shader_file(shader_files *f, const char *path, const char *name, const struct stat *status)
{
    const char *known = library_name(name);
    for (size_t i = 0; i < f->count; i++)
        if (known == f->sources[i].name)
            known = NULL;
    if (!known || f->count == f->room)
        return;
    f->sources[f->count] = (mgt_gl_source){.name = known};
    snprintf(f->paths[f->count++], sizeof *f->paths, "%s", path);
    f->stamp = f->stamp * 31 + (int64_t)status->st_mtim.tv_sec * 1000003 + status->st_mtim.tv_nsec + status->st_size;
}

/* Finds the files of a folder and its subfolders in the order of their names, so that the same files give the same stamp. Of two files of one name the first
 * counts. */
static void find_shader_files(shader_files *f, const char *folder, int depth)
{
    struct dirent **entries = NULL;
    const int count = depth < 8 ? scandir(folder, &entries, NULL, alphasort) : 0;
    for (int i = 0; i < count; i++) {
        char path[1024];
        struct stat status;
        snprintf(path, sizeof path, "%.760s/%.255s", folder, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.' && stat(path, &status) == 0) {
            if (S_ISDIR(status.st_mode))
                find_shader_files(f, path, depth + 1);
            else
                add_shader_file(f, path, entries[i]->d_name, &status);
        }
        free(entries[i]);
    }
    free(entries);
}

/* Gives the files to OpenGL. An error leaves the former ones in use. */
static void use_shader_files(viewer *v, shader_files *f)
{
    size_t good = 0;
    for (size_t i = 0; i < f->count; i++) {
        size_t size;
        char *text = memory_text_read(f->paths[i], &size);
        if (text)
            f->sources[good++] = (mgt_gl_source){f->sources[i].name, text};
    }
    const mgt_status status = mgt_gl_set_sources(v->render.gl, f->sources, good);
    for (size_t i = 0; i < good; i++)
        free((char *)f->sources[i].text);
    if (status == MGT_OK) {
        v->shader_error.text[0] = 0;
        v->render.last.serial = 0;
        viewer_report(v, false, "%s: %zu shader files in use", v->request->shader_folder, good);
    } else {
        snprintf(v->shader_error.text, sizeof v->shader_error.text, "%s", mgt_last_error(v->render.gl));
        v->shader_error.is_error = true;
        viewer_log(v, "%s", v->shader_error.text);
    }
}

void viewer_poll_shaders(viewer *v)
{
    shader_files f = {.stamp = 1};
    if (!v->request->shader_folder || !v->render.gl)
        return;
    while (mgt_gl_source_name(f.room))
        f.room++;
    f.sources = calloc(f.room + 1, sizeof *f.sources);
    f.paths = calloc(f.room + 1, sizeof *f.paths);
    if (f.sources && f.paths)
        find_shader_files(&f, v->request->shader_folder, 0);
    if (f.sources && f.paths && f.stamp != v->render.shader_stamp) {
        v->render.shader_stamp = f.stamp;
        use_shader_files(v, &f);
    }
    free(f.sources);
    free(f.paths);
}

/* ---- every frame ---- */

void viewer_render(viewer *v)
{
    take(v, v->render.live, false);
    take(v, v->render.refining, true);
    order(v);
}

bool viewer_is_settled(const viewer *v, uint64_t samples)
{
    if (v->render.last.serial == 0 || v->render.behind || v->render.reduced)
        return false;
    for (int side = 0; side < SIDE_COUNT; side++) {
        const picture *p = &v->render.pictures[side];
        if (!v->render.last.wanted[side] || v->render_error.text[0])
            continue;
        if (v->render.shown[side] != v->render.serial)
            return false;
        if (side_refines(&v->render.last.quality[side]) && p->samples < p->samples_total && (samples == 0 || p->samples < samples))
            return false;
    }
    return true;
}
