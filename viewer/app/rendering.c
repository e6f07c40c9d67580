/* SPDX-License-Identifier: MIT
 * What is rendered, where and at which size: orders to the workers, or straight into textures by OpenGL. */
#include <GLFW/glfw3.h>

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/common/progress.h"
#include "params/methods.h"
#include "viewer/app/viewer.h"

/* Frames a second that moving pictures hold, how long after the last change they count as still, and how small they may get. */
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

/* OpenGL on the window's context. False with the reason in `why`. */
static bool start_gl(viewer *v, char *why, size_t size)
{
    mgt_context_desc desc = viewer_cpu_desc(v);
    desc.backend = MGT_BACKEND_GL;
    desc.gl_get_proc = glfwGetProcAddress;
    if (v->request->context.backend == MGT_BACKEND_GL) { /* what is only tried says its own line */
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
            viewer_tell(v, false, "the CPU renders: %s", why);
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
    v->render = (renderers){0};
}

mgt_context *viewer_tools(viewer *v)
{
    mgt_context_desc desc = viewer_cpu_desc(v);
    desc.threads = 1;
    if (!v->render.tools && mgt_context_create(&v->render.tools, &desc) != MGT_OK)
        viewer_tell(v, true, "%s", mgt_last_error(NULL));
    return v->render.tools;
}

/* ---- size ---- */

/* The share of the full size at which moving pictures keep their rate. */
static double moving_scale(const viewer *v)
{
    const double pixels = (double)v->place.width * v->place.height, seconds = v->render.seconds_per_pixel * pixels;
    if (!(seconds > 0))
        return v->render.gl ? 1 : 0.5; /* not measured yet */
    return fmin(fmax(sqrt(0.8 / (moving_rate * seconds)), least_scale), 1);
}

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

/* Steps of an eighth, so that sizes do not change from frame to frame. */
static uint32_t scaled(uint32_t side, double scale)
{
    const double stepped = scale < 1 && scale > least_scale ? fmax(floor(scale * 8) / 8, least_scale) : scale;
    const double pixels = ceil(side * stepped);
    return pixels > 1 ? (uint32_t)pixels : 1;
}

/* ---- orders ---- */

static bool same_quality(const mgt_quality *a, const mgt_quality *b)
{
    return a->method == b->method && a->spatial_samples == b->spatial_samples && a->time_samples == b->time_samples && a->seed == b->seed &&
           a->ndf_mean_drop == b->ndf_mean_drop;
}

static bool same_camera(const mgt_camera *a, const mgt_camera *b) { return memcmp(a, b, sizeof *a) == 0; }

static bool same_light(const mgt_light *a, const mgt_light *b)
{
    return a->body == b->body && a->elevation_deg == b->elevation_deg && a->azimuth_deg == b->azimuth_deg && a->angular_radius_deg == b->angular_radius_deg &&
           memcmp(a->radiance, b->radiance, sizeof a->radiance) == 0;
}

static bool same_shot(const shot *a, const shot *b)
{
    const mgt_scene *s = &a->scene, *t = &b->scene;
    return same_camera(&s->camera, &t->camera) && s->camera_moves == t->camera_moves && (!s->camera_moves || same_camera(&s->camera_open, &t->camera_open)) &&
           s->time == t->time && s->shutter == t->shutter && same_light(&s->light, &t->light) && memcmp(&s->sky, &t->sky, sizeof s->sky) == 0 &&
           s->water.wave_count == t->water.wave_count && memcmp(a->waves, b->waves, s->water.wave_count * sizeof *a->waves) == 0 &&
           s->water.index_of_refraction == t->water.index_of_refraction &&
           memcmp(s->water.body_albedo, t->water.body_albedo, sizeof s->water.body_albedo) == 0 && s->water.level == t->water.level &&
           memcmp(s->water.absorption, t->water.absorption, sizeof s->water.absorption) == 0 &&
           memcmp(s->water.scattering, t->water.scattering, sizeof s->water.scattering) == 0 && s->objects == t->objects &&
           s->post.auto_exposure == t->post.auto_exposure && s->post.exposure_ev == t->post.exposure_ev && s->post.tone_map == t->post.tone_map &&
           s->post.glare == t->post.glare;
}

static void copy_shot(shot *to, const shot *from)
{
    to->scene = from->scene;
    memcpy(to->waves, from->waves, from->scene.water.wave_count * sizeof *to->waves);
    to->scene.water.waves = to->waves;
}

static bool side_refines(const mgt_quality *q) { return method_takes(q->method, METHOD_TAKES_TIMES); }

static render_order order_of(const viewer *v)
{
    render_order o = {.serial = v->render.serial, .layer = (mgt_layer)v->settings.view.layer};
    o.wanted[SIDE_A] = true;
    o.wanted[SIDE_B] = v->settings.view.compare != COMPARE_OFF;
    for (int side = 0; side < SIDE_COUNT; side++)
        o.quality[side] = side_quality(&v->settings.sides[side]);
    return o;
}

/* Whether the two orders differ in what their sides show. */
static bool same_wishes(const render_order *a, const render_order *b)
{
    bool same = a->layer == b->layer && a->wanted[SIDE_B] == b->wanted[SIDE_B];
    for (int side = 0; side < SIDE_COUNT; side++)
        same &= !a->wanted[side] || same_quality(&a->quality[side], &b->quality[side]);
    return same;
}

void viewer_lose_gl(viewer *v, const char *why)
{
    char problem[VIEWER_TEXT];
    if (!v->render.gl)
        return;
    viewer_tell(v, true, "OpenGL gave up, the CPU renders: %s", why);
    mgt_context_destroy(v->render.gl);
    v->render.gl = NULL;
    if (!start_live(v, problem, sizeof problem))
        viewer_tell(v, true, "%s", problem);
    v->render.last.serial = 0;
}

static void count_seconds(viewer *v, double seconds, uint32_t width, uint32_t height)
{
    const double per_pixel = seconds / ((double)width * height);
    v->render.seconds_per_pixel = v->render.seconds_per_pixel > 0 ? 0.7 * v->render.seconds_per_pixel + 0.3 * per_pixel : per_pixel;
    timing_add(&v->timings.render, seconds);
}

/* Sides without samples, straight into their textures. */
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
    /* Also when there is nothing to refine any more, to end what is under way. */
    if (refining || side_refines(&v->render.last.quality[SIDE_A]) || side_refines(&v->render.last.quality[SIDE_B]))
        render_worker_post(v->render.refining, o);
}

static bool worker_is_behind(const viewer *v) { return v->render.live && !render_worker_is_idle(v->render.live); }

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
    const double scale = wanted_scale(v, moving);
    o.scene = now.scene;
    o.scene.image = (mgt_image){.width = scaled(v->place.width, scale), .height = scaled(v->place.height, scale)};
    const mgt_image *old = &v->render.last.scene.image;
    const bool resized = o.scene.image.width != old->width || o.scene.image.height != old->height;
    /* While things move, one frame after the other; a size alone waits until they rest. */
    if (!changed && (!resized || (moving && v->settings.view.resolution == RESOLUTION_AUTO && v->render.reduced)))
        return;
    v->render.behind = changed && moving && worker_is_behind(v) && !v->render.last.interruptible;
    if (v->render.behind)
        return;
    o.serial = ++v->render.serial;
    o.interruptible = !moving;
    copy_shot(&v->render.ordered, &now);
    o.scene.water.waves = v->render.ordered.waves;
    v->render.reduced = scale < 1 && v->settings.view.resolution == RESOLUTION_AUTO;
    post(v, &o);
    v->render.last = o;
}

/* ---- results ---- */

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

enum { MOST_SOURCES = 32 };

static char *read_text(const char *path)
{
    FILE *stream = fopen(path, "rb");
    char *text = NULL;
    size_t size = 0;
    FILE *memory = stream ? open_memstream(&text, &size) : NULL;
    char block[4096];
    for (size_t n; memory && (n = fread(block, 1, sizeof block, stream)) > 0;)
        fwrite(block, 1, n, memory);
    if (stream)
        fclose(stream);
    if (memory)
        fclose(memory);
    return text;
}

static bool is_kernel(const char *name)
{
    const size_t length = strlen(name);
    return length > 2 && length < 60 && strcmp(name + length - 2, ".k") == 0;
}

void viewer_poll_shaders(viewer *v)
{
    const char *folder = v->request->shader_folder;
    mgt_gl_source sources[MOST_SOURCES];
    char names[MOST_SOURCES][64], *texts[MOST_SOURCES];
    size_t count = 0;
    int64_t stamp = 1;
    DIR *listing = folder && v->render.gl ? opendir(folder) : NULL;
    if (!listing)
        return;
    for (struct dirent *entry; (entry = readdir(listing)) && count < MOST_SOURCES;) {
        char path[1024];
        struct stat status;
        if (!is_kernel(entry->d_name))
            continue;
        snprintf(path, sizeof path, "%.900s/%.60s", folder, entry->d_name);
        if (stat(path, &status) != 0)
            continue;
        stamp += (int64_t)status.st_mtim.tv_sec * 1000003 + status.st_mtim.tv_nsec + status.st_size;
        snprintf(names[count], sizeof names[count], "%.60s", entry->d_name);
        texts[count] = NULL;
        count++;
    }
    closedir(listing);
    if (stamp == v->render.shader_stamp)
        return;
    v->render.shader_stamp = stamp;
    size_t good = 0;
    for (size_t i = 0; i < count; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%.900s/%.60s", folder, names[i]);
        texts[i] = read_text(path);
        if (texts[i])
            sources[good++] = (mgt_gl_source){names[i], texts[i]};
    }
    const mgt_status status = mgt_gl_set_sources(v->render.gl, sources, good);
    for (size_t i = 0; i < count; i++)
        free(texts[i]);
    if (status == MGT_OK) {
        v->shader_error.text[0] = 0;
        v->render.last.serial = 0;
        viewer_tell(v, false, "%s: %zu kernel files in use", folder, good);
    } else {
        snprintf(v->shader_error.text, sizeof v->shader_error.text, "%s", mgt_last_error(v->render.gl));
        v->shader_error.is_error = true;
        viewer_log(v, "%s", v->shader_error.text);
    }
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
