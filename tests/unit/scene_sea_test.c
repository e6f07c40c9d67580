/* SPDX-License-Identifier: MIT */
/* Seas from the wind alone: the key water.wind, and scenes from the words of --sea. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_edit.h"
#include "scene/scene_sea.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static scene_file *parse(const char *text, const char *const *words, size_t count)
{
    scene_error error;
    scene_file *file = scene_file_parse(text, strlen(text), "sea.yaml", words, count, &error);
    if (file == NULL)
        fail_msg("%s\n%s", error.text, text);
    return file;
}

static void assert_same_pictures(const scene_file *left, const scene_file *right)
{
    char *a = scene_file_canonical(left, NULL), *b = scene_file_canonical(right, NULL);
    assert_string_equal(a, b);
    free(a);
    free(b);
}

/* Whatever the spelling, the render hash is that of the waves. */
static void the_wind_stands_for_a_spectrum(void **state)
{
    (void)state;
    static const char *const seas[][2] = {
        {"{wind: 12}", "{wind: {speed: 12}}"},
        {"{wind: {speed: 9, direction_deg: 30, fetch: 5e4, count: 40, seed: 5}}",
         "{spectrum: {model: elfouhaily, wind: 9, wind_height: 10, fetch: 5e4, direction_deg: 30, slope: cox-munk, count: 40, seed: 5}, choppiness: 0.7, foam: {amount: 1}}\nsky: {aerial: on}"},
        {"{wind: {speed: 9, fetch: 5e4, depth: 8}}",
         "{spectrum: {model: elfouhaily, wind: 9, fetch: 5e4, depth: 8, slope: cox-munk, count: 160}, choppiness: 0.7, foam: {amount: 1}}\nsky: {aerial: on}"},
        {"{wind: {speed: 9, depth: 12000}}", "{wind: 9}"},
        {"{wind: 0}", "{waves: []}"},
        {"{wind: 0, waves: [{amplitude: 1, a: 1, b: 0, c: -3}]}", "{waves: [{amplitude: 1, a: 1, b: 0, c: -3}]}"},
        {"{wind: 7, waves: [], spectrum: {model: none}}", "{wind: 7}"},
        {"{wind: 7, choppiness: 0.7}", "{wind: 7}"},
        {"{wind: 7, foam: {amount: 1}}", "{wind: 7}"},
        {"{wind: 7}\nsky: {aerial: auto}", "{wind: 7}"},
        {"{wind: 7}\nlight: {body: moon}", "{wind: 7}\nlight: {body: moon}\nsky: {stars: on}\npost: {night_tint: on}"},
        {"{wind: 7}\nsky: {stars: auto}\npost: {night_tint: auto}", "{wind: 7}\nsky: {stars: off}\npost: {night_tint: off}"},
        {"{waves: []}\nlight: {body: moon}", "{waves: []}\nlight: {body: moon}\nsky: {stars: off}\npost: {night_tint: off}"},
        {"{waves: []}\nsky: {aerial: auto}", "{waves: []}\nsky: {aerial: off}"},
    };
    for (size_t i = 0; i < COUNT(seas); i++) {
        scene_file *files[2];
        for (int k = 0; k < 2; k++) {
            char text[256];
            snprintf(text, sizeof text, "mangata: 1\nwater: %s\n", seas[i][k]);
            files[k] = parse(text, NULL, 0);
        }
        assert_same_pictures(files[0], files[1]);
        scene_file_free(files[0]);
        scene_file_free(files[1]);
    }
}

static void overrides_reach_into_the_short_form(void **state)
{
    (void)state;
    static const char *const words[] = {"water.wind.seed=9", "water.wind.fetch=3e4"};
    scene_file *shortly = parse("mangata: 1\nwater: {wind: 12}\n", words, 2),
               *whole = parse("mangata: 1\nwater: {wind: {speed: 12, seed: 9, fetch: 3e4}}\n", NULL, 0);
    assert_same_pictures(shortly, whole);
    scene_file_free(shortly);
    scene_file_free(whole);
    static const char *const again[] = {"water.wind=8", "water.wind.seed=4", "water.wind=5"};
    shortly = parse("mangata: 1\nwater: {wind: {speed: 12, seed: 9}}\n", again, 3);
    whole = parse("mangata: 1\nwater: {wind: 5}\n", NULL, 0);
    assert_same_pictures(shortly, whole);
    scene_file_free(shortly);
    scene_file_free(whole);
}

/* Every wind makes a sea with Cox and Munk's slopes and the height of a developed one. */
static void every_wind_makes_a_sea(void **state)
{
    (void)state;
    for (double wind = 0.5; wind <= 75; wind *= 1.3) {
        char text[80];
        snprintf(text, sizeof text, "mangata: 1\nwater: {wind: %.17g}\n", wind);
        scene_file *file = parse(text, NULL, 0);
        mgt_scene scene;
        assert_true(scene_file_frame(file, 0, &scene));
        assert_int_equal(scene.water.wave_count, 160);
        const sea_statistics sea = waves_statistics(scene.water.waves, scene.water.wave_count, 0);
        assert_true(fabs(sea.slope / (0.003 + 0.00512 * wind_at_height(wind, 10, 12.5)) - 1) < 1e-3);
        const double height = sea.height * 9.80665 / (wind * wind);
        if (!(height > 0.23 && height < 0.265))
            fail_msg("%g U²/g at %g m/s", height, wind);
        scene_file_free(file);
    }
}

static void written_out_it_is_no_wind(void **state)
{
    (void)state;
    scene_file *file = parse("mangata: 1\nwater: {wind: 12}\n", NULL, 0);
    scene_values values;
    assert_true(scene_values_copy(&values, scene_file_values(file)));
    scene_values_write_out_sea(&values);
    assert_true(values.water.wind.speed == 0);
    assert_int_equal(values.water.waves.count, 160);
    scene_error error;
    scene_file *again = scene_values_parse(&values, "again", NULL, 0, &error);
    assert_non_null(again);
    assert_same_pictures(file, again);
    scene_file_free(again);

    /* The words of a scene that differs elsewhere say nothing about waves. */
    scene_overrides words;
    values.light.elevation_deg = 3;
    assert_true(scene_overrides_between(scene_file_values(file), &values, &words));
    assert_int_equal(words.count, 1);
    assert_string_equal(words.words[0], "light.elevation_deg=3");
    scene_overrides_free(&words);
    scene_values_free(&values);
    scene_file_free(file);
}

static void words_make_a_scene(void **state)
{
    (void)state;
    scene_error error;
    scene_file *file = scene_file_open("--sea wind=12,direction=30,seed=3,count=50,fetch=1e5,depth=0", NULL, 0, &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    assert_string_equal(scene_file_path(file), "--sea wind=12,direction=30,seed=3,count=50,fetch=1e5,depth=0");
    assert_int_equal(scene_file_frame_count(file), 60);
    assert_string_equal(scene_file_warning(file), "");
    scene_file *same = parse("mangata: 1\nwater: {wind: {speed: 12, direction_deg: 30, seed: 3, count: 50, fetch: 1e5}}\n", NULL, 0);
    mgt_scene one, other;
    assert_true(scene_file_frame(file, 0, &one) && scene_file_frame(same, 0, &other));
    assert_int_equal(one.water.wave_count, 50);
    assert_memory_equal(one.water.waves, other.water.waves, 50 * sizeof(mgt_wave));
    scene_file_free(same);
    scene_file_free(file);

    /* The camera stands over the crests; overrides come later. */
    for (double wind = 1; wind < 40; wind *= 2) {
        char words[64];
        static const char *const override = "light.elevation_deg=5";
        snprintf(words, sizeof words, "wind=%g", wind);
        file = scene_file_sea(words, &override, 1, &error);
        assert_non_null(file);
        assert_true(scene_file_frame(file, 0, &one));
        assert_true(one.light.elevation_deg == 5);
        assert_true(one.water.choppiness == 0.7f && one.foam > 0); /* as water.wind decides */
        assert_true(one.camera.position[1] >= 3 && one.camera.position[1] > 1.2 * waves_statistics(one.water.waves, one.water.wave_count, 0).height);
        assert_string_equal(scene_file_warning(file), "");
        scene_file_free(file);
    }
}

/* In deep water ω² = g k; crests go where the direction says. */
static void waves_may_be_measured(void **state)
{
    (void)state;
    scene_file *file = parse("mangata: 1\nwater: {waves: [{wavelength: 40, direction_deg: 90, height: 1.2}, {wavelength: 5, height: 0.1, phase: 2},\n"
                             "  {height: 1, wavelength: 100, direction_deg: -150}, {amplitude: 1, a: 1, b: 2, c: -3}]}\n",
                             NULL, 0);
    mgt_scene scene;
    assert_true(scene_file_frame(file, 0, &scene));
    assert_int_equal(scene.water.wave_count, 4);
    const mgt_wave *waves = scene.water.waves;
    const double lengths[] = {40, 5, 100}, directions[] = {90, 0, -150}, pi = 3.14159265358979323846;
    for (int i = 0; i < 3; i++) {
        const double k = 2 * pi / lengths[i], angle = directions[i] * pi / 180;
        assert_true(fabs(waves[i].kx - k * sin(angle)) < 1e-6 * k && fabs(waves[i].kz + k * cos(angle)) < 1e-6 * k);
        assert_true(fabs(waves[i].omega + sqrt(9.80665 * k)) < 1e-6 * sqrt(9.80665 * k));
    }
    assert_true(waves[0].amplitude == 0.6 && waves[1].amplitude == 0.05 && waves[2].amplitude == 0.5);
    assert_true(waves[0].kz == 0 && waves[1].kx == 0); /* exactly */
    assert_true(waves[1].phase == 2 && waves[0].phase == 0);
    assert_true(waves[3].kz == 2 && waves[3].omega == -3);

    /* Changed by its own keys, and by a whole item from what a program made of it. */
    static const char *const change = "water.waves[0].height=2";
    static const char text[] = "mangata: 1\nwater: {waves: [{wavelength: 40, height: 1}, {wavelength: 4, height: 0.1}]}\n";
    scene_file *higher = parse(text, &change, 1), *old = parse(text, NULL, 0);
    assert_true(((const mgt_wave *)scene_file_values(higher)->water.waves.items)->amplitude == 1);
    scene_overrides words;
    assert_true(scene_overrides_between(scene_file_values(old), scene_file_values(higher), &words));
    assert_int_equal(words.count, 1);
    assert_memory_equal(words.words[0], "water.waves[0]={amplitude: 1, a: 0, b: ", 38);
    scene_overrides_free(&words);
    scene_file_free(old);
    scene_file_free(higher);
    scene_file_free(file);
}

/* Every swell has its height, its period and its direction; all seas add up. */
static void swells_come_beside_the_wind(void **state)
{
    (void)state;
    const double pi = 3.14159265358979323846;
    static const char text[] = "mangata: 1\nwater:\n  wind: 3\n  swell:\n    - {height: 2, period: 12, direction_deg: 70}\n"
                               "    - {height: 0.8, period: 6, direction_deg: 180, spread: 75, count: 30}\n";
    scene_file *file = parse(text, NULL, 0), *calm = parse("mangata: 1\nwater: {wind: 3}\n", NULL, 0);
    mgt_scene scene, alone;
    assert_true(scene_file_frame(file, 0, &scene) && scene_file_frame(calm, 0, &alone));
    assert_int_equal(scene.water.wave_count, 160 + 24 + 30);
    assert_memory_equal(scene.water.waves, alone.water.waves, 160 * sizeof(mgt_wave));
    static const struct {
        size_t from, count;
        double height, period, comes_from;
    } swells[] = {{160, 24, 2, 12, 70}, {184, 30, 0.8, 6, 180}};
    for (size_t i = 0; i < COUNT(swells); i++) {
        const mgt_wave *waves = scene.water.waves + swells[i].from;
        double x = 0, z = 0, highest = 0, frequency = 0;
        for (size_t k = 0; k < swells[i].count; k++) {
            const double variance = waves[k].amplitude * waves[k].amplitude, number = hypot(waves[k].kx, waves[k].kz);
            x += variance * waves[k].kx / number;
            z += variance * waves[k].kz / number;
            highest += variance;
            frequency -= variance * waves[k].omega;
        }
        assert_true(fabs(waves_statistics(waves, swells[i].count, 0).height - swells[i].height) < 1e-5);
        assert_true(fabs(frequency / highest * swells[i].period / (2 * pi) - 1.1) < 0.05); /* the mean is a tenth above the peak */
        const double to = atan2(x, -z) * 180 / pi, wanted = remainder(swells[i].comes_from + 180, 360);
        if (!(fabs(remainder(to - wanted, 360)) < 6))
            fail_msg("runs to %g, not to %g", to, wanted);
        assert_true(hypot(x, z) / highest > 0.96); /* close together */
    }
    assert_true(scene.water.waves[160].phase != scene.water.waves[0].phase);

    scene_error error;
    scene_file *words = scene_file_sea("wind=3,swell=2,swell_period=12,swell_direction=70", NULL, 0, &error);
    if (words == NULL)
        fail_msg("%s", error.text);
    assert_true(scene_file_frame(words, 0, &alone));
    assert_int_equal(alone.water.wave_count, 184);
    assert_memory_equal(scene.water.waves, alone.water.waves, 184 * sizeof(mgt_wave));
    assert_true(alone.camera.position[1] == 4.5);
    scene_file_free(words);
    words = scene_file_sea("swell=1", NULL, 0, &error);
    assert_int_equal(scene_file_wave_count(words), 24);
    scene_file_free(words);
    scene_file_free(calm);
    scene_file_free(file);
}

static void bad_words_say_what_is_allowed(void **state)
{
    (void)state;
    static const struct {
        const char *words, *message;
        scene_error_kind kind;
    } bad[] = {
        {"", "--sea : \"\" is not of the form key=value; allowed: such as wind=12,direction=30", SCENE_ERROR_BAD_OVERRIDE},
        {"wind", "--sea wind: \"wind\" is not of the form key=value; allowed: such as wind=12,direction=30", SCENE_ERROR_BAD_OVERRIDE},
        {"wind=3,", "--sea wind=3,: \"\" is not of the form key=value; allowed: such as wind=12,direction=30", SCENE_ERROR_BAD_OVERRIDE},
        {"wynd=3",
         "--sea wynd=3: unknown key \"wynd\"; allowed: wind, direction, fetch, depth, count, seed, swell, swell_period, swell_direction, swell_spread, swell_count, swell_seed",
         SCENE_ERROR_BAD_OVERRIDE},
        {"speed=3",
         "--sea speed=3: unknown key \"speed\"; allowed: wind, direction, fetch, depth, count, seed, swell, swell_period, swell_direction, swell_spread, swell_count, swell_seed",
         SCENE_ERROR_BAD_OVERRIDE},
        {"wind=3,wind=3", "--sea wind=3,wind=3: key \"wind\" stands twice; allowed: once", SCENE_ERROR_BAD_OVERRIDE},
        {"wind=-3", "--sea wind=-3: wind is \"-3\"; allowed: a number, 0 or 0.5 to 75 m/s", SCENE_ERROR_BAD_OVERRIDE},
        {"wind=nan", "--sea wind=nan: wind is \"nan\"; allowed: a number, 0 or 0.5 to 75 m/s", SCENE_ERROR_BAD_OVERRIDE},
        {"wind=3}", "--sea wind=3}: wind is \"3}\"; allowed: a number, 0 or 0.5 to 75 m/s", SCENE_ERROR_BAD_OVERRIDE},
        {"wind=3,count=1.5", "--sea wind=3,count=1.5: count is \"1.5\"; allowed: a whole number, 1 to 2048", SCENE_ERROR_BAD_OVERRIDE},
        {"wind=0", "--sea wind=0: there is no wind and no swell; allowed: such as wind=12,direction=30", SCENE_ERROR_BAD_OVERRIDE},
        {"seed=2", "--sea seed=2: there is no wind and no swell; allowed: such as wind=12,direction=30", SCENE_ERROR_BAD_OVERRIDE},
        {"swell=-1", "--sea swell=-1: swell is \"-1\"; allowed: a number, 0.001 to 50 m", SCENE_ERROR_BAD_OVERRIDE},
        {"swell_period=9", "--sea swell_period=9: swell_period is given, but no swell; allowed: beside swell, its height, such as swell=2,swell_period=9",
         SCENE_ERROR_BAD_OVERRIDE},
        {"wind=20,fetch=500", "--sea wind=20,fetch=500: fetch is 500 m, too short for the spectrum in this wind; allowed: at least 2365 m",
         SCENE_ERROR_BAD_OVERRIDE},
    };
    for (size_t i = 0; i < COUNT(bad); i++) {
        scene_error error = {0};
        assert_null(scene_file_sea(bad[i].words, NULL, 0, &error));
        assert_string_equal(error.text, bad[i].message);
        assert_int_equal(error.kind, bad[i].kind);
    }
    char flood[5000];
    memset(flood, '9', sizeof flood - 1);
    flood[sizeof flood - 1] = '\0';
    memcpy(flood, "wind=", 5);
    scene_error error;
    assert_null(scene_file_sea(flood, NULL, 0, &error));
    assert_null(scene_file_sea(flood, NULL, 0, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_wind_stands_for_a_spectrum),
        cmocka_unit_test(overrides_reach_into_the_short_form),
        cmocka_unit_test(every_wind_makes_a_sea),
        cmocka_unit_test(written_out_it_is_no_wind),
        cmocka_unit_test(words_make_a_scene),
        cmocka_unit_test(waves_may_be_measured),
        cmocka_unit_test(swells_come_beside_the_wind),
        cmocka_unit_test(bad_words_say_what_is_allowed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
