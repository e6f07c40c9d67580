/* SPDX-License-Identifier: MIT */
/* FLIP against the papers' equations in double without separable filters, and against the properties they state. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/metrics_color.h"
#include "image/metrics_filter.h"
#include "image/metrics_flip.h"

#define PI 3.14159265358979323846

enum { W = 40, H = 28, PIXELS = W * H };

static double uniform(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

static flip_picture grey(const float *pixels) { return (flip_picture){pixels, 1}; }

static flip_picture colour(const float *pixels) { return (flip_picture){pixels, 3}; }

static flip *make_flip(double pixels_per_degree)
{
    flip *f = NULL;
    assert_int_equal(flip_create(&f, W, H, pixels_per_degree, NULL), FILE_OK);
    return f;
}

/* Glitter: dark water with streaks of light. */
static void fill_glitter(float *pixels, uint32_t seed)
{
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const float light = (float)pow(uniform(&seed), 6), base = 0.1f + 0.004f * (float)y;
            pixels[3 * (y * W + x)] = base + light;
            pixels[3 * (y * W + x) + 1] = base * 1.2f + 0.8f * light;
            pixels[3 * (y * W + x) + 2] = base * 1.6f + 0.4f * light;
        }
}

/* ---- the filters ---- */

static void test_filters_against_sums(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1}, {5, 300}, {300, 5}, {257, 3}, {37, 23}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        const uint32_t width = sizes[s][0], height = sizes[s][1], count = width * height;
        uint32_t seed = 7;
        float *in = malloc(count * sizeof *in), *rows = malloc(count * sizeof *rows), *columns = malloc(count * sizeof *columns);
        filter_kernel kernel = {.radius = 9};
        for (int tap = 0; tap <= 2 * kernel.radius; tap++)
            kernel.weights[tap] = (float)(uniform(&seed) - 0.5);
        for (uint32_t i = 0; i < count; i++)
            in[i] = (float)uniform(&seed);
        filter_rows(rows, in, width, height, &kernel);
        filter_columns(columns, in, width, height, &kernel, 0);
        filter_columns(columns, in, width, height, &kernel, 1);
        for (int y = 0; y < (int)height; y++)
            for (int x = 0; x < (int)width; x++) {
                double along = 0, down = 0;
                for (int d = -kernel.radius; d <= kernel.radius; d++) {
                    const int near_x = x + d < 0 ? 0 : x + d >= (int)width ? (int)width - 1 : x + d;
                    const int near_y = y + d < 0 ? 0 : y + d >= (int)height ? (int)height - 1 : y + d;
                    along += (double)kernel.weights[kernel.radius + d] * in[(uint32_t)y * width + (uint32_t)near_x];
                    down += (double)kernel.weights[kernel.radius + d] * in[(uint32_t)near_y * width + (uint32_t)x];
                }
                assert_true(fabs(rows[(uint32_t)y * width + (uint32_t)x] - along) < 2e-6);
                assert_true(fabs(columns[(uint32_t)y * width + (uint32_t)x] - 2 * down) < 4e-6);
            }
        free(in);
        free(rows);
        free(columns);
    }
    const filter_kernel gaussian = filter_gaussian(2.5, 8);
    double sum = 0;
    for (int tap = 0; tap <= 16; tap++)
        sum += gaussian.weights[tap];
    assert_true(fabs(sum - 1) < 1e-6);
    assert_true(fabs(gaussian.weights[8 + 5] / gaussian.weights[8] - exp(-2)) < 1e-6);
}

/* ---- the metric once more, in double, with filters of two dimensions ---- */

typedef struct seen {
    double lab[PIXELS][3], edge[PIXELS], point[PIXELS];
} seen;

static const double to_xyz[3][3] = {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
static const double from_xyz[3][3] = {{3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
static const double white[3] = {0.9504700, 1.0000001, 1.0888300};

static double front_pixel(const double *plane, int x, int y)
{
    x = x < 0 ? 0 : x >= W ? W - 1 : x;
    y = y < 0 ? 0 : y >= H ? H - 1 : y;
    return plane[y * W + x];
}

typedef double kernel_function(double dx, double dy, const double *constants);

static double sensitivity(double dx, double dy, const double *c)
{
    const double d2 = (dx * dx + dy * dy) / (c[4] * c[4]);
    return c[0] * sqrt(PI / c[1]) * exp(-PI * PI * d2 / c[1]) + c[2] * sqrt(PI / c[3]) * exp(-PI * PI * d2 / c[3]);
}

static double edge_along_x(double dx, double dy, const double *c) { return -dx * exp(-(dx * dx + dy * dy) / (2 * c[0] * c[0])); }

static double edge_along_y(double dx, double dy, const double *c) { return edge_along_x(dy, dx, c); }

static double point_along_x(double dx, double dy, const double *c) { return (dx * dx / (c[0] * c[0]) - 1) * exp(-(dx * dx + dy * dy) / (2 * c[0] * c[0])); }

static double point_along_y(double dx, double dy, const double *c) { return point_along_x(dy, dx, c); }

/* Positive weights sum to 1, negative ones to −1. */
static double filtered(const double *plane, int x, int y, int radius, kernel_function *kernel, const double *constants)
{
    double above = 0, below = 0, sum_above = 0, sum_below = 0;
    for (int dy = -radius; dy <= radius; dy++)
        for (int dx = -radius; dx <= radius; dx++) {
            const double weight = kernel(dx, dy, constants), value = front_pixel(plane, x + dx, y + dy);
            above += fmax(weight, 0);
            below += fmax(-weight, 0);
            sum_above += fmax(weight, 0) * value;
            sum_below += fmin(weight, 0) * value;
        }
    return sum_above / above + (below > 0 ? sum_below / below : 0);
}

static double lab_function(double t) { return t > 216.0 / 24389.0 ? cbrt(t) : 841.0 / 108.0 * t + 4.0 / 29.0; }

static void light_to_hunt_lab(const double light[3], double lab[3])
{
    double f[3];
    for (int r = 0; r < 3; r++)
        f[r] = lab_function((to_xyz[r][0] * light[0] + to_xyz[r][1] * light[1] + to_xyz[r][2] * light[2]) / white[r]);
    lab[0] = 116 * f[1] - 16;
    lab[1] = 0.01 * lab[0] * 500 * (f[0] - f[1]);
    lab[2] = 0.01 * lab[0] * 200 * (f[1] - f[2]);
}

static void look(const float *pixels, double pixels_per_degree, seen *s)
{
    static double planes[3][PIXELS], features[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        double relative[3] = {0};
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++)
                relative[r] += to_xyz[r][c] * fmin(fmax(pixels[3 * i + c], 0), 1);
            relative[r] /= white[r];
        }
        planes[0][i] = 116 * relative[1] - 16;
        planes[1][i] = 500 * (relative[0] - relative[1]);
        planes[2][i] = 200 * (relative[1] - relative[2]);
        features[i] = (planes[0][i] + 16) / 116;
    }
    const double constants[3][5] = {{1, 0.0047, 0, 1e-5, pixels_per_degree},
                                    {1, 0.0053, 0, 1e-5, pixels_per_degree},
                                    {34.1, 0.04, 13.5, 0.025, pixels_per_degree}};
    const int radius = (int)ceil(3 * sqrt(0.04 / (2 * PI * PI)) * pixels_per_degree);
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int feature_radius = (int)ceil(3 * sigma);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double blurred[3], light[3];
            for (int c = 0; c < 3; c++)
                blurred[c] = filtered(planes[c], x, y, radius, sensitivity, constants[c]);
            const double relative_y = (blurred[0] + 16) / 116;
            const double xyz[3] = {white[0] * (blurred[1] / 500 + relative_y), white[1] * relative_y, white[2] * (relative_y - blurred[2] / 200)};
            for (int r = 0; r < 3; r++)
                light[r] = fmin(fmax(from_xyz[r][0] * xyz[0] + from_xyz[r][1] * xyz[1] + from_xyz[r][2] * xyz[2], 0), 1);
            light_to_hunt_lab(light, s->lab[y * W + x]);
            s->edge[y * W + x] =
                hypot(filtered(features, x, y, feature_radius, edge_along_x, &sigma), filtered(features, x, y, feature_radius, edge_along_y, &sigma));
            s->point[y * W + x] =
                hypot(filtered(features, x, y, feature_radius, point_along_x, &sigma), filtered(features, x, y, feature_radius, point_along_y, &sigma));
        }
}

static double hyab(const double a[3], const double b[3]) { return fabs(a[0] - b[0]) + hypot(a[1] - b[1], a[2] - b[2]); }

static double expected_flip(const seen *a, const seen *b, int i)
{
    const double green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    double green_lab[3], blue_lab[3];
    light_to_hunt_lab(green, green_lab);
    light_to_hunt_lab(blue, blue_lab);
    const double greatest = pow(hyab(green_lab, blue_lab), 0.7), knee = 0.4 * greatest, difference = pow(hyab(a->lab[i], b->lab[i]), 0.7);
    const double color = difference < knee ? 0.95 / knee * difference : 0.95 + (difference - knee) / (greatest - knee) * 0.05;
    const double feature = sqrt(fmax(fabs(a->edge[i] - b->edge[i]), fabs(a->point[i] - b->point[i])) / sqrt(2));
    return pow(color, 1 - feature);
}

static void test_against_equations(void **state)
{
    (void)state;
    static const double distances[] = {10, 25, 67, 150};
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS];
    seen *seen_a = malloc(sizeof *seen_a), *seen_b = malloc(sizeof *seen_b);
    fill_glitter(a, 1);
    fill_glitter(b, 2);
    memcpy(b, a, sizeof b / 2);
    b[3 * 200] = 3.0f;
    b[3 * 210 + 1] = -1.0f;
    for (int d = 0; d < 4; d++) {
        flip *f = make_flip(distances[d]);
        double sum = 0;
        look(a, distances[d], seen_a);
        look(b, distances[d], seen_b);
        const double mean = flip_ldr(f, colour(a), colour(b), map);
        for (int i = 0; i < PIXELS; i++) {
            /* Square roots and powers near 0 magnify the rounding of what is nearly the same. */
            assert_true(fabs(map[i] - expected_flip(seen_a, seen_b, i)) < 2e-3);
            sum += expected_flip(seen_a, seen_b, i);
        }
        assert_true(sum / PIXELS > 0.05);
        assert_true(fabs(mean - sum / PIXELS) < 2e-4);
        flip_free(f);
    }
    free(seen_a);
    free(seen_b);
}

/* ---- properties ---- */

static void test_identity_symmetry_range(void **state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS], other[PIXELS];
    flip *f = make_flip(FLIP_PIXELS_PER_DEGREE);
    for (uint32_t seed = 0; seed < 8; seed++) {
        fill_glitter(a, seed);
        fill_glitter(b, seed + 100);
        assert_true(flip_ldr(f, colour(a), colour(a), map) == 0.0);
        const flip_exposures range = flip_exposures_of(f, colour(a));
        assert_true(flip_hdr(f, colour(a), colour(a), &range, NULL) == 0.0);
        assert_true(flip_ldr(f, colour(a), colour(b), map) == flip_ldr(f, colour(b), colour(a), other));
        assert_memory_equal(map, other, sizeof map);
        for (int i = 0; i < PIXELS; i++)
            assert_true(map[i] >= 0 && map[i] <= 1);
    }
    flip_free(f);
}

/* Without features the metric is the colour difference alone, its greatest that of green and blue. */
static void test_constant_pictures(void **state)
{
    (void)state;
    static const float colours[][3] = {{0, 0, 0}, {1, 1, 1}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0.5f, 0.5f, 0.5f}, {0.2f, 0.25f, 0.3f}};
    static float a[3 * PIXELS], b[3 * PIXELS];
    flip *f = make_flip(FLIP_PIXELS_PER_DEGREE);
    for (int p = 0; p < 7; p++)
        for (int q = 0; q < 7; q++) {
            for (int i = 0; i < 3 * PIXELS; i++) {
                a[i] = colours[p][i % 3];
                b[i] = colours[q][i % 3];
            }
            const double expected = flip_color_difference(colours[p], colours[q]);
            assert_true(expected == flip_color_difference(colours[q], colours[p]));
            assert_true(fabs(flip_ldr(f, colour(a), colour(b), NULL) - expected) < 2e-4);
            assert_true((expected == 0) == (p == q));
        }
    assert_true(fabs(flip_color_difference(colours[2], colours[3]) - 1) < 1e-6);
    assert_true(flip_color_difference(colours[0], colours[1]) < 1);
    flip_free(f);
}

static void test_grey_is_colour_without_hue(void **state)
{
    (void)state;
    static float a[PIXELS], b[PIXELS], a3[3 * PIXELS], b3[3 * PIXELS];
    uint32_t seed = 3;
    flip *f = make_flip(30);
    for (int i = 0; i < PIXELS; i++) {
        a[i] = a3[3 * i] = a3[3 * i + 1] = a3[3 * i + 2] = (float)uniform(&seed);
        b[i] = b3[3 * i] = b3[3 * i + 1] = b3[3 * i + 2] = (float)uniform(&seed);
    }
    assert_true(flip_ldr(f, grey(a), grey(b), NULL) == flip_ldr(f, colour(a3), colour(b3), NULL));
    const flip_exposures one = flip_exposures_of(f, grey(a)), three = flip_exposures_of(f, colour(a3));
    assert_true(fabs(one.first - three.first) < 1e-5 && fabs(one.last - three.last) < 1e-5 && one.count == three.count);
    flip_free(f);
}

static double rms(const float *a, const float *b)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        sum += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(sum / PIXELS);
}

/* A bright disk on grey, blurred more and more, on a screen whose pixels the eye resolves: noise of the same RMSE everywhere is worse, for
 * blur errs at the rim alone and FLIP is a concave function of contrast. What the eye cannot resolve costs less from farther away. */
static void test_known_orders(void **state)
{
    (void)state;
    static float disk[PIXELS], blurred[PIXELS], noisy[PIXELS], scratch[PIXELS], flat[PIXELS], checked[PIXELS];
    uint32_t seed = 11;
    double before = 0;
    flip *f = make_flip(25);
    for (int i = 0; i < PIXELS; i++)
        disk[i] = hypot(i % W - 20, i / W - 14) < 8 ? 0.7f : 0.3f;
    for (int step = 1; step <= 3; step++) {
        const filter_kernel kernel = filter_gaussian(step, 3 * step);
        filter_rows(scratch, disk, W, H, &kernel);
        filter_columns(blurred, scratch, W, H, &kernel, 0);
        const double amplitude = rms(disk, blurred) * sqrt(12);
        for (int i = 0; i < PIXELS; i++)
            noisy[i] = disk[i] + (float)(amplitude * (uniform(&seed) - 0.5));
        const double of_blur = flip_ldr(f, grey(disk), grey(blurred), NULL);
        assert_true(fabs(rms(disk, noisy) / rms(disk, blurred) - 1) < 0.1);
        assert_true(of_blur > before);
        assert_true(flip_ldr(f, grey(disk), grey(noisy), NULL) > of_blur);
        before = of_blur;
    }
    before = 0;
    for (int step = 1; step <= 4; step++) {
        for (int i = 0; i < PIXELS; i++)
            noisy[i] = disk[i] + (i % 5 == 0 ? 0.06f * (float)step : 0.0f);
        const double now = flip_ldr(f, grey(disk), grey(noisy), NULL);
        assert_true(now > before);
        before = now;
    }
    flip_free(f);
    before = 1;
    for (int step = 0; step < 4; step++) {
        f = make_flip(15 << step);
        for (int i = 0; i < PIXELS; i++) {
            flat[i] = 0.4f;
            checked[i] = (i % W + i / W) % 2 ? 0.3f : 0.5f;
        }
        const double now = flip_ldr(f, grey(flat), grey(checked), NULL);
        assert_true(now < before);
        before = now;
        flip_free(f);
    }
    assert_true(before < 0.1);
}

/* ---- HDR ---- */

static void test_tone_curve(void **state)
{
    (void)state;
    assert_true(fabs(flip_tone(1 / 0.6) - 2.54 / 3.16) < 1e-12);
    for (double value = 0.05; value < 1; value += 0.05)
        assert_true(fabs(flip_tone(flip_tone_inverse(value)) - value) < 1e-12);
}

static void test_exposure_range(void **state)
{
    (void)state;
    static float light[PIXELS];
    flip *f = make_flip(FLIP_PIXELS_PER_DEGREE);
    for (int i = 0; i < PIXELS; i++)
        light[i] = i < PIXELS / 3 ? 0.5f : i == PIXELS - 1 ? 1000.0f : 2.0f;
    flip_exposures range = flip_exposures_of(f, grey(light));
    assert_true(fabs(flip_tone(1000 * exp2(range.first)) - 0.85) < 1e-9);
    assert_true(fabs(flip_tone(2 * exp2(range.last)) - 0.85) < 1e-9);
    assert_int_equal(range.count, (int)ceil(log2(500)));
    for (int i = 0; i < PIXELS; i++)
        light[i] = 3.0f;
    range = flip_exposures_of(f, grey(light));
    assert_true(range.first == range.last && range.count == 2);
    memset(light, 0, sizeof light);
    light[5] = 7.0f;
    range = flip_exposures_of(f, grey(light));
    assert_true(range.first == range.last && fabs(flip_tone(7 * exp2(range.first)) - 0.85) < 1e-9);
    light[5] = 0;
    range = flip_exposures_of(f, grey(light));
    assert_true(range.first == 0 && range.last == 0 && range.count == 1);
    flip_free(f);
}

static void tone_map(const float *light, double stops, float *out)
{
    for (int i = 0; i < 3 * PIXELS; i++)
        out[i] = (float)fmin(flip_tone(fmax(light[i], 0) * exp2(stops)), 1);
}

static void test_hdr_is_the_worst_exposure(void **state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS], a_shown[3 * PIXELS], b_shown[3 * PIXELS], map[PIXELS], worst[PIXELS], hdr[PIXELS];
    flip *f = make_flip(FLIP_PIXELS_PER_DEGREE);
    fill_glitter(a, 5);
    fill_glitter(b, 6);
    for (int i = 0; i < 3 * PIXELS; i++) {
        a[i] = powf(10, 4 * a[i] - 2);
        b[i] = powf(10, 4 * b[i] - 2);
    }
    for (int stops = -6; stops <= 4; stops += 5) {
        const flip_exposures one = {stops, stops + 3, 1};
        tone_map(a, stops, a_shown);
        tone_map(b, stops, b_shown);
        const double ldr = flip_ldr(f, colour(a_shown), colour(b_shown), NULL);
        assert_true(ldr > 0.01 && fabs(flip_hdr(f, colour(a), colour(b), &one, NULL) - ldr) < 1e-6);
    }
    const flip_exposures range = flip_exposures_of(f, colour(b));
    memset(worst, 0, sizeof worst);
    for (uint32_t e = 0; e < range.count; e++) {
        const double stops = range.first + e * (range.last - range.first) / (range.count - 1);
        tone_map(a, stops, a_shown);
        tone_map(b, stops, b_shown);
        flip_ldr(f, colour(a_shown), colour(b_shown), map);
        for (int i = 0; i < PIXELS; i++)
            worst[i] = fmaxf(worst[i], map[i]);
    }
    const double score = flip_hdr(f, colour(a), colour(b), &range, hdr);
    for (int i = 0; i < PIXELS; i++)
        assert_true(fabsf(worst[i] - hdr[i]) < 1e-4f);
    /* The unit of light does not matter. */
    for (int i = 0; i < 3 * PIXELS; i++) {
        a[i] *= 1024;
        b[i] *= 1024;
    }
    const flip_exposures scaled = flip_exposures_of(f, colour(b));
    assert_true(fabs(scaled.first - range.first + 10) < 1e-5);
    assert_true(fabs(flip_hdr(f, colour(a), colour(b), &scaled, NULL) - score) < 1e-5);
    /* Light that a float can hold but its square cannot. */
    a[0] = 3e38f;
    b[1] = -3e38f;
    assert_true(isfinite(flip_hdr(f, colour(a), colour(b), &range, NULL)));
    flip_free(f);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    static const double wrong[] = {0, -1, 3.9, 401, NAN, INFINITY};
    flip *f = NULL;
    file_error error;
    for (int i = 0; i < 6; i++)
        assert_int_equal(flip_create(&f, 8, 8, wrong[i], &error), FILE_ARGUMENT);
    assert_int_equal(flip_create(&f, 0, 8, 67, &error), FILE_ARGUMENT);
    assert_null(f);
    flip_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_filters_against_sums),
        cmocka_unit_test(test_against_equations),
        cmocka_unit_test(test_identity_symmetry_range),
        cmocka_unit_test(test_constant_pictures),
        cmocka_unit_test(test_grey_is_colour_without_hue),
        cmocka_unit_test(test_known_orders),
        cmocka_unit_test(test_tone_curve),
        cmocka_unit_test(test_exposure_range),
        cmocka_unit_test(test_hdr_is_the_worst_exposure),
        cmocka_unit_test(test_bad_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
