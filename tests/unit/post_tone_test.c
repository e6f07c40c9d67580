/* SPDX-License-Identifier: MIT
 *
 * tone.k at one lane: bounds, monotony, anchors and the way bright colours turn to white.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "cpu/kernel_context.h"
#include "frame/kernel_data.h"
#include "mangata/mangata.h"

static double double_pow(double x, double y) { return pow(x, y); }

#pragma GCC diagnostic ignored "-Wunused-parameter" /* the dialect hands cx to every function */
#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#define FRAME(cx) (*(cx)->frame)

#include "kernels/display/tone.k"

#include "unit/kernel_words_off.h"

enum { TONE_MAPS = 4 };

static vec3 shown(double exposure, double r, double g, double b, int tone_map)
{
    FrameData frame = {.exposure = (float)exposure};
    struct kernel_context cx = {.frame = &frame};
    return display_color(&cx, vec3((float)r, (float)g, (float)b), tone_map);
}

static double decode(double code) { return code <= 0.04045 ? code / 12.92 : double_pow((code + 0.055) / 1.055, 2.4); }

static void encoding_is_srgb(void **unused)
{
    (void)unused;
    for (double x = 0; x <= 1.0; x += 1.0 / 4096) {
        double code = shown(1, x, x, x, MGT_TONE_NONE).y;
        assert_true(fabs(decode(code) - x) < 2e-6);
    }
    assert_true(shown(1, 2, 2, 2, MGT_TONE_NONE).x > 0.999999f);
    assert_true(shown(0.25, 2, 2, 2, MGT_TONE_NONE).x == shown(1, 0.5, 0.5, 0.5, MGT_TONE_NONE).x); /* exposure is a factor */
}

static void greys_rise_from_black_to_white(void **unused)
{
    (void)unused;
    for (int map = 0; map < TONE_MAPS; ++map) {
        assert_true(shown(1, 0, 0, 0, map).x < 2e-3f);
        assert_true(shown(1, 1e5, 1e5, 1e5, map).x > 0.999f);
        double before = -1;
        for (double stops = -14; stops < 14; stops += 1.0 / 16) {
            double x = exp2(stops);
            vec3 c = shown(1, x, x, x, map);
            assert_true(c.x >= before - 1e-6);                             /* rounding alone may take it back */
            assert_true(fabs(c.x - c.y) < 3e-3 && fabs(c.x - c.z) < 3e-3); /* grey stays grey */
            if (stops > -8 && stops < 2) {
                assert_true(map == MGT_TONE_NONE && stops > 0 ? true : c.x > before + 1e-4);
            }
            before = c.x;
        }
        double middle = decode(shown(1, 0.18, 0.18, 0.18, map).y);
        assert_true(middle > 0.14 && middle < 0.20);
    }
    assert_true(fabs(decode(shown(1, 0.18, 0.18, 0.18, MGT_TONE_AGX).y) - 0.18) < 2e-3);
}

static void each_channel_rises_with_brightness(void **unused)
{
    (void)unused;
    static const double colours[][3] = {{1, 0.5, 0.1}, {0.2, 0.5, 1}, {0.4, 1, 0.4}, {1, 0.3, 0.5}};
    for (int map = 0; map < 3; ++map) { /* AgX mixes back, and lets a channel dip a little on its way to white */
        for (size_t k = 0; k < sizeof colours / sizeof colours[0]; ++k) {
            vec3 before = {-1, -1, -1};
            for (double stops = -8; stops < 8; stops += 0.125) {
                double x = exp2(stops);
                vec3 c = shown(1, x * colours[k][0], x * colours[k][1], x * colours[k][2], map);
                double sum = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z, last = 0.2126 * before.x + 0.7152 * before.y + 0.0722 * before.z;
                assert_true(sum >= last - 1e-6);
                before = c;
            }
        }
    }
}

static void nothing_leaves_the_display(void **unused)
{
    (void)unused;
    static const double values[] = {0, 1e-45, 1e-20, 1e-4, 0.18, 1, 50, 1e6, 1e30, 3.4e38, INFINITY};
    static const double exposures[] = {0, 1e-30, 1, 1e30, INFINITY};
    const size_t n = sizeof values / sizeof values[0];
    for (int map = 0; map < TONE_MAPS; ++map) {
        for (size_t e = 0; e < sizeof exposures / sizeof exposures[0]; ++e) {
            for (size_t i = 0; i < n * n * n; ++i) {
                vec3 c = shown(exposures[e], values[i % n], values[i / n % n], values[i / n / n], map);
                if (exposures[e] == INFINITY && (values[i % n] == 0 || values[i / n % n] == 0 || values[i / n / n] == 0)) {
                    continue; /* no number */
                }
                assert_true(c.x >= 0 && c.x <= 1 && c.y >= 0 && c.y <= 1 && c.z >= 0 && c.z <= 1);
            }
        }
    }
}

static void a_bright_sunset_pales_but_stays_warm(void **unused)
{
    (void)unused;
    static const int maps[] = {MGT_TONE_ACES, MGT_TONE_AGX};
    for (size_t k = 0; k < 2; ++k) {
        double saturation = 2;
        for (double stops = 0; stops <= 12; stops += 0.5) {
            double x = exp2(stops);
            vec3 c = shown(1, x, 0.45 * x, 0.1 * x, maps[k]);
            assert_true(c.x >= c.y - 1e-6f && c.y >= c.z - 1e-6f);
            double now = (c.x - c.z) / c.x;
            assert_true(now <= saturation + 1e-3);
            saturation = now;
        }
        assert_true(saturation < 0.08);
        vec3 red = shown(1, 200, 0.5, 0.1, maps[k]); /* even a laser ends pale rather than in the gamut's corner */
        assert_true(red.x > 0.95f && red.y > 0.15f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(encoding_is_srgb),
        cmocka_unit_test(greys_rise_from_black_to_white),
        cmocka_unit_test(each_channel_rises_with_brightness),
        cmocka_unit_test(nothing_leaves_the_display),
        cmocka_unit_test(a_bright_sunset_pales_but_stays_warm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
