/* SPDX-License-Identifier: MIT
 *
 * The skyline of the water, against the highest of points of the surface that lie close together in each direction.
 */
#include "frame/skyline.h"
#include "unit/kernel_lane.h"

enum { WAVES = 12, WIDTH = 320, HEIGHT = 180, DIRECTIONS = 40 };

static wave_set set;
static frame prepared;
static mgt_scene scene;

static mgt_water sea(mgt_wave waves[WAVES], double choppiness, uint64_t seed)
{
    random_state r = {seed};
    for (int i = 0; i < WAVES; i++) {
        const double k = 2 * M_PI / (4 * pow(20, random_range(&r, 0, 1))), heading = random_range(&r, 0, 2 * M_PI);
        waves[i] =
            (mgt_wave){.amplitude = 0.05 / k, .kx = k * cos(heading), .kz = k * sin(heading), .omega = sqrt(9.81 * k), .phase = random_range(&r, 0, 2 * M_PI)};
    }
    return (mgt_water){.waves = waves, .wave_count = WAVES, .index_of_refraction = 1.333, .choppiness = (float)choppiness};
}

static double height_at(const mgt_water *water, double x, double z)
{
    const double point[2] = {x, z}, ray[3] = {1, 0, 0};
    double gap = 0, closing = 0;
    sines_lower(water, point, 0, ray, &gap, &closing);
    return -gap;
}

static double highest(const mgt_water *water, double camera_height, const double direction[2], double most, double step)
{
    double slope = 0;
    for (double r = step; r < most; r += step)
        slope = fmax(slope, (height_at(water, r * direction[0], r * direction[1]) - camera_height) / r);
    return slope;
}

/* As skyline_at() of pixel.k finds it, in double precision. */
static double found_towards(const FrameData *data, const double d[2])
{
    const double ahead = d[0] * (double)data->skyline_x + d[1] * (double)data->skyline_z;
    const double aside = d[1] * (double)data->skyline_x - d[0] * (double)data->skyline_z, part = aside / (fabs(ahead) + fabs(aside));
    const double bearing = ahead < 0 ? copysign(2, aside) - part : part;
    const double at = (bearing - (double)data->skyline_first) * (double)data->skyline_scale;
    assert_true(at >= 0 && at < SKYLINE_MOST - 1);
    const size_t entry = (size_t)at;
    const double share = at - (double)entry;
    return (1 - share) * (double)set.skyline[entry][0] + share * (double)set.skyline[entry + 1][0];
}

/* A frame of these waves before a camera, and `set` placed there. */
static void prepare(const mgt_water *water, const camera_rays *rays)
{
    FrameData other;
    FrameData *const both[] = {&prepared.data, &other};
    uint16_t order[MGT_MAX_WAVES];
    scene.water = *water;
    prepared.scene = &scene;
    prepared.data = (FrameData){.grazing_fall = 2.5f, .pixel_angle = (float)(2 * tan(25 * M_PI / 180) / HEIGHT)};
    prepared.skyline_entries = skyline_span(rays, rays, WIDTH, HEIGHT, both);
    sines_order(water, order);
    set.view = (ViewData){.camera_height = (float)rays->position[1], .filter_waves = 1};
    sines_place(water, order, (wave_meeting){0, 0, 0, 0, 0}, &set);
}

/* Prints errors in pixels, for directions all over a picture that is rolled by `roll`, and holds them. */
static void compare(const char *what, double choppiness, double roll, double most, double step)
{
    mgt_wave waves[WAVES];
    double error[DIRECTIONS];
    const mgt_water water = sea(waves, choppiness, 7);
    const double camera_height = sines_crest(&water) / 4;
    const mgt_camera camera = {.position = {0, camera_height, 0}, .target = {30, camera_height - 2, -100}, .up = {sin(roll), cos(roll), 0}, .fov_y_deg = 50};
    const camera_rays rays = camera_rays_of(&camera, WIDTH, HEIGHT);
    prepare(&water, &rays);
    assert_int_equal(prepared.skyline_entries, WIDTH + HEIGHT);
    assert_true(skyline_may_stand(&prepared, &rays));
    skyline_find(&prepared, &set);
    assert_int_equal(set.view.skyline, 1);
    for (int i = 0; i < DIRECTIONS; i++) {
        /* Where the column meets the horizon. */
        const double column = WIDTH * (i + 0.5) / DIRECTIONS, row = -(rays.corner[1] + column * rays.right[1]) / rays.down[1];
        double direction[2];
        for (int k = 0; k < 2; k++)
            direction[k] = rays.corner[2 * k] + column * rays.right[2 * k] + row * rays.down[2 * k];
        const double length = hypot(direction[0], direction[1]), unit[2] = {direction[0] / length, direction[1] / length};
        const double found = found_towards(&prepared.data, unit), truth = highest(&water, camera_height, unit, most, step);
        assert_true(found <= (double)set.view.skyline_top);
        error[i] = fabs(found - truth) / (double)prepared.data.pixel_angle;
    }
    print_message("%s\n", what);
    expect_below("error in pixels, median", quantile(error, DIRECTIONS, 0.5), 0.01);
    expect_below("nine of ten", quantile(error, DIRECTIONS, 0.9), 0.05);
}

static void rises_to_the_highest_crest(void **state)
{
    (void)state;
    compare("sines", 0, 0, 3000, 0.05);
    compare("choppy water, a rolled camera", 0.8, 0.3, 600, 0.2);
}

/* A camera above all crests, one that looks down, and one within a wave. */
static void there_is_none_where_the_horizon_is_the_edge(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves, 0, 7);
    mgt_camera camera = {.position = {0, 1.01 * sines_crest(&water), 0}, .target = {100, 0, 0}, .up = {0, 1, 0}, .fov_y_deg = 50};
    camera_rays rays = camera_rays_of(&camera, WIDTH, HEIGHT);
    prepare(&water, &rays);
    assert_true(prepared.skyline_entries > 0 && !skyline_may_stand(&prepared, &rays));

    camera = (mgt_camera){.position = {0, 0.1, 0}, .target = {0.01, 0, 0}, .up = {1, 0, 0}, .fov_y_deg = 50};
    rays = camera_rays_of(&camera, WIDTH, HEIGHT);
    prepare(&water, &rays);
    assert_true(!skyline_may_stand(&prepared, &rays));

    camera = (mgt_camera){.position = {0, height_at(&water, 0, 0) - 0.01, 0}, .target = {100, 0, 0}, .up = {0, 1, 0}, .fov_y_deg = 50};
    rays = camera_rays_of(&camera, WIDTH, HEIGHT);
    prepare(&water, &rays);
    assert_true(skyline_may_stand(&prepared, &rays));
    skyline_find(&prepared, &set);
    assert_int_equal(set.view.skyline, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rises_to_the_highest_crest),
        cmocka_unit_test(there_is_none_where_the_horizon_is_the_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
