/* SPDX-License-Identifier: MIT
 * mangata-viewer: the window, and the loop that draws one frame after the other. */
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "image/video.h"
#include "viewer/app/panels.h"
#include "params/methods.h"
#include "cli/common/progress.h"

/* Seconds between looks at the files, seconds that a frame waits for events when nothing moves, and seconds of a frame of a script. */
static const double poll_interval = 0.2, idle_wait = 0.1, script_frame = 1 / 60.0;

/* ---- the window ---- */

static void on_glfw_error(int code, const char *text)
{
    (void)code;
    (void)text; /* no_display() reads the error with glfwGetError() */
}

/* Creates the window with a context of OpenGL `major`.`minor` core. NULL: GLFW cannot. */
static GLFWwindow *make_window(const view_request *r, const scene_values *values, int major, int minor)
{
    GLFWmonitor *monitor = glfwGetPrimaryMonitor(); /* NULL where no screen is connected */
    const GLFWvidmode *screen = monitor ? glfwGetVideoMode(monitor) : NULL;
    uint32_t width = r->changes.width ? r->changes.width : values->image.width, height = r->changes.height ? r->changes.height : values->image.height;
    if (screen && !r->changes.width) {
        width = width < (uint32_t)screen->width ? width : (uint32_t)screen->width;
        height = height < (uint32_t)screen->height ? height : (uint32_t)screen->height;
    }
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "mangata");
    return glfwCreateWindow((int)width, (int)height, "Mangata", NULL, NULL);
}

static int no_display(void)
{
    const char *text = NULL;
    glfwGetError(&text);
    return console_error(EXIT_CODE_UNAVAILABLE, "no window can be opened: %s", text ? text : "no display, or no OpenGL 3.3");
}

static bool open_window(viewer *v)
{
    const char *missing = NULL;
    char error[VIEWER_TEXT] = "";
    if (v->request->context.backend != MGT_BACKEND_CPU)
        v->window = make_window(v->request, &v->document.values, 4, 5);
    if (!v->window)
        v->window = make_window(v->request, &v->document.values, 3, 3);
    if (!v->window) {
        v->exit_code = no_display();
        return false;
    }
    glfwMakeContextCurrent(v->window);
    glfwSwapInterval(v->request->script ? 0 : 1);
    if (!gl_functions_load(&v->gl_functions, glfwGetProcAddress, &missing)) {
        v->exit_code = console_error(EXIT_CODE_UNAVAILABLE, "the window's OpenGL has no %s; OpenGL 3.3 is needed", missing);
        return false;
    }
    v->display = display_create(&v->gl_functions, error, sizeof error);
    if (!v->display || !ui_create(v->window)) {
        v->exit_code = console_error(EXIT_CODE_UNAVAILABLE, "the window cannot be drawn: %s", error);
        return false;
    }
    input_install(v);
    return true;
}

static void close_window(viewer *v)
{
    if (!v->window)
        return;
    if (v->display)
        ui_destroy();
    display_destroy(v->display);
    glfwDestroyWindow(v->window);
}

/* ---- a frame ---- */

static void follow_scale(viewer *v)
{
    float x = 1, y = 1;
    int width, pixels;
    glfwGetWindowContentScale(v->window, &x, &y);
    glfwGetWindowSize(v->window, &width, NULL);
    glfwGetFramebufferSize(v->window, &pixels, NULL);
    /* If window coordinates are pixels, text must grow with the screen's scale. Otherwise the system scales the window. */
    const float scale = (float)v->settings.panel.scale * (pixels > width ? 1 : x);
    if (scale == v->ui_scale)
        return;
    ui_set_scale(scale);
    v->ui_scale = scale;
}

/* Computes the place of the picture in the window and its full size in pixels. */
static void place_picture(viewer *v)
{
    int window_width, window_height, width, height;
    glfwGetWindowSize(v->window, &window_width, &window_height);
    glfwGetFramebufferSize(v->window, &width, &height);
    const float density = window_width > 0 ? (float)width / (float)window_width : 1;
    picture_place *p = &v->place;
    p->room = (ui_rect){0, 0, fmaxf((float)window_width - panels_width(v), 64), (float)window_height};
    p->place = p->room;
    p->width = (uint32_t)fmaxf(p->room.width * density, 1);
    p->height = (uint32_t)fmaxf(p->room.height * density, 1);
    if (v->settings.view.frame != FRAME_AS_SCENE)
        return;
    const mgt_image *image = &v->document.values.image;
    const float fit = fminf(p->room.width / (float)image->width, p->room.height / (float)image->height);
    const float scale = fminf(fit, 1 / density); /* a pixel of the picture is never larger than one of the window */
    p->width = image->width;
    p->height = image->height;
    p->place.width = scale * (float)image->width;
    p->place.height = scale * (float)image->height;
    p->place.x = floorf((p->room.width - p->place.width) / 2);
    p->place.y = floorf((p->room.height - p->place.height) / 2);
}

/* The value at the upper end of the layer's palette. */
static float range_end(const view_settings *s)
{
    switch ((mgt_layer)s->layer) {
    case MGT_LAYER_COVERAGE:
        return (float)s->coverage_end;
    case MGT_LAYER_DEPTH:
        return (float)(fmax(s->near_depth, s->far_depth) * 1.0001); /* so that it differs from the lower end */
    case MGT_LAYER_NORMAL:
        return (float)s->lean_end;
    default:
        break;
    }
    return 1;
}

static void draw_picture(viewer *v)
{
    const gl_functions *gl = &v->gl_functions;
    int window_width, window_height, width, height;
    glfwGetWindowSize(v->window, &window_width, &window_height);
    glfwGetFramebufferSize(v->window, &width, &height);
    const float density = window_width > 0 ? (float)width / (float)window_width : 1;
    const ui_rect *p = &v->place.place;
    const view_settings *s = &v->settings.view;
    const bool depth = s->layer == MGT_LAYER_DEPTH;
    const display_view view = {
        .x = (int)lroundf(p->x * density),
        .y = height - (int)lroundf((p->y + p->height) * density),
        .width = (int)lroundf(p->width * density),
        .height = (int)lroundf(p->height * density),
        .compare = (compare_mode)s->compare,
        .wipe = (float)s->wipe,
        .difference_scale = (float)s->difference_scale,
        .low = depth ? (float)fmin(s->near_depth, s->far_depth) : 0,
        .high = range_end(s),
        .logarithmic = depth,
        .zoom = (float)s->zoom,
        .center_x = (float)fmin(fmax(s->center_x, 0.5 / s->zoom), 1 - 0.5 / s->zoom),
        .center_y = (float)fmin(fmax(s->center_y, 0.5 / s->zoom), 1 - 0.5 / s->zoom),
    };
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl->Viewport(0, 0, width, height);
    gl->ClearColor(0.035f, 0.04f, 0.05f, 1);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    display_draw(v->display, &view);
    gl->Viewport(0, 0, width, height);
}

static void time_frame(viewer *v)
{
    timings *t = &v->timings;
    const double now = seconds_now();
    if (t->last_frame > 0)
        timing_add(&t->window, now - t->last_frame);
    t->last_frame = now;
}

/* Whether the next frame must not wait for events, because something moves or changes. */
static bool is_busy(const viewer *v)
{
    const bool *k = v->pointer.keys;
    const bool moves = k[0] || k[1] || k[2] || k[3] || k[4] || k[5];
    return v->script || v->settings.clock.play || moves || v->film_export || v->render.reduced || seconds_now() - v->render.changed_at < 1 ||
           v->message.until > seconds_now();
}

static void run_frame(viewer *v)
{
    const bool busy = is_busy(v);
    if (busy)
        glfwPollEvents();
    else
        glfwWaitEventsTimeout(idle_wait);
    /* The first frame after a wait has step 0, so that what begins to move does not jump. */
    const double now = seconds_now(), step = v->script ? script_frame : busy ? fmin(now - v->advanced_at, 0.1) : 0;
    v->advanced_at = now;
    if (v->script && v->place.width > 0) /* not in the first frame, because commands ask for the place of the picture */
        script_step(v);
    if (now - v->polled_at > poll_interval || v->script) {
        v->polled_at = now;
        viewer_poll_files(v);
        viewer_poll_shaders(v);
    }
    viewer_advance(v, step);
    follow_scale(v);
    place_picture(v);
    viewer_render(v);
    viewer_judge(v);
    film_watch(v);
    viewer_watch_saver(v);
    viewer_keep_step(v, false);
    v->stand_in.seconds = (float)script_frame;
    ui_frame_begin(&v->stand_in);
    draw_picture(v);
    panels_draw(v);
    overlays_draw(v);
    ui_frame_end();
    if (v->script)
        script_after_frame(v);
    glfwSwapBuffers(v->window);
    time_frame(v);
    v->quit |= glfwWindowShouldClose(v->window) || *interrupt_flag();
}

/* ---- from start to end ---- */

static bool open_scene(viewer *v)
{
    scene_error error;
    const view_request *r = v->request;
    if (!document_open(&v->document, r->scene_path, r->changes.items, r->changes.count, &error)) {
        v->exit_code = console_scene_error(&error);
        return false;
    }
    char wrong[600];
    const mgt_quality base = scene_file_quality(v->document.source->file);
    mgt_quality *a = &v->settings.sides[SIDE_A];
    const uint32_t spatial = a->spatial_samples;
    if (!quality_options_apply(&r->quality, &base, a, wrong, sizeof wrong)) {
        v->exit_code = console_error(EXIT_CODE_USAGE, "%s", wrong);
        return false;
    }
    if (!method_is_sampled(a->method)) /* kept for when the user chooses a method with samples */
        a->spatial_samples = spatial;
    v->board = (control_board){&v->document, &v->settings};
    v->settings.clock.time = v->document.values.time.start;
    document_save_name(&v->document, v->save_name, sizeof v->save_name);
    recent_add(r->scene_path);
    snprintf(v->picture_name, sizeof v->picture_name, "mangata.png");
    v->film = (film_choice){.name = "film", .last = UINT32_MAX, .crf = VIDEO_CRF_DEFAULT};
    if (history_start(&v->history, &v->document, &v->settings))
        return true;
    v->exit_code = console_error(EXIT_CODE_FAILED, "out of memory");
    return false;
}

static bool open_script(viewer *v)
{
    if (!v->request->script)
        return true;
    v->script = script_open(v->request->script);
    if (!v->script)
        v->exit_code = console_error(EXIT_CODE_NO_INPUT, "%s: the script cannot be read", v->request->script);
    return v->script != NULL;
}

static int run(const view_request *request)
{
    viewer *v = calloc(1, sizeof *v);
    if (!v)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    v->request = request;
    v->held_handle = -1;
    v->settings = settings_defaults();
    v->settings.panel.judge = !request->script; /* so that the window does not depend on the script's speed */
    glfwSetErrorCallback(on_glfw_error);
    const bool opened = open_scene(v) && open_script(v);
    interrupt_install();
    if (opened) {
        if (!glfwInit()) {
            v->exit_code = no_display();
        } else if (open_window(v) && viewer_start_rendering(v)) {
            viewer_set_title(v);
            while (!v->quit)
                run_frame(v);
            if (*interrupt_flag())
                v->exit_code = interrupt_exit_code();
        }
    }
    film_stop(v);
    judge_destroy(v->judging.judge);
    picture_saver_destroy(v->saver);
    viewer_stop_rendering(v);
    close_window(v);
    glfwTerminate();
    script_close(v->script);
    history_free(&v->history);
    document_close(&v->document);
    dialog_free(v);
    const int code = v->exit_code;
    free(v);
    return code;
}

int main(int argc, char **argv)
{
    console_begin();
    view_request request;
    int code = view_request_read(&request, argc - 1, argv + 1);
    if (code == EXIT_CODE_OK) {
        interrupt_while_reading();
        code = run(&request);
    }
    view_request_free(&request);
    return console_finish(code < 0 ? EXIT_CODE_OK : code);
}
