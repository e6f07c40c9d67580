/* SPDX-License-Identifier: MIT
 *
 * The brute-force renderer against analytic pictures, against the slow first hit, and against itself: sample ranges, blocks,
 * lane widths, far origins.
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

#include "reference/equations.h"
#include "reference/reference.h"
#include "scene/scene_file.h"

static const double pi = 3.14159265358979323846;

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g is not %.17g within %g", value, expected, tolerance);
}

/* ---- scenes ---- */

static mgt_scene flat_scene(uint32_t width, uint32_t height)
{
    mgt_scene scene = {.struct_size = sizeof scene};
    scene.image.width = width;
    scene.image.height = height;
    scene.camera.position[1] = 4;
    scene.camera.target[1] = 3.840636;
    scene.camera.target[2] = -0.98722;
    scene.camera.up[1] = 1;
    scene.camera.fov_y_deg = 50;
    scene.time = 10;
    scene.shutter = 1.0 / 30;
    scene.light.elevation_deg = 18;
    scene.light.angular_radius_deg = 2;
    scene.water.index_of_refraction = 1.333;
    scene.quality.spatial_samples = 4;
    scene.quality.time_samples = 2;
    return scene;
}

/* Many waves over four octaves, from a seed. */
static void rough_waves(mgt_wave *waves, size_t count, double slope_deviation)
{
    uint64_t state = 99;
    for (size_t i = 0; i < count; i++) {
        double number[4];
        for (int k = 0; k < 4; k++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            number[k] = (double)(state >> 11) * 0x1p-53;
        }
        const double frequency = pow(2, 4 * number[0]), angle = pi * (number[1] - 0.5);
        const double amplitude = slope_deviation * sqrt(2.0 / (double)count) / frequency;
        waves[i] = (mgt_wave){amplitude, frequency * sin(angle), frequency * cos(angle), -sqrt(9.81 * frequency), 6.28 * number[2]};
    }
}

/* Frame 0 of a shipped scene at a size; its waves live in *file. */
static mgt_scene shipped_scene(const char *name, uint32_t width, uint32_t height, scene_file **file)
{
    char path[1024];
    scene_error error;
    mgt_scene scene;
    snprintf(path, sizeof path, "%s/scenes/%s%s", MGT_SOURCE_DIR, name, strchr(name, '.') ? "" : ".json");
    *file = scene_file_load(path, NULL, 0, &error);
    if (!*file)
        fail_msg("%s", error.text);
    assert_true(scene_file_frame(*file, 0, &scene));
    scene.image = (mgt_image){.width = width, .height = height};
    scene.quality.spatial_samples = 1;
    scene.quality.time_samples = 1;
    return scene;
}

/* ---- pictures ---- */

typedef struct picture {
    uint32_t width, height;
    float *color, *coverage, *mask, *depth, *normal;
    uint64_t evaluations;
} picture;

static picture picture_create(uint32_t width, uint32_t height)
{
    const size_t pixels = (size_t)width * height;
    picture p = {.width = width, .height = height};
    p.color = malloc(9 * pixels * sizeof(float));
    assert_non_null(p.color);
    for (size_t i = 0; i < 9 * pixels; i++)
        p.color[i] = NAN;
    p.normal = p.color + 3 * pixels;
    p.coverage = p.normal + 3 * pixels;
    p.mask = p.coverage + pixels;
    p.depth = p.mask + pixels;
    return p;
}

static void picture_free(picture *p) { free(p->color); }

static reference_result picture_part(picture *p, uint32_t x, uint32_t y)
{
    const size_t at = (size_t)y * p->width + x;
    return (reference_result){.color = p->color + 3 * at,
                              .coverage = p->coverage + at,
                              .mask = p->mask + at,
                              .depth = p->depth + at,
                              .normal = p->normal + 3 * at,
                              .row_stride = p->width,
                              .evaluations = &p->evaluations};
}

static picture render(const mgt_scene *scene, const reference_sky *sky, const reference_options *options)
{
    reference_frame *frame;
    assert_int_equal(reference_frame_create(&frame, scene, sky, options), MGT_OK);
    picture p = picture_create(scene->image.width, scene->image.height);
    const reference_result result = picture_part(&p, 0, 0);
    reference_render_block(frame, 0, 0, p.width, p.height, &result);
    reference_frame_destroy(frame);
    return p;
}

/* Depth and normal alone. */
static picture render_geometry(const mgt_scene *scene, const reference_options *options)
{
    reference_frame *frame;
    assert_int_equal(reference_frame_create(&frame, scene, NULL, options), MGT_OK);
    picture p = picture_create(scene->image.width, scene->image.height);
    const reference_result result = {.depth = p.depth, .normal = p.normal, .evaluations = &p.evaluations};
    reference_render_block(frame, 0, 0, p.width, p.height, &result);
    reference_frame_destroy(frame);
    return p;
}

static size_t picture_pixels(const picture *p) { return (size_t)p->width * p->height; }

static void assert_same_bytes(const picture *a, const picture *b) { assert_memory_equal(a->color, b->color, 9 * picture_pixels(a) * sizeof(float)); }

static double sum_of(const float *plane, size_t pixels)
{
    double sum = 0;
    for (size_t i = 0; i < pixels; i++)
        sum += plane[i];
    return sum;
}

static void uniform_sky(const void *user, const double direction[3], double rgb[3])
{
    assert_true(direction[1] >= 0);
    assert_near(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2], 1, 1e-12);
    rgb[0] = rgb[1] = rgb[2] = *(const double *)user;
}

/* Area in pixels of a cone of angular radius `radius` whose axis stands `off` radians from the view: an ellipse. */
static double disk_area(const mgt_scene *scene, double off, double radius)
{
    const double focal = 0.5 * scene->image.height / tan(scene->camera.fov_y_deg * pi / 360);
    const double q = cos(off) * cos(off) - sin(radius) * sin(radius);
    return pi * (focal * sin(radius) * cos(radius) / q) * (focal * sin(radius) / sqrt(q));
}

/* ---- analytic pictures ---- */

static void flat_mirror_shows_the_whole_disk(void **unused)
{
    (void)unused;
    mgt_scene scene = flat_scene(160, 90);
    scene.quality.spatial_samples = 12;
    scene.quality.time_samples = 1;
    picture p = render(&scene, NULL, NULL);
    const double tilt = asin((4 - 3.840636) / hypot(4 - 3.840636, 0.98722));
    const double expected = disk_area(&scene, 18 * pi / 180 - tilt, 2 * pi / 180);
    assert_near(sum_of(p.coverage, picture_pixels(&p)), expected, 0.003 * expected);
    float largest = 0;
    for (size_t i = 0; i < picture_pixels(&p); i++)
        largest = fmaxf(largest, p.coverage[i]);
    assert_true(largest == 1);

    /* All below the horizon is water. */
    const double horizon = 45 - 45 * tan(tilt) / tan(25 * pi / 180);
    assert_near(sum_of(p.mask, picture_pixels(&p)), 160 * (90 - horizon), 1);
    for (uint32_t y = 0; y < 90; y++) {
        const size_t i = (size_t)y * 160 + 17;
        double origin[3], d[3];
        camera_ray(&scene, 17.5, y + 0.5, scene.time, origin, d);
        if (d[1] < 0)
            assert_near(p.depth[i] * -d[1], 4, 1e-6 * 4);
        else
            assert_true(isinf(p.depth[i]));
        assert_true(p.normal[3 * i + 1] == (d[1] < 0 ? 1 : 0));
    }
    picture_free(&p);
}

static void flat_mirror_reflects_as_a_dielectric(void **unused)
{
    (void)unused;
    const double two = 2;
    mgt_scene scene = flat_scene(160, 90);
    scene.light.elevation_deg = -5;
    const reference_sky sky = {.lookup = uniform_sky, .user = &two, .disks = {{9, 9, 9}}, .body_radiance = {0, 0.5, 1}};
    picture p = render(&scene, &sky, NULL);
    for (uint32_t y = 0; y < 90; y += 7)
        for (uint32_t x = 3; x < 160; x += 31) {
            double mean = 0, origin[3], d[3];
            const size_t i = (size_t)y * 160 + x;
            if (p.mask[i] != 1)
                continue;
            for (int k = 0; k < 400; k++) {
                camera_ray(&scene, x + (k % 20 + 0.5) / 20, y + (k / 20 + 0.5) / 20, scene.time, origin, d);
                mean += fresnel_dielectric(-d[1], 1.333) / 400;
            }
            assert_near(p.color[3 * i], 2 * mean, 0.004);
            assert_near(p.color[3 * i + 1], 2 * mean + 0.5 * (1 - mean), 0.004);
            assert_near(p.color[3 * i + 2], 2 * mean + (1 - mean), 0.004);
        }
    assert_near(p.color[0], 2, 1e-6);                         /* sky */
    assert_true(sum_of(p.coverage, picture_pixels(&p)) == 0); /* the light has set */
    picture_free(&p);
}

static void light_in_the_sky_has_its_area_and_limb(void **unused)
{
    (void)unused;
    mgt_scene scene = flat_scene(100, 100);
    light_direction(&scene.light, scene.camera.target);
    scene.camera.target[1] += 4;
    scene.camera.fov_y_deg = 6;
    scene.quality.spatial_samples = 8;
    const reference_sky sky = {.disks = {{0.5, 5, 50}}, .hidden = {0.5}}; /* what is above the horizon is twice as bright as the mean */
    picture p = render(&scene, &sky, NULL);
    double sum[3] = {0};
    for (size_t i = 0; i < picture_pixels(&p); i++)
        for (int c = 0; c < 3; c++)
            sum[c] += p.color[3 * i + (size_t)c];
    const double expected = disk_area(&scene, 0, 2 * pi / 180);
    assert_near(sum[0], expected, 0.005 * expected);
    assert_near(sum[2], 100 * expected, 0.5 * expected);
    assert_near(p.color[3 * 5050 + 1], 10 / 0.8, 0.01); /* centre: 1 / (1 − u/3) */
    assert_true(sum_of(p.mask, picture_pixels(&p)) == 0);
    picture_free(&p);
}

/* One long wave, on which the glint sweeps over pixels within the shutter. */
static void one_long_wave_meets_a_dense_integral(void **unused)
{
    (void)unused;
    const mgt_wave wave = {0.25, 0.3, 0.6, -3, 1};
    mgt_scene scene = flat_scene(40, 24);
    scene.camera.target[1] = 3.3;
    scene.light.elevation_deg = 35;
    scene.light.angular_radius_deg = 5;
    scene.shutter = 0.4;
    scene.water.waves = &wave;
    scene.water.wave_count = 1;
    scene.quality.spatial_samples = 6;
    scene.quality.time_samples = 100;
    double light[3];
    light_direction(&scene.light, light);
    picture p = render(&scene, NULL, NULL);
    int partly = 0, compared = 0;
    for (uint32_t y = 6; y < 24; y++)
        for (uint32_t x = 2; x < 40; x += 3) {
            const float value = p.coverage[y * 40 + x];
            if (value > 0.02 && value < 0.98)
                partly++;
            else if (compared % 4 != 0) { /* a few of the plain ones */
                compared++;
                continue;
            }
            compared++;
            int covered = 0;
            for (int k = 0; k < 6 * 6 * 100; k++) { /* the glint is brief: many instants */
                const double px = x + (k % 6 + 0.5) / 6, py = y + (k / 6 % 6 + 0.5) / 6;
                const double time = scene.time - scene.shutter * (k / 36 + 0.5) / 100;
                double origin[3], d[3], point[2];
                camera_ray(&scene, px, py, time, origin, d);
                const water_hit hit = first_hit_brute_force(&scene, px, py, time);
                const double to_eye[3] = {-d[0], -d[1], -d[2]};
                covered += hit.hit && mirror_map(to_eye, light, hit.water.slope, point) && hypot(point[0], point[1]) < tan(5 * pi / 180);
            }
            assert_near(value, covered / 3600.0, 0.01);
        }
    assert_true(partly >= 8);
    picture_free(&p);
}

/* ---- strata ---- */

typedef struct strata_count {
    const mgt_scene *scene;
    uint32_t seen[16];
} strata_count;

/* The camera looks at the zenith: the direction tells where in the (one) pixel the sample lies. */
static void count_stratum(const void *user, const double d[3], double rgb[3])
{
    strata_count *count = (strata_count *)user;
    const double extent = tan(count->scene->camera.fov_y_deg * pi / 360);
    const int x = (int)floor(4 * (0.5 + 0.5 * d[0] / d[1] / extent));
    const int y = (int)floor(4 * (0.5 + 0.5 * d[2] / d[1] / extent));
    assert_in_range(x, 0, 3);
    assert_in_range(y, 0, 3);
    count->seen[4 * y + x]++;
    rgb[0] = rgb[1] = rgb[2] = 0;
}

static void every_stratum_is_sampled_once_per_pass(void **unused)
{
    (void)unused;
    mgt_scene scene = flat_scene(1, 1);
    scene.camera = (mgt_camera){.position = {0, 4, 0}, .target = {0, 5, 0}, .up = {0, 0, -1}, .fov_y_deg = 20};
    scene.quality.time_samples = 5;
    scene.light.elevation_deg = -40;
    for (uint32_t pass = 0; pass < 6; pass++) {
        strata_count count = {.scene = &scene};
        scene.quality.sample_first = 16 * (pass % 5);
        scene.quality.sample_count = pass < 5 ? 16 : 0; /* at last all: 5 of each */
        const reference_sky sky = {.lookup = count_stratum, .user = &count};
        picture p = render(&scene, &sky, NULL);
        for (int i = 0; i < 16; i++)
            assert_int_equal(count.seen[i], pass < 5 ? 1 : 5);
        picture_free(&p);
    }
}

static void sample_ranges_add_up(void **unused)
{
    (void)unused;
    mgt_wave waves[24];
    rough_waves(waves, 24, 0.15);
    const double one = 1;
    const reference_sky sky = {.lookup = uniform_sky, .user = &one, .disks = {{5, 5, 5}}};
    mgt_scene scene = flat_scene(40, 24);
    scene.water.waves = waves;
    scene.water.wave_count = 24;
    picture whole = render(&scene, &sky, NULL);
    scene.quality.sample_count = 12;
    picture head = render(&scene, &sky, NULL);
    scene.quality.sample_first = 12;
    scene.quality.sample_count = 1000; /* beyond the end: what remains */
    picture tail = render(&scene, &sky, NULL);
    for (size_t i = 0; i < picture_pixels(&whole); i++) {
        assert_near(whole.coverage[i], (12 * head.coverage[i] + 20 * tail.coverage[i]) / 32, 1e-6);
        assert_near(whole.mask[i], (12 * head.mask[i] + 20 * tail.mask[i]) / 32, 1e-6);
        assert_near(whole.color[3 * i], (12 * head.color[3 * i] + 20 * tail.color[3 * i]) / 32, 1e-5);
    }
    assert_true(sum_of(whole.coverage, picture_pixels(&whole)) > 1);
    assert_memory_not_equal(head.coverage, tail.coverage, picture_pixels(&whole) * sizeof(float));
    picture_free(&whole);
    picture_free(&head);
    picture_free(&tail);
}

static void seed_changes_the_jitter_alone(void **unused)
{
    (void)unused;
    mgt_scene scene = flat_scene(80, 45);
    picture first = render(&scene, NULL, NULL);
    scene.quality.seed = 1;
    picture second = render(&scene, NULL, NULL);
    const size_t pixels = picture_pixels(&first);
    assert_memory_not_equal(first.coverage, second.coverage, pixels * sizeof(float));
    assert_memory_equal(first.depth, second.depth, pixels * sizeof(float));
    const double sum = sum_of(first.coverage, pixels);
    assert_near(sum_of(second.coverage, pixels), sum, 0.05 * sum);
    picture_free(&first);
    picture_free(&second);
}

/* ---- the same bits ---- */

static void compare_blocks_and_widths(size_t wave_count, uint32_t samples, double target_height)
{
    static const mgt_isa isas[] = {MGT_ISA_SCALAR, MGT_ISA_AVX2, MGT_ISA_AVX512, MGT_ISA_SSE2};
    mgt_wave waves[40];
    rough_waves(waves, wave_count, 0.2);
    const double one = 1;
    const reference_sky sky = {.lookup = uniform_sky, .user = &one, .disks = {{5, 5, 5}}};
    mgt_scene scene = flat_scene(45, 26);
    scene.water.waves = waves;
    scene.water.wave_count = wave_count;
    scene.camera.target[1] = target_height;
    scene.quality.spatial_samples = samples;
    scene.quality.time_samples = samples;
    scene.camera_moves = true;
    scene.camera_open = scene.camera;
    scene.camera_open.position[0] = 0.3;
    scene.camera_open.fov_y_deg = 48;
    picture whole = render(&scene, &sky, NULL);
    assert_true(sum_of(whole.coverage, picture_pixels(&whole)) > 1);
    for (size_t i = 0; i < 9 * picture_pixels(&whole); i++)
        assert_false(isnan(whole.color[i]));
    for (size_t k = 0; k < sizeof isas / sizeof isas[0]; k++) {
        reference_frame *frame;
        const reference_options options = {.isa = isas[k]};
        const mgt_status status = reference_frame_create(&frame, &scene, &sky, &options);
        if (status == MGT_ERROR_UNAVAILABLE) {
            assert_null(frame);
            continue;
        }
        assert_int_equal(status, MGT_OK);
        picture p = picture_create(45, 26);
        for (uint32_t y = 0; y < 26; y += 9) /* uneven blocks, from the bottom right */
            for (uint32_t x = 0; x < 45; x += 7) {
                const uint32_t bx = 45 - x < 7 ? 0 : 45 - x - 7, by = 26 - y < 9 ? 0 : 26 - y - 9;
                const reference_result result = picture_part(&p, bx, by);
                reference_render_block(frame, bx, by, 45 - x < 7 ? 45 - x : 7, 26 - y < 9 ? 26 - y : 9, &result);
            }
        assert_same_bytes(&p, &whole);
        picture_free(&p);
        reference_frame_destroy(frame);
    }
    picture_free(&whole);
}

static void blocks_and_widths_give_the_same_bits(void **unused)
{
    (void)unused;
    compare_blocks_and_widths(20, 3, 3.84);
    compare_blocks_and_widths(40, 2, 3.4); /* enough waves for levels, and no whole block of them; the horizon would take long without vectors */
}

static void far_origin_shows_the_same_sea(void **unused)
{
    (void)unused;
    mgt_wave waves[32], shifted[32];
    rough_waves(waves, 32, 0.15);
    mgt_scene scene = flat_scene(80, 45);
    scene.water.waves = waves;
    scene.water.wave_count = 32;
    picture near = render(&scene, NULL, NULL);
    const double x = 1e5, z = -7e4;
    for (int i = 0; i < 32; i++) {
        shifted[i] = waves[i];
        const long double phase = waves[i].phase - (long double)waves[i].kx * x - (long double)waves[i].kz * z;
        shifted[i].phase = (double)remainderl(phase, 6.283185307179586476925286766559L);
    }
    scene.water.waves = shifted;
    scene.camera.position[0] += x;
    scene.camera.position[2] += z;
    scene.camera.target[0] += x;
    scene.camera.target[2] += z;
    picture far = render(&scene, NULL, NULL);
    int differ = 0;
    for (size_t i = 0; i < picture_pixels(&near); i++) {
        differ += near.coverage[i] != far.coverage[i];
        if (isinf(near.depth[i]))
            assert_true(isinf(far.depth[i]));
        else
            assert_near(far.depth[i], near.depth[i], 1e-6 * near.depth[i]);
    }
    assert_true(sum_of(near.coverage, picture_pixels(&near)) > 5);
    assert_true(differ <= 2);
    picture_free(&near);
    picture_free(&far);
}

/* ---- first hits ---- */

/* Compares every `stride`th water pixel with brute force; returns how many were compared. */
static int compare_with_brute_force(const mgt_scene *scene, uint32_t stride)
{
    picture p = render_geometry(scene, NULL);
    int compared = 0;
    for (uint32_t i = stride / 2; i < picture_pixels(&p); i += stride) {
        const double px = i % p.width + 0.5, py = i / p.width + 0.5;
        const water_hit hit = first_hit_brute_force(scene, px, py, scene->time);
        assert_int_equal(hit.hit, isfinite(p.depth[i]));
        if (!hit.hit)
            continue;
        compared++;
        assert_near(p.depth[i], hit.distance, 2e-7 * hit.distance);
        const double *slope = hit.water.slope, length = sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
        const double bend = fabs(hit.water.hessian[0]) + fabs(hit.water.hessian[1]) + fabs(hit.water.hessian[2]);
        const double tolerance = 1e-6 + 2e-9 * hit.distance * bend; /* what the hit's own tolerance moves the normal */
        assert_near(p.normal[3 * i], -slope[0] / length, tolerance);
        assert_near(p.normal[3 * i + 1], 1 / length, tolerance);
        assert_near(p.normal[3 * i + 2], -slope[1] / length, tolerance);
    }
    picture_free(&p);
    return compared;
}

static void first_hits_are_those_of_brute_force(void **unused)
{
    (void)unused;
    static const char *const names[] = {"high", "rough"};
    for (int k = 0; k < 2; k++) {
        scene_file *file;
        const mgt_scene scene = shipped_scene(names[k], 160, 90, &file);
        assert_true(compare_with_brute_force(&scene, 53) > 100);
        scene_file_free(file);
    }
}

/* Two degrees below the horizon, where rays graze many crests. */
static mgt_scene view_at_the_horizon(const char *name, scene_file **file)
{
    mgt_scene scene = shipped_scene(name, 64, 12, file);
    scene.camera.fov_y_deg = 2;
    scene.camera.target[1] =
        scene.camera.position[1] - 0.021 * hypot(scene.camera.target[0] - scene.camera.position[0], scene.camera.target[2] - scene.camera.position[2]);
    return scene;
}

static const char *const seas[] = {"gale.yaml", "breeze.yaml", "lagoon.yaml"};

static void approach_ends_short_of_first_hits(void **unused)
{
    (void)unused;
    for (int k = 0; k < 3; k++) {
        scene_file *file;
        const mgt_scene scene = view_at_the_horizon(seas[k], &file);
        assert_true(compare_with_brute_force(&scene, 23) > 30);
        scene_file_free(file);
    }
}

/* More waves than the approach knows. */
static void approach_leaves_waves_beyond_its_most(void **unused)
{
    (void)unused;
    static mgt_wave waves[600];
    rough_waves(waves, 600, 0.15);
    mgt_scene scene = flat_scene(96, 54);
    scene.water.waves = waves;
    scene.water.wave_count = 600;
    assert_true(compare_with_brute_force(&scene, 61) > 30);
}

/* From between the crests many rays rise, and some end under the next crest. */
static void camera_among_the_crests(void **unused)
{
    (void)unused;
    mgt_wave waves[8] = {{0.6, 0.1, 0.7, 0, -2.6}, {0.2, -0.4, 1.5, 0, 2}};
    mgt_scene scene = flat_scene(48, 27);
    scene.water.waves = waves;
    scene.water.wave_count = 2;
    scene.camera.position[1] = 0.35;
    scene.camera.target[1] = 0.33;
    scene.camera.target[2] = -1;
    assert_in_range(compare_with_brute_force(&scene, 1), 400, 1200);

    scene.camera.position[1] = 0.2;
    waves[0].phase = pi / 2; /* a crest closes over the camera */
    picture p = render(&scene, NULL, NULL);
    for (size_t i = 0; i < picture_pixels(&p); i++)
        assert_true(p.mask[i] == 1 && p.coverage[i] == 0 && p.depth[i] == 0);
    picture_free(&p);
}

/* The search's statistical bounds lose nothing against bounds that hold for any phases. */
static void default_bounds_find_every_hit(void **unused)
{
    (void)unused;
    static const char *const names[] = {"high", "rough", "smooth"};
    const reference_options exhaustive = {.bound_deviations = HUGE_VAL};
    for (int k = 0; k < 6; k++) {
        scene_file *file;
        const mgt_scene scene = k < 3 ? shipped_scene(names[k], 160, 90, &file) : view_at_the_horizon(seas[k - 3], &file);
        picture p = render_geometry(&scene, NULL), all = render_geometry(&scene, &exhaustive);
        int differ = 0;
        for (size_t i = 0; i < picture_pixels(&p); i++)
            differ += isinf(p.depth[i]) ? !isinf(all.depth[i]) : !(fabsf(p.depth[i] - all.depth[i]) <= 1e-6f * all.depth[i]);
        assert_int_equal(differ, 0);
        assert_true(p.evaluations < all.evaluations);
        if (k < 3)
            assert_true(p.evaluations < 40 * picture_pixels(&p));
        picture_free(&p);
        picture_free(&all);
        scene_file_free(file);
    }
}

/* ---- moving camera ---- */

static void moving_camera_is_the_mean_of_still_ones(void **unused)
{
    (void)unused;
    mgt_wave waves[6];
    rough_waves(waves, 6, 0.1);
    for (int i = 0; i < 6; i++)
        waves[i].omega = 0; /* only the camera moves */
    mgt_scene scene = flat_scene(48, 27), still = scene;
    scene.water.waves = waves;
    scene.water.wave_count = 6;
    scene.quality.time_samples = 16;
    scene.camera_moves = true;
    scene.camera_open = scene.camera;
    scene.camera_open.position[0] = 0.8;
    scene.camera_open.target[0] = 0.6;
    scene.camera_open.fov_y_deg = 40;
    picture moving = render(&scene, NULL, NULL);
    double mean[48 * 27] = {0};
    still = scene;
    still.camera_moves = false;
    still.quality.time_samples = 1;
    for (int k = 0; k < 16; k++) {
        const double weight = (k + 0.5) / 16;
        for (int i = 0; i < 3; i++) {
            still.camera.position[i] = scene.camera.position[i] + weight * (scene.camera_open.position[i] - scene.camera.position[i]);
            still.camera.target[i] = scene.camera.target[i] + weight * (scene.camera_open.target[i] - scene.camera.target[i]);
        }
        still.camera.fov_y_deg = scene.camera.fov_y_deg + weight * (40 - scene.camera.fov_y_deg);
        picture p = render(&still, NULL, NULL);
        for (size_t i = 0; i < picture_pixels(&p); i++)
            mean[i] += p.coverage[i] / 16;
        picture_free(&p);
    }
    double square = 0, sum = 0, expected = 0;
    for (size_t i = 0; i < picture_pixels(&moving); i++) {
        square += (moving.coverage[i] - mean[i]) * (moving.coverage[i] - mean[i]);
        sum += moving.coverage[i];
        expected += mean[i];
    }
    assert_true(expected > 3);
    assert_near(sum, expected, 0.05 * expected);
    assert_true(sqrt(square / (48 * 27)) < 0.01);

    scene.shutter = 0; /* an instant: the camera at closing time */
    still = scene;
    still.camera_moves = false;
    picture instant = render(&scene, NULL, NULL), closing = render(&still, NULL, NULL);
    assert_same_bytes(&instant, &closing);
    picture_free(&moving);
    picture_free(&instant);
    picture_free(&closing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_mirror_shows_the_whole_disk),
        cmocka_unit_test(flat_mirror_reflects_as_a_dielectric),
        cmocka_unit_test(light_in_the_sky_has_its_area_and_limb),
        cmocka_unit_test(one_long_wave_meets_a_dense_integral),
        cmocka_unit_test(every_stratum_is_sampled_once_per_pass),
        cmocka_unit_test(sample_ranges_add_up),
        cmocka_unit_test(seed_changes_the_jitter_alone),
        cmocka_unit_test(blocks_and_widths_give_the_same_bits),
        cmocka_unit_test(far_origin_shows_the_same_sea),
        cmocka_unit_test(first_hits_are_those_of_brute_force),
        cmocka_unit_test(approach_ends_short_of_first_hits),
        cmocka_unit_test(approach_leaves_waves_beyond_its_most),
        cmocka_unit_test(camera_among_the_crests),
        cmocka_unit_test(default_bounds_find_every_hit),
        cmocka_unit_test(moving_camera_is_the_mean_of_still_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
