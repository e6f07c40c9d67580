/* SPDX-License-Identifier: MIT
 *
 * Where the far water ends. Under water both sides of the horizon show the water's own light, whether the camera rests or moves, by traced rays as well.
 * Above, what the water mirrors of a far wall has the air's light, water of few octaves mirrors as much of the sky as brute force says,
 * and a low light is mirrored only before itself.
 */
#include "unit/api_sea.h"

#include "unit/text_scene.h"

enum { WIDTH = 16, HEIGHT = 24, MIDDLE = HEIGHT / 2, PIXELS = WIDTH * HEIGHT };

/* The horizon lies between rows MIDDLE − 1 and MIDDLE. */
static const char sea[] = "mangata: 1\n"
                          "image: {width: 16, height: 24}\n"
                          "camera: {position: [0, -3, 0], target: [0, -3, -10], fov_y_deg: 30}\n"
                          "light: {elevation_deg: 55, azimuth_deg: 20}\n"
                          "time: {start: 3, shutter: 0}\n"
                          "water:\n"
                          "  clarity: clear\n"
                          "  waves:\n"
                          "    - {amplitude: 0.2, a: 0.6, b: 0.5, c: -2.8, phase: 0.7}\n"
                          "    - {amplitude: 0.06, a: -1.2, b: 1.9, c: -4.7, phase: 2.1}\n"
                          "    - {amplitude: 0.03, a: 2.9, b: 3.4, c: -6.6, phase: 4}\n"
                          "    - {amplitude: 0.01, a: -9, b: 7, c: -10.6, phase: 1}\n";

static void render(mgt_context *context, const mgt_scene *scene, float color[3 * PIXELS])
{
    const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, color, 0);
    sea_render(context, scene, &target, 1);
}

/* Mean green of a row. */
static double mean_green(const float *color, int row)
{
    double sum = 0;
    for (int x = 0; x < WIDTH; x++)
        sum += (double)color[3 * (row * WIDTH + x) + 1] / WIDTH;
    return sum;
}

/* ---- a camera at rest ---- */

/* From below the surface mirrors the deep water at the horizon. Light from both sides of it has come through the same water, so that it is the same. */
static void both_sides_are_the_same(void **state)
{
    (void)state;
    static float color[3 * PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene v = text_scene_read(sea, NULL, 0);
    static const mgt_method methods[] = {MGT_METHOD_MANGATA, MGT_METHOD_NONE, MGT_METHOD_PODEE_PIXEL};
    static const mgt_refraction ways[] = {MGT_REFRACTION_TWO_PHASE, MGT_REFRACTION_HYBRID, MGT_REFRACTION_OFF, MGT_REFRACTION_PATH_TRACED};
    for (int i = 0; i < 12; i++) {
        v.scene.quality.method = methods[i % 3];
        v.scene.quality.refraction = ways[i / 3];
        v.scene.quality.refraction_samples = 1;
        const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, color, 0);
        const mgt_status status = mgt_render(context, &v.scene, &target, 1);
        if (status == MGT_ERROR_UNAVAILABLE)
            continue;
        assert_int_equal(status, MGT_OK);
        const double over = mean_green(color, MIDDLE - 1), under = mean_green(color, MIDDLE);
        printf("under water, method %d, refraction %d: %.3f over the horizon, %.3f under it\n", methods[i % 3], ways[i / 3], over, under);
        assert_true(fabs(over / under - 1) < 0.04);
    }
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

/* A row that the horizon passes through has the light of those beside it. The rays through the middle of its pixels are below the horizon. */
static void traced_rows_have_no_gap(void **state)
{
    (void)state;
    static float color[3 * PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    static const char *const tilted[] = {"camera.target=[0, -3.15, -10]"};
    text_scene v = text_scene_read(sea, tilted, 1);
    v.scene.quality.refraction = MGT_REFRACTION_PATH_TRACED;
    v.scene.quality.refraction_samples = 1;
    static const mgt_method methods[] = {MGT_METHOD_MANGATA, MGT_METHOD_SSAA};
    for (int i = 0; i < 2; i++) {
        v.scene.quality.method = methods[i];
        v.scene.quality.spatial_samples = 4;
        const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, color, 0);
        const mgt_status status = mgt_render(context, &v.scene, &target, 1);
        if (status == MGT_ERROR_UNAVAILABLE)
            skip();
        assert_int_equal(status, MGT_OK);
        for (int row = MIDDLE - 3; row <= MIDDLE + 1; row++) {
            const double here = mean_green(color, row), beside = 0.5 * (mean_green(color, row - 1) + mean_green(color, row + 1));
            printf("traced, method %d: row %d has %.3f, those beside it %.3f\n", methods[i], row, here, beside);
            assert_true(fabs(here / beside - 1) < 0.02);
        }
    }
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

/* ---- a moving camera ---- */

static void tilt(mgt_camera *camera, double share) { camera->target[1] = -3 + share * 0.6; }

/* While the shutter is open the horizon passes over rows. They have the mean light of cameras at rest. */
static void moving_horizons_are_means(void **state)
{
    (void)state;
    enum { INSTANTS = 16 };
    static float color[3 * PIXELS], instant[3 * PIXELS], mean[3 * PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene v = text_scene_read(sea, NULL, 0);
    v.scene.shutter = 1e-4; /* the waves stand still */
    v.scene.camera_moves = true;
    static const mgt_method methods[] = {MGT_METHOD_MANGATA, MGT_METHOD_PODEE_PIXEL, MGT_METHOD_SSAA};
    for (int i = 0; i < 6; i++) {
        const double way = i % 2 ? 1 : -1;
        mgt_scene moving = v.scene;
        moving.quality.method = methods[i / 2];
        moving.quality.spatial_samples = moving.quality.time_samples = 2;
        moving.camera_open = moving.camera;
        tilt(&moving.camera, way);
        tilt(&moving.camera_open, -way);
        render(context, &moving, color);
        memset(mean, 0, sizeof mean);
        for (int k = 0; k < INSTANTS; k++) {
            mgt_scene still = v.scene;
            still.camera_moves = false;
            tilt(&still.camera, 2 * (k + 0.5) / INSTANTS - 1);
            render(context, &still, instant);
            for (int p = 0; p < 3 * PIXELS; p++)
                mean[p] += instant[p] / INSTANTS;
        }
        double worst = 0;
        for (int row = MIDDLE - 3; row < MIDDLE + 3; row++)
            for (int p = row * WIDTH; p < (row + 1) * WIDTH; p++)
                worst = fmax(worst, fabs((double)color[3 * p + 1] / (double)mean[3 * p + 1] - 1));
        printf("a camera that tilts %s, method %d: off by %.3f at most between the horizons\n", way > 0 ? "up" : "down", methods[i / 2], worst);
        assert_true(worst < 0.1);
    }
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

/* ---- the air before what is mirrored ---- */

/* A black wall 60 km away shows the air's light alone, which is that of the sky at the horizon. Still water mirrors it as it mirrors the sky there. */
static void mirrored_walls_have_air(void **state)
{
    (void)state;
    static const char *const wall[] = {"camera={position: [0, 2, 0], target: [0, 2, -10], fov_y_deg: 4}", "water.waves=[]", "sky.turbidity=10",
                                       "objects=[{shape: box, size: [40000, 8000, 1000], position: [0, 0, -60000], material: {base_color: [0, 0, 0]}}]"};
    static float with[3 * PIXELS], without[3 * PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene v = text_scene_read(sea, wall, 4);
    v.scene.aerial = true;
    render(context, &v.scene, with);
    v.scene.object_count = 0;
    render(context, &v.scene, without);
    for (int row = MIDDLE + 1; row < HEIGHT; row++) {
        printf("row %d: the mirrored wall has %.3f, the mirrored sky %.3f\n", row, mean_green(with, row), mean_green(without, row));
        assert_true(fabs(mean_green(with, row) / mean_green(without, row) - 1) < 0.1);
    }
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

/* ---- few octaves ---- */

/* A breeze over a short fetch has waves of three octaves, which hide each other as those of one scale do. Rows of 1/16 of a degree. */
static void few_octaves_mirror_the_sky(void **state)
{
    (void)state;
    static const char breeze[] = "mangata: 1\n"
                                 "image: {width: 16, height: 24}\n"
                                 "camera: {position: [0, 2.5, 0], target: [0, 2.5, -10], fov_y_deg: 1.5}\n"
                                 "light: {elevation_deg: 44, azimuth_deg: 285}\n"
                                 "time: {start: 10}\n"
                                 "water:\n"
                                 "  spectrum: {model: jonswap, wind: 2.5, fetch: 400, direction_deg: 150, shortest: 0.08, count: 48, seed: 3}\n";
    static float color[3 * PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene t = text_scene_read(breeze, NULL, 0);
    double sums[2] = {0};
    for (int side = -1; side <= 1; side++)
        for (int truth = 0; truth < 2; truth++) {
            t.scene.camera.target[0] = 3 * side;
            t.scene.quality.method = truth ? MGT_METHOD_REFERENCE : MGT_METHOD_MANGATA;
            t.scene.quality.spatial_samples = 6;
            t.scene.quality.time_samples = 1;
            render(context, &t.scene, color);
            for (int row = MIDDLE + 1; row < HEIGHT; row++)
                sums[truth] += mean_green(color, row);
        }
    print_message("  green of 11 rows under the horizon over brute force's: %.3f\n", sums[0] / sums[1]);
    assert_true(fabs(sums[0] / sums[1] - 1) <= 0.03);
    scene_file_free(t.file);
    mgt_context_destroy(context);
}

/* ---- a low light ---- */

/* No water has a slope that mirrors a sun on the horizon 33 degrees to the side, nor a wide light behind the camera. */
static void low_lights_stay_aside(void **state)
{
    (void)state;
    static const char evening[] = "mangata: 1\n"
                                  "image: {width: 16, height: 24}\n"
                                  "camera: {position: [0, 3, 0], target: [0, 3, -10], fov_y_deg: 6.6}\n"
                                  "light: {elevation_deg: 0.05, azimuth_deg: 33}\n"
                                  "water: {wind: 6}\n";
    static const char *const behind[] = {"light={elevation_deg: 5, azimuth_deg: 180, angular_radius_deg: 15}", "camera.fov_y_deg=30", "water.wind=2"};
    static const mgt_method methods[] = {MGT_METHOD_MANGATA, MGT_METHOD_LEAN, MGT_METHOD_LEADR, MGT_METHOD_TOKUYOSHI, MGT_METHOD_TNDF, MGT_METHOD_GGX_MOMENTS};
    static float coverage[PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene scenes[2] = {text_scene_read(evening, NULL, 0), text_scene_read(evening, behind, 3)};
    for (int i = 0; i < 12; i++) {
        text_scene *v = &scenes[i / 6];
        v->scene.quality.method = methods[i % 6];
        const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage, 0);
        sea_render(context, &v->scene, &target, 1);
        float most = 0;
        for (int p = 0; p < PIXELS; p++)
            most = fmaxf(most, coverage[p]);
        print_message("  %s, method %d: coverage %g at most\n", i < 6 ? "a sun aside" : "a wide light behind", methods[i % 6], (double)most);
        assert_true(most < 1e-4f);
    }
    scene_file_free(scenes[0].file);
    scene_file_free(scenes[1].file);
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_sides_are_the_same), cmocka_unit_test(traced_rows_have_no_gap),    cmocka_unit_test(moving_horizons_are_means),
        cmocka_unit_test(mirrored_walls_have_air), cmocka_unit_test(few_octaves_mirror_the_sky), cmocka_unit_test(low_lights_stay_aside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
