/* SPDX-License-Identifier: MIT
 * The cells of method adaptive on OpenGL: the same samples and pictures as on the CPU, the same bytes every time, and nothing is read back. */
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/backend.h"
#include "gl/gl_host.h"
#include "mangata/gl.h"
#include "scene/scene_file.h"

enum { WIDTH = 96, HEIGHT = 54, PIXELS = WIDTH * HEIGHT };

static const double most_others = 5e-3; /* share of the pixels that may have another number of samples; */
static const double largest_rms = 5e-5; /* of the others */

typedef struct picture {
    float coverage[PIXELS], mask[PIXELS], samples[PIXELS], importance[PIXELS], detail[PIXELS];
    unsigned char shown[4 * PIXELS];
} picture;

static mgt_context *context_of(mgt_backend backend)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = backend;
    mgt_context *context = NULL;
    if (mgt_context_create(&context, &desc) != MGT_OK)
        fail_msg("%s", mgt_last_error(NULL));
    return context;
}

static scene_file *load(const char *name, mgt_scene *scene)
{
    char path[512];
    snprintf(path, sizeof path, "%s/scenes/%s", MGT_SOURCE_DIR, name);
    scene_error error;
    scene_file *file = scene_file_load(path, NULL, 0, &error);
    if (!file || !scene_file_frame(file, 0, scene))
        fail_msg("%s: %s", path, file ? "no frame" : error.text);
    scene->image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    mgt_quality_init(&scene->quality, sizeof scene->quality);
    scene->quality.method = MGT_METHOD_ADAPTIVE;
    return file;
}

static mgt_target target_of(mgt_layer layer, mgt_format format, void *pixels)
{
    mgt_target t;
    mgt_target_init(&t, sizeof t);
    t.layer = layer;
    t.format = format;
    t.pixels = pixels;
    return t;
}

static void render(mgt_context *context, const mgt_scene *scene, picture *out)
{
    const mgt_target targets[] = {
        target_of(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, out->coverage), target_of(MGT_LAYER_MASK, MGT_FORMAT_R32F, out->mask),
        target_of(MGT_LAYER_SAMPLES, MGT_FORMAT_R32F, out->samples),   target_of(MGT_LAYER_IMPORTANCE, MGT_FORMAT_R32F, out->importance),
        target_of(MGT_LAYER_DETAIL, MGT_FORMAT_R32F, out->detail),     target_of(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, out->shown),
    };
    memset(out, 0xff, sizeof *out);
    if (mgt_render(context, scene, targets, sizeof targets / sizeof *targets) != MGT_OK)
        fail_msg("%s", mgt_last_error(context));
}

static double rms_where(const float *a, const float *b, const bool *where)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < PIXELS; i++)
        if (where[i]) {
            sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
            count++;
        }
    return count ? sqrt(sum / (double)count) : 0;
}

static void expect_alike(const char *name, const picture *a, const picture *b)
{
    static bool same[PIXELS];
    size_t others = 0, steps = 0;
    for (size_t i = 0; i < PIXELS; i++) {
        same[i] = fabsf(a->samples[i] - b->samples[i]) <= 1e-4f * fmaxf(b->samples[i], 1); /* sums of floats in other orders */
        others += !same[i];
        for (size_t k = 0; k < 3; k++)
            steps += same[i] && abs(a->shown[4 * i + k] - b->shown[4 * i + k]) > 1;
    }
    const double coverage = rms_where(a->coverage, b->coverage, same), mask = rms_where(a->mask, b->mask, same);
    const double importance = rms_where(a->importance, b->importance, same), detail = rms_where(a->detail, b->detail, same);
    printf("  %-18s %5zu pixels of other samples, rms of the others: coverage %.1e, mask %.1e, importance %.1e, detail %.1e\n", name, others, coverage, mask,
           importance, detail);
    assert_true((double)others <= most_others * PIXELS);
    assert_true(coverage <= largest_rms && mask <= largest_rms && importance <= largest_rms && detail <= largest_rms);
    assert_true((double)steps <= 1e-3 * 3 * PIXELS);
}

/* With what the CPU renders. The plain run compares: sanitizers look at what draws. */
static void compare(mgt_context *cpu, const mgt_scene *scene, const char *name, const picture *got)
{
    static picture expected;
    if (MGT_SANITIZED)
        return;
    render(cpu, scene, &expected);
    expect_alike(name, got, &expected);
}

/* Near waves, far ones, a low sun, the moon, and many waves. */
static const char *const seas[] = {"smooth.json", "high.json", "sunset.json", "moonlit.json", "gale.yaml"};
enum { SEAS = sizeof seas / sizeof *seas };

static void pictures_are_those_of_the_cpu(void **state)
{
    (void)state;
    static picture got, again;
    mgt_context *gl = context_of(MGT_BACKEND_GL), *cpu = context_of(MGT_BACKEND_CPU);
    for (size_t i = 0; i < SEAS; i += MGT_SANITIZED ? SEAS - 1 : 1) {
        mgt_scene scene;
        scene_file *file = load(seas[i], &scene);
        assert_true(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_SAMPLES));
        render(gl, &scene, &got);
        compare(cpu, &scene, seas[i], &got);
        if (i % 2 == 0) {
            render(gl, &scene, &again);
            assert_memory_equal(&again, &got, sizeof got);
        }
        scene_file_free(file);
    }
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
}

/* How far, with a camera that moves, and in pictures whose sides are no multiples of tiles. */
static void options_are_those_of_the_cpu(void **state)
{
    (void)state;
    static picture got;
    static const struct {
        const char *name, *sea;
        mgt_quality quality;
        bool moves;
    } cases[] = {
        {"--samples 2", "medium.json", {.samples = 2}, false},
        {"--samples 24", "smooth.json", {.samples = 24, .seed = 5}, false},
        {"--target-rmse", "smooth.json", {.target_rmse = 1e-3}, false},
        {"--target-displayed", "sunset.json", {.target_displayed = 0.03}, false},
        {"moving", "sunset.json", {.samples = 0}, true},
    };
    mgt_context *gl = context_of(MGT_BACKEND_GL), *cpu = context_of(MGT_BACKEND_CPU);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i += 1 + MGT_SANITIZED) {
        mgt_scene scene;
        scene_file *file = load(cases[i].sea, &scene);
        scene.quality.samples = cases[i].quality.samples;
        scene.quality.seed = cases[i].quality.seed;
        scene.quality.target_rmse = cases[i].quality.target_rmse;
        scene.quality.target_displayed = cases[i].quality.target_displayed;
        scene.camera_moves = cases[i].moves;
        scene.camera_open = scene.camera;
        scene.camera_open.position[0] -= 0.02;
        render(gl, &scene, &got);
        compare(cpu, &scene, cases[i].name, &got);
        scene_file_free(file);
    }
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
}

static void crops_are_parts_of_the_whole(void **state)
{
    (void)state;
    static picture whole;
    enum { X = 35, Y = 21, W = 40, H = 26 };
    static float part[W * H];
    mgt_context *gl = context_of(MGT_BACKEND_GL);
    mgt_scene scene;
    scene_file *file = load("smooth.json", &scene);
    render(gl, &scene, &whole);
    scene.image.crop_x = X, scene.image.crop_y = Y, scene.image.crop_width = W, scene.image.crop_height = H;
    const mgt_target target = target_of(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, part);
    assert_int_equal(mgt_render(gl, &scene, &target, 1), MGT_OK);
    for (size_t y = 0; y < H; y++)
        assert_memory_equal(part + y * W, whole.coverage + (y + Y) * WIDTH + X, W * sizeof(float));
    scene_file_free(file);
    mgt_context_destroy(gl);
}

/* Objects are shown alike, and what they hide takes no samples. */
static void objects_are_shown(void **state)
{
    (void)state;
    static picture expected, got;
    static const char *const scenes[] = {"shore.yaml", "hull.yaml", "diver.yaml"}; /* the last one costs sanitizers a quarter of the first */
    const int steps_off = 2;                                                       /* as in gl_agreement.c */
    const double most_steps_off = 2e-3;
    mgt_context *gl = context_of(MGT_BACKEND_GL), *cpu = context_of(MGT_BACKEND_CPU);
    for (size_t s = MGT_SANITIZED ? 2 : 0; s < sizeof scenes / sizeof *scenes; s++) {
        mgt_scene scene;
        scene_file *file = load(scenes[s], &scene);
        assert_true(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR));
        render(gl, &scene, &got);
        if (!MGT_SANITIZED)
            render(cpu, &scene, &expected);
        size_t off = 0;
        for (size_t i = 0; i < PIXELS && !MGT_SANITIZED; i++) {
            int worst = 0;
            for (size_t k = 0; k < 3; k++) {
                const int d = abs(got.shown[4 * i + k] - expected.shown[4 * i + k]);
                worst = d > worst ? d : worst;
            }
            off += worst > steps_off;
        }
        printf("  %-18s %5zu pixels off by more than %d steps\n", scenes[s], off, steps_off);
        assert_true((double)off <= most_steps_off * PIXELS);
        scene_file_free(file);
    }
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
}

/* ---- what the CPU still does ---- */

static void a_budget_of_time_is_the_cpus(void **state)
{
    (void)state;
    mgt_scene scene;
    scene_file *file = load("smooth.json", &scene);
    scene.quality.budget_ms = 20;
    assert_false(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COVERAGE));
    scene_file_free(file);
}

/* ---- nothing is read back ---- */

/* Calls by which a program learns what the GPU has done; mapping counts where it is for reading. */
static size_t reads, waits;
static PFNGLGETTEXTURESUBIMAGEPROC get_texture;
static PFNGLMAPNAMEDBUFFERRANGEPROC map_buffer;
static PFNGLCLIENTWAITSYNCPROC wait_sync;

static void APIENTRY counted_get_texture(GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width, GLsizei height, GLsizei depth, GLenum format,
                                         GLenum type, GLsizei size, void *pixels)
{
    reads++;
    get_texture(texture, level, x, y, z, width, height, depth, format, type, size, pixels);
}

static void *APIENTRY counted_map_buffer(GLuint buffer, GLintptr offset, GLsizeiptr size, GLbitfield access)
{
    reads += (access & GL_MAP_READ_BIT) != 0;
    return map_buffer(buffer, offset, size, access);
}

/* A look whether a fence has been reached does not wait. */
static GLenum APIENTRY counted_wait_sync(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    waits += timeout > 0;
    return wait_sync(sync, flags, timeout);
}

static mgt_gl_function counting_get_proc(const char *name)
{
    const mgt_gl_function function = gl_egl_get_proc(name);
    if (strcmp(name, "glGetTextureSubImage") == 0) {
        get_texture = (PFNGLGETTEXTURESUBIMAGEPROC)function;
        return (mgt_gl_function)counted_get_texture;
    }
    if (strcmp(name, "glMapNamedBufferRange") == 0) {
        map_buffer = (PFNGLMAPNAMEDBUFFERRANGEPROC)function;
        return (mgt_gl_function)counted_map_buffer;
    }
    if (strcmp(name, "glClientWaitSync") == 0) {
        wait_sync = (PFNGLCLIENTWAITSYNCPROC)function;
        return (mgt_gl_function)counted_wait_sync;
    }
    return function;
}

enum { SIDE = 64 };

static GLuint texture_of(const gl_host *h, GLenum format)
{
    GLuint name = 0;
    h->gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
    h->gl.TextureStorage2D(name, 1, format, SIDE, SIDE);
    return name;
}

static mgt_gl_texture color_texture(const gl_host *h)
{
    mgt_gl_texture t;
    mgt_gl_texture_init(&t, sizeof t);
    t.layer = MGT_LAYER_COLOR;
    t.texture = texture_of(h, GL_RGBA32F);
    return t;
}

static void nothing_is_read_back(void **state)
{
    (void)state;
    enum { FRAMES = 10 };
    gl_host h;
    gl_host_start(&h);
    mgt_context *context = gl_context_of(counting_get_proc);
    mgt_scene scene;
    scene_file *file = load("simple.json", &scene);
    scene.image = (mgt_image){.width = SIDE, .height = SIDE};
    const mgt_gl_texture texture = color_texture(&h);
    reads = waits = 0;
    for (int i = 0; i < FRAMES; i++) {
        scene.time = 0.01 * i;
        if (mgt_gl_render_textures(context, &scene, &texture, 1) != MGT_OK)
            fail_msg("%s", mgt_last_error(context));
    }
    printf("  %d frames: %zu times read back, %zu times waited for room in the ring of uniform data\n", FRAMES, reads, waits);
    assert_int_equal(reads, 0);
    scene_file_free(file);
    mgt_context_destroy(context);
    gl_host_stop(&h);
}

/* ---- a host's view ---- */

/* Level, along −z, 45 degrees high. */
static mgt_gl_view level_view(const gl_host *h, GLuint color, double height)
{
    mgt_gl_view v;
    mgt_gl_view_init(&v, sizeof v);
    h->gl.CreateFramebuffers(1, &v.framebuffer);
    h->gl.NamedFramebufferTexture(v.framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
    h->gl.NamedFramebufferTexture(v.framebuffer, GL_DEPTH_ATTACHMENT, texture_of(h, GL_DEPTH_COMPONENT32F), 0);
    const GLfloat black[4] = {0}, far_away = 1;
    h->gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, v.framebuffer);
    h->gl.ClearBufferfv(GL_COLOR, 0, black);
    h->gl.ClearBufferfv(GL_DEPTH, 0, &far_away);
    const double cot = 1 / tan(45 * 3.14159265358979323846 / 360), near_plane = 0.1, far_plane = 1e5;
    memset(v.view, 0, sizeof v.view);
    memset(v.projection, 0, sizeof v.projection);
    for (int i = 0; i < 4; i++)
        v.view[5 * i] = 1;
    v.view[13] = -height;
    v.projection[0] = v.projection[5] = cot;
    v.projection[10] = (far_plane + near_plane) / (near_plane - far_plane);
    v.projection[11] = -1;
    v.projection[14] = 2 * far_plane * near_plane / (near_plane - far_plane);
    v.width = v.height = SIDE;
    v.color = MGT_GL_COLOR_RADIANCE;
    v.draw_sky = true;
    return v;
}

static void read_color(const gl_host *h, GLuint texture, float out[SIDE * SIDE * 4])
{
    h->gl.GetTextureSubImage(texture, 0, 0, 0, 0, SIDE, SIDE, 1, GL_RGBA, GL_FLOAT, SIDE * SIDE * 4 * (GLsizei)sizeof *out, out);
}

static void views_show_the_picture(void **state)
{
    (void)state;
    static float layer[SIDE * SIDE * 4], seen[SIDE * SIDE * 4];
    gl_host h;
    gl_host_start(&h);
    mgt_context *context = gl_context_of(counting_get_proc);
    mgt_scene scene;
    scene_file *file = load("sunset.json", &scene);
    const double height = scene.camera.position[1];
    scene.image = (mgt_image){.width = SIDE, .height = SIDE};
    scene.camera = (mgt_camera){.position = {0, height, 0}, .target = {0, height, -1}, .up = {0, 1, 0}, .fov_y_deg = 45};
    const mgt_gl_texture texture = color_texture(&h);
    if (mgt_gl_render_textures(context, &scene, &texture, 1) != MGT_OK)
        fail_msg("%s", mgt_last_error(context));
    const GLuint shown = texture_of(&h, GL_RGBA32F);
    const mgt_gl_view view = level_view(&h, shown, height);
    if (mgt_gl_render_views(context, &scene, &view, 1) != MGT_OK)
        fail_msg("%s", mgt_last_error(context));
    read_color(&h, texture.texture, layer);
    read_color(&h, shown, seen);
    size_t off = 0;
    for (size_t y = 0; y < SIDE; y++)
        for (size_t x = 0; x < 4 * (size_t)SIDE; x++) {
            const double a = (double)layer[y * SIDE * 4 + x], b = (double)seen[(SIDE - 1 - y) * SIDE * 4 + x];
            off += !(fabs(a - b) <= 1e-2 * fmax(fabs(a), 1));
        }
    printf("  %zu of %d values differ\n", off, SIDE * SIDE * 4);
    assert_true(off <= SIDE * SIDE * 4 / 200);
    scene_file_free(file);
    mgt_context_destroy(context);
    gl_host_stop(&h);
}

/* ---- foam ---- */

/* The layer in pictures and in textures, of the method whose pixels cells begin with. */
static void foam_is_that_of_the_cpu(void **state)
{
    (void)state;
    static float expected[SIDE * SIDE], got[SIDE * SIDE], held[SIDE * SIDE], coverage[SIDE * SIDE];
    gl_host h;
    gl_host_start(&h);
    mgt_context *context = gl_context_of(counting_get_proc);
    mgt_context *cpu = context_of(MGT_BACKEND_CPU);
    mgt_scene scene;
    scene_file *file = load("../tests/gl/foam.yaml", &scene);
    scene.image = (mgt_image){.width = SIDE, .height = SIDE};
    scene.quality.method = MGT_METHOD_MANGATA;
    const mgt_target truly = target_of(MGT_LAYER_FOAM, MGT_FORMAT_R32F, expected);
    const mgt_target targets[] = {target_of(MGT_LAYER_FOAM, MGT_FORMAT_R32F, got), target_of(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage)};
    mgt_gl_texture texture = color_texture(&h);
    texture.layer = MGT_LAYER_FOAM;
    assert_int_equal(mgt_gl_render_textures(context, &scene, &texture, 1), MGT_ERROR_ARGUMENT); /* four channels */
    assert_non_null(strstr(mgt_last_error(context), "layer foam (GL_R32F or GL_R16F)"));
    texture.texture = texture_of(&h, GL_R32F);
    assert_true(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_FOAM));
    if (mgt_render(cpu, &scene, &truly, 1) != MGT_OK || mgt_render(context, &scene, targets, 2) != MGT_OK ||
        mgt_gl_render_textures(context, &scene, &texture, 1) != MGT_OK)
        fail_msg("%s%s", mgt_last_error(cpu), mgt_last_error(context));
    h.gl.GetTextureSubImage(texture.texture, 0, 0, 0, 0, SIDE, SIDE, 1, GL_RED, GL_FLOAT, sizeof held, held);
    double sum = 0, squared = 0;
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        const double off = (double)got[i] - (double)expected[i];
        sum += (double)expected[i];
        squared += off * off;
    }
    printf("  %.2f %% of the picture is foam, rms %.1e\n", 100 * sum / (SIDE * SIDE), sqrt(squared / (SIDE * SIDE)));
    assert_true(sum > 1e-3 * SIDE * SIDE);
    assert_true(sqrt(squared / (SIDE * SIDE)) <= largest_rms);
    assert_memory_equal(held, got, sizeof held);
    scene_file_free(file);
    mgt_context_destroy(cpu);
    mgt_context_destroy(context);
    gl_host_stop(&h);
}

int main(void)
{
    if (gl_is_missing())
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_those_of_the_cpu), cmocka_unit_test(options_are_those_of_the_cpu),
        cmocka_unit_test(crops_are_parts_of_the_whole),  cmocka_unit_test(objects_are_shown),
        cmocka_unit_test(a_budget_of_time_is_the_cpus),  cmocka_unit_test(nothing_is_read_back),
        cmocka_unit_test(views_show_the_picture),        cmocka_unit_test(foam_is_that_of_the_cpu),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
