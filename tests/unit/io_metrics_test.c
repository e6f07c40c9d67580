/* SPDX-License-Identifier: MIT */
/* mgt_metrics_measure(): pictures that cannot be compared have no score. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "mangata/io.h"

enum { WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT, FRAMES = 3, MOST_METRICS = 32 };

typedef struct clip {
    float pixels[FRAMES][3 * PIXELS];
} clip;

typedef struct answer {
    double scores[MOST_METRICS];
    float map[PIXELS];
} answer;

static uint32_t metric_of(const char *name)
{
    uint32_t metric = 0;
    while (strcmp(mgt_metric_name(metric), name) != 0)
        metric++;
    return metric;
}

static answer measure(const clip *a, const clip *b, const char *words, const char *map)
{
    answer result;
    mgt_metrics_desc desc;
    mgt_metrics_desc_init(&desc, sizeof desc);
    desc.width = WIDTH;
    desc.height = HEIGHT;
    desc.channels = 3;
    desc.metrics = words;
    const float *of_a[FRAMES], *of_b[FRAMES];
    for (int i = 0; i < FRAMES; i++) {
        of_a[i] = a->pixels[i];
        of_b[i] = b->pixels[i];
    }
    assert_int_equal(mgt_metrics_measure(&desc, of_a, of_b, FRAMES, result.scores, metric_of(map), result.map, NULL), MGT_IO_OK);
    return result;
}

static clip some_clip(void)
{
    clip c;
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < 3 * PIXELS; i++)
            c.pixels[f][i] = (float)((i * 37 + f * 11) % 101) / 101.0f;
    return c;
}

/* The values from `first` on, `count` in all, of frame `frame` of A, of B, and of both. */
static void check_broken(float value, int frame, int first, int count, bool equal)
{
    static const char *const mapped[] = {"rmse", "relrmse", "flip", "hdr-flip", "ssim"};
    static clip clips[2];
    for (int broken = 1; broken < 4; broken++)
        for (size_t m = 0; m < sizeof mapped / sizeof mapped[0]; m++) {
            for (int side = 0; side < 2; side++) {
                clips[side] = some_clip();
                for (int i = first; i < first + count && broken >> side & 1; i++)
                    clips[side].pixels[frame][i] = value;
            }
            const bool fine = equal && broken == 3;
            const answer all = measure(&clips[0], &clips[1], NULL, mapped[m]), one = measure(&clips[0], &clips[1], "energy", mapped[m]);
            assert_true(isnan(one.scores[metric_of("energy")]) == !fine);
            for (uint32_t i = 0; mgt_metric_name(i); i++)
                assert_true(isnan(all.scores[i]) == (!fine || i == metric_of("yee")));
            for (int i = 0; i < PIXELS; i++) {
                const bool lost = !fine && frame == FRAMES - 1 && 3 * i + 2 >= first && 3 * i < first + count;
                assert_true(isnan(all.map[i]) == lost && isnan(one.map[i]) == lost);
            }
        }
}

static void broken_pictures_have_no_scores(void **state)
{
    (void)state;
    check_broken(NAN, FRAMES - 1, 0, 3 * PIXELS, false);
    check_broken(NAN, FRAMES - 1, 40, 3 * PIXELS / 2, false);
    check_broken(NAN, 0, 40, 1, false);
    check_broken(INFINITY, FRAMES - 1, 40, 1, true);
    check_broken(-INFINITY, 1, 41, 1, true);
}

static void unlike_infinities_have_no_scores(void **state)
{
    (void)state;
    static clip a, b;
    a = b = some_clip();
    a.pixels[1][7] = INFINITY;
    b.pixels[1][7] = -INFINITY;
    assert_true(isnan(measure(&a, &b, "rmse", "rmse").scores[metric_of("rmse")]));
}

static void finite_pictures_have_scores(void **state)
{
    (void)state;
    static clip a, b;
    a = b = some_clip();
    assert_true(measure(&a, &b, "rmse", "rmse").scores[metric_of("rmse")] == 0);
    a.pixels[FRAMES - 1][5] += 0.5f;
    const answer one = measure(&a, &b, "rmse", "rmse");
    assert_true(fabs(one.scores[metric_of("rmse")] - 0.5 / sqrt(3.0 * PIXELS * FRAMES)) < 1e-6);
    assert_true(fabsf(one.map[1] - 0.5f / sqrtf(3)) < 1e-6f && one.map[0] == 0);
    assert_true(isnan(one.scores[metric_of("energy")]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(broken_pictures_have_no_scores),
        cmocka_unit_test(unlike_infinities_have_no_scores),
        cmocka_unit_test(finite_pictures_have_scores),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
