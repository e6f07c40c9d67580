/* SPDX-License-Identifier: MIT
 *
 * The body of examples/floating_body.h against closed forms: Archimedes' draught, the period of heave, metacentric stability, a slope of water. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "floating_body.h"

enum { ACROSS = 8, ALONG = 8 };
static const double pi = 3.14159265358979323846;
static const double box[3] = {2, 1, 4};

/* A box that floats with half of it under water, its centre of mass in the waterline. */
static floating_body make_box(double damping)
{
    floating_body body = {.damping = damping};
    for (int i = 0; i < ACROSS * ALONG; i++)
        body.columns[body.count++] = (body_column){((i % ACROSS + 0.5) / ACROSS - 0.5) * box[0], ((i / ACROSS + 0.5) / ALONG - 0.5) * box[2], -box[1] / 2,
                                                   box[1] / 2, box[0] * box[2] / (ACROSS * ALONG)};
    body_float_as_drawn(&body, 0, box);
    return body;
}

static mgt_water flat_water(void)
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    return scene.water;
}

static void it_settles_at_the_draught_of_archimedes(void **state)
{
    (void)state;
    const mgt_water water = flat_water();
    floating_body body = make_box(2000);
    for (double share = 0.5; share < 1.6; share += 0.25) {
        body.mass = share * BODY_WATER_DENSITY * box[0] * box[1] * box[2] / 2;
        body_motion motion = {0};
        assert_int_equal(body_run(&body, &motion, &water, 0, 30), MGT_OK);
        const double draught = box[1] / 2 - motion.heave, expected = body.mass / (BODY_WATER_DENSITY * box[0] * box[2]);
        assert_true(fabs(draught - expected) < 0.001 * expected);
        assert_true(fabs(motion.heave_speed) < 1e-6);
    }
}

/* Seconds of a period: between the first and the last of three downward crossings of zero, half of it. */
static double measure_period(const floating_body *body, body_motion *motion, const double *value)
{
    const mgt_water water = flat_water();
    double first = 0, last = 0;
    int crossings = 0;
    for (int i = 0; i < 6000 && crossings < 3; i++) {
        const double before = *value, time = i / 300.0;
        assert_int_equal(body_step(body, motion, &water, time, 1 / 300.0), MGT_OK);
        if (before > 0 && *value <= 0) {
            last = time + before / (before - *value) / 300;
            first = crossings++ ? first : last;
        }
    }
    assert_int_equal(crossings, 3);
    return (last - first) / 2;
}

static void it_heaves_with_the_analytic_period(void **state)
{
    (void)state;
    const double area = box[0] * box[2];
    for (double damping = 0; damping < 700; damping += 300) {
        const floating_body body = make_box(damping);
        const double stiffness = BODY_WATER_DENSITY * BODY_GRAVITY * area / body.mass, decay = damping * area / (2 * body.mass);
        body_motion motion = {.heave = 0.2};
        const double period = measure_period(&body, &motion, &motion.heave);
        assert_true(fabs(period / (2 * pi / sqrt(stiffness - decay * decay)) - 1) < 0.01);
        assert_true(fabs(period / (2 * pi / sqrt(stiffness)) - 1) < 0.05);
    }
}

/* Small angles: the restoring moment is the weight times the metacentric height, that of the columns' own waterplane. */
static void it_rolls_and_pitches_with_the_metacentric_period(void **state)
{
    (void)state;
    const floating_body body = make_box(0);
    double across = 0, along = 0;
    for (size_t i = 0; i < body.count; i++) {
        across += body.columns[i].area * body.columns[i].x * body.columns[i].x;
        along += body.columns[i].area * body.columns[i].z * body.columns[i].z;
    }
    const double volume = body.mass / BODY_WATER_DENSITY, weight = body.mass * BODY_GRAVITY, down = box[1] / 4;
    body_motion roll = {.roll = 0.02}, pitch = {.pitch = 0.02};
    const double roll_period = 2 * pi * sqrt(body.roll_inertia / (weight * (across / volume - down)));
    const double pitch_period = 2 * pi * sqrt(body.pitch_inertia / (weight * (along / volume - down)));
    assert_true(fabs(measure_period(&body, &roll, &roll.roll) / roll_period - 1) < 0.01);
    assert_true(fabs(measure_period(&body, &pitch, &pitch.pitch) / pitch_period - 1) < 0.01);
}

/* On a wave much longer than the body, which hardly moves, it lies along the slope, whatever its heading. */
static void it_lies_along_the_water(void **state)
{
    (void)state;
    mgt_water water = flat_water();
    const mgt_wave wave = {.amplitude = 5, .kx = 0.01};
    water.waves = &wave;
    water.wave_count = 1;
    const double slope = atan(wave.amplitude * wave.kx);
    for (int quarter = 0; quarter < 4; quarter++) {
        floating_body body = make_box(2000);
        body.heading = quarter * pi / 2;
        body_motion motion = {0};
        assert_int_equal(body_run(&body, &motion, &water, 0, 30), MGT_OK);
        /* The bow points to -z, -x, +z and +x in turn; the water rises towards +x. */
        assert_true(fabs(motion.roll - slope * cos(body.heading)) < 0.03 * slope);
        assert_true(fabs(motion.pitch + slope * sin(body.heading)) < 0.03 * slope);
        assert_true(fabs(motion.heave) < 0.01);
    }
}

/* Water that rises and falls as a whole: stiffness and damping pull the body along, its mass holds it back. */
static void it_answers_swell_as_a_damped_oscillator(void **state)
{
    (void)state;
    mgt_water water = flat_water();
    const mgt_wave swell = {.amplitude = 0.1, .kx = 1e-6, .omega = 3};
    water.waves = &swell;
    water.wave_count = 1;
    const floating_body body = make_box(1500);
    body_motion motion = {0};
    assert_int_equal(body_run(&body, &motion, &water, 0, 30), MGT_OK);
    const double area = box[0] * box[2], stiffness = BODY_WATER_DENSITY * BODY_GRAVITY * area, drag = body.damping * area * swell.omega;
    const double inert = stiffness - body.mass * swell.omega * swell.omega;
    const double gain = hypot(stiffness, drag) / hypot(inert, drag), shift = atan2(drag, stiffness) - atan2(drag, inert);
    for (int i = 0; i < 200; i++) {
        const double time = 30 + i / 60.0, expected = swell.amplitude * gain * sin(swell.omega * time + shift);
        assert_true(fabs(motion.heave - expected) < 0.02 * swell.amplitude);
        assert_int_equal(body_run(&body, &motion, &water, time, 1 / 60.0), MGT_OK);
    }
}

static void waves_that_do_not_count_do_not_move_it(void **state)
{
    (void)state;
    mgt_water water = flat_water();
    const mgt_wave wave = {.amplitude = 0.05, .kx = 2 * pi, .omega = -7.8};
    water.waves = &wave;
    water.wave_count = 1;
    floating_body body = make_box(500);
    body.least_wavelength = 2;
    body_motion motion = {0};
    assert_int_equal(body_run(&body, &motion, &water, 0, 5), MGT_OK);
    assert_true(fabs(motion.heave) < 1e-9 && fabs(motion.roll) < 1e-9);
}

static void bad_water_is_reported(void **state)
{
    (void)state;
    mgt_water water = flat_water();
    const mgt_wave wave = {.amplitude = -1};
    water.waves = &wave;
    water.wave_count = 1;
    const floating_body body = make_box(500);
    body_motion motion = {0};
    assert_int_equal(body_run(&body, &motion, &water, 0, 1), MGT_ERROR_SCENE);
    assert_true(motion.heave == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(it_settles_at_the_draught_of_archimedes),
                                       cmocka_unit_test(it_heaves_with_the_analytic_period),
                                       cmocka_unit_test(it_rolls_and_pitches_with_the_metacentric_period),
                                       cmocka_unit_test(it_lies_along_the_water),
                                       cmocka_unit_test(it_answers_swell_as_a_damped_oscillator),
                                       cmocka_unit_test(waves_that_do_not_count_do_not_move_it),
                                       cmocka_unit_test(bad_water_is_reported)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
