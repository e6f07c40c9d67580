/* SPDX-License-Identifier: MIT */
/* Error measures between pictures against figures worked out by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "image/image_metrics.h"

static void test_by_hand(void **state)
{
    (void)state;
    float a[6] = {1, 2, 3, 4, 5, 6}, b[6] = {1, 2, 3, 2, 5, 7};
    float_image image_a = {3, 2, 1, a}, image_b = {3, 2, 1, b};
    image_metrics metrics = {0};
    assert_int_equal(image_metrics_add(&metrics, &image_a, &image_b, NULL), FILE_OK);
    assert_int_equal(metrics.values, 6);
    assert_true(fabs(image_metrics_rmse(&metrics) - sqrt(5.0 / 6.0)) < 1e-15);
    assert_true(fabs(image_metrics_relative_rmse(&metrics) - sqrt(5.0 / 92.0)) < 1e-15);
    assert_true(fabs(image_metrics_mean_ratio(&metrics) - 21.0 / 20.0) < 1e-15);
    assert_true(metrics.max_difference == 2.0);
    assert_int_equal(metrics.max_x, 0);
    assert_int_equal(metrics.max_y, 1);
    assert_int_equal(metrics.mismatches, 0);
}

/* Frames scored together equal one tall picture of them all; the maximum names its frame. */
static void test_frames_together(void **state)
{
    (void)state;
    float a[12] = {1, 0, 2, 3, 9, 1, 0, 0, 2, 2, 2, 1}, b[12] = {1, 1, 2, 0, 1, 1, 0, 3, 2, 2, 1, 1};
    image_metrics frames = {0}, tall = {0};
    for (int f = 0; f < 2; f++) {
        float_image image_a = {1, 2, 3, a + 6 * f}, image_b = {1, 2, 3, b + 6 * f};
        assert_int_equal(image_metrics_add(&frames, &image_a, &image_b, NULL), FILE_OK);
    }
    float_image tall_a = {1, 4, 3, a}, tall_b = {1, 4, 3, b};
    assert_int_equal(image_metrics_add(&tall, &tall_a, &tall_b, NULL), FILE_OK);
    assert_true(image_metrics_rmse(&frames) == image_metrics_rmse(&tall));
    assert_true(image_metrics_relative_rmse(&frames) == image_metrics_relative_rmse(&tall));
    assert_true(image_metrics_mean_ratio(&frames) == image_metrics_mean_ratio(&tall));
    assert_int_equal(frames.frames, 2);
    assert_true(frames.max_difference == 8.0);
    assert_int_equal(frames.max_frame, 0);
    assert_int_equal(frames.max_y, 1);
    assert_int_equal(frames.max_channel, 1);
}

static void test_non_finite(void **state)
{
    (void)state;
    float a[8] = {INFINITY, INFINITY, -INFINITY, NAN, NAN, 1, 2, 3}, b[8] = {INFINITY, -INFINITY, 1, NAN, 2, INFINITY, 2, 5};
    float_image image_a = {8, 1, 1, a}, image_b = {8, 1, 1, b};
    image_metrics metrics = {0};
    assert_int_equal(image_metrics_add(&metrics, &image_a, &image_b, NULL), FILE_OK);
    assert_int_equal(metrics.equal_infinities, 1);
    assert_int_equal(metrics.mismatches, 5);
    assert_int_equal(metrics.non_finite_a, 5);
    assert_int_equal(metrics.non_finite_b, 4);
    assert_int_equal(metrics.values, 2);
    assert_true(image_metrics_rmse(&metrics) == sqrt(2.0));
}

static void test_empty_and_black(void **state)
{
    (void)state;
    image_metrics metrics = {0};
    assert_true(image_metrics_rmse(&metrics) == 0.0);
    assert_true(image_metrics_relative_rmse(&metrics) == 0.0);
    assert_true(image_metrics_mean_ratio(&metrics) == 1.0);
    float zero[2] = {0, 0}, one[2] = {1, 1};
    float_image black = {2, 1, 1, zero}, white = {2, 1, 1, one};
    assert_int_equal(image_metrics_add(&metrics, &white, &black, NULL), FILE_OK);
    assert_true(isinf(image_metrics_relative_rmse(&metrics)));
    assert_true(isinf(image_metrics_mean_ratio(&metrics)));
}

static void test_unlike_pictures_are_refused(void **state)
{
    (void)state;
    float values[12] = {0};
    float_image a = {2, 2, 3, values};
    const float_image others[] = {{3, 2, 2, values}, {2, 1, 3, values}, {2, 2, 1, values}, {1, 2, 3, values}};
    for (int i = 0; i < 4; i++) {
        image_metrics metrics = {0};
        file_error error;
        assert_int_equal(image_metrics_add(&metrics, &a, &others[i], &error), FILE_ARGUMENT);
        assert_int_equal(metrics.frames, 0);
        assert_int_equal(metrics.values, 0);
    }
}

/* A small constant difference must not drown in the rounding of a large sum. */
static void test_large_sums(void **state)
{
    (void)state;
    const uint32_t side = 1000;
    float *a = malloc((size_t)side * side * sizeof *a), *b = malloc((size_t)side * side * sizeof *b);
    for (uint32_t i = 0; i < side * side; i++) {
        b[i] = 1000.0f;
        a[i] = 1000.0f + 0x1p-10f;
    }
    float_image image_a = {side, side, 1, a}, image_b = {side, side, 1, b};
    image_metrics metrics = {0};
    for (int frame = 0; frame < 4; frame++)
        assert_int_equal(image_metrics_add(&metrics, &image_a, &image_b, NULL), FILE_OK);
    assert_true(fabs(image_metrics_rmse(&metrics) / 0x1p-10 - 1.0) < 1e-12);
    assert_true(fabs(image_metrics_mean_ratio(&metrics) - (1.0 + 0x1p-10 / 1000.0)) < 1e-13);
    free(a);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_by_hand),
        cmocka_unit_test(test_frames_together),
        cmocka_unit_test(test_non_finite),
        cmocka_unit_test(test_empty_and_black),
        cmocka_unit_test(test_unlike_pictures_are_refused),
        cmocka_unit_test(test_large_sums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
