/* SPDX-License-Identifier: MIT */
/* Texture, specks, errors freed of noise and noise floors, against closed forms: sines with independent noise, single pixels. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/metrics_clip.h"
#include "image/metrics_noise.h"
#include "image/metrics_specks.h"
#include "image/metrics_texture.h"

enum { W = 600, H = 47, PIXELS = W * H, WAVES = 12 };

static const double tau = 6.283185307179586;

/* Of mean 0 and variance 1, by a sum of twelve even numbers. */
static float noise(uint64_t *seed)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        *seed = *seed * 6364136223846793005u + 1442695040888963407u;
        sum += (double)(*seed >> 11) / 9007199254740992.0;
    }
    return (float)sum;
}

/* offset + amplitude · sine; WAVES whole waves a row, so that its mean is `offset` and its variance amplitude²/2. `turns` shifts the wave. */
static void fill_sine(float *pixels, double offset, double amplitude, double turns)
{
    for (int i = 0; i < PIXELS; i++)
        pixels[i] = (float)(offset + amplitude * sin(tau * (WAVES * (i % W + 0.5) / W + turns)));
}

static void add_noise(float *pixels, double deviation, uint64_t seed)
{
    for (int i = 0; i < PIXELS; i++)
        pixels[i] += (float)deviation * noise(&seed);
}

static texture *texture_of(const float *p, const float *a, const float *b)
{
    texture *t = NULL;
    const texture_input input = {p, {a, b}, NULL};
    assert_int_equal(texture_create(&t, W, H, NULL), FILE_OK);
    texture_add(t, &input);
    return t;
}

/* ---- texture ---- */

static void test_bands(void **state)
{
    (void)state;
    static const uint32_t heights[] = {1, 4, 5, 9, 10, 14, 15, 47}, bands[] = {0, 0, 1, 1, 1, 1, 2, 5}, last[] = {0, 0, 5, 9, 10, 10, 5, 7};
    static float pixels[47];
    for (int i = 0; i < 8; i++) {
        texture *t = NULL;
        const texture_input input = {pixels, {pixels, pixels}, NULL};
        assert_int_equal(texture_create(&t, 1, heights[i], NULL), FILE_OK);
        texture_add(t, &input);
        assert_int_equal(texture_bands(t), bands[i]);
        for (uint32_t b = 0; b < bands[i]; b++) {
            assert_int_equal(texture_band_at(t, b).row, 10 * b);
            assert_int_equal(texture_band_at(t, b).rows, b + 1 == bands[i] ? last[i] : 10);
        }
        assert_true(isnan(texture_summarize(t).correlation_mean) && isnan(texture_summarize(t).mean_least));
        texture_free(t);
    }
}

/* Without noise: contrast is the ratio of amplitudes, correlation the cosine of the shift, mean the ratio of offsets. */
static void test_texture_of_sines(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS];
    fill_sine(a, 2, 0.5, 0);
    for (int i = 0; i <= 8; i++) {
        fill_sine(p, 1.5, 0.1 * (i + 1), i / 16.0);
        texture *t = texture_of(p, a, a);
        for (uint32_t b = 0; b < texture_bands(t); b++) {
            const texture_band band = texture_band_at(t, b);
            assert_true(fabs(band.contrast - 0.2 * (i + 1)) < 1e-5);
            assert_true(fabs(band.correlation - cos(tau * i / 16)) < 1e-5);
            assert_true(fabs(band.mean - 0.75) < 1e-6);
        }
        texture_free(t);
    }
}

/* References with noise of half the texture's strength: neither contrast nor correlation is off, though those of one picture against the other are. */
static void test_texture_is_free_of_noise(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS], b[PIXELS];
    const double amplitude = 0.5, variance = amplitude * amplitude / 2, deviation = sqrt(variance / 2);
    fill_sine(a, 2, amplitude, 0);
    memcpy(b, a, sizeof b);
    fill_sine(p, 2, 0.8 * amplitude, 0);
    add_noise(a, deviation, 1);
    add_noise(b, deviation, 2);
    texture *t = texture_of(p, a, b);
    for (uint32_t i = 0; i < texture_bands(t); i++) {
        const texture_band band = texture_band_at(t, i);
        assert_true(fabs(band.contrast - 0.8) < 0.02);
        assert_true(fabs(band.correlation - 1) < 0.03);
        assert_true(fabs(band.mean - 1) < 0.005);
    }
    texture_free(t);
    /* Noise of the picture itself counts: contrast² = .64 + .5, and the sine is that part of it. */
    add_noise(p, deviation, 3);
    t = texture_of(p, a, b);
    const texture_summary summary = texture_summarize(t);
    assert_true(fabs(summary.contrast_least - sqrt(1.14)) < 0.03 && fabs(summary.contrast_greatest - sqrt(1.14)) < 0.03);
    assert_true(fabs(summary.correlation_mean - 0.8 / sqrt(1.14)) < 0.01);
    assert_true(summary.correlation_least <= summary.correlation_mean && summary.correlation_least > 0.8 / sqrt(1.14) - 0.03);
    texture_free(t);
    /* With one noisy picture as both references its noise counts as texture. */
    fill_sine(p, 2, 0.8 * amplitude, 0);
    t = texture_of(p, a, a);
    assert_true(fabs(texture_band_at(t, 0).contrast - 0.8 / sqrt(1.5)) < 0.02);
    texture_free(t);
}

/* Over many pairs of references the figures of a band spread as their noise says, here and for a picture of other texture. */
static void test_texture_tells_its_noise(void **state)
{
    (void)state;
    enum { RUNS = 200 };
    static float p[PIXELS], a[PIXELS], b[PIXELS];
    for (int shift = 0; shift < 2; shift++) {
        double sums[3] = {0}, squares[3] = {0}, told[3] = {0};
        fill_sine(p, 2, 0.4, shift / 8.0);
        for (int run = 0; run < RUNS; run++) {
            fill_sine(a, 2, 0.5, 0);
            memcpy(b, a, sizeof b);
            add_noise(a, 0.25, 1000 + 2 * (uint64_t)run);
            add_noise(b, 0.25, 1001 + 2 * (uint64_t)run);
            texture *t = texture_of(p, a, b);
            const texture_band band = texture_band_at(t, 0);
            const double values[] = {band.contrast, band.correlation, band.mean}, noise[] = {band.contrast_noise, band.correlation_noise, band.mean_noise};
            for (int i = 0; i < 3; i++) {
                sums[i] += values[i] / RUNS;
                squares[i] += values[i] * values[i] / RUNS;
                told[i] += noise[i] / RUNS;
            }
            texture_free(t);
        }
        for (int i = 0; i < 3; i++) {
            const double spread = sqrt(squares[i] - sums[i] * sums[i]);
            assert_true(fabs(told[i] / spread - 1) < 0.2);
        }
    }
    /* Without noise there is none to tell. */
    fill_sine(a, 2, 0.5, 0);
    texture *t = texture_of(p, a, a);
    const texture_summary noise = texture_summarize_noise(t);
    assert_true(noise.correlation_mean == 0 && noise.correlation_least == 0 && noise.contrast_least == 0 && noise.mean_greatest == 0);
    texture_free(t);
}

static void test_texture_adds_frames(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS];
    texture *t = NULL;
    const texture_input input = {p, {a, a}, NULL};
    assert_int_equal(texture_create(&t, W, H, NULL), FILE_OK);
    for (int f = 0; f < 2; f++) { /* amplitudes 1 and 3, seen as 1 and 1; means 2 and 6, seen as 1 */
        fill_sine(a, f ? 6 : 2, f ? 3 : 1, 0);
        fill_sine(p, 1, 1, 0);
        texture_add(t, &input);
    }
    const texture_band band = texture_band_at(t, 4);
    assert_true(fabs(band.contrast - sqrt(2.0 / 10)) < 1e-5);
    assert_true(fabs(band.correlation - (1 + 3) / sqrt(2 * 10)) < 1e-5);
    assert_true(fabs(band.mean - 2.0 / 8) < 1e-6);
    texture_free(t);
}

/* Each undefined figure is NaN, alone, and the summary leaves it out. */
static void test_texture_without_meaning(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS], b[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        p[i] = 0.1f;
    fill_sine(a, 2, 0.5, 0);
    texture *t = texture_of(p, a, a);
    assert_true(texture_band_at(t, 0).contrast == 0 && isnan(texture_band_at(t, 0).correlation) && fabs(texture_band_at(t, 0).mean - 0.05) < 1e-6);
    texture_free(t);
    t = texture_of(a, p, p);
    assert_true(isnan(texture_band_at(t, 0).contrast) && isnan(texture_band_at(t, 0).correlation) && fabs(texture_band_at(t, 0).mean - 20) < 1e-4);
    texture_free(t);
    fill_sine(b, 2, 0.5, 0.5);
    t = texture_of(a, a, b);
    assert_true(isnan(texture_band_at(t, 0).contrast) && isnan(texture_band_at(t, 0).correlation) && texture_band_at(t, 0).mean == 1);
    texture_free(t);
    t = texture_of(a, b, b);
    assert_true(fabs(texture_band_at(t, 0).correlation + 1) < 1e-6);
    texture_free(t);
    memset(b, 0, sizeof b);
    t = texture_of(a, b, b);
    assert_true(isnan(texture_band_at(t, 0).mean));
    texture_free(t);
    /* Nothing but the top band has texture. */
    fill_sine(a, 2, 0.5, 0);
    for (int i = 10 * W; i < PIXELS; i++)
        a[i] = 1;
    t = texture_of(a, a, a);
    const texture_summary summary = texture_summarize(t);
    assert_true(fabs(summary.correlation_mean - 1) < 1e-12 && fabs(summary.correlation_least - 1) < 1e-12);
    assert_true(summary.contrast_least == summary.contrast_greatest && fabs(summary.contrast_least - 1) < 1e-12);
    assert_true(summary.mean_least == 1 && summary.mean_greatest == 1);
    texture_free(t);
}

/* Pixels that do not count may hold anything, and a row may have none that does. */
static void test_texture_of_a_part(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS];
    static bool counted[PIXELS];
    texture *t = NULL;
    const texture_input input = {p, {a, a}, counted};
    fill_sine(a, 2, 0.5, 0);
    fill_sine(p, 1, 0.25, 0);
    for (int i = 0; i < PIXELS; i++) {
        counted[i] = i / W != 3 && i % W >= W / 2;
        if (!counted[i])
            p[i] = 100;
    }
    assert_int_equal(texture_create(&t, W, H, NULL), FILE_OK);
    texture_add(t, &input);
    for (uint32_t i = 0; i < texture_bands(t); i++) {
        const texture_band band = texture_band_at(t, i);
        assert_true(fabs(band.contrast - 0.5) < 1e-6 && fabs(band.correlation - 1) < 1e-6 && fabs(band.mean - 0.5) < 1e-6);
    }
    texture_free(t);
}

/* ---- specks ---- */

static uint64_t specks(const float *picture, const float *truth, const bool *counted)
{
    const specks_input input = {picture, truth, counted, W, H};
    return specks_count(&input);
}

static void test_planted_specks(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS];
    static bool counted[PIXELS];
    fill_sine(a, 0.5, 0.1, 0);
    memcpy(p, a, sizeof p);
    assert_int_equal(specks(p, a, NULL), 0);
    p[0] = 1;            /* the corners and an edge have fewer neighbours */
    p[PIXELS - 1] = 0;   /* too dark */
    p[20 * W] = 1;       /* the row's other end is no neighbour */
    p[30 * W + 100] = 1; /* inside */
    p[30 * W + 101] = 0; /* each pixel counts by itself */
    assert_int_equal(specks(p, a, NULL), 5);
    for (int i = 0; i < PIXELS; i++)
        counted[i] = i / W >= 25;
    assert_int_equal(specks(p, a, counted), 3);
    /* A neighbour of the truth that is as bright excuses it, but not one that does not count. */
    memcpy(p, a, sizeof p);
    p[24 * W + 100] = p[25 * W + 300] = 1;
    a[25 * W + 101] = a[24 * W + 300] = 1;
    memset(counted, 1, sizeof counted);
    assert_int_equal(specks(p, a, counted), 0);
    counted[24 * W + 300] = false;
    assert_int_equal(specks(p, a, counted), 1);
    /* What only moved by a pixel is none, by two it is. */
    memset(a, 0, sizeof a);
    a[10 * W + 10] = 1;
    for (int shift = 0; shift < 3; shift++) {
        memset(p, 0, sizeof p);
        p[10 * W + 10 + shift] = 1;
        assert_int_equal(specks(p, a, NULL), shift == 2);
    }
    /* .1 beyond is not yet too far. */
    memset(p, 0, sizeof p);
    memset(a, 0, sizeof a);
    p[77] = SPECKS_DISTANCE;
    p[99] = 0.1001f;
    assert_int_equal(specks(p, a, NULL), 1);
}

/* Even noise of ±.2: the range of nine pixels mostly reaches as far as another draw of the same noise. By the closed form of the greatest of nine,
 * 2 ∫ (x − .25)⁹ dx from .25 to 1, a pixel in about 90 is beyond it by a quarter of the whole width. A picture that is all off is nothing but specks. */
static void test_noise_is_no_speck(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS];
    uint64_t seed = 5;
    for (int i = 0; i < PIXELS; i++) {
        float *const of[2] = {&p[i], &a[i]};
        for (int k = 0; k < 2; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            *of[k] = (float)(0.3 + 0.4 * (double)(seed >> 11) / 9007199254740992.0);
        }
    }
    const double expected = 2 * pow(0.75, 10) / 10, share = (double)specks(p, a, NULL) / PIXELS;
    assert_true(fabs(share - expected) < 0.1 * expected + 0.001);
    p[5 * W + 5] = 1;
    p[5 * W + 6] = 0.5f;
    const uint64_t one = specks(p, a, NULL);
    p[5 * W + 5] = 0.5f;
    assert_true(one == specks(p, a, NULL) + 1);
    for (int i = 0; i < PIXELS; i++)
        p[i] = 1;
    assert_int_equal(specks(p, a, NULL), PIXELS);
}

/* ---- errors freed of noise ---- */

static void test_noise_sums(void **state)
{
    (void)state;
    static float p[PIXELS], a[PIXELS], b[PIXELS];
    static bool counted[PIXELS];
    const float_image images[3] = {{W / 3, H, 3, p}, {W / 3, H, 3, a}, {W / 3, H, 3, b}};
    noise_sums sums = {0};
    assert_true(noise_sums_rmse(&sums) == 0 && noise_sums_floor(&sums) == 0);
    fill_sine(a, 2, 0.5, 0);
    memcpy(b, a, sizeof b);
    for (int f = 0; f < 2; f++) { /* off by .1 and by .3 */
        for (int i = 0; i < PIXELS; i++)
            p[i] = a[i] + (f ? 0.3f : 0.1f);
        assert_int_equal(noise_sums_add(&sums, images, NULL, NULL), FILE_OK);
    }
    assert_int_equal(sums.values, 2 * PIXELS);
    assert_true(fabs(noise_sums_rmse(&sums) - sqrt(0.05)) < 1e-6 && noise_sums_floor(&sums) == 0);
    /* Noise as strong as the error: freed of it the error is as before, and half of its square is left in the mean of both references. */
    add_noise(a, 0.3, 1);
    add_noise(b, 0.3, 2);
    sums = (noise_sums){0};
    assert_int_equal(noise_sums_add(&sums, images, NULL, NULL), FILE_OK);
    assert_true(fabs(noise_sums_rmse(&sums) - 0.3) < 0.006);
    assert_true(fabs(noise_sums_floor(&sums) - 0.3 / sqrt(2)) < 0.003);
    /* A picture between both references would have a negative square. */
    for (int i = 0; i < PIXELS; i++)
        p[i] = (a[i] + b[i]) / 2;
    sums = (noise_sums){0};
    noise_sums_add(&sums, images, NULL, NULL);
    assert_true(sums.product < 0 && noise_sums_rmse(&sums) == 0);
    /* Pixels that do not count and values that are not finite are left out. */
    memcpy(a, p, sizeof a);
    memcpy(b, p, sizeof b);
    for (int i = 0; i < PIXELS; i++)
        p[i] += i < PIXELS / 2 ? 9 : 1;
    for (int i = 0; i < PIXELS / 3; i++)
        counted[i] = i >= PIXELS / 6;
    p[PIXELS - 1] = NAN;
    a[PIXELS - 2] = INFINITY;
    b[PIXELS - 3] = -INFINITY;
    sums = (noise_sums){0};
    noise_sums_add(&sums, images, counted, NULL);
    assert_int_equal(sums.values, PIXELS / 2 - 3);
    assert_true(fabs(noise_sums_rmse(&sums) - 1) < 1e-5);
}

/* A floor is what the truth scores against the mean of two halves; that of RMSE is the one of noise_sums. */
static void test_floors_of_clips(void **state)
{
    (void)state;
    static float truth[PIXELS], a[PIXELS], b[PIXELS];
    const clip_metrics_desc desc = {.width = W,
                                    .height = H,
                                    .channels = 1,
                                    .metrics = 1u << CLIP_RMSE | 1u << CLIP_ENERGY | 1u << CLIP_FLIP | 1u << CLIP_SSIM | 1u << CLIP_FLICKER};
    clip_metrics *noise = NULL, *true_scores = NULL;
    noise_sums sums = {0};
    assert_int_equal(clip_metrics_create(&noise, &desc, NULL), FILE_OK);
    assert_int_equal(clip_metrics_create(&true_scores, &desc, NULL), FILE_OK);
    for (uint64_t frame = 0; frame < 4; frame++) {
        fill_sine(truth, 0.5, 0.2, (double)frame / 8);
        memcpy(a, truth, sizeof a);
        memcpy(b, truth, sizeof b);
        add_noise(a, 0.03, 100 + frame);
        add_noise(b, 0.03, 200 + frame);
        const float_image images[3] = {{W, H, 1, truth}, {W, H, 1, a}, {W, H, 1, b}};
        float_image mean;
        assert_int_equal(noise_mean(&mean, &images[1], &images[2], NULL), FILE_OK);
        assert_int_equal(noise_sums_add(&sums, images, NULL, NULL), FILE_OK);
        assert_int_equal(clip_metrics_add(noise, &images[1], &mean, NULL, NULL, NULL), FILE_OK);
        assert_int_equal(clip_metrics_add(true_scores, &images[0], &mean, NULL, NULL, NULL), FILE_OK);
        float_image_free(&mean);
    }
    clip_scores floors, scores;
    assert_int_equal(clip_metrics_noise(noise, &floors, NULL), FILE_OK);
    assert_int_equal(clip_metrics_scores(true_scores, &scores, NULL), FILE_OK);
    assert_true(fabs(floors.values[CLIP_RMSE] - noise_sums_floor(&sums)) < 1e-7);
    /* SSIM divides by variances, which the noise of a half raises twice as much. */
    static const clip_metric compared[] = {CLIP_RMSE, CLIP_FLIP, CLIP_FLICKER, CLIP_SSIM};
    static const double within[] = {0.03, 0.03, 0.03, 0.3};
    for (int i = 0; i < 4; i++) {
        const double right = fabs(scores.values[compared[i]] - clip_metric_best(compared[i]));
        assert_true(right > 0 && fabs(floors.values[compared[i]] / right - 1) < within[i]);
    }
    const double energy = 0.03 / sqrt(2) / 0.5 / sqrt(4.0 * PIXELS);
    assert_true(fabs(floors.values[CLIP_ENERGY] / energy - 1) < 0.02 && fabs(scores.values[CLIP_ENERGY] - 1) < 4 * energy);
    assert_true(isnan(floors.values[CLIP_YEE]));
    clip_metrics_free(noise);
    clip_metrics_free(true_scores);
}

static void test_sizes_must_agree(void **state)
{
    (void)state;
    static float pixels[64];
    for (int i = 0; i < 3; i++)
        for (int which = 0; which < 3; which++) {
            float_image images[3] = {{4, 4, 3, pixels}, {4, 4, 3, pixels}, {4, 4, 3, pixels}};
            *(uint32_t *[]){&images[i].width, &images[i].height, &images[i].channels}[which] = 1;
            noise_sums sums = {0};
            file_error error;
            assert_int_equal(noise_sums_add(&sums, images, NULL, &error), FILE_ARGUMENT);
            assert_int_equal(sums.values, 0);
            assert_non_null(strstr(error.text, "4x4"));
            float_image mean;
            if (i > 0)
                assert_int_equal(noise_mean(&mean, &images[0], &images[i], &error), FILE_ARGUMENT);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bands),
        cmocka_unit_test(test_texture_of_sines),
        cmocka_unit_test(test_texture_is_free_of_noise),
        cmocka_unit_test(test_texture_tells_its_noise),
        cmocka_unit_test(test_texture_adds_frames),
        cmocka_unit_test(test_texture_without_meaning),
        cmocka_unit_test(test_texture_of_a_part),
        cmocka_unit_test(test_planted_specks),
        cmocka_unit_test(test_noise_is_no_speck),
        cmocka_unit_test(test_noise_sums),
        cmocka_unit_test(test_floors_of_clips),
        cmocka_unit_test(test_sizes_must_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
