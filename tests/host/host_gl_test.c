/* SPDX-License-Identifier: MIT
 *
 * The engine of examples/host_gl.c, checked: where its bodies meet the water, that depth conventions and views agree, and that a frame costs
 * the host no state, no allocation and no wait. Exit 77, which ctest counts as skipped, where there is no OpenGL 4.5 without a window.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gl_calls.h"
#include "gl_state.h"
#include "host_geometry.h"
#include "unit/test_mesh.h"

/* The example itself, but for its main(). */
#define HOST_GL_NO_WINDOW
#define main host_gl_main
int host_gl_main(int argc, char **argv);
#include "host_gl.c"
#undef main

enum { WIDTH = 160, HEIGHT = 90, CONVENTIONS = 3 };
static const double test_time = 3.7;

typedef struct picture {
    uint8_t rgba[HEIGHT][WIDTH][4]; /* lowest row first */
    float depth[HEIGHT][WIDTH];
} picture;

/* ---- drawing --------------------------------------------------------------------------------------------- */

static void clean(void) { assert_int_equal(glGetError(), GL_NO_ERROR); }

static engine start(depth_convention depth)
{
    engine e;
    assert_int_equal(engine_start(&e, depth, WIDTH, HEIGHT, gl_calls_get_proc), MGT_OK);
    clean();
    return e;
}

static void stop(engine *e)
{
    engine_stop(e);
    clean();
}

static void read_picture(GLuint framebuffer, picture *p)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, p->rgba);
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_DEPTH_COMPONENT, GL_FLOAT, p->depth);
    clean();
}

static void clear(const engine *e)
{
    glBindFramebuffer(GL_FRAMEBUFFER, e->framebuffer);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static mgt_gl_view whole_view(const engine *e)
{
    mgt_gl_view v = make_camera(e->depth, (double)WIDTH / HEIGHT, test_time);
    v.framebuffer = e->framebuffer;
    v.width = WIDTH;
    v.height = HEIGHT;
    return v;
}

/* The water alone, in the views given. */
static void draw_views(const engine *e, const mgt_scene *scene, const mgt_gl_view *views, size_t count)
{
    const mgt_status status = mgt_gl_render_views(e->mangata, scene, views, count);
    if (status != MGT_OK)
        fail_msg("%s: %s", mgt_status_text(status), mgt_last_error(e->mangata));
    clean();
}

/* The picture of one view in the engine's framebuffer, which is cleared first. */
static void draw_picture(const engine *e, const mgt_scene *scene, const mgt_gl_view *view, picture *out)
{
    clear(e);
    draw_views(e, scene, view, 1);
    read_picture(e->framebuffer, out);
}

static int difference(const uint8_t a[4], const uint8_t b[4])
{
    int most = 0;
    for (int c = 0; c < 3; c++)
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    return most;
}

/* Pixels of two pictures that are more than `steps` of 255 apart. */
static long count_different(const picture *a, const picture *b, int steps)
{
    long count = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            count += difference(a->rgba[y][x], b->rgba[y][x]) > steps;
    return count;
}

/* Many colours, bright and dark ones: what a failed draw does not give. */
static void assert_lively(const picture *p)
{
    int least = 255, most = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            least = p->rgba[y][x][2] < least ? p->rgba[y][x][2] : least;
            most = p->rgba[y][x][2] > most ? p->rgba[y][x][2] : most;
        }
    if (most - least < 60)
        fail_msg("blue runs from %d to %d only", least, most);
}

/* ---- geometry -------------------------------------------------------------------------------------------- */

typedef enum seen { SEEN_NONE, SEEN_WATER, SEEN_BALL, SEEN_POLE } seen;

static seen nearest_of(geometry_depths d)
{
    const double least = fmin(d.water, fmin(d.ball, d.pole));
    return !(least < INFINITY) ? SEEN_NONE : least == d.water ? SEEN_WATER : least == d.ball ? SEEN_BALL : SEEN_POLE;
}

/* Metres along the camera's axis of a value in the depth buffer. */
static double metres_of(const engine *e, const mgt_gl_view *v, float depth)
{
    const double clip = e->depth == DEPTH_STANDARD ? 2.0 * (double)depth - 1 : (double)depth;
    return v->projection[14] / (clip + v->projection[10]);
}

/* A body is seen where the picture with water is the picture of the bodies alone. */
static seen seen_in(const picture *drawn, const picture *bodies, const geometry_depths *d, int x, int y)
{
    const bool alone = (d->ball < INFINITY || d->pole < INFINITY) && difference(drawn->rgba[y][x], bodies->rgba[y][x]) == 0;
    return !alone ? SEEN_WATER : d->ball < d->pole ? SEEN_BALL : SEEN_POLE;
}

/* What stands where, computed once: the camera is the same in every convention. */
typedef struct oracle {
    geometry_depths depths[HEIGHT][WIDTH];
    seen expected[HEIGHT][WIDTH];
} oracle;

static void make_oracle(oracle *o)
{
    mgt_wave waves[WAVES];
    make_waves(waves);
    const body ball = make_ball(waves, test_time), pole = make_pole();
    const mgt_gl_view view = make_camera(DEPTH_REVERSED, (double)WIDTH / HEIGHT, test_time);
    geometry g = {.width = WIDTH,
                  .height = HEIGHT,
                  .waves = waves,
                  .wave_count = WAVES,
                  .time = test_time,
                  .ball = {ball.centre[0], ball.centre[1], ball.centre[2], ball.radius},
                  .pole = {pole.centre[0], pole.centre[1], pole.centre[2], pole.radius, pole.height}};
    memcpy(g.view, view.view, sizeof g.view);
    memcpy(g.projection, view.projection, sizeof g.projection);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            o->depths[y][x] = geometry_at(&g, x, y);
            o->expected[y][x] = nearest_of(o->depths[y][x]);
        }
}

/* Whether something else is seen, or covered, within two pixels. */
static bool at_an_edge(const oracle *o, int x, int y)
{
    const geometry_depths *d = &o->depths[y][x];
    for (int i = 0; i < 25; i++) {
        const int v = y + i / 5 - 2, u = x + i % 5 - 2;
        if (v < 0 || v >= HEIGHT || u < 0 || u >= WIDTH || o->expected[v][u] != o->expected[y][x])
            return true;
        const geometry_depths *near = &o->depths[v][u];
        if ((d->ball < INFINITY) != (near->ball < INFINITY) || (d->pole < INFINITY) != (near->pole < INFINITY))
            return true;
    }
    return false;
}

static void check_geometry(depth_convention convention, const oracle *o, picture *drawn)
{
    static picture bodies;
    mgt_wave waves[WAVES];
    make_waves(waves);
    engine e = start(convention);
    const mgt_gl_view view = whole_view(&e);
    const body ball = make_ball(waves, test_time), pole = make_pole();
    const mgt_scene scene = make_scene(waves, test_time);
    clear(&e);
    engine_draw_body(&e, &view, &scene.light, &ball);
    engine_draw_body(&e, &view, &scene.light, &pole);
    read_picture(e.framebuffer, &bodies);
    assert_int_equal(engine_draw(&e, test_time), MGT_OK);
    read_picture(e.framebuffer, drawn);
    assert_lively(drawn);

    /* What is seen where a body is, and the depth of the water where a pixel's footprint is small. */
    long compared = 0, agreed = 0, seen_bodies = 0, drowned = 0, measured = 0, deep = 0;
    double worst = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const geometry_depths *d = &o->depths[y][x];
            const seen expected = o->expected[y][x];
            if ((d->ball < INFINITY || d->pole < INFINITY) && !at_an_edge(o, x, y)) {
                compared++;
                agreed += seen_in(drawn, &bodies, d, x, y) == expected;
                seen_bodies += expected != SEEN_WATER;
                drowned += expected == SEEN_WATER;
            }
            if (expected == SEEN_WATER && d->water < 20) {
                const double error = fabs(metres_of(&e, &view, drawn->depth[y][x]) / d->water - 1);
                measured++;
                deep += error > 5e-3; /* filtered methods find the surface of the waves that a pixel resolves */
                worst = fmax(worst, error);
            }
        }
    print_message("  %s: %.2f%% of %ld pixels of the bodies agree (%ld seen, %ld under water)\n", depth_names[convention],
                  100.0 * (double)agreed / (double)compared, compared, seen_bodies, drowned);
    print_message("  %s: %.2f%% of %ld depths of water within .5%%, the worst off by %.3g\n", depth_names[convention],
                  100.0 * (double)(measured - deep) / (double)measured, measured, worst);
    assert_true(seen_bodies > 125 && drowned > 12 && measured > 1250);
    assert_true((double)agreed >= 0.99 * (double)compared);
    assert_true((double)deep <= 0.01 * (double)measured);
    stop(&e);
}

/* In every convention, and all show the same. */
static void bodies_meet_the_water(void **state)
{
    (void)state;
    static oracle o;
    static picture pictures[CONVENTIONS];
    make_oracle(&o);
    for (int convention = 0; convention < CONVENTIONS; convention++) {
        check_geometry((depth_convention)convention, &o, &pictures[convention]);
        const long different = count_different(&pictures[convention], &pictures[0], 2);
        print_message("  %s: %ld of %d pixels differ by more than 2 of 255\n", depth_names[convention], different, WIDTH * HEIGHT);
        assert_true(different <= WIDTH * HEIGHT / 1000);
    }
}

/* ---- views ----------------------------------------------------------------------------------------------- */

/* The part of the whole view that begins at column x and row y of its image, rows counted from the lowest. */
static mgt_gl_view part_of(mgt_gl_view v, int x, int y, int width, int height)
{
    const double left = (v.projection[8] - 1) / v.projection[0], low = (v.projection[9] - 1) / v.projection[5];
    const double across = 2 / v.projection[0] / WIDTH, up = 2 / v.projection[5] / HEIGHT;
    const double near_terms[2] = {v.projection[10], v.projection[14]};
    make_projection(v.reversed_depth ? DEPTH_REVERSED : DEPTH_STANDARD, left + x * across, left + (x + width) * across, low + y * up, low + (y + height) * up,
                    v.projection);
    v.projection[10] = near_terms[0];
    v.projection[14] = near_terms[1];
    v.x = x;
    v.y = y;
    v.width = (uint32_t)width;
    v.height = (uint32_t)height;
    return v;
}

/* A view and what the CPU renders with the same camera. */
static void compare_view(const mgt_scene *drawn_scene, int divisor)
{
    static picture drawn, rendered;
    mgt_scene scene = *drawn_scene;
    engine e = start(DEPTH_INFINITE_REVERSED);
    const mgt_gl_view view = whole_view(&e);
    draw_picture(&e, &scene, &view, &drawn);
    assert_lively(&drawn);

    scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    scene.camera.fov_y_deg = 45;
    for (int i = 0; i < 3; i++) {
        const double *row = &view.view[4 * i];
        scene.camera.position[i] = -(row[0] * view.view[12] + row[1] * view.view[13] + row[2] * view.view[14]);
        scene.camera.target[i] = scene.camera.position[i] - row[2];
        scene.camera.up[i] = row[1];
    }
    mgt_context *cpu;
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.pixels = rendered.rgba[HEIGHT - 1];
    target.row_stride = -(ptrdiff_t)sizeof rendered.rgba[0];
    assert_int_equal(mgt_context_create(&cpu, NULL), MGT_OK);
    const mgt_status status = mgt_render(cpu, &scene, &target, 1);
    mgt_context_destroy(cpu);
    if (status == MGT_ERROR_UNAVAILABLE && scene.quality.refraction == MGT_REFRACTION_HYBRID) { /* the CPU's needs Embree */
        stop(&e);
        return;
    }
    assert_int_equal(status, MGT_OK);
    const long different = count_different(&drawn, &rendered, 2);
    print_message("  %ld of %d pixels differ by more than 2 of 255 from the CPU's\n", different, WIDTH * HEIGHT);
    assert_true(different <= WIDTH * HEIGHT / divisor);
    stop(&e);
}

/* Its water and sky; with an object that rises out of the water; and under a higher sea, from below; with and without traced rays. */
static void view_is_the_picture(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    make_waves(waves);
    mgt_scene scene = make_scene(waves, test_time);
    scene.post.glare = 0; /* views have none */
    compare_view(&scene, 1000);

    static const float corners[] = {-6, -3, 6, 6, -3, 6, 6, 1, -14, -6, 1, -14};
    static const uint32_t halves[] = {0, 1, 2, 0, 2, 3};
    mgt_mesh *ramp = test_mesh(corners, NULL, 4, halves, 2);
    const mgt_object object = {.mesh = ramp,
                               .transform = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}},
                               .material = {.base_color = {0.7f, 0.5f, 0.3f}, .roughness = 0.6f, .pattern_size = 1}};
    scene.objects = &object;
    scene.object_count = 1;
    scene.post.exposure_ev = 1; /* this evening is dim from below */
    for (int i = 0; i < 4; i += 1 + 2 * MGT_SANITIZED) {
        scene.water.level = i % 2 ? 8 : 0;
        scene.quality.refraction = i < 2 ? MGT_REFRACTION_TWO_PHASE : MGT_REFRACTION_HYBRID;
        compare_view(&scene, 500);
    }
    mgt_mesh_destroy(ramp);
}

/* Four off-centre views side by side, in one call, are the whole view. */
static void parts_make_the_whole(void **state)
{
    (void)state;
    static picture whole, parts, separate;
    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    for (int convention = 0; convention < CONVENTIONS; convention += 1 + MGT_SANITIZED) {
        engine e = start((depth_convention)convention);
        const mgt_gl_view view = whole_view(&e);
        draw_picture(&e, &scene, &view, &whole);
        assert_lively(&whole);

        const mgt_gl_view quarters[4] = {part_of(view, 0, 42, 64, 48), part_of(view, 64, 42, 96, 48), part_of(view, 0, 0, 64, 42),
                                         part_of(view, 64, 0, 96, 42)};
        clear(&e);
        draw_views(&e, &scene, quarters, 4);
        read_picture(e.framebuffer, &parts);
        clear(&e);
        for (int i = 0; i < 4; i++)
            draw_views(&e, &scene, &quarters[i], 1);
        read_picture(e.framebuffer, &separate);
        const long different = count_different(&whole, &parts, 2);
        print_message("  %s: %ld of %d pixels of the parts differ by more than 2 of 255\n", depth_names[convention], different, WIDTH * HEIGHT);
        assert_true(different <= WIDTH * HEIGHT / 1000);
        assert_memory_equal(&parts, &separate, sizeof parts);
        stop(&e);
    }
}

/* Samples of a pixel within the water get one colour; the resolved picture is the plain one away from edges. */
static void multisampled_framebuffer(void **state)
{
    (void)state;
    static picture plain, resolved;
    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    engine e = start(DEPTH_REVERSED);
    mgt_gl_view view = whole_view(&e);
    draw_picture(&e, &scene, &view, &plain);

    GLuint framebuffer, buffers[2];
    glCreateFramebuffers(1, &framebuffer);
    glCreateRenderbuffers(2, buffers);
    glNamedRenderbufferStorageMultisample(buffers[0], 4, GL_RGBA8, WIDTH, HEIGHT);
    glNamedRenderbufferStorageMultisample(buffers[1], 4, GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    view.framebuffer = framebuffer;
    draw_views(&e, &scene, &view, 1);
    clear(&e);
    glBlitNamedFramebuffer(framebuffer, e.framebuffer, 0, 0, WIDTH, HEIGHT, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    read_picture(e.framebuffer, &resolved);
    assert_true(count_different(&plain, &resolved, 2) <= WIDTH * HEIGHT / 1000);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(2, buffers);
    stop(&e);
}

/* Engines that turn the clip space over find the top row first. */
static void upper_left_origin(void **state)
{
    (void)state;
    static picture upright, turned, back;
    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    engine e = start(DEPTH_REVERSED);
    const mgt_gl_view view = whole_view(&e);
    draw_picture(&e, &scene, &view, &upright);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    clear(&e);
    draw_views(&e, &scene, &view, 1);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    read_picture(e.framebuffer, &turned);
    for (int y = 0; y < HEIGHT; y++) {
        memcpy(back.rgba[y], turned.rgba[HEIGHT - 1 - y], sizeof back.rgba[y]);
        memcpy(back.depth[y], turned.depth[HEIGHT - 1 - y], sizeof back.depth[y]);
    }
    assert_lively(&upright);
    assert_memory_equal(&upright, &back, sizeof back);
    stop(&e);
}

/* A framebuffer with a colour at two attachments, of which the second is the first draw buffer. */
typedef struct two_colors {
    GLuint framebuffer, color[2], depth;
} two_colors;

static two_colors make_two_colors(GLenum first, GLenum second)
{
    two_colors t;
    const GLenum formats[] = {first, second};
    glCreateFramebuffers(1, &t.framebuffer);
    glCreateRenderbuffers(2, t.color);
    glCreateRenderbuffers(1, &t.depth);
    for (int i = 0; i < 2; i++)
        if (formats[i] != GL_NONE) {
            glNamedRenderbufferStorage(t.color[i], formats[i], WIDTH, HEIGHT);
            glNamedFramebufferRenderbuffer(t.framebuffer, GL_COLOR_ATTACHMENT0 + (GLenum)i, GL_RENDERBUFFER, t.color[i]);
        }
    glNamedRenderbufferStorage(t.depth, GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT);
    glNamedFramebufferRenderbuffer(t.framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, t.depth);
    glNamedFramebufferDrawBuffer(t.framebuffer, GL_COLOR_ATTACHMENT1);
    glNamedFramebufferReadBuffer(t.framebuffer, GL_COLOR_ATTACHMENT1);
    return t;
}

static void delete_two_colors(two_colors *t)
{
    glDeleteFramebuffers(1, &t->framebuffer);
    glDeleteRenderbuffers(2, t->color);
    glDeleteRenderbuffers(1, &t->depth);
}

/* A view asks the attachment that it draws into whether it encodes colours itself, and whether it holds integers. */
static void the_first_draw_buffer_counts(void **state)
{
    (void)state;
    static picture plain, drawn;
    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    engine e = start(DEPTH_REVERSED);
    mgt_gl_view view = whole_view(&e);
    view.color = MGT_GL_COLOR_DISPLAY;
    draw_picture(&e, &scene, &view, &plain);
    assert_lively(&plain);
    static const GLenum formats[][2] = {{GL_RGBA8, GL_SRGB8_ALPHA8}, {GL_SRGB8_ALPHA8, GL_RGBA8}, {GL_RGBA8UI, GL_RGBA8}, {GL_NONE, GL_RGBA8}};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        two_colors t = make_two_colors(formats[i][0], formats[i][1]);
        glBindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        view.framebuffer = t.framebuffer;
        glEnable(GL_FRAMEBUFFER_SRGB);
        draw_views(&e, &scene, &view, 1);
        glDisable(GL_FRAMEBUFFER_SRGB);
        read_picture(t.framebuffer, &drawn);
        const long different = count_different(&plain, &drawn, 2);
        if (different > 0)
            fail_msg("formats %zu: %ld pixels are others", i, different);
        delete_two_colors(&t);
    }
    stop(&e);
}

/* Framebuffer 0, which only a surface brings: here one without a window, in a context of its own. */
static void default_framebuffer(void **state)
{
    (void)state;
    static picture textured, surfaced;
    static const EGLint config_wants[] =
        {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_DEPTH_SIZE, 24,
         EGL_NONE};
    static const EGLint context_wants[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    static const EGLint surface_wants[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE};
    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLContext before = eglGetCurrentContext();
    EGLConfig config;
    EGLint configs = 0;
    if (!eglChooseConfig(display, config_wants, &config, 1, &configs) || configs < 1) {
        print_message("  NOTICE: no surfaces without windows here\n");
        return;
    }
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_wants);
    const EGLSurface surface = eglCreatePbufferSurface(display, config, surface_wants);
    assert_true(eglMakeCurrent(display, surface, surface, context));

    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    engine e = start(DEPTH_STANDARD);
    mgt_gl_view view = whole_view(&e);
    draw_picture(&e, &scene, &view, &textured);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    view.framebuffer = 0;
    draw_views(&e, &scene, &view, 1);
    read_picture(0, &surfaced);
    assert_lively(&surfaced);
    assert_int_equal(count_different(&textured, &surfaced, 1), 0);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_true(fabsf(textured.depth[y][x] - surfaced.depth[y][x]) < 1e-6f);
    stop(&e);
    assert_true(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, before));
    eglDestroySurface(display, surface);
    eglDestroyContext(display, context);
}

/* ---- what a frame costs the host ------------------------------------------------------------------------- */

/* All that a host can draw but leadr, which is lean with another kernel. podee-pixel comes again with sums, before it has tables of kernels, and with these. */
static const mgt_method methods[] = {MGT_METHOD_MANGATA,     MGT_METHOD_NONE,        MGT_METHOD_SSAA,        MGT_METHOD_PODEE_UNIFORM,
                                     MGT_METHOD_PODEE_PIXEL, MGT_METHOD_MSAA32,      MGT_METHOD_LEAN,        MGT_METHOD_ADAPTIVE,
                                     MGT_METHOD_TOKUYOSHI,   MGT_METHOD_BRUNETON,    MGT_METHOD_FXAA,        MGT_METHOD_TAA,
                                     MGT_METHOD_TNDF,        MGT_METHOD_PODEE_PIXEL, MGT_METHOD_PODEE_PIXEL, MGT_METHOD_GGX_MOMENTS};
enum { METHODS = sizeof methods / sizeof methods[0] };

static mgt_quality quality_of(int i)
{
    const mgt_mixture kernels = i + 3 == METHODS ? MGT_MIXTURE_RIEMANN : i + 2 == METHODS ? MGT_MIXTURE_5 : MGT_MIXTURE_EXACT;
    const mgt_adaptive scheme = methods[i] == MGT_METHOD_ADAPTIVE ? MGT_ADAPTIVE_PODEE : MGT_ADAPTIVE_CELLS;
    return (mgt_quality){.method = methods[i], .spatial_samples = 1, .time_samples = 1, .kernels = kernels, .adaptive = scheme};
}

static void state_is_as_before(void **state)
{
    (void)state;
    static picture friendly, hostile;
    static gl_state before, after;
    mgt_wave waves[WAVES];
    make_waves(waves);
    mgt_scene scene = make_scene(waves, test_time);
    engine e = start(DEPTH_REVERSED);
    for (int i = 0; i < METHODS; i += 1 + MGT_SANITIZED) {
        scene.quality = quality_of(i);
        scene.quality.spatial_samples = 2;
        for (int color = i == 0 ? MGT_GL_COLOR_RADIANCE : MGT_GL_COLOR_DISPLAY; color <= MGT_GL_COLOR_DISPLAY; color++) {
            mgt_gl_view view = whole_view(&e);
            view.color = (mgt_gl_color)color;
            view.width /= 4;
            view.height /= 4;
            clear(&e);
            gl_state_read(&before);
            draw_views(&e, &scene, &view, 1);
            gl_state_read(&after);
            if (gl_state_compare(&before, &after) != 0)
                fail_msg("method %d, colour %d changes the state above", (int)methods[i], color);
            read_picture(e.framebuffer, &friendly);

            clear(&e);
            gl_state_make_hostile();
            clean();
            gl_state_read(&before);
            draw_views(&e, &scene, &view, 1);
            gl_state_read(&after);
            const size_t changed = gl_state_compare(&before, &after);
            gl_state_make_friendly();
            glEnable(GL_DEPTH_TEST);
            glDepthFunc(GL_GREATER);
            clean();
            if (changed != 0)
                fail_msg("method %d, colour %d changes the hostile state above", (int)methods[i], color);
            read_picture(e.framebuffer, &hostile);
            const long different = count_different(&friendly, &hostile, 0);
            if (different != 0)
                fail_msg("method %d, colour %d: the host's state changes %ld pixels", (int)methods[i], color, different);
        }
    }
    print_message("  %zu values of state compared\n", before.count);
    assert_true(before.count >= 300);

    /* A program that is deleted while in use is lost with the next one; that is no error. */
    const mgt_gl_view view = whole_view(&e);
    const body pole = make_pole();
    engine_draw_body(&e, &view, &scene.light, &pole);
    glDeleteProgram(e.program);
    e.program = 0;
    engine other = start(DEPTH_REVERSED); /* builds programs of its own meanwhile */
    draw_views(&other, &scene, &view, 1);
    stop(&other);
    stop(&e);
}

/* A host may have as many debug groups as OpenGL takes: then the passes have none, and the host's stay. */
static void full_stacks_of_debug_groups(void **state)
{
    (void)state;
    static picture grouped, full;
    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    engine e = start(DEPTH_REVERSED);
    const mgt_gl_view view = whole_view(&e);
    GLint most = 0, depth = 0;
    glGetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &most);
    for (int room = 1; room >= 0; room--) {
        for (glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth); depth < most - room; depth++)
            glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "the host's");
        clean();
        clear(&e);
        draw_views(&e, &scene, &view, 1);
        read_picture(e.framebuffer, room ? &grouped : &full);
        glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
        assert_int_equal(depth, most - room);
    }
    assert_lively(&full);
    assert_memory_equal(&grouped, &full, sizeof full);
    for (; depth > 1; depth--)
        glPopDebugGroup();
    stop(&e);
}

/* Everything that may change from frame to frame does; sky and light, which have a table, only if asked to. */
static mgt_scene changing_scene(mgt_wave waves[WAVES], int frame, bool sky_changes)
{
    make_waves(waves);
    for (int i = 0; i < WAVES; i++)
        waves[i].amplitude *= 1 + 0.2 * sin(frame + i);
    mgt_scene scene = make_scene(waves, frame / 30.0);
    scene.shutter = 0.01 * (frame % 4);
    scene.water.wave_count = (size_t)(WAVES - frame % 7);
    scene.water.index_of_refraction = 1.3 + 0.01 * (frame % 5);
    scene.post.exposure_ev = 0.1 * (frame % 3);
    scene.post.tone_map = (mgt_tone_map)(frame % 4);
    scene.quality = quality_of(frame % METHODS);
    scene.sky.model = MGT_SKY_GRADIENT;
    if (sky_changes) {
        scene.light.azimuth_deg = frame % 9;
        scene.light.angular_radius_deg = 0.3 + 0.1 * (frame % 3);
        scene.sky.zenith[0] = 0.1f * (float)(frame % 5);
    }
    return scene;
}

/* Frames from `first` on, the host never more than two ahead of the GPU, as one that shows them is. Returns the allocations. */
static long draw_changing(const engine *e, int first, int count, bool sky_changes)
{
    const gl_calls before = gl_calls_read();
    const long allocated = allocations_read();
    GLsync drawn[2] = {NULL, NULL};
    for (int frame = first; frame < first + count; frame++) {
        if (drawn[frame % 2]) {
            glClientWaitSync(drawn[frame % 2], GL_SYNC_FLUSH_COMMANDS_BIT, 60000000000u);
            glDeleteSync(drawn[frame % 2]);
        }
        mgt_wave waves[WAVES];
        const mgt_scene scene = changing_scene(waves, frame, sky_changes);
        mgt_gl_view view = make_camera(e->depth, 1.5, 0.2 * frame);
        view.framebuffer = e->framebuffer;
        view.width = (uint32_t)(48 + 16 * ((frame % METHODS + frame / METHODS) % 2)); /* each method in both sizes within 2 METHODS frames */
        view.height = 32;
        clear(e);
        draw_views(e, &scene, &view, 1);
        drawn[frame % 2] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    }
    for (int i = 0; i < 2; i++)
        glDeleteSync(drawn[i]);
    const gl_calls after = gl_calls_read();
    long wrong = 0;
    for (int i = 0; i < after.kinds && first > 0; i++)
        if (after.counts[i] != before.counts[i]) {
            fprintf(stderr, "  %s: %ld calls in %d frames\n", after.names[i], after.counts[i] - before.counts[i], count);
            wrong++;
        }
    assert_int_equal(wrong, 0);
    return allocations_read() - allocated;
}

static void steady_frames_cost_nothing(void **state)
{
    (void)state;
    if (MGT_SANITIZED) /* calls are counted, and the other tests draw the same */
        skip();
    enum { WARM = 2 * METHODS, STEADY = METHODS }; /* each method in each size, then each again */
    engine e = start(DEPTH_REVERSED);
    assert_true(draw_changing(&e, 0, WARM, false) > 0); /* else the linker has not wrapped anything */
    const gl_calls calls = gl_calls_read();
    long built = 0;
    for (int i = 0; i < calls.kinds; i++)
        built += calls.counts[i];
    assert_true(built > 0); /* else the library does not use the functions that it was given */
    assert_int_equal(draw_changing(&e, WARM, STEADY, false), 0);
    draw_changing(&e, WARM + STEADY, METHODS, true);
    stop(&e);
}

/* A view that cannot be drawn is refused by name and leaves everything as it was. */
static void expect_refused(const engine *e, mgt_gl_view view, mgt_status expected, const char *what)
{
    static gl_state before, after;
    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    gl_state_read(&before);
    const mgt_status status = mgt_gl_render_views(e->mangata, &scene, &view, 1);
    gl_state_read(&after);
    if (status != expected || strlen(mgt_last_error(e->mangata)) < 10)
        fail_msg("%s: %s: '%s'", what, mgt_status_text(status), mgt_last_error(e->mangata));
    clean();
    assert_int_equal(gl_state_compare(&before, &after), 0);
}

static void wrong_views_are_refused(void **state)
{
    (void)state;
    engine e = start(DEPTH_STANDARD);
    const mgt_gl_view good = whole_view(&e);
    GLuint framebuffer, color;
    glCreateFramebuffers(1, &framebuffer);
    glCreateRenderbuffers(1, &color);
    glNamedRenderbufferStorage(color, GL_RGBA8, WIDTH, HEIGHT);

    mgt_gl_view v = good;
    v.framebuffer = framebuffer;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "nothing attached");
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "no depth attached");
    two_colors t = make_two_colors(GL_RGBA8, GL_RGBA8UI);
    v.framebuffer = t.framebuffer;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "integers where the first draw buffer is");
    glNamedFramebufferDrawBuffer(t.framebuffer, GL_NONE);
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "no draw buffer");
    assert_non_null(strstr(mgt_last_error(e.mangata), "draw buffer of framebuffer"));
    glNamedFramebufferDrawBuffer(t.framebuffer, GL_COLOR_ATTACHMENT5);
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "a draw buffer with nothing attached");
    delete_two_colors(&t);
    v.framebuffer = 999;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "no such framebuffer");
    v.framebuffer = 0;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "no default framebuffer");
    v = good;
    v.width = 0;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "an empty viewport");
    v = good;
    v.struct_size = 3;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "an unknown size of struct");
    for (size_t i = 0; i < sizeof v.reserved; i++) {
        v = good;
        v.reserved[i] = 1;
        expect_refused(&e, v, MGT_ERROR_ARGUMENT, "a member without a meaning");
        assert_non_null(strstr(mgt_last_error(e.mangata), "of reserved is 1; allowed is 0"));
    }
    v = good;
    v.projection[11] = 0, v.projection[15] = 1;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "an orthographic projection");
    v = good;
    v.reversed_depth = true;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "reversed depth by a projection that reverses nothing");
    v = good;
    v.view[0] *= 2;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "a view that scales");
    v = good;
    v.view[13] = NAN;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "not a number");
    v = good;
    v.color = (mgt_gl_color)77;
    expect_refused(&e, v, MGT_ERROR_ARGUMENT, "an unknown colour");

    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, test_time);
    draw_views(&e, &scene, &good, 1); /* still possible */
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &color);
    stop(&e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_meet_the_water),        cmocka_unit_test(view_is_the_picture),         cmocka_unit_test(parts_make_the_whole),
        cmocka_unit_test(multisampled_framebuffer),     cmocka_unit_test(upper_left_origin),           cmocka_unit_test(default_framebuffer),
        cmocka_unit_test(state_is_as_before),           cmocka_unit_test(steady_frames_cost_nothing),  cmocka_unit_test(wrong_views_are_refused),
        cmocka_unit_test(the_first_draw_buffer_counts), cmocka_unit_test(full_stacks_of_debug_groups),
    };
    engine e;
    if (!headless_gl_start() || engine_start(&e, DEPTH_STANDARD, WIDTH, HEIGHT, eglGetProcAddress) == MGT_ERROR_UNAVAILABLE)
        return 77;
    engine_stop(&e);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
