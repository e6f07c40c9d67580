/* SPDX-License-Identifier: MIT */
/* Metrics over clips: SSIM, flicker, glints, Yee's test, and the stream that joins them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/error_colors.h"
#include "image/metrics_clip.h"
#include "image/metrics_color.h"
#include "image/metrics_filter.h"
#include "image/metrics_flicker.h"
#include "image/metrics_flip.h"
#include "image/metrics_ssim.h"
#include "image/metrics_yee.h"

enum { W = 32, H = 24, PIXELS = W * H, FRAMES = 12 };

static double uniform(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

static void fill_noise(float *pixels, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++)
        pixels[i] = (float)uniform(&seed);
}

/* ---- SSIM ---- */

static void test_ssim_by_definition(void **state)
{
    (void)state;
    static float a[PIXELS], b[PIXELS], map[PIXELS], buffers[SSIM_BUFFERS * PIXELS];
    double weights[11], weight_sum = 0, mean = 0;
    fill_noise(a, PIXELS, 1);
    fill_noise(b, PIXELS, 2);
    for (int i = 0; i < PIXELS; i++)
        b[i] = 0.7f * a[i] + 0.2f * b[i];
    for (int d = 0; d < 11; d++)
        weight_sum += weights[d] = exp(-(d - 5) * (d - 5) / 4.5);
    const double score = ssim_mean(a, b, W, H, map, buffers);
    for (int y = 5; y < H - 5; y++)
        for (int x = 5; x < W - 5; x++) {
            double ma = 0, mb = 0, va = 0, vb = 0, covariance = 0;
            for (int i = 0; i < 121; i++) {
                const double weight = weights[i % 11] * weights[i / 11] / (weight_sum * weight_sum);
                ma += weight * a[(y + i / 11 - 5) * W + x + i % 11 - 5];
                mb += weight * b[(y + i / 11 - 5) * W + x + i % 11 - 5];
            }
            for (int i = 0; i < 121; i++) {
                const double weight = weights[i % 11] * weights[i / 11] / (weight_sum * weight_sum);
                const double da = a[(y + i / 11 - 5) * W + x + i % 11 - 5] - ma, db = b[(y + i / 11 - 5) * W + x + i % 11 - 5] - mb;
                va += weight * da * da;
                vb += weight * db * db;
                covariance += weight * da * db;
            }
            const double expected = (2 * ma * mb + 1e-4) * (2 * covariance + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
            assert_true(fabs(map[y * W + x] - expected) < 1e-5);
            mean += expected / ((W - 10) * (H - 10));
        }
    assert_true(fabs(score - mean) < 1e-6);
}

static void test_ssim_closed_forms(void **state)
{
    (void)state;
    static float a[PIXELS], b[PIXELS], buffers[SSIM_BUFFERS * PIXELS];
    fill_noise(a, PIXELS, 3);
    assert_true(ssim_mean(a, a, W, H, NULL, buffers) == 1.0);
    for (int i = 0; i < PIXELS; i++)
        b[i] = 1.0f - a[i];
    assert_true(ssim_mean(a, b, W, H, NULL, buffers) < -0.8);
    assert_true(ssim_mean(a, b, W, H, NULL, buffers) == ssim_mean(b, a, W, H, NULL, buffers));
    for (int step = 0; step <= 4; step++) {
        const double p = 0.25 * step, q = 0.4;
        for (int i = 0; i < PIXELS; i++) {
            a[i] = (float)p;
            b[i] = (float)q;
        }
        assert_true(fabs(ssim_mean(a, b, W, H, NULL, buffers) - (2 * p * q + 1e-4) / (p * p + q * q + 1e-4)) < 1e-4);
        assert_true(fabs(ssim_mean(a, b, 3, 2, NULL, buffers) - (2 * p * q + 1e-4) / (p * p + q * q + 1e-4)) < 1e-4);
    }
}

/* ---- glints ---- */

static uint32_t glints_in(const char *picture, uint32_t width, uint64_t sizes[32])
{
    float luminance[256];
    uint32_t labels[512];
    const uint32_t count = (uint32_t)strlen(picture);
    for (uint32_t i = 0; i < count; i++)
        luminance[i] = picture[i] == '#' ? 0.6f : 0.5f;
    memset(sizes, 0, 32 * sizeof *sizes);
    return flicker_count_glints(luminance, width, count / width, 0.5f, labels, sizes);
}

static void test_glints_by_hand(void **state)
{
    (void)state;
    uint64_t sizes[32];
    assert_int_equal(glints_in("............", 4, sizes), 0);
    assert_int_equal(glints_in("############", 4, sizes), 1);
    assert_int_equal(sizes[3], 1);
    assert_int_equal(glints_in("#..#....#..#", 4, sizes), 4);
    assert_int_equal(sizes[0], 4);
    assert_int_equal(glints_in("#....#....#....#", 4, sizes), 1);
    assert_int_equal(sizes[2], 1);
    /* Three tips that meet only at the bottom; a ring and what it holds. */
    assert_int_equal(glints_in("#.#.#"
                               "#.#.#"
                               "#####",
                               5, sizes),
                     1);
    assert_int_equal(sizes[3], 1);
    assert_int_equal(glints_in("#####"
                               "#...#"
                               "#.#.#"
                               "#...#"
                               "#####",
                               5, sizes),
                     2);
    assert_int_equal(sizes[0] + sizes[4], 2);
    /* No join around the end of a row. */
    assert_int_equal(glints_in("...."
                               "...#"
                               "...."
                               "#...",
                               4, sizes),
                     2);
}

static void flood(const float *luminance, bool *done, int x, int y, uint32_t *size)
{
    if (x < 0 || y < 0 || x >= W || y >= H || done[y * W + x] || !(luminance[y * W + x] > 0.6f))
        return;
    done[y * W + x] = true;
    ++*size;
    for (int n = 0; n < 9; n++)
        flood(luminance, done, x + n % 3 - 1, y + n / 3 - 1, size);
}

static void test_glints_against_flooding(void **state)
{
    (void)state;
    static float luminance[PIXELS];
    static uint32_t labels[2 * PIXELS];
    for (uint32_t seed = 0; seed < 50; seed++) {
        bool done[PIXELS] = {false};
        uint64_t sizes[32] = {0}, expected[32] = {0};
        uint32_t glints = 0;
        fill_noise(luminance, PIXELS, seed);
        for (int i = 0; i < PIXELS; i++) {
            uint32_t size = 0;
            flood(luminance, done, i % W, i / W, &size);
            glints += size > 0;
            if (size > 0)
                expected[(int)floor(log2(size))]++;
        }
        assert_int_equal(flicker_count_glints(luminance, W, H, 0.6f, labels, sizes), glints);
        assert_memory_equal(sizes, expected, sizeof sizes);
    }
}

/* ---- flicker ---- */

typedef struct clip {
    float frames[FRAMES][PIXELS];
} clip;

/* Glints that flash on a swell. */
static void fill_clip(clip *c, uint32_t seed)
{
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < PIXELS; i++) {
            const double swell = 0.3 + 0.1 * sin(0.3 * (i % W) + 0.2 * f);
            c->frames[f][i] = (float)(swell + (uniform(&seed) > 0.9 ? 0.6 : 0.0));
        }
}

static void blur(const clip *from, clip *to, double sigma)
{
    static float scratch[PIXELS];
    const filter_kernel kernel = filter_gaussian(sigma, (int)ceil(3 * sigma));
    for (int f = 0; f < FRAMES; f++) {
        filter_rows(scratch, from->frames[f], W, H, &kernel);
        filter_columns(to->frames[f], scratch, W, H, &kernel, 0);
    }
}

static clip_scores score(const clip *a, const clip *b, uint32_t metrics)
{
    const clip_metrics_desc desc = {.width = W, .height = H, .channels = 1, .metrics = metrics};
    clip_metrics *m = NULL;
    clip_scores scores;
    assert_int_equal(clip_metrics_create(&m, &desc, NULL), FILE_OK);
    for (int f = 0; f < FRAMES; f++) {
        float_image image_a = {W, H, 1, (float *)a->frames[f]}, image_b = {W, H, 1, (float *)b->frames[f]};
        assert_int_equal(clip_metrics_add(m, &image_a, &image_b, NULL, NULL, NULL), FILE_OK);
    }
    assert_int_equal(clip_metrics_scores(m, &scores, NULL), FILE_OK);
    clip_metrics_free(m);
    return scores;
}

/* RMS of the frame differences of one clip, and its mean power. */
static double power_of(const clip *c)
{
    double sum = 0;
    for (int f = 1; f < FRAMES; f++)
        for (int i = 0; i < PIXELS; i++)
            sum += pow((double)c->frames[f][i] - c->frames[f - 1][i], 2);
    return sum / (FRAMES - 1) / PIXELS;
}

static void test_flicker_of_identical_clips(void **state)
{
    (void)state;
    static clip a;
    fill_clip(&a, 1);
    const clip_scores scores = score(&a, &a, CLIP_ALL_FLICKER);
    for (int m = CLIP_FLICKER; m < CLIP_METRICS; m++)
        assert_true(scores.values[m] == (m == CLIP_FLICKER_RATIO ? 1.0 : 0.0));
    assert_true(isnan(scores.values[CLIP_RMSE]));
}

/* Blur in space, blur in time and a still picture: every one is charged, the calmer the more. */
static void test_blur_is_not_rewarded(void **state)
{
    (void)state;
    static clip reference, calm;
    fill_clip(&reference, 2);
    const double power = power_of(&reference);
    clip_scores before = {{0}};
    before.values[CLIP_FLICKER_RATIO] = 1;
    for (int step = 1; step <= 3; step++) {
        blur(&reference, &calm, 0.5 * step);
        const clip_scores now = score(&calm, &reference, CLIP_ALL_FLICKER);
        assert_true(now.values[CLIP_FLICKER] > before.values[CLIP_FLICKER]);
        assert_true(now.values[CLIP_FLICKER_POWER] > before.values[CLIP_FLICKER_POWER]);
        assert_true(now.values[CLIP_FLICKER_RATIO] < before.values[CLIP_FLICKER_RATIO]);
        assert_true(now.values[CLIP_FLICKER_BRIGHT] > before.values[CLIP_FLICKER_BRIGHT]);
        assert_true(now.values[CLIP_FLICKER_SIZES] > before.values[CLIP_FLICKER_SIZES]);
        before = now;
    }
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < PIXELS; i++)
            calm.frames[f][i] = reference.frames[0][i];
    const clip_scores still = score(&calm, &reference, CLIP_ALL_FLICKER);
    assert_true(fabs(still.values[CLIP_FLICKER] - sqrt(power)) < 1e-9);
    assert_true(fabs(still.values[CLIP_FLICKER_POWER] - power) < 1e-9);
    assert_true(still.values[CLIP_FLICKER_RATIO] == 0);
    assert_true(still.values[CLIP_FLICKER_GLINTS] > 0);
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < PIXELS; i++)
            calm.frames[f][i] = 0.3f;
    const clip_scores dark = score(&calm, &reference, CLIP_ALL_FLICKER);
    for (int m = CLIP_FLICKER_BRIGHT; m <= CLIP_FLICKER_SIZES; m++)
        assert_true(dark.values[m] == 1);
}

/* Glints elsewhere but as many: the power and the counts agree, the steps do not. A clip that is only brighter flickers alike. */
static void test_what_each_flicker_score_sees(void **state)
{
    (void)state;
    static clip reference, other;
    fill_clip(&reference, 3);
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < PIXELS; i++)
            other.frames[f][i] = 1 - reference.frames[f][i];
    clip_scores scores = score(&other, &reference, CLIP_ALL_FLICKER);
    assert_true(scores.values[CLIP_FLICKER_POWER] < 1e-7);
    assert_true(fabs(scores.values[CLIP_FLICKER_RATIO] - 1) < 1e-6);
    assert_true(fabs(scores.values[CLIP_FLICKER] - 2 * sqrt(power_of(&reference))) < 1e-6);
    for (int f = 0; f < FRAMES; f++)
        memcpy(other.frames[f], reference.frames[FRAMES - 1 - f], sizeof other.frames[f]);
    scores = score(&other, &reference, CLIP_ALL_FLICKER);
    assert_true(scores.values[CLIP_FLICKER_POWER] < 1e-12);
    assert_true(scores.values[CLIP_FLICKER_BRIGHT] == 0 && scores.values[CLIP_FLICKER_GLINTS] == 0 && scores.values[CLIP_FLICKER_SIZES] == 0);
    assert_true(scores.values[CLIP_FLICKER] > 0.1);
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < PIXELS; i++)
            other.frames[f][i] = reference.frames[f][i] + 0.25f;
    scores = score(&other, &reference, CLIP_ALL_FLICKER | 1u << CLIP_RMSE);
    assert_true(scores.values[CLIP_FLICKER] < 1e-6);
    assert_true(fabs(scores.values[CLIP_RMSE] - 0.25) < 1e-6);
    /* More restless than the reference. */
    uint32_t seed = 9;
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < PIXELS; i++)
            other.frames[f][i] = reference.frames[f][i] + (float)(uniform(&seed) - 0.5);
    scores = score(&other, &reference, CLIP_ALL_FLICKER);
    assert_true(scores.values[CLIP_FLICKER_RATIO] > 1.2);
    assert_true(fabs(scores.values[CLIP_FLICKER] - sqrt(2.0 / 12)) < 0.01);
}

static void test_flicker_by_hand(void **state)
{
    (void)state;
    float a[3][6] = {{0, 0, 0, 0, 0, 0}, {1, 1, 1, 0, 0, 0}, {0, 0, 0, 3, 0, 0}}, b[3][6] = {{0}, {0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 1, 1}};
    const clip_metrics_desc desc = {.width = 2, .height = 1, .channels = 3, .metrics = CLIP_ALL_FLICKER};
    clip_metrics *m = NULL;
    clip_frame frame;
    clip_scores scores;
    float map[2];
    const clip_maps maps = {.maps[CLIP_FLICKER] = map};
    assert_int_equal(clip_metrics_create(&m, &desc, NULL), FILE_OK);
    for (int f = 0; f < 3; f++) {
        const float_image image_a = {2, 1, 3, a[f]}, image_b = {2, 1, 3, b[f]};
        assert_int_equal(clip_metrics_add(m, &image_a, &image_b, &maps, &frame, NULL), FILE_OK);
        if (f == 0) {
            assert_true(map[0] == 0 && map[1] == 0 && isnan(frame.scores.values[CLIP_FLICKER]));
            assert_string_equal(clip_metrics_missing(m, CLIP_FLICKER), "flicker needs two frames");
            assert_non_null(clip_metrics_missing(m, CLIP_FLICKER_GLINTS));
            assert_null(clip_metrics_missing(m, CLIP_SSIM));
        }
        if (f == 1) {
            assert_true(map[0] == 1 && map[1] == 1 && frame.scores.values[CLIP_FLICKER] == 1 && frame.scores.values[CLIP_FLICKER_RATIO] == 1);
            assert_int_equal(frame.glints[0] + frame.glints[1] + frame.bright[0] + frame.bright[1], 4);
        }
    }
    assert_true(map[0] == 1 && fabsf(map[1] - sqrtf(3)) < 1e-6f);
    assert_int_equal(clip_metrics_scores(m, &scores, NULL), FILE_OK);
    assert_true(fabs(scores.values[CLIP_FLICKER] - sqrt(6.0 / 4)) < 1e-12);
    /* Pixel 0: A (1 + 1) / 2, B 0. Pixel 1: A 3 / 2, B 1 / 2. */
    assert_true(fabs(scores.values[CLIP_FLICKER_POWER] - 1) < 1e-12);
    assert_true(fabs(scores.values[CLIP_FLICKER_RATIO] - 5) < 1e-12);
    /* A has one bright pixel in frames 1 and 2 (a red of 3 has luminance 0.64), B likewise. */
    for (int i = CLIP_FLICKER_BRIGHT; i <= CLIP_FLICKER_SIZES; i++)
        assert_true(scores.values[i] == 0);
    clip_metrics_free(m);
}

/* The reference's first frame sets it, whatever the method shows; later frames and outliers do not. */
static void test_glint_threshold(void **state)
{
    (void)state;
    enum { SIDE = 64 };
    static float a[SIDE * SIDE], b[SIDE * SIDE];
    const float_image image_a = {SIDE, SIDE, 1, a}, image_b = {SIDE, SIDE, 1, b};
    const clip_metrics_desc desc = {.width = SIDE, .height = SIDE, .channels = 1, .metrics = 1u << CLIP_FLICKER_GLINTS};
    for (int fixed = 0; fixed < 2; fixed++) {
        clip_metrics_desc with = desc;
        clip_metrics *m = NULL;
        clip_frame frame;
        with.glint_threshold = fixed ? 0.001 : 0;
        assert_int_equal(clip_metrics_create(&m, &with, NULL), FILE_OK);
        assert_true(clip_metrics_glint_threshold(m) == (fixed ? 0.001 : 0.0));
        for (int f = 0; f < 3; f++) {
            for (int i = 0; i < SIDE * SIDE; i++) {
                a[i] = 0.003f;
                b[i] = i % 8 == 0 && i / SIDE % 8 == 0 ? 0.004f * (float)(f + 1) : 0.0005f;
            }
            b[77] = b[99] = b[121] = 100.0f;
            assert_int_equal(clip_metrics_add(m, &image_a, &image_b, NULL, &frame, NULL), FILE_OK);
            assert_true(fabs(clip_metrics_glint_threshold(m) - (fixed ? 0.001 : 0.002)) < 1e-8);
            assert_int_equal(frame.glints[0], 1);
            assert_int_equal(frame.bright[1], 64 + 3);
        }
        clip_metrics_free(m);
    }
}

/* ---- the stream ---- */

/* What the clip's scores are made of, each from its own function. */
static void test_clip_gathers_its_frames(void **state)
{
    (void)state;
    static float a[4][3 * PIXELS], b[4][3 * PIXELS], light_a[3 * PIXELS], light_b[3 * PIXELS], grey_a[PIXELS], grey_b[PIXELS];
    static float maps_of[CLIP_METRICS][PIXELS], map[PIXELS], buffers[SSIM_BUFFERS * PIXELS];
    const uint32_t set = CLIP_ALL_METRICS & ~(1u << CLIP_YEE);
    const clip_metrics_desc desc = {.width = W, .height = H, .channels = 3, .metrics = set, .srgb_encoded = true, .pixels_per_degree = 40};
    clip_metrics *m = NULL;
    clip_maps maps;
    double flip_sum = 0, hdr_sum = 0, ssim_sum = 0;
    flip *f = NULL;
    image_metrics sums = {0};
    assert_int_equal(clip_metrics_create(&m, &desc, NULL), FILE_OK);
    assert_int_equal(flip_create(&f, W, H, 40, NULL), FILE_OK);
    for (int i = 0; i < CLIP_METRICS; i++)
        maps.maps[i] = maps_of[i];
    for (int n = 0; n < 4; n++) {
        fill_noise(a[n], 3 * PIXELS, 20 + (uint32_t)n);
        fill_noise(b[n], 3 * PIXELS, 30 + (uint32_t)n);
        const float_image image_a = {W, H, 3, a[n]}, image_b = {W, H, 3, b[n]};
        clip_frame frame;
        assert_int_equal(clip_metrics_add(m, &image_a, &image_b, &maps, &frame, NULL), FILE_OK);
        image_metrics_add(&sums, &image_a, &image_b, NULL);
        for (int i = 0; i < 3 * PIXELS; i++) {
            light_a[i] = color_srgb_decode(a[n][i]);
            light_b[i] = color_srgb_decode(b[n][i]);
        }
        for (int i = 0; i < PIXELS; i++) {
            grey_a[i] = color_srgb_encode(color_luminance(light_a + 3 * i, 3));
            grey_b[i] = color_srgb_encode(color_luminance(light_b + 3 * i, 3));
        }
        const flip_picture picture_a = {light_a, 3}, picture_b = {light_b, 3};
        const flip_exposures range = flip_exposures_of(f, picture_b);
        const double now = flip_ldr(f, picture_a, picture_b, map);
        assert_memory_equal(map, maps_of[CLIP_FLIP], sizeof map);
        assert_true(frame.scores.values[CLIP_FLIP] == now);
        flip_sum += now;
        hdr_sum += flip_hdr(f, picture_a, picture_b, &range, map);
        assert_memory_equal(map, maps_of[CLIP_HDR_FLIP], sizeof map);
        ssim_sum += ssim_mean(grey_a, grey_b, W, H, map, buffers);
        for (int i = 0; i < PIXELS; i++) {
            assert_true(fabsf(maps_of[CLIP_SSIM][i] - (1 - map[i])) < 1e-6f);
            double square = 0;
            for (int c = 0; c < 3; c++)
                square += pow((double)a[n][3 * i + c] - b[n][3 * i + c], 2) / 3;
            assert_true(fabs(maps_of[CLIP_RMSE][i] - sqrt(square)) < 1e-6);
        }
        assert_true(isnan(frame.scores.values[CLIP_YEE]));
    }
    clip_scores scores;
    assert_int_equal(clip_metrics_scores(m, &scores, NULL), FILE_OK);
    assert_true(scores.values[CLIP_RMSE] == image_metrics_rmse(&sums));
    assert_true(scores.values[CLIP_RELATIVE_RMSE] == image_metrics_relative_rmse(&sums));
    assert_true(scores.values[CLIP_ENERGY] == image_metrics_mean_ratio(&sums));
    assert_true(fabs(scores.values[CLIP_FLIP] - flip_sum / 4) < 1e-12);
    assert_true(fabs(scores.values[CLIP_HDR_FLIP] - hdr_sum / 4) < 1e-12);
    assert_true(fabs(scores.values[CLIP_SSIM] - ssim_sum / 4) < 1e-12);
    assert_int_equal(clip_metrics_sums(m)->frames, 4);
    flip_free(f);
    clip_metrics_free(m);
}

static void test_fixed_exposures(void **state)
{
    (void)state;
    static float a[PIXELS], b[PIXELS], shown_a[PIXELS], shown_b[PIXELS];
    const clip_metrics_desc hdr = {.width = W,
                                   .height = H,
                                   .channels = 1,
                                   .metrics = 1u << CLIP_HDR_FLIP,
                                   .fixed_exposures = true,
                                   .first_exposure = -2,
                                   .last_exposure = 4,
                                   .exposures = 1};
    const clip_metrics_desc ldr = {.width = W, .height = H, .channels = 1, .metrics = 1u << CLIP_FLIP};
    clip_metrics *m[2] = {NULL, NULL};
    clip_frame frames[2];
    fill_noise(a, PIXELS, 5);
    fill_noise(b, PIXELS, 6);
    for (int i = 0; i < PIXELS; i++) {
        shown_a[i] = (float)fmin(flip_tone((a[i] *= 8) / 4), 1);
        shown_b[i] = (float)fmin(flip_tone((b[i] *= 8) / 4), 1);
    }
    const float_image images[4] = {{W, H, 1, a}, {W, H, 1, b}, {W, H, 1, shown_a}, {W, H, 1, shown_b}};
    assert_int_equal(clip_metrics_create(&m[0], &hdr, NULL), FILE_OK);
    assert_int_equal(clip_metrics_create(&m[1], &ldr, NULL), FILE_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(clip_metrics_add(m[i], &images[2 * i], &images[2 * i + 1], NULL, &frames[i], NULL), FILE_OK);
        clip_metrics_free(m[i]);
    }
    assert_true(frames[1].scores.values[CLIP_FLIP] > 0.01);
    assert_true(fabs(frames[0].scores.values[CLIP_HDR_FLIP] - frames[1].scores.values[CLIP_FLIP]) < 1e-5);
}

static void test_values_that_are_not_finite(void **state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS];
    const uint32_t set = CLIP_ALL_METRICS & ~(1u << CLIP_YEE);
    const clip_metrics_desc desc = {.width = W, .height = H, .channels = 3, .metrics = set};
    clip_metrics *m = NULL;
    clip_scores scores;
    const clip_maps maps = {.maps[CLIP_RMSE] = map};
    const float_image image_a = {W, H, 3, a}, image_b = {W, H, 3, b};
    assert_int_equal(clip_metrics_create(&m, &desc, NULL), FILE_OK);
    for (int f = 0; f < 2; f++) {
        fill_noise(a, 3 * PIXELS, 40 + (uint32_t)f);
        fill_noise(b, 3 * PIXELS, 50 + (uint32_t)f);
        a[10] = NAN;
        a[20] = b[20] = INFINITY;
        b[30] = -INFINITY;
        assert_int_equal(clip_metrics_add(m, &image_a, &image_b, &maps, NULL, NULL), FILE_OK);
    }
    assert_int_equal(clip_metrics_scores(m, &scores, NULL), FILE_OK);
    for (int i = 0; i < CLIP_METRICS; i++)
        assert_true(isfinite(scores.values[i]) == (i <= CLIP_ENERGY));
    for (int i = CLIP_FLIP; i < CLIP_METRICS; i++)
        assert_true(i == CLIP_YEE || strcmp(clip_metrics_missing(m, (clip_metric)i), image_mismatch_text) == 0);
    for (int i = 0; i < PIXELS; i++)
        assert_true(isnan(map[i]) == (i == 10 / 3 || i == 30 / 3));
    assert_int_equal(clip_metrics_sums(m)->mismatches, 4);
    assert_int_equal(clip_metrics_sums(m)->equal_infinities, 2);
    clip_metrics_free(m);
}

static void test_words(void **state)
{
    (void)state;
    uint32_t set = 7;
    static const char *const wrong[] = {"", ",", "rmse,", "flicke", "flickers", "RMSE", "rmse flip", "all"};
    assert_true(clip_metrics_parse("rmse", &set) && set == 1u << CLIP_RMSE);
    assert_true(clip_metrics_parse("flip,hdr-flip", &set) && set == (1u << CLIP_FLIP | 1u << CLIP_HDR_FLIP));
    assert_true(clip_metrics_parse("flicker", &set) && set == CLIP_ALL_FLICKER);
    assert_true(clip_metrics_parse("flicker-power,yee", &set) && set == (1u << CLIP_FLICKER_POWER | 1u << CLIP_YEE));
    for (int i = 0; i < CLIP_METRICS; i++)
        assert_non_null(strstr(clip_metric_words, clip_metric_name((clip_metric)i)));
    for (int i = 0; i < 8; i++) {
        set = 7;
        assert_false(clip_metrics_parse(wrong[i], &set));
        assert_int_equal(set, 7);
    }
}

static void test_bad_arguments(void **state)
{
    (void)state;
    static float pixels[3 * PIXELS];
    const clip_metrics_desc good = {.width = W, .height = H, .channels = 3, .metrics = CLIP_ALL_METRICS};
    clip_metrics_desc wrong[12];
    clip_metrics *m = NULL;
    file_error error;
    for (int i = 0; i < 12; i++)
        wrong[i] = good;
    wrong[0].width = 0;
    wrong[1].height = 32769;
    wrong[2].channels = 2;
    wrong[3].metrics = 1u << CLIP_METRICS;
    wrong[4].pixels_per_degree = NAN;
    wrong[5].pixels_per_degree = 1000;
    wrong[6].glint_threshold = -1;
    wrong[7].glint_threshold = INFINITY;
    wrong[8].exposures = 65;
    wrong[9].fixed_exposures = wrong[10].fixed_exposures = wrong[11].fixed_exposures = true;
    wrong[9].first_exposure = 2;
    wrong[10].last_exposure = NAN;
    wrong[11].last_exposure = 1e9;
    for (int i = 0; i < 12; i++) {
        assert_int_equal(clip_metrics_create(&m, &wrong[i], &error), FILE_ARGUMENT);
        assert_null(m);
    }
    assert_int_equal(clip_metrics_create(&m, &good, &error), FILE_OK);
    const float_image image = {W, H, 3, pixels}, others[3] = {{H, W, 3, pixels}, {W, H - 1, 3, pixels}, {W, H, 1, pixels}};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(clip_metrics_add(m, &image, &others[i], NULL, NULL, &error), FILE_ARGUMENT);
        assert_int_equal(clip_metrics_add(m, &others[i], &image, NULL, NULL, &error), FILE_ARGUMENT);
    }
    assert_int_equal(clip_metrics_sums(m)->frames, 0);
    assert_string_equal(clip_metrics_missing(m, CLIP_FLIP), "no frame was measured");
    clip_metrics_free(m);
    clip_metrics_free(NULL);
}

/* ---- Yee's test ---- */

static void test_yee_reads_idiff(void **state)
{
    (void)state;
    uint64_t failures = 9;
    assert_true(yee_parse("Comparing \"a\" and \"b\"\n  8960 pixels (62.2%) over 1e-06\n"
                          "  4589 pixels (31.8681%) failed the perceptual test\nFAILURE\n",
                          &failures));
    assert_int_equal(failures, 4589);
    assert_true(yee_parse("Comparing \"a\" and \"b\"\n  0 pixels (  0%) failed the perceptual test\nFAILURE\n", &failures));
    assert_int_equal(failures, 0);
    assert_true(yee_parse("Comparing \"a\" and \"b\"\nPASS\n", &failures));
    assert_int_equal(failures, 0);
    assert_false(yee_parse("", &failures));
    assert_false(yee_parse("idiff ERROR: Could not read a:\n", &failures));
    assert_false(yee_parse(" failed the perceptual test", &failures));
}

static void test_yee_missing_loses_nothing_else(void **state)
{
    (void)state;
    static float pixels[2][PIXELS];
    static const char *const programs[] = {"/nonexistent/idiff", "/dev/null", "false", "true"};
    fill_noise(pixels[0], PIXELS, 1);
    for (int i = 0; i < 4; i++) {
        const clip_metrics_desc desc = {.width = W, .height = H, .channels = 1, .metrics = CLIP_ALL_METRICS, .idiff = programs[i]};
        const float_image a = {W, H, 1, pixels[0]}, b = {W, H, 1, pixels[1]};
        clip_metrics *m = NULL;
        clip_frame frame;
        clip_scores scores;
        assert_int_equal(clip_metrics_create(&m, &desc, NULL), FILE_OK);
        for (int f = 0; f < 2; f++)
            assert_int_equal(clip_metrics_add(m, f ? &a : &b, &b, NULL, &frame, NULL), FILE_OK);
        assert_int_equal(clip_metrics_scores(m, &scores, NULL), FILE_OK);
        for (int j = 0; j < CLIP_METRICS; j++)
            assert_true(isnan(scores.values[j]) == (j == CLIP_YEE) && !clip_metrics_missing(m, (clip_metric)j) == (j != CLIP_YEE));
        assert_non_null(strstr(clip_metrics_missing(m, CLIP_YEE), "idiff"));
        clip_metrics_free(m);
    }
}

static void test_yee_itself(void **state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS];
    double share = -1;
    file_error error;
    fill_noise(a, 3 * PIXELS, 1);
    if (yee_failures(&share, a, a, W, H, NULL, &error) == FILE_UNAVAILABLE) {
        print_message("%s\n", error.text);
        skip();
    }
    assert_true(share == 0);
    for (int i = 0; i < 3 * PIXELS; i++) {
        a[i] = 0.5f;
        b[i] = i / 3 % W < W / 2 ? 0.5f : i % 3 ? 0.3f : 0.8f;
    }
    assert_int_equal(yee_failures(&share, a, b, W, H, NULL, &error), FILE_OK);
    assert_true(share == 0.5);
    for (int i = 0; i < 3 * PIXELS; i++)
        b[i] = 0.5001f;
    assert_int_equal(yee_failures(&share, a, b, W, H, NULL, &error), FILE_OK);
    assert_true(share == 0);
}

/* ---- colours of error maps ---- */

static void test_error_colors(void **state)
{
    (void)state;
    uint8_t colors[ERROR_COLORS][3];
    double before = -1;
    error_colors(colors);
    assert_memory_equal(colors[0], "\0\0\0", 3);
    for (int i = 0; i < ERROR_COLORS; i++) {
        float light[3];
        for (int c = 0; c < 3; c++)
            light[c] = color_srgb_decode((float)colors[i][c] / 255);
        const double y = color_luminance(light, 3), lightness = y > 216.0 / 24389 ? 116 * cbrt(y) - 16 : 24389.0 / 27 * y;
        assert_true(fabs(lightness - 98 * i / 255.0) < 0.6); /* 8 bits */
        assert_true(lightness > before);
        before = lightness;
    }
    /* Violet, magenta, orange, pale yellow. */
    assert_true(colors[64][2] > colors[64][0] && colors[64][0] > colors[64][1]);
    assert_true(colors[128][0] > colors[128][2] && colors[128][2] > colors[128][1]);
    assert_true(colors[192][0] > colors[192][1] && colors[192][1] > colors[192][2]);
    assert_true(colors[255][0] > 240 && colors[255][1] > 240 && colors[255][2] > 160 && colors[255][2] < 220);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_error_colors),
        cmocka_unit_test(test_ssim_by_definition),
        cmocka_unit_test(test_ssim_closed_forms),
        cmocka_unit_test(test_glints_by_hand),
        cmocka_unit_test(test_glints_against_flooding),
        cmocka_unit_test(test_flicker_of_identical_clips),
        cmocka_unit_test(test_blur_is_not_rewarded),
        cmocka_unit_test(test_what_each_flicker_score_sees),
        cmocka_unit_test(test_flicker_by_hand),
        cmocka_unit_test(test_glint_threshold),
        cmocka_unit_test(test_clip_gathers_its_frames),
        cmocka_unit_test(test_fixed_exposures),
        cmocka_unit_test(test_values_that_are_not_finite),
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_bad_arguments),
        cmocka_unit_test(test_yee_reads_idiff),
        cmocka_unit_test(test_yee_missing_loses_nothing_else),
        cmocka_unit_test(test_yee_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
