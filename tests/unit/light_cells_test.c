/* SPDX-License-Identifier: MIT
 *
 * Mirrored lights that the reference finds by cells of the surface, against those that its rays meet.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "reference/reference.h"
#include "scene/scene_file.h"

enum { WIDTH = 16, HEIGHT = 12, PIXELS = WIDTH * HEIGHT, SEEDS = 6 };

typedef struct sea {
    const char *file;
    uint32_t x, y; /* of the area, in a picture of 1280 x 720 */
} sea;

/* A shipped scene under a light of some radius; its waves live in *file. */
static mgt_scene scene_of(const char *name, double radius_deg, scene_file **file)
{
    char path[1024];
    scene_error error;
    mgt_scene scene;
    snprintf(path, sizeof path, "%s/scenes/%s", MGT_SOURCE_DIR, name);
    *file = scene_file_load(path, NULL, 0, &error);
    if (!*file)
        fail_msg("%s", error.text);
    assert_true(scene_file_frame(*file, 0, &scene));
    scene.image = (mgt_image){.width = 1280, .height = 720};
    scene.light.angular_radius_deg = radius_deg;
    return scene;
}

static void black_sky(const void *user, const double direction[3], double rgb[3])
{
    (void)user;
    (void)direction;
    rgb[0] = rgb[1] = rgb[2] = 0;
}

typedef struct part {
    uint32_t x, y, width, height;
} part;

/* Coverage, and colour where it is not NULL, under a light of radiance 1. */
static void render(const mgt_scene *scene, mgt_isa isa, part p, float *coverage, float *color)
{
    const reference_sky sky = {.lookup = black_sky, .disks = {{1, 1, 1}}};
    const reference_options options = {.isa = isa};
    reference_frame *frame;
    assert_int_equal(reference_frame_create(&frame, scene, &sky, &options), MGT_OK);
    const reference_result result = {.coverage = coverage, .color = color};
    reference_render_block(frame, p.x, p.y, p.width, p.height, &result);
    reference_frame_destroy(frame);
}

/* Means over seeds, and the variance of such a mean. */
typedef struct estimate {
    double mean[PIXELS], variance[PIXELS];
} estimate;

static void estimate_area(mgt_scene scene, part p, estimate *out)
{
    static float coverage[SEEDS][PIXELS];
    const uint32_t pixels = p.width * p.height;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        scene.quality.seed = seed + 1;
        render(&scene, MGT_ISA_AUTO, p, coverage[seed], NULL);
    }
    for (uint32_t i = 0; i < pixels; i++) {
        double sum = 0, square = 0;
        for (int k = 0; k < SEEDS; k++)
            sum += (double)coverage[k][i];
        for (int k = 0; k < SEEDS; k++)
            square += ((double)coverage[k][i] - sum / SEEDS) * ((double)coverage[k][i] - sum / SEEDS);
        out->mean[i] = sum / SEEDS;
        out->variance[i] = square / (SEEDS - 1) / SEEDS;
    }
}

/* Holds sums over the area, and pixels, to what the noise of both allows. */
static void compare(const char *what, const estimate *cells, const estimate *rays, uint32_t pixels)
{
    double difference = 0, variance = 0, square = 0, sum = 0;
    for (uint32_t i = 0; i < pixels; i++) {
        const double d = cells->mean[i] - rays->mean[i];
        difference += d;
        square += d * d;
        variance += cells->variance[i] + rays->variance[i];
        sum += rays->mean[i];
    }
    assert_true(sum > 0);
    if (!(fabs(difference) <= 4 * sqrt(variance)))
        fail_msg("%s: sums of coverage differ by %g of %g, by noise %g", what, difference, sum, sqrt(variance));
    if (!(square <= 1.5 * variance))
        fail_msg("%s: squared differences %g, by noise %g", what, square, variance);
}

static void compare_scene(const char *what, mgt_scene scene, part p, uint32_t spatial, uint32_t times, double cell_count)
{
    static estimate rays, cells;
    scene.quality.time_samples = times;
    scene.quality.spatial_samples = spatial;
    scene.quality.light_cells = 0;
    estimate_area(scene, p, &rays);
    scene.quality.spatial_samples = 1;
    scene.quality.light_cells = cell_count;
    estimate_area(scene, p, &cells);
    compare(what, &cells, &rays, p.width * p.height);
}

static const sea seas[] = {{"breeze.yaml", 740, 256}, {"gale.yaml", 500, 250}, {"sunset.json", 630, 310}};

static void test_light_of_2_degrees(void **state)
{
    (void)state;
    if (MGT_SANITIZED)
        skip(); /* test_sun runs the same code */
    for (size_t i = 0; i < sizeof seas / sizeof *seas; i++) {
        scene_file *file;
        const mgt_scene scene = scene_of(seas[i].file, 2, &file);
        compare_scene(seas[i].file, scene, (part){seas[i].x, seas[i].y, WIDTH, HEIGHT}, 8, 4, 100);
        scene_file_free(file);
    }
}

static void test_sun(void **state)
{
    (void)state;
    scene_file *file;
    const mgt_scene scene = scene_of("breeze.yaml", 0.2665, &file);
    compare_scene("sun", scene, (part){750, 300, 8, 6}, MGT_SANITIZED ? 16 : 40, 4, MGT_SANITIZED ? 16 : 64);
    scene_file_free(file);
}

/* The rows about the horizon, where pixels of the plane have no end. */
static void test_horizon(void **state)
{
    (void)state;
    scene_file *file;
    const mgt_scene scene = scene_of("breeze.yaml", 2, &file);
    compare_scene("horizon", scene, (part){760, 236, 8, 6}, 8, 4, 100);
    scene_file_free(file);
}

static void test_moving_camera(void **state)
{
    (void)state;
    scene_file *file;
    mgt_scene scene = scene_of("sunset.json", 2, &file);
    scene.camera_moves = true;
    scene.camera_open = scene.camera;
    scene.camera_open.position[0] -= 0.3;
    scene.camera_open.position[1] += 0.2;
    scene.camera_open.target[0] += 0.002;
    scene.camera_open.up[0] = 0.02;
    scene.camera_open.fov_y_deg += 1;
    compare_scene("camera", scene, (part){630, 320, WIDTH, HEIGHT}, 8, 8, 100);
    scene_file_free(file);
}

static void test_parts_and_lanes(void **state)
{
    (void)state;
    static float whole[PIXELS], other[PIXELS], color[3 * PIXELS], other_color[3 * PIXELS];
    scene_file *file;
    mgt_scene scene = scene_of("sunset.json", 0.2665, &file);
    scene.quality.spatial_samples = 1;
    scene.quality.time_samples = 3;
    scene.quality.light_cells = 50;
    const part p = {630, 310, WIDTH, HEIGHT};
    render(&scene, MGT_ISA_AUTO, p, whole, color);
    render(&scene, MGT_ISA_SSE2, p, other, other_color);
    assert_memory_equal(whole, other, sizeof whole);
    assert_memory_equal(color, other_color, sizeof color);
    double sum = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        render(&scene, MGT_ISA_AUTO, (part){p.x, p.y + y, WIDTH / 2, 1}, other, NULL);
        render(&scene, MGT_ISA_AUTO, (part){p.x + WIDTH / 2, p.y + y, WIDTH / 2, 1}, other + WIDTH / 2, NULL);
        assert_memory_equal(whole + y * WIDTH, other, WIDTH * sizeof *other);
        for (uint32_t x = 0; x < WIDTH; x++)
            sum += (double)whole[y * WIDTH + x];
    }
    assert_true(sum > 0);
    scene_file_free(file);
}

/* Under water, and where waves may rise over the camera, rays serve. */
static void test_where_rays_serve(void **state)
{
    (void)state;
    static float rays[PIXELS], cells[PIXELS];
    scene_file *file;
    mgt_scene scene = scene_of("gale.yaml", 2, &file);
    scene.camera.position[1] = 1;
    scene.camera.target[1] = 0.84;
    scene.quality.spatial_samples = 2;
    scene.quality.time_samples = 1;
    const part p = {500, 400, WIDTH, HEIGHT};
    render(&scene, MGT_ISA_AUTO, p, rays, NULL);
    scene.quality.light_cells = 50;
    render(&scene, MGT_ISA_AUTO, p, cells, NULL);
    assert_memory_equal(rays, cells, sizeof rays);
    scene_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_light_of_2_degrees),
        cmocka_unit_test(test_sun),
        cmocka_unit_test(test_horizon),
        cmocka_unit_test(test_moving_camera),
        cmocka_unit_test(test_parts_and_lanes),
        cmocka_unit_test(test_where_rays_serve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
