/* SPDX-License-Identifier: MIT
 *
 * Method adaptive, scheme podee, with OpenGL: its pictures against the CPU's, the same bytes again, and frames of a host that nothing waits for.
 */
#include "gl_sea.h"

#include "mangata/gl.h"

typedef struct picture {
    float color[PIXELS * 3], coverage[PIXELS], mask[PIXELS], samples[PIXELS], importance[PIXELS], detail[PIXELS], depth[PIXELS];
} picture;

static void render(mgt_context *context, const mgt_scene *scene, picture *out)
{
    const mgt_target targets[] = {
        sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, out->color, 0),
        sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, out->coverage, 0),
        sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, out->mask, 0),
        sea_target(MGT_LAYER_SAMPLES, MGT_FORMAT_R32F, out->samples, 0),
        sea_target(MGT_LAYER_IMPORTANCE, MGT_FORMAT_R32F, out->importance, 0),
        sea_target(MGT_LAYER_DETAIL, MGT_FORMAT_R32F, out->detail, 0),
        sea_target(MGT_LAYER_DEPTH, MGT_FORMAT_R32F, out->depth, 0),
    };
    memset(out, 0xff, sizeof *out);
    sea_render(context, scene, targets, sizeof targets / sizeof *targets);
}

static mgt_scene podee_scene(mgt_wave waves[SEA_WAVES])
{
    mgt_scene s = sea_scene(waves);
    s.shutter = 0.02;
    s.quality.method = MGT_METHOD_ADAPTIVE;
    s.quality.adaptive = MGT_ADAPTIVE_PODEE;
    return s;
}

/* ---- against the CPU ---- */

/* RMS over the pixels that have the same number of samples. */
static double rms_of(const picture *a, const picture *b, const float *x, const float *y, size_t channels)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < PIXELS; i++)
        for (size_t c = 0; c < channels && a->samples[i] == b->samples[i]; c++) {
            const double scale = fmax(1, fabs((double)y[channels * i + c]));
            const double d = ((double)x[channels * i + c] - (double)y[channels * i + c]) / scale;
            sum += d * d;
            count++;
        }
    return sqrt(sum / (double)(count ? count : 1));
}

static double sum_of(const float *values)
{
    double sum = 0;
    for (size_t i = 0; i < PIXELS; i++)
        sum += (double)values[i];
    return sum;
}

static void expect_same_picture(const char *name, const picture *gl, const picture *cpu)
{
    size_t recounted = 0, tasks = 0;
    for (size_t i = 0; i < PIXELS; i++) {
        recounted += gl->samples[i] != cpu->samples[i];
        tasks += cpu->importance[i] > 0;
        assert_true((gl->samples[i] > 0) <= (gl->importance[i] > 0));
        if (gl->samples[i] == 0)
            assert_true(gl->detail[i] == 0);
    }
    const double rms[] = {rms_of(gl, cpu, gl->color, cpu->color, 3), rms_of(gl, cpu, gl->coverage, cpu->coverage, 1), rms_of(gl, cpu, gl->mask, cpu->mask, 1),
                          rms_of(gl, cpu, gl->importance, cpu->importance, 1), rms_of(gl, cpu, gl->detail, cpu->detail, 1)};
    print_message("  %-14s %6.0f samples of %4zu pixels; other numbers: %zu; rms %.1e %.1e %.1e %.1e %.1e\n", name, sum_of(gl->samples), tasks, recounted,
                  rms[0], rms[1], rms[2], rms[3], rms[4]);
    assert_true(sum_of(gl->samples) == sum_of(cpu->samples) && tasks > 0);
    if (200 * recounted > PIXELS)
        fail_msg("%s: %zu pixels have got another number of samples", name, recounted);
    for (size_t i = 0; i < sizeof rms / sizeof *rms; i++)
        if (!(rms[i] <= 5e-5))
            fail_msg("%s: layer %zu differs by %g rms", name, i, rms[i]);
}

enum { CASES = 9 };

static const char *change_scene(mgt_scene *s, int i)
{
    switch (i) {
    case 0:
        return "defaults";
    case 1:
        s->shutter = 0;
        s->quality.seed = 0xfedcba9876543210;
        return "an instant";
    case 2:
        s->camera_moves = true;
        s->camera_open = s->camera;
        s->camera_open.position[0] = -0.05;
        return "camera moves";
    case 3:
        s->sky.model = MGT_SKY_BLACK;
        s->quality.samples = 2.5;
        return "black sky";
    case 4:
        s->quality.sample_slots = 40001; /* in two chunks of a software rasteriser */
        s->quality.importance_threshold = 0.9;
        return "many a pixel";
    case 5:
        s->quality.sample_slots = 11;
        return "few in all";
    case 6:
        s->quality.importance_center = 0.3;
        s->quality.importance_width = 0.2;
        s->quality.importance_threshold = 1e-4;
        return "other rules";
    case 7:
        s->camera.position[1] = -2;
        s->camera.target[1] = 0;
        s->light.elevation_deg = 60;
        return "under water";
    default:
        s->water.wave_count = 0;
        s->quality.importance_center = 1e-3; /* the light's mirror image has an edge of few pixels */
        s->quality.importance_width = 1;
        return "no waves";
    }
}

static void pictures_are_those_of_the_cpu(void **state)
{
    (void)state;
    static picture got, expected;
    mgt_wave waves[SEA_WAVES];
    mgt_context *gl = gl_context(), *cpu = sea_context(2, MGT_ISA_AUTO);
    for (int i = 0; i < CASES; i++) {
        mgt_scene scene = podee_scene(waves);
        const char *name = change_scene(&scene, i);
        assert_true(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_SAMPLES));
        render(cpu, &scene, &expected);
        render(gl, &scene, &got);
        expect_same_picture(name, &got, &expected);
        expect_same("depth", got.depth, expected.depth, PIXELS, 2e-3);
    }
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
}

/* Without tasks the approximate picture is all there is. */
static void no_task_no_sample(void **state)
{
    (void)state;
    static picture got, approximate;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = podee_scene(waves);
    scene.light.elevation_deg = 89;
    mgt_context *gl = gl_context();
    render(gl, &scene, &got);
    assert_true(sum_of(got.samples) == 0 && sum_of(got.importance) == 0 && sum_of(got.detail) == 0);
    scene.quality.method = MGT_METHOD_PODEE_UNIFORM;
    scene.quality.adaptive = MGT_ADAPTIVE_CELLS;
    render(gl, &scene, &approximate);
    assert_memory_equal(got.color, approximate.color, sizeof got.color);
    assert_memory_equal(got.coverage, approximate.coverage, sizeof got.coverage);
    mgt_context_destroy(gl);
}

/* The same bytes again, in a fresh context, and within a crop. */
static void bytes_do_not_change(void **state)
{
    (void)state;
    static picture first, again;
    static float part[PIXELS];
    enum { X = 35, Y = 17, W = 40, H = 26 };
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = podee_scene(waves);
    mgt_scene crop = scene, other = scene;
    crop.image.crop_x = X, crop.image.crop_y = Y, crop.image.crop_width = W, crop.image.crop_height = H;
    other.time += 1;
    for (int fresh = 0; fresh < 2; fresh++) {
        mgt_context *gl = gl_context();
        if (fresh) {
            render(gl, &other, &again);
            assert_memory_not_equal(&again, &first, sizeof again);
        }
        render(gl, &scene, fresh ? &again : &first);
        for (int layer = MGT_LAYER_SAMPLES; layer <= MGT_LAYER_DETAIL && fresh; layer++) {
            const float *whole = layer == MGT_LAYER_SAMPLES ? first.samples : layer == MGT_LAYER_IMPORTANCE ? first.importance : first.detail;
            const mgt_target target = sea_target((mgt_layer)layer, MGT_FORMAT_R32F, part, 0);
            sea_render(gl, &crop, &target, 1);
            for (size_t y = 0; y < H; y++)
                assert_memory_equal(part + y * W, whole + (y + Y) * SEA_WIDTH + X, W * sizeof(float));
        }
        mgt_context_destroy(gl);
    }
    assert_memory_equal(&again, &first, sizeof again);
}

/* What is left to the CPU. */
static void limits_are_told(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = podee_scene(waves);
    assert_true(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR));
    scene.quality.sample_slots = 2147483647;
    assert_true(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR));
    scene.quality.sample_slots++;
    assert_false(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR));
    scene.quality.sample_slots = 0;
    scene.quality.samples = 4096;
    assert_true(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR));
    scene.image = (mgt_image){.width = 1024, .height = 513};
    assert_false(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR));
}

/* ---- frames of a host ---- */

/* Calls by which a program reads what the GPU has made; and waits for room in the ring of uniform data, where the host is ahead of the GPU. */
static int read_backs, waits;
static gl_host host;

static void APIENTRY count_get_texture(GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width, GLsizei height, GLsizei depth, GLenum format,
                                       GLenum type, GLsizei size, void *pixels)
{
    read_backs++;
    host.gl.GetTextureSubImage(texture, level, x, y, z, width, height, depth, format, type, size, pixels);
}

static void *APIENTRY count_map(GLuint buffer, GLintptr offset, GLsizeiptr length, GLbitfield access)
{
    read_backs += (access & GL_MAP_READ_BIT) != 0;
    return host.gl.MapNamedBufferRange(buffer, offset, length, access);
}

/* A look at a fence is no wait. */
static GLenum APIENTRY count_wait(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    waits += timeout > 0;
    return host.gl.ClientWaitSync(sync, flags, timeout);
}

static mgt_gl_function counting_get_proc(const char *name)
{
    if (strcmp(name, "glGetTextureSubImage") == 0)
        return (mgt_gl_function)count_get_texture;
    if (strcmp(name, "glMapNamedBufferRange") == 0)
        return (mgt_gl_function)count_map;
    if (strcmp(name, "glClientWaitSync") == 0)
        return (mgt_gl_function)count_wait;
    return gl_egl_get_proc(name);
}

static GLuint host_texture(void)
{
    GLuint name = 0;
    host.gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
    host.gl.TextureStorage2D(name, 1, GL_R32F, SEA_WIDTH, SEA_HEIGHT);
    return name;
}

/* A hundred frames of a moving sea into textures of a host; the last one holds what mgt_render() gets. */
static void frames_are_not_waited_for(void **state)
{
    (void)state;
    static float got[2][PIXELS], expected[2][PIXELS];
    enum { FRAMES = 100 };
    static const mgt_layer written[] = {MGT_LAYER_COVERAGE, MGT_LAYER_SAMPLES};
    gl_host_start(&host);
    mgt_context *context = gl_context_of(counting_get_proc);

    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = podee_scene(waves);
    scene.quality.sample_slots = 500;
    mgt_gl_texture textures[2];
    for (int i = 0; i < 2; i++) {
        mgt_gl_texture_init(&textures[i], sizeof *textures);
        textures[i].layer = written[i];
        textures[i].texture = host_texture();
    }
    read_backs = 0;
    for (int f = 0; f < FRAMES; f++) {
        scene.time = 3 + 0.02 * f;
        if (mgt_gl_render_textures(context, &scene, textures, 2) != MGT_OK)
            fail_msg("%s", mgt_last_error(context));
    }
    print_message("  %d frames: %d readbacks, %d waits for room\n", FRAMES, read_backs, waits);
    assert_int_equal(read_backs, 0);
    for (int i = 0; i < 2; i++)
        host.gl.GetTextureSubImage(textures[i].texture, 0, 0, 0, 0, SEA_WIDTH, SEA_HEIGHT, 1, GL_RED, GL_FLOAT, sizeof got[i], got[i]);
    const mgt_target targets[] = {sea_target(written[0], MGT_FORMAT_R32F, expected[0], 0), sea_target(written[1], MGT_FORMAT_R32F, expected[1], 0)};
    sea_render(context, &scene, targets, 2);
    assert_true(read_backs > 0 && sum_of(got[1]) == 500);
    assert_memory_equal(got, expected, sizeof got);
    for (int i = 0; i < 2; i++)
        host.gl.DeleteTextures(1, &textures[i].texture);
    mgt_context_destroy(context);
    gl_host_stop(&host);
}

int main(void)
{
    if (gl_is_missing())
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_those_of_the_cpu), cmocka_unit_test(no_task_no_sample),
        cmocka_unit_test(bytes_do_not_change),           cmocka_unit_test(limits_are_told),
        cmocka_unit_test(frames_are_not_waited_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
