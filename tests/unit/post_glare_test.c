/* SPDX-License-Identifier: MIT
 *
 * Glare: energy, symmetry, fall-off, independence of resolution and of threads.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/glare.h"

typedef struct image {
    size_t width, height, stride;
    float *rgb;
} image;

static image image_make(size_t width, size_t height)
{
    image i = {width, height, 3 * width + 5, NULL};
    i.rgb = calloc(i.stride * height, sizeof(float));
    assert_non_null(i.rgb);
    return i;
}

static float *pixel(const image *i, size_t x, size_t y) { return &i->rgb[y * i->stride + 3 * x]; }

static void fill_noise(image *i, unsigned seed)
{
    for (size_t y = 0; y < i->height; ++y) {
        for (size_t x = 0; x < 3 * i->width; ++x) {
            seed = seed * 1664525u + 1013904223u;
            i->rgb[y * i->stride + x] = (float)(seed >> 8) / 16777216.0f;
        }
    }
}

static double channel_sum(const image *i, int c)
{
    double sum = 0;
    for (size_t y = 0; y < i->height; ++y) {
        for (size_t x = 0; x < i->width; ++x) {
            sum += pixel(i, x, y)[c];
        }
    }
    return sum;
}

static void apply(image *i, float glare) { assert_int_equal(glare_apply(i->rgb, i->width, i->height, i->stride, glare, NULL, NULL), MGT_OK); }

static void the_sum_stays_for_every_size(void **unused)
{
    (void)unused;
    static const size_t sizes[][2] = {{1, 1}, {1, 9}, {2, 2}, {3, 5}, {17, 31}, {128, 72}, {129, 127}, {257, 130}, {300, 3}, {640, 360}};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; ++k) {
        image i = image_make(sizes[k][0], sizes[k][1]);
        fill_noise(&i, (unsigned)k);
        *pixel(&i, 0, 0) = 1e4f; /* in a corner, red */
        pixel(&i, i.width - 1, i.height - 1)[2] = 1e4f;
        for (size_t y = 0; y < i.height; ++y) {
            memset(&i.rgb[y * i.stride + 3 * i.width], 0x55, 5 * sizeof(float)); /* not ours to touch */
        }
        double before[3], after[3];
        for (int c = 0; c < 3; ++c) {
            before[c] = channel_sum(&i, c);
        }
        apply(&i, 0.6f);
        for (int c = 0; c < 3; ++c) {
            after[c] = channel_sum(&i, c);
            assert_true(fabs(after[c] / before[c] - 1) < 2e-6);
        }
        for (size_t y = 0; y < i.height; ++y) {
            const unsigned char *room = (const unsigned char *)&i.rgb[y * i.stride + 3 * i.width];
            for (size_t b = 0; b < 5 * sizeof(float); ++b) {
                assert_int_equal(room[b], 0x55);
            }
        }
        free(i.rgb);
    }
}

static void an_even_picture_stays_even(void **unused)
{
    (void)unused;
    image i = image_make(211, 147);
    for (size_t y = 0; y < i.height; ++y) {
        for (size_t x = 0; x < 3 * i.width; ++x) {
            i.rgb[y * i.stride + x] = 3.0f;
        }
    }
    apply(&i, 1.0f);
    for (size_t y = 0; y < i.height; ++y) {
        for (size_t x = 0; x < 3 * i.width; ++x) {
            assert_true(fabsf(i.rgb[y * i.stride + x] - 3.0f) < 2e-5f);
        }
    }
    free(i.rgb);
}

static void zero_glare_changes_nothing(void **unused)
{
    (void)unused;
    image i = image_make(60, 40), copy = image_make(60, 40);
    fill_noise(&i, 3);
    memcpy(copy.rgb, i.rgb, i.stride * i.height * sizeof(float));
    apply(&i, 0.0f);
    assert_memory_equal(copy.rgb, i.rgb, i.stride * i.height * sizeof(float));
    free(i.rgb);
    free(copy.rgb);
}

static void spread_is_symmetric(void **unused)
{
    (void)unused;
    /* Mirrored pictures give mirrored glare, exchanged axes exchanged glare. */
    image a = image_make(256, 256), b = image_make(256, 256), c = image_make(256, 256);
    pixel(&a, 90, 41)[0] = 1e5f;
    pixel(&b, 255 - 90, 41)[0] = 1e5f;
    pixel(&c, 41, 90)[0] = 1e5f;
    apply(&a, 0.1f);
    apply(&b, 0.1f);
    apply(&c, 0.1f);
    for (size_t y = 0; y < 256; ++y) {
        for (size_t x = 0; x < 256; ++x) {
            float here = *pixel(&a, x, y);
            assert_true(fabsf(*pixel(&b, 255 - x, y) - here) <= 1e-5f * here);
            assert_true(fabsf(*pixel(&c, y, x) - here) <= 1e-5f * here);
            assert_true(pixel(&a, x, y)[1] == 0.0f && pixel(&a, x, y)[2] == 0.0f);
        }
    }
    /* What a sends to b, b sends to a; odd sizes too. */
    image p = image_make(203, 151), q = image_make(203, 151);
    *pixel(&p, 202, 7) = 1e5f;
    *pixel(&q, 160, 60) = 1e5f;
    apply(&p, 0.2f);
    apply(&q, 0.2f);
    float there = *pixel(&p, 160, 60), back = *pixel(&q, 202, 7);
    assert_true(there > 0.0f && fabsf(there - back) < 1e-4f * back);
    free(a.rgb);
    free(b.rgb);
    free(c.rgb);
    free(p.rgb);
    free(q.rgb);
}

/* Mean over a ring of some directions, so that the pyramid's slight anisotropy drops out. */
static double ring(const image *i, double cx, double cy, double radius)
{
    double sum = 0;
    for (int k = 0; k < 64; ++k) {
        double a = k * 6.283185307 / 64;
        sum += *pixel(i, (size_t)(cx + radius * cos(a) + 0.5), (size_t)(cy + radius * sin(a) + 0.5));
    }
    return sum / 64;
}

static void light_falls_off_between_the_square_and_the_cube(void **unused)
{
    (void)unused;
    image i = image_make(1024, 1024);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) {
            *pixel(&i, 511 + x, 511 + y) = 1e5f;
        }
    }
    apply(&i, 0.05f);
    double before = ring(&i, 511.5, 511.5, 6);
    for (double r = 12; r < 200; r *= 2) {
        double now = ring(&i, 511.5, 511.5, r), power = log2(before / now);
        if (!(power > 1.7 && power < 3.6)) {
            fail_msg("falls by r^-%g at %g pixels", power, r);
        }
        before = now;
    }
    /* No blocks: along a row the light falls, and its steps shrink smoothly. */
    for (size_t x = 516; x < 700; ++x) {
        double left = *pixel(&i, x - 1, 512), here = *pixel(&i, x, 512), right = *pixel(&i, x + 1, 512);
        assert_true(here < left * 1.0001);
        double r = (double)x - 511.5;
        assert_true(fabs(left - 2 * here + right) < 40 / (r * r) * here);
    }
    /* A sun of 1e5 over 4 pixels must not drown the picture. */
    assert_true(ring(&i, 511.5, 511.5, 60) < 1.0);
    assert_true(ring(&i, 511.5, 511.5, 6) > 1.0);
    free(i.rgb);
}

static void look_does_not_depend_on_resolution(void **unused)
{
    (void)unused;
    double seen[3];
    for (int k = 0; k < 3; ++k) {
        size_t size = 192u << k, side = size / 48; /* a bright square of a 48th of the picture */
        image i = image_make(size, size);
        for (size_t y = 0; y < side; ++y) {
            for (size_t x = 0; x < side; ++x) {
                *pixel(&i, size / 2 - side / 2 + x, size / 2 - side / 2 + y) = 1e3f;
            }
        }
        apply(&i, 0.1f);
        seen[k] = ring(&i, (double)size / 2 - 0.5, (double)size / 2 - 0.5, 0.12 * (double)size);
        free(i.rgb);
    }
    assert_true(fabs(seen[1] / seen[0] - 1) < 0.06);
    assert_true(fabs(seen[2] / seen[1] - 1) < 0.06);
}

static void backwards_for(void *user, size_t count, void (*body)(void *arg, size_t index), void *arg)
{
    *(size_t *)user += count;
    for (size_t i = count; i-- > 0;) {
        body(arg, i);
    }
}

static void order_of_the_tasks_does_not_matter(void **unused)
{
    (void)unused;
    image one = image_make(333, 222), two = image_make(333, 222);
    fill_noise(&one, 9);
    fill_noise(&two, 9);
    size_t tasks = 0;
    apply(&one, 0.3f);
    assert_int_equal(glare_apply(two.rgb, two.width, two.height, two.stride, 0.3f, backwards_for, &tasks), MGT_OK);
    assert_true(tasks > 40);
    assert_memory_equal(one.rgb, two.rgb, one.stride * one.height * sizeof(float));
    free(one.rgb);
    free(two.rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sum_stays_for_every_size),
        cmocka_unit_test(an_even_picture_stays_even),
        cmocka_unit_test(zero_glare_changes_nothing),
        cmocka_unit_test(spread_is_symmetric),
        cmocka_unit_test(light_falls_off_between_the_square_and_the_cube),
        cmocka_unit_test(look_does_not_depend_on_resolution),
        cmocka_unit_test(order_of_the_tasks_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
