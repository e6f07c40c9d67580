/* SPDX-License-Identifier: MIT
 *
 * Stars: how many of each magnitude and how bright together, their spots against all stars in double precision, their sum over a moving camera's pixels,
 * and what is added to the sky; the colours of the night.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/kernel_context.h"
#include "frame/atmosphere.h"
#include "frame/kernel_data.h"
#include "frame/stars.h"
#include "unit/random_numbers.h"

static double double_sqrt(double x) { return sqrt(x); }
static double double_floor(double x) { return floor(x); }

#include "unit/sky_lane.h"

#include "kernels/display/night.k"
#include "kernels/sky/stars.k"

#include "unit/kernel_words_off.h"

#define PI 3.14159265358979323846

typedef struct night {
    sky_state *sky;
    FrameData frame;
    struct kernel_context cx;
    double star[STAR_COUNT][3]; /* unit vectors */
    double light[STAR_COUNT];
} night;

static night *night_at(double turbidity)
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    mgt_light_init(&scene.light, MGT_SOURCE_MOON);
    scene.sky.turbidity = (float)turbidity;
    night *n = calloc(1, sizeof *n);
    assert_non_null(n);
    n->sky = sky_state_create();
    assert_non_null(n->sky);
    assert_int_equal(sky_state_build(n->sky, &scene.sky, &scene.light), MGT_OK);
    n->cx = (struct kernel_context){.frame = &n->frame, .sky = n->sky->table};
    for (int i = 0; i < STAR_COUNT; i++) {
        const float *t = n->sky->table + 3 * (SKY_COLUMNS * STAR_ROW + i);
        const double x = (double)t[0] - 4 * double_floor((double)t[0] / 4) - 1, z = (double)t[1] - 1, across = double_sqrt(2 - x * x - z * z);
        n->star[i][0] = x * across;
        n->star[i][1] = 1 - x * x - z * z;
        n->star[i][2] = z * across;
        n->light[i] = (double)t[2];
        assert_true(t[0] >= 0 && t[0] < 32);
    }
    return n;
}

static void night_end(night *n)
{
    sky_state_destroy(n->sky);
    free(n);
}

/* ---- how many ---- */

static void there_are_as_many_as_in_the_sky(void **unused)
{
    (void)unused;
    night *n = night_at(1.8);
    /* Allen 1973: stars of the whole sky brighter than magnitude 0 … 7. */
    static const double brighter[] = {4, 15, 48, 171, 513, 1602, 4800, 14000};
    double sum = 0;
    for (int m = 0; m <= 6; m++) {
        int count = 0;
        for (int i = 0; i < STAR_COUNT; i++)
            count += n->light[i] > stars_illuminance(m);
        assert_true(fabs(count - brighter[m] / 2) <= 1);
        assert_true(fabs(stars_magnitude_of(pow(brighter[m], 0.7) * pow(brighter[m + 1], 0.3)) - (m + 0.3)) < 1e-9);
    }
    for (int i = 0; i < STAR_COUNT; i++) {
        sum += n->light[i];
        assert_true(n->star[i][1] > 0);
    }
    assert_true(fabs(sum / (2 * PI) / stars_mean_radiance() - 1) < 1e-6);
    /* The light of stars down to magnitude 6.5 over the whole sky is that of about a hundred of magnitude 0. */
    assert_true(fabs(2 * sum / stars_illuminance(0) - 100) < 10);
    night_end(n);
}

/* Evenly over the hemisphere: eight parts of equal area, whose counts would seldom be further off by chance. */
static void they_are_everywhere(void **unused)
{
    (void)unused;
    night *n = night_at(1.8);
    int parts[8] = {0};
    for (int i = 0; i < STAR_COUNT; i++)
        parts[(n->star[i][0] > 0) + 2 * (n->star[i][2] > 0) + 4 * (n->star[i][1] > 0.5)]++;
    for (int i = 0; i < 8; i++)
        assert_true(abs(parts[i] - STAR_COUNT / 8) < 4 * double_sqrt(STAR_COUNT / 8.0));
    night_end(n);
}

/* ---- spots ---- */

static double from_all_stars(const night *n, const double d[3], double pixel)
{
    const double radius = 1.7610 * pixel;
    double sum = 0;
    for (int i = 0; i < STAR_COUNT; i++) {
        double squared = 0;
        for (int k = 0; k < 3; k++)
            squared += (d[k] - n->star[i][k]) * (d[k] - n->star[i][k]);
        const double share = 1 - squared / (radius * radius);
        if (share > 0)
            sum += n->light[i] * share * share * share;
    }
    return sum * 4 / (PI * radius * radius);
}

static vec3 seen(const night *n, const double d[3], double pixel) { return star_radiance(&n->cx, vec3((float)d[0], (float)d[1], (float)d[2]), (float)pixel); }

static double luminance_of(vec3 c) { return 0.2126 * (double)c.x + 0.7152 * (double)c.y + 0.0722 * (double)c.z; }

static void spots_are_those_of_all_stars(void **unused)
{
    (void)unused;
    static const double pixels[] = {2e-4, 1.2e-3, 8e-3};
    night *n = night_at(1);
    random_state random = {5};
    for (int i = 0; i < 3000; i++) {
        const double pixel = pixels[i % 3], *star = n->star[i * 7 % STAR_COUNT];
        double d[3], length = 0, wanted[3];
        for (int k = 0; k < 3; k++)
            d[k] = star[k] + pixel * random_range(&random, -1.5, 1.5);
        d[1] = fmax(d[1], 0.03); /* lower down no blue is left */
        for (int k = 0; k < 3; k++)
            length += d[k] * d[k];
        for (int k = 0; k < 3; k++)
            d[k] = (double)(float)(d[k] / double_sqrt(length));
        const vec3 c = seen(n, d, pixel);
        stars_lookup(n->sky->table, d, pixel, wanted);
        const double peak = n->light[i * 7 % STAR_COUNT] / (pixel * pixel);
        assert_true(fabs((double)c.y - wanted[1]) < 2e-3 * fabs(wanted[1]) + 5e-4 * peak);
        /* Without the atmosphere, and what of the mean the night holds. */
        const double v = double_sqrt(d[1]) * (SKY_ROWS - 1), row = fmin(double_floor(v), SKY_ROWS - 2);
        const float *clear = n->sky->table + 3 * SKY_COLUMNS * STAR_CLEAR_ROW;
        double outside = 0;
        for (int k = 0; k < 3; k++) {
            const double through = (double)clear[3 * (int)row + k] * (1 - v + row) + (double)clear[3 * (int)row + 3 + k] * (v - row);
            outside += (k == 0 ? 0.2126 : k == 1 ? 0.7152 : 0.0722) * (wanted[k] / fmax(through, 1e-30) + (double)clear[3 * SKY_ROWS + k]);
        }
        const double all = from_all_stars(n, d, pixel);
        if (!(fabs(outside - all) <= 2e-3 * all + 1e-6 * stars_mean_radiance()))
            fail_msg("%g at y %g: %g, not %g", pixel, d[1], outside, all);
    }
    night_end(n);
}

/* A camera that looks at the brightest star and turns by parts of a pixel: the sum over its pixels. */
static void nothing_flickers(void **unused)
{
    (void)unused;
    night *n = night_at(1.8);
    int brightest = 0;
    for (int i = 1; i < STAR_COUNT; i++)
        brightest = n->light[i] > n->light[brightest] ? i : brightest;
    const double *f = n->star[brightest], pixel = 1e-3, across = double_sqrt(f[0] * f[0] + f[2] * f[2]);
    const double right[3] = {-f[2] / across, 0, f[0] / across};
    const double up[3] = {right[1] * f[2] - right[2] * f[1], right[2] * f[0] - right[0] * f[2], right[0] * f[1] - right[1] * f[0]};
    double least = INFINITY, most = 0;
    for (int turn = 0; turn < 64; turn++) {
        double sum = 0;
        for (int y = -4; y <= 4; y++)
            for (int x = -4; x <= 4; x++) {
                const double a = (x + turn % 8 / 8.0) * pixel, b = (y + turn / 8 / 8.0) * pixel;
                const double ray[3] = {f[0] + a * right[0] + b * up[0], f[1] + a * right[1] + b * up[1], f[2] + a * right[2] + b * up[2]};
                const double length = double_sqrt(1 + a * a + b * b);
                sum += from_all_stars(n, (const double[3]){ray[0] / length, ray[1] / length, ray[2] / length}, pixel / (length * double_sqrt(length)));
            }
        least = fmin(least, sum * pixel * pixel);
        most = fmax(most, sum * pixel * pixel);
    }
    assert_true(most / least < 1.013);
    assert_true(fabs(most / n->light[brightest] - 1) < 0.01); /* a faint one may stand near */
    night_end(n);
}

/* The mean of their light is in sky.night already: between them it is missing, so that on the whole nothing is added. */
static void nothing_is_added_on_the_whole(void **unused)
{
    (void)unused;
    night *n = night_at(1.8);
    random_state random = {9};
    int between = 0;
    for (int i = 0; i < 1000; i++) {
        const double y = random_range(&random, 0.3, 1), turn = random_range(&random, 0, 2 * PI), across = double_sqrt(1 - y * y);
        const double d[3] = {across * cos(turn), y, across * sin(turn)};
        if (from_all_stars(n, d, 1e-3) > 0)
            continue;
        double through[SPECTRUM_BANDS];
        scattering_transmittance(n->sky->air, y, through);
        assert_true(fabs((double)seen(n, d, 1e-3).y / (stars_mean_radiance() * through[5]) + 1) < 0.1);
        between++;
    }
    assert_true(between > 950);
    night_end(n);
}

static void wide_pixels_see_the_mean(void **unused)
{
    (void)unused;
    night *n = night_at(1.8);
    for (int i = 0; i < 100; i++)
        assert_true(seen(n, n->star[i], 0.02).y == 0);
    assert_true(seen(n, n->star[0], 0.012).y > 0);
    night_end(n);
}

static void haze_hides_them(void **unused)
{
    (void)unused;
    night *clear = night_at(1), *hazy = night_at(6);
    for (int i = 0; i < STAR_COUNT; i += 7) {
        const double *star = clear->star[i];
        if (star[1] < 0.02)
            continue;
        double through[SPECTRUM_BANDS];
        scattering_transmittance(clear->sky->air, star[1], through);
        const double seen_clear = (double)seen(clear, star, 1e-3).y, seen_hazy = (double)seen(hazy, star, 1e-3).y;
        const double outside = from_all_stars(clear, star, 1e-3);
        assert_true(seen_hazy < seen_clear);
        /* 540 nm stands for green; colours differ by the star's own. */
        assert_true(seen_clear < 1.05 * outside * through[5] + 1e-8 && seen_clear > 0.85 * outside * through[5] - 1e-7);
    }
    night_end(clear);
    night_end(hazy);
}

/* ---- colours of the night ---- */

static vec3 by_night(double adaptation, const double rgb[3])
{
    FrameData frame = {.rod_luminance = (float)adaptation};
    struct kernel_context cx = {.frame = &frame};
    return night_vision(&cx, vec3((float)rgb[0], (float)rgb[1], (float)rgb[2]));
}

static void night_vision_is_the_paper_s(void **unused)
{
    (void)unused;
    random_state random = {3};
    for (int i = 0; i < 20000; i++) {
        const double bright = pow(10, random_range(&random, -8, 0)), adaptation = pow(10, random_range(&random, -8, 0));
        double rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = bright * random_range(&random, 0.001, 1);
        const double x = 0.4124564 * rgb[0] + 0.3575761 * rgb[1] + 0.1804375 * rgb[2], y = 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2],
                     z = 0.0193339 * rgb[0] + 0.1191920 * rgb[1] + 0.9503041 * rgb[2];
        const double t = fmin(fmax((log10(1000 * fmax(y, adaptation)) + 2) / 2.6, 0), 1), cones = 3 * t * t - 2 * t * t * t;
        const double scotopic = 0.4468 * y * (1.33 * (1 + (y + z) / x) - 1.68);
        /* (0.25, 0.25) of luminance 1 is X = 1, Z = 2. */
        const double hue[3] = {3.2404542 - 1.5371385 - 2 * 0.4985314, -0.9692660 + 1.8760108 + 2 * 0.0415560, 0.0556434 - 0.2040259 + 2 * 1.0572252};
        const vec3 c = by_night(adaptation, rgb);
        const double got[3] = {(double)c.x, (double)c.y, (double)c.z};
        for (int k = 0; k < 3; k++) {
            const double want = cones * rgb[k] + (1 - cones) * scotopic * hue[k];
            if (!(fabs(got[k] - want) < 2e-4 * bright))
                fail_msg("%g %g: channel %d is %g, not %g", bright, adaptation, k, got[k], want);
        }
    }
}

static void day_keeps_its_colours(void **unused)
{
    (void)unused;
    const double dark[3] = {1e-7, 2e-8, 3e-8}, black[3] = {0, 0, 0};
    assert_true(by_night(1, dark).x == 1e-7f && by_night(1, dark).y == 2e-8f);
    assert_true(by_night(1e-6, black).x == 0 && by_night(1e-6, black).z == 0);
    assert_true(by_night(1e-7, (const double[3]){1e30, 1e30, 1e30}).x == 1e30f);
    /* Purkinje: of two that look equally bright by day, the blue one is the brighter by night. */
    assert_true(luminance_of(by_night(1e-7, (const double[3]){0, 0, 1e-7})) > luminance_of(by_night(1e-7, (const double[3]){1e-7 * 0.0722 / 0.2126, 0, 0})));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_are_as_many_as_in_the_sky),
        cmocka_unit_test(they_are_everywhere),
        cmocka_unit_test(spots_are_those_of_all_stars),
        cmocka_unit_test(nothing_flickers),
        cmocka_unit_test(nothing_is_added_on_the_whole),
        cmocka_unit_test(wide_pixels_see_the_mean),
        cmocka_unit_test(haze_hides_them),
        cmocka_unit_test(night_vision_is_the_paper_s),
        cmocka_unit_test(day_keeps_its_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
