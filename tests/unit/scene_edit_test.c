/* SPDX-License-Identifier: MIT */
/* Edited scenes: copies, the way back to text, and words that turn one scene into another. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "scene/scene_edit.h"

static scene_file *parse(const char *text, const char *const *words, size_t count)
{
    scene_error error;
    scene_file *file = scene_file_parse(text, strlen(text), "test", words, count, &error);
    if (file == NULL)
        fail_msg("%s\n%s", error.text, text);
    return file;
}

static char *canonical(const scene_values *values)
{
    char *text = scene_values_canonical(values, NULL);
    assert_non_null(text);
    return text;
}

static void assert_same_values(const scene_values *left, const scene_values *right)
{
    char *a = canonical(left), *b = canonical(right);
    assert_string_equal(a, b);
    assert_int_equal(left->time.frames, right->time.frames);
    assert_string_equal(left->description ? left->description : "", right->description ? right->description : "");
    free(a);
    free(b);
}

static const char *const scenes[] = {
    "mangata: 1\n",
    ("mangata: 1\ndescription: \"quotes \\\" and\\nlines\"\nimage: {width: 64}\ncamera: {position: [1, 2, 3], target: [0, 1, 0.1], fov_y_deg: 33.3}\n"
     "light: {body: moon, elevation_deg: 3}\nsky: {model: gradient, zenith: [0.1, 0.2, 0.3]}\n"
     "water: {waves: [{amplitude: 0.1, a: 1, b: 2, c: -3.1}, {amplitude: 0.2, a: -1, b: 0.3333333333333333, c: 4, phase: 1e-3}], ior: 1.4}\n"
     "post: {exposure: -3.5, tone_map: none}\n"),
    "mangata: 1\nlight: {body: sun, angular_radius_deg: 0.2590}\npost: {exposure: auto, exposure_offset: 1.25, glare: 0}\n",
    ("mangata: 1\ntime: {start: 1, fps: 23.976, frames: 12, shutter: 0.5}\ncamera:\n  fov_y_deg: 40\n  path:\n"
     "    - {time: 0, position: [0, 2, 0], target: [0, 1.8, -5]}\n    - {time: 2.5, position: [3, 4, -2], target: [1, 3.5, -8], fov_y_deg: 30}\n"),
    "mangata: 1\nwater: {waves: [{amplitude: 0.1, a: 1, b: 2, c: -3.1}]}\n",
    "mangata: 1\nwater: {waves: [{amplitude: 0.1, a: 1, b: 2, c: -3.1}], spectrum: {model: tma, wind: 7, depth: 5, count: 9, seed: 4}}\n",
    "mangata: 1\nwater: {spectrum: {model: pierson-moskowitz, directions: fixed, spread: 4, slope: cox-munk}, ior: 1.4}\n",
    "mangata: 1\nwater: {wind: 7}\n",
    "mangata: 1\nwater: {wind: 3, swell: [{height: 2}, {height: 1.5, period: 9, direction_deg: 250, seed: 4}]}\n",
    "mangata: 1\nwater: {swell: [{height: 1, period: 8, spread: 75, count: 10}], waves: [{amplitude: 0.1, a: 1, b: 2, c: -3.1}]}\n",
    "mangata: 1\nwater: {waves: [{wavelength: 40, direction_deg: 30, height: 1.2}]}\n",
    "mangata: 1\nwater: {waves: [{wavelength: 7, height: 0.3, phase: 2}, {amplitude: 0.2, a: -1, b: 0.25, c: 4}]}\n",
    "mangata: 1\nwater: {wind: {speed: 9, direction_deg: 20, fetch: 2e4, count: 30, seed: 7}, amplitude: 0.5}\n",
    /* What a wind decides, without a wind; and a wind with what is usual without one. */
    "mangata: 1\nwater: {choppiness: 0.7, foam: {amount: 1}}\n",
    "mangata: 1\nwater: {wind: 9, choppiness: 0, foam: {amount: 0}}\n",
};
enum { SCENE_COUNT = sizeof scenes / sizeof scenes[0] };

static void a_written_scene_reads_back(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        scene_file *file = parse(scenes[i], NULL, 0);
        char *text = NULL;
        size_t size = 0;
        FILE *stream = open_memstream(&text, &size);
        assert_true(scene_values_write(stream, scene_file_values(file)));
        fclose(stream);
        scene_file *again = parse(text, NULL, 0);
        assert_same_values(scene_file_values(file), scene_file_values(again));
        scene_file_free(again);
        scene_file_free(file);
        free(text);
    }
}

static void words_lead_from_any_scene_to_any_other(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENE_COUNT; i++)
        for (size_t j = 0; j < SCENE_COUNT; j++) {
            scene_file *from = parse(scenes[i], NULL, 0), *to = parse(scenes[j], NULL, 0);
            scene_overrides words;
            assert_true(scene_overrides_between(scene_file_values(from), scene_file_values(to), &words));
            assert_int_equal(words.count == 0, i == j);
            scene_file *changed = parse(scenes[i], (const char *const *)words.words, words.count);
            assert_same_values(scene_file_values(changed), scene_file_values(to));
            scene_overrides_free(&words);
            scene_file_free(changed);
            scene_file_free(from);
            scene_file_free(to);
        }
}

static void one_change_is_one_word(void **state)
{
    (void)state;
    scene_file *file = parse(scenes[1], NULL, 0);
    scene_values values;
    assert_true(scene_values_copy(&values, scene_file_values(file)));
    ((mgt_wave *)values.water.waves.items)[1].phase = 2;
    values.light.elevation_deg = 4.5;
    scene_overrides words;
    assert_true(scene_overrides_between(scene_file_values(file), &values, &words));
    assert_int_equal(words.count, 2);
    assert_string_equal(words.words[0], "light.elevation_deg=4.5");
    assert_string_equal(words.words[1], "water.waves[1].phase=2");
    scene_overrides_free(&words);
    assert_true(((const mgt_wave *)scene_file_values(file)->water.waves.items)[1].phase == 1e-3);
    scene_values_free(&values);
    scene_file_free(file);
}

/* By the names of version 0.1 and by those that were added since: the same values, and one text that is written. */
static void new_names_are_read_as_old_ones(void **state)
{
    (void)state;
    static const struct {
        const char *old, *new, *written;
    } cases[] = {
        {"mangata: 1\nlight: {body: moon}\n", "mangata: 1\nlight: {source: moon}\n", "body: moon"},
        {"mangata: 1\nlight: {elevation_deg: 3, body: moon}\n", "mangata: 1\nlight: {elevation_deg: 3, source: moon}\n", "body: moon"},
        {"mangata: 1\nquality: {refraction: truth}\n", "mangata: 1\nquality: {refraction: path-traced}\n", "refraction: truth"},
        {"mangata: 1\nquality: {method: podee-pixel, kernels: 9}\n", "mangata: 1\nquality: {mixture: 9, method: podee-pixel}\n", "kernels: 9"},
        {"mangata: 1\nquality: {method: podee-pixel, kernels: feline}\n", "mangata: 1\nquality: {method: podee-pixel, mixture: \"feline\"}\n",
         "kernels: feline"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene_file *files[] = {parse(cases[i].old, NULL, 0), parse(cases[i].new, NULL, 0)};
        char *texts[2] = {NULL, NULL};
        assert_same_values(scene_file_values(files[0]), scene_file_values(files[1]));
        for (int k = 0; k < 2; k++) {
            size_t size = 0;
            FILE *stream = open_memstream(&texts[k], &size);
            assert_true(scene_values_write(stream, scene_file_values(files[k])));
            fclose(stream);
        }
        assert_string_equal(texts[0], texts[1]);
        assert_non_null(strstr(texts[1], cases[i].written));
        for (int k = 0; k < 2; k++) {
            free(texts[k]);
            scene_file_free(files[k]);
        }
    }
}

/* --set by either name replaces what the file says by the other. */
static void an_override_goes_by_either_name(void **state)
{
    (void)state;
    static const char *const texts[] = {"mangata: 1\n", "mangata: 1\nlight: {body: sun, elevation_deg: 7}\n", "mangata: 1\nlight: {source: sun}\n"};
    static const char *const words[] = {"light.body=moon", "light.source=moon", "light.body=moon"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        scene_file *files[] = {parse(texts[i], &words[0], 1), parse(texts[i], &words[1], 1)};
        assert_int_equal(scene_file_values(files[0])->light.body, MGT_SOURCE_MOON);
        assert_same_values(scene_file_values(files[0]), scene_file_values(files[1]));
        scene_file_free(files[0]);
        scene_file_free(files[1]);
        static const char *const messages[] = {
            "--set light.source=moon: key \"source\" stands beside \"body\" of --set light.body=moon; \"source\" is the new name of \"body\"; allowed: one of them",
            "--set light.body=moon: key \"body\" stands beside \"source\" of --set light.source=moon; \"source\" is the new name of \"body\"; allowed: one of them"};
        for (int k = 0; k < 2; k++) {
            scene_error error;
            assert_null(scene_file_parse(texts[i], strlen(texts[i]), "test", words + k, 2, &error));
            assert_string_equal(error.text, messages[k]);
        }
    }
    static const char *const both = "mangata: 1\nlight: {body: sun, source: sun}\n";
    scene_error error;
    assert_null(scene_file_parse(both, strlen(both), "test", words, 1, &error));
    assert_non_null(strstr(error.text, "test:2:20: key \"source\" stands beside \"body\""));
}

static void paths_find_their_values(void **state)
{
    (void)state;
    scene_file *file = parse(scenes[1], NULL, 0);
    const scene_values *values = scene_file_values(file);
    const void *at = NULL;
    assert_non_null(scene_values_find(values, "water.waves[1].a", &at));
    assert_ptr_equal(at, &((const mgt_wave *)values->water.waves.items)[1].kx);
    assert_non_null(scene_values_find(values, "camera.position", &at));
    assert_ptr_equal(at, values->camera.still.position);
    static const char *const none[] = {"",       "wave",  "water.waves[2].a", "water.waves[x].a", "water.waves[0]", "camera.position.x", "camera..up",
                                       "light.", ".light"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        assert_null(scene_values_find(values, none[i], &at));
    scene_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_written_scene_reads_back),     cmocka_unit_test(words_lead_from_any_scene_to_any_other), cmocka_unit_test(one_change_is_one_word),
        cmocka_unit_test(new_names_are_read_as_old_ones), cmocka_unit_test(an_override_goes_by_either_name),        cmocka_unit_test(paths_find_their_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
