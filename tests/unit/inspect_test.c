/* SPDX-License-Identifier: MIT */
/* mgt_inspect_pixel() against the rendered frame and against the waves themselves; mgt_display() against mgt_render(). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mangata/mangata.h"
#include "scene/scene_file.h"

enum { WIDTH = 160, HEIGHT = 90, PIXELS = WIDTH * HEIGHT };
static const double pi = 3.14159265358979323846;

static mgt_context *make_context(mgt_backend backend)
{
    mgt_context *context = NULL;
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = backend;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    return context;
}

static void render(mgt_context *context, const mgt_scene *scene, mgt_layer layer, mgt_format format, void *pixels)
{
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.layer = layer;
    target.format = format;
    target.pixels = pixels;
    if (mgt_render(context, scene, &target, 1) != MGT_OK)
        fail_msg("%s", mgt_last_error(context));
}

static mgt_pixel_info inspect(mgt_context *context, const mgt_scene *scene, uint32_t x, uint32_t y)
{
    mgt_pixel_info info = {.struct_size = sizeof info};
    if (mgt_inspect_pixel(context, scene, x, y, &info) != MGT_OK)
        fail_msg("%s", mgt_last_error(context));
    return info;
}

static void check_frame(mgt_context *context, const mgt_scene *scene)
{
    float *color = malloc(PIXELS * 3 * sizeof *color), *coverage = malloc(PIXELS * sizeof *coverage), *water = malloc(PIXELS * sizeof *water);
    assert_true(color && coverage && water);
    render(context, scene, MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, color);
    render(context, scene, MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage);
    render(context, scene, MGT_LAYER_MASK, MGT_FORMAT_R32F, water);
    size_t lit = 0;
    for (uint32_t y = 0; y < HEIGHT; y += 3)
        for (uint32_t x = y % 7; x < WIDTH; x += 7) {
            const size_t i = y * WIDTH + x;
            const mgt_pixel_info info = inspect(context, scene, x, y);
            assert_true((float)info.water == water[i]);
            assert_true((float)info.coverage == coverage[i]);
            for (size_t c = 0; c < 3; c++)
                assert_true((float)info.radiance[c] == color[3 * i + c]);
            if (info.water > 0)
                assert_int_equal(info.resolved + info.mixed + info.filtered, scene->water.wave_count);
            lit += info.coverage > 1e-4;
        }
    assert_true(lit > 5);
    free(color);
    free(coverage);
    free(water);
}

static void pixels_are_the_frames(void **state)
{
    (void)state;
    static const char *const names[] = {"sunset", "high", "rough", "smooth"};
    static const char *const words[] = {"image.width=160", "image.height=90"};
    mgt_context *context = make_context(MGT_BACKEND_CPU);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[512];
        scene_error error;
        mgt_scene scene;
        snprintf(path, sizeof path, "%s/scenes/%s.json", MGT_SOURCE_DIR, names[i]);
        scene_file *file = scene_file_load(path, words, 2, &error);
        if (file == NULL)
            fail_msg("%s", error.text);
        assert_true(scene_file_frame(file, 3, &scene));
        check_frame(context, &scene);
        /* A camera that moves takes another way. */
        scene.camera_open = scene.camera;
        scene.camera_open.position[0] -= 0.05;
        scene.camera_moves = true;
        check_frame(context, &scene);
        scene_file_free(file);
    }
    mgt_context_destroy(context);
}

/* A sea of 20 m/s with foam and air, far above the zero of heights. */
static mgt_scene stormy_scene(mgt_wave *waves, size_t count)
{
    mgt_scene scene;
    mgt_sea sea;
    mgt_scene_init(&scene, sizeof scene);
    mgt_sea_init(&sea, sizeof sea);
    sea.wind = 20;
    sea.count = 48;
    sea.foam = 4;
    mgt_sea_scene(&sea, waves, count, &scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.water.level = 50;
    scene.camera.position[1] = 70;
    scene.camera.target[1] = 67;
    scene.camera.target[2] = -8;
    scene.light.elevation_deg = 30;
    scene.light.angular_radius_deg = 5;
    return scene;
}

static void foam_and_air_are_the_frames(void **state)
{
    (void)state;
    static mgt_wave waves[MGT_MAX_WAVES];
    static float foam[PIXELS], depth[PIXELS];
    mgt_context *context = make_context(MGT_BACKEND_CPU);
    mgt_scene scene = stormy_scene(waves, MGT_MAX_WAVES);
    assert_true(scene.foam > 0 && scene.aerial);
    check_frame(context, &scene);
    render(context, &scene, MGT_LAYER_FOAM, MGT_FORMAT_R32F, foam);
    render(context, &scene, MGT_LAYER_DEPTH, MGT_FORMAT_R32F, depth);
    size_t foamy = 0, near = 0, agree = 0;
    for (uint32_t y = HEIGHT / 2; y < HEIGHT; y += 6)
        for (uint32_t x = 0; x < WIDTH; x += 11) {
            const size_t i = y * WIDTH + x;
            const mgt_pixel_info info = inspect(context, &scene, x, y);
            double square = 0;
            for (int axis = 0; axis < 3; axis++)
                square += pow(info.position[axis] - scene.camera.position[axis], 2);
            assert_true(fabs(sqrt(square) / info.distance - 1) < 1e-6);
            foamy += foam[i] > 0.05f;
            near++;
            agree += fabs(info.distance / (double)depth[i] - 1) < 1e-3;
        }
    assert_true(foamy > near / 2 && agree > near * 19 / 20);
    mgt_context_destroy(context);
}

static const mgt_wave long_waves[] = {{0.05, 1.1, 0.4, -3.2, 0.3}, {0.03, -0.5, 1.3, -3.6, 2.0}};

static mgt_scene calm_scene(void)
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.camera.position[1] = 2;
    scene.camera.target[1] = 1;
    scene.camera.target[2] = -2;
    scene.camera.fov_y_deg = 30;
    scene.shutter = 0;
    scene.time = 1.25;
    scene.light.elevation_deg = 30;
    scene.light.angular_radius_deg = 2;
    scene.water.waves = long_waves;
    scene.water.wave_count = 2;
    return scene;
}

static double height_at(const mgt_scene *scene, double x, double z)
{
    double height = 0;
    for (size_t i = 0; i < scene->water.wave_count; i++) {
        const mgt_wave *w = &scene->water.waves[i];
        height += w->amplitude * sin(w->kx * x + w->kz * z + w->omega * scene->time + w->phase);
    }
    return height;
}

static void hits_lie_on_the_water_and_slopes_are_its_own(void **state)
{
    (void)state;
    mgt_context *context = make_context(MGT_BACKEND_CPU);
    const mgt_scene scene = calm_scene();
    const double step = 1e-4;
    for (uint32_t y = 5; y < HEIGHT; y += 10)
        for (uint32_t x = 5; x < WIDTH; x += 10) {
            const mgt_pixel_info info = inspect(context, &scene, x, y);
            const double px = info.position[0], pz = info.position[2];
            assert_true(info.water == 1);
            assert_true(fabs(info.position[1] - height_at(&scene, px, pz)) < 1e-6);
            const double dx = px - scene.camera.position[0], dy = info.position[1] - scene.camera.position[1], dz = pz - scene.camera.position[2];
            assert_true(fabs(sqrt(dx * dx + dy * dy + dz * dz) - info.distance) < 1e-6);
            const double sx = (height_at(&scene, px + step, pz) - height_at(&scene, px - step, pz)) / (2 * step);
            const double sz = (height_at(&scene, px, pz + step) - height_at(&scene, px, pz - step)) / (2 * step);
            /* What is left is the smallest part of the waves that this pixel does not resolve. */
            assert_true(fabs(info.slope_close[0] - sx) < 1e-3 && fabs(info.slope_close[1] - sz) < 1e-3);
            assert_true(info.slope_open[0] == info.slope_close[0] && info.slope_open[1] == info.slope_close[1]);
            assert_true(info.unresolved[0] >= 0 && info.unresolved[2] >= 0 && info.unresolved[0] + info.unresolved[2] < 1e-4);
        }
    mgt_context_destroy(context);
}

/* The mirrored view on the light plane r·L = 1, from the light's centre, for a slope. */
static void mirror_on_plane(const mgt_scene *scene, const mgt_pixel_info *info, const double slope[2], double out[2])
{
    const double el = scene->light.elevation_deg * pi / 180, az = scene->light.azimuth_deg * pi / 180;
    const double light[3] = {sin(az) * cos(el), sin(el), -cos(az) * cos(el)};
    double n[3] = {-slope[0], 1, -slope[1]}, view[3], ray[3], dot = 0, along = 0;
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++) {
        n[i] /= length;
        view[i] = (info->position[i] - scene->camera.position[i]) / info->distance;
        dot += n[i] * view[i];
    }
    for (int i = 0; i < 3; i++) {
        ray[i] = view[i] - 2 * dot * n[i];
        along += ray[i] * light[i];
    }
    const double e[3] = {-cos(az), 0, -sin(az)}, f[3] = {-sin(az) * sin(el), cos(el), cos(az) * sin(el)};
    out[0] = out[1] = 0;
    for (int i = 0; i < 3; i++) {
        out[0] += ray[i] / along * e[i];
        out[1] += ray[i] / along * f[i];
    }
}

static void the_path_is_that_of_the_mirrored_view(void **state)
{
    (void)state;
    mgt_context *context = make_context(MGT_BACKEND_CPU);
    mgt_scene scene = calm_scene();
    scene.shutter = 0.05;
    size_t near = 0;
    for (uint32_t y = 5; y < HEIGHT; y += 5)
        for (uint32_t x = 5; x < WIDTH; x += 5) {
            const mgt_pixel_info info = inspect(context, &scene, x, y);
            double exact[2], close[2];
            if (info.light_radius == 0)
                continue;
            assert_true(fabs(info.light_radius - tan(scene.light.angular_radius_deg * pi / 180)) < 1e-6);
            mirror_on_plane(&scene, &info, info.mirror_slope, exact);
            assert_true(fabs(exact[0]) < 2e-3 && fabs(exact[1]) < 2e-3);
            mirror_on_plane(&scene, &info, info.slope_close, close);
            if (hypot(close[0], close[1]) > 0.15)
                continue;
            near++;
            /* The model takes the map as straight about the mirror slope. */
            assert_true(hypot(close[0] - info.path[1][0], close[1] - info.path[1][1]) < 0.006 + 0.15 * hypot(close[0], close[1]));
            const double *c = info.covariance;
            assert_true(c[0] > 0 && c[2] > 0 && c[0] * c[2] >= c[1] * c[1]);
        }
    assert_true(near > 10);
    mgt_context_destroy(context);
}

static void wrong_arguments_are_refused(void **state)
{
    (void)state;
    mgt_context *context = make_context(MGT_BACKEND_NULL); /* inspecting is the CPU's, whatever renders */
    mgt_scene scene = calm_scene();
    mgt_pixel_info info = {.struct_size = sizeof info};
    assert_int_equal(mgt_inspect_pixel(context, &scene, 10, 80, &info), MGT_OK);
    assert_true(info.water == 1);
    assert_int_equal(mgt_inspect_pixel(context, &scene, WIDTH, 0, &info), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(mgt_last_error(context), "160, 0"));
    assert_int_equal(mgt_inspect_pixel(context, &scene, 0, HEIGHT, &info), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_inspect_pixel(context, &scene, 0, 0, NULL), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_inspect_pixel(NULL, &scene, 0, 0, &info), MGT_ERROR_ARGUMENT);
    info.struct_size--;
    assert_int_equal(mgt_inspect_pixel(context, &scene, 0, 0, &info), MGT_ERROR_ARGUMENT);
    scene.camera.fov_y_deg = -1;
    info.struct_size++;
    assert_int_equal(mgt_inspect_pixel(context, &scene, 0, 0, &info), MGT_ERROR_SCENE);
    mgt_context_destroy(context);
}

static void displayed_radiance_is_what_render_displays(void **state)
{
    (void)state;
    mgt_context *context = make_context(MGT_BACKEND_CPU), *other = make_context(MGT_BACKEND_NULL);
    static float radiance[PIXELS * 3];
    static uint8_t rendered[PIXELS * 4], shown[PIXELS * 4];
    mgt_scene scene = calm_scene();
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    for (int glare = 0; glare < 2; glare++) {
        scene.post.glare = glare ? 0.1f : 0;
        render(context, &scene, MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, radiance);
        render(context, &scene, MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, rendered);
        target.pixels = shown;
        assert_int_equal(mgt_display(context, &scene, radiance, &target), MGT_OK);
        assert_memory_equal(rendered, shown, sizeof shown);
        memset(shown, 0, sizeof shown);
        assert_int_equal(mgt_display(other, &scene, radiance, &target), MGT_OK);
        assert_memory_equal(rendered, shown, sizeof shown);
    }
    assert_int_equal(mgt_display(context, &scene, NULL, &target), MGT_ERROR_ARGUMENT);
    target.format = MGT_FORMAT_RGB32F;
    assert_int_equal(mgt_display(context, &scene, radiance, &target), MGT_ERROR_ARGUMENT);
    mgt_context_destroy(context);
    mgt_context_destroy(other);
}

static void exposure_set_by_hand_displays_the_same(void **state)
{
    (void)state;
    static uint8_t automatic[PIXELS * 4], fixed[PIXELS * 4];
    mgt_context *context = make_context(MGT_BACKEND_CPU), *other = make_context(MGT_BACKEND_NULL);
    mgt_scene scene = calm_scene();
    scene.sky.model = MGT_SKY_GRADIENT; /* soon built */
    scene.post.exposure_ev = 0.7;
    render(context, &scene, MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, automatic);
    double stops = 0, again = 0;
    assert_int_equal(mgt_exposure(context, &scene, &stops), MGT_OK);
    assert_int_equal(mgt_exposure(other, &scene, &again), MGT_OK);
    assert_true(stops == again && stops != 0.7);
    scene.post.auto_exposure = false;
    scene.post.exposure_ev = stops;
    render(context, &scene, MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, fixed);
    assert_memory_equal(automatic, fixed, sizeof fixed);
    assert_int_equal(mgt_exposure(context, &scene, &again), MGT_OK);
    assert_true(again == stops);
    assert_int_equal(mgt_exposure(context, &scene, NULL), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_exposure(NULL, &scene, &again), MGT_ERROR_ARGUMENT);
    scene.post.exposure_ev = NAN;
    assert_int_equal(mgt_exposure(context, &scene, &again), MGT_ERROR_SCENE);
    assert_true(again == stops);
    mgt_context_destroy(context);
    mgt_context_destroy(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_the_frames),
        cmocka_unit_test(exposure_set_by_hand_displays_the_same),
        cmocka_unit_test(foam_and_air_are_the_frames),
        cmocka_unit_test(hits_lie_on_the_water_and_slopes_are_its_own),
        cmocka_unit_test(the_path_is_that_of_the_mirrored_view),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(displayed_radiance_is_what_render_displays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
