/* SPDX-License-Identifier: MIT
 * Seas of the public interface: the waves that a scene file's are, to the byte; what is refused; callers of other versions. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mangata/mangata.h"
#include "scene/scene_file.h"

enum { ROOM = MGT_MAX_WAVES };

static mgt_sea sea_now(void)
{
    mgt_sea sea;
    mgt_sea_init(&sea, sizeof sea);
    return sea;
}

/* The scene that the sea makes is that of a file with this water. */
static void assert_as_file(const mgt_sea *sea, const char *water)
{
    char text[512];
    snprintf(text, sizeof text, "mangata: 1\n%s\n", water);
    scene_error error;
    scene_file *file = scene_file_parse(text, strlen(text), "s.yaml", NULL, 0, &error);
    if (!file)
        fail_msg("%s", error.text);
    mgt_scene expected, scene;
    assert_true(scene_file_frame(file, 0, &expected));
    static mgt_wave waves[ROOM];
    mgt_scene_init(&scene, sizeof scene);
    assert_int_equal(mgt_sea_scene(sea, waves, ROOM, &scene), MGT_OK);
    assert_int_equal(scene.water.wave_count, expected.water.wave_count);
    assert_int_equal(mgt_sea_wave_count(sea), expected.water.wave_count);
    assert_memory_equal(waves, expected.water.waves, expected.water.wave_count * sizeof *waves);
    assert_ptr_equal(scene.water.waves, waves);
    assert_true(scene.water.choppiness == expected.water.choppiness && scene.foam == expected.foam && scene.aerial == expected.aerial);
    scene_file_free(file);
}

static void seas_are_those_of_files(void **unused)
{
    (void)unused;
    mgt_sea sea = sea_now();
    assert_as_file(&sea, "water: {wind: 10}");
    sea.wind = 14;
    sea.direction_deg = 40;
    sea.fetch = 5e4;
    sea.count = 70;
    sea.seed = 9;
    sea.foam = 2;
    assert_as_file(&sea, "water: {wind: {speed: 14, direction_deg: 40, fetch: 5e4, count: 70, seed: 9}, foam: {amount: 2}}");
    sea.depth = 9;
    sea.choppiness = 0.25f;
    sea.foam = 0;
    assert_as_file(&sea, "water: {wind: {speed: 14, direction_deg: 40, fetch: 5e4, depth: 9, count: 70, seed: 9}, choppiness: 0.25, foam: {amount: 0}}");

    mgt_swell swells[2];
    mgt_swell_init(&swells[0]);
    mgt_swell_init(&swells[1]);
    swells[0].height = 2;
    swells[0].direction_deg = 250;
    swells[1] = (mgt_swell){.height = 0.6, .period = 5, .direction_deg = 40, .spread = 20, .count = 10, .seed = 1};
    sea = sea_now();
    sea.wind = 3;
    sea.swells = swells;
    sea.swell_count = 2;
    const char *two = "water: {wind: 3, swell: [{height: 2, direction_deg: 250}, {height: 0.6, period: 5, direction_deg: 40, spread: 20, count: 10}]}";
    assert_as_file(&sea, two);
    sea.wind = 0;
    sea.choppiness = 0;
    assert_as_file(&sea, "water: {swell: [{height: 2, direction_deg: 250}, {height: 0.6, period: 5, direction_deg: 40, spread: 20, count: 10}]}");

    sea = sea_now();
    sea.spectrum = MGT_SPECTRUM_JONSWAP;
    sea.spreading = MGT_SPREADING_FIXED;
    sea.fetch = 2e4;
    sea.gamma = 5;
    sea.cox_munk = 0;
    sea.count = 33;
    assert_as_file(
        &sea,
        "sky: {aerial: on}\nwater: {choppiness: 0.7, foam: {amount: 1}, spectrum: {model: jonswap, wind: 10, fetch: 2e4, gamma: 5, count: 33, directions: fixed}}");
    sea.spectrum = MGT_SPECTRUM_PIERSON_MOSKOWITZ;
    sea.spreading = MGT_SPREADING_DONELAN_BANNER;
    assert_as_file(
        &sea,
        "sky: {aerial: on}\nwater: {choppiness: 0.7, foam: {amount: 1}, spectrum: {model: pierson-moskowitz, wind: 10, count: 33, directions: donelan-banner}}");
}

static float foam_of(mgt_sea sea, mgt_spectrum spectrum, double wind_height)
{
    static mgt_wave waves[ROOM];
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    sea.spectrum = spectrum;
    sea.wind_height = wind_height;
    assert_int_equal(mgt_sea_scene(&sea, waves, ROOM, &scene), MGT_OK);
    return scene.foam;
}

/* Foam follows the wind at 10 m by a logarithmic profile, whatever the spectrum and the height at which the wind is given. */
static void foam_follows_the_wind_at_ten_metres(void **unused)
{
    (void)unused;
    static const struct {
        mgt_spectrum spectrum;
        const char *model;
        double given, height;
    } cases[] = {{MGT_SPECTRUM_AUTO, NULL, 0, 10},
                 {MGT_SPECTRUM_AUTO, NULL, 100, 100},
                 {MGT_SPECTRUM_ELFOUHAILY, "elfouhaily", 0, 10},
                 {MGT_SPECTRUM_ELFOUHAILY, "elfouhaily", 100, 100},
                 {MGT_SPECTRUM_PIERSON_MOSKOWITZ, "pierson-moskowitz", 0, 19.5},
                 {MGT_SPECTRUM_PIERSON_MOSKOWITZ, "pierson-moskowitz", 2, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        mgt_sea sea = sea_now();
        sea.wind = 15;
        const double at_ten = 15 / (1 + sqrt(1.3e-3) / 0.4 * log(cases[i].height / 10)), expected = 3.84e-6 * pow(at_ten, 3.41);
        const double foam = (double)foam_of(sea, cases[i].spectrum, cases[i].given);
        if (!(fabs(foam / expected - 1) < 1e-6))
            fail_msg("case %zu: %.9g, not %.9g", i, foam, expected);
        if (!cases[i].model)
            continue;
        char water[256];
        sea.spectrum = cases[i].spectrum;
        sea.spreading = MGT_SPREADING_MITSUYASU;
        sea.fetch = sea.spectrum == MGT_SPECTRUM_ELFOUHAILY ? 5e4 : 0;
        sea.wind_height = cases[i].given;
        snprintf(
            water, sizeof water,
            "sky: {aerial: on}\nwater: {choppiness: 0.7, foam: {amount: 1}, spectrum: {model: %s, wind: 15, wind_height: %g, count: 160, slope: cox-munk%s}}",
            cases[i].model, cases[i].given, cases[i].spectrum == MGT_SPECTRUM_ELFOUHAILY ? ", fetch: 5e4" : ", directions: mitsuyasu");
        assert_as_file(&sea, water);
    }
}

/* Under the sun the caller's stars and night tint are left alone. */
static void night_is_set_under_the_moon_alone(void **unused)
{
    (void)unused;
    static mgt_wave waves[ROOM];
    const mgt_sea sea = sea_now();
    for (int i = 0; i < 4; i++) {
        mgt_scene scene;
        mgt_scene_init(&scene, sizeof scene);
        const bool moon = i & 1, before = i & 2;
        scene.light.body = moon ? MGT_SOURCE_MOON : MGT_SOURCE_SUN;
        scene.stars = scene.night_tint = before;
        assert_int_equal(mgt_sea_scene(&sea, waves, ROOM, &scene), MGT_OK);
        assert_int_equal(scene.stars, moon || before);
        assert_int_equal(scene.night_tint, moon || before);
    }
}

static void every_wind_makes_a_sea(void **unused)
{
    (void)unused;
    static mgt_wave waves[ROOM];
    mgt_sea sea = sea_now();
    for (sea.wind = 1.5; sea.wind <= 75; sea.wind *= 1.4) {
        assert_int_equal(mgt_sea_waves(&sea, waves, ROOM), MGT_OK);
        for (size_t i = 0; i < sea.count; i++)
            assert_true(isfinite(waves[i].amplitude) && waves[i].amplitude >= 0);
    }
}

/* Refused with these words, and nothing is written. */
static void assert_refused(const mgt_sea *sea, size_t room, mgt_status status, const char *words)
{
    static mgt_wave waves[ROOM], before[ROOM];
    memset(waves, 0x3c, sizeof waves);
    memset(before, 0x3c, sizeof before);
    mgt_scene scene, old;
    mgt_scene_init(&scene, sizeof scene);
    memcpy(&old, &scene, sizeof old);
    assert_int_equal(mgt_sea_scene(sea, waves, room, &scene), status);
    if (!strstr(mgt_last_error(NULL), words))
        fail_msg("\"%s\" lacks \"%s\"", mgt_last_error(NULL), words);
    assert_memory_equal(waves, before, sizeof waves);
    assert_memory_equal(&scene, &old, sizeof old);
}

#define WITH(statement, room, status, words)       \
    do {                                           \
        mgt_sea sea = sea_now();                   \
        statement;                                 \
        assert_refused(&sea, room, status, words); \
    } while (0)

static void bad_seas_are_refused(void **unused)
{
    (void)unused;
    mgt_swell swell;
    mgt_swell_init(&swell);
    WITH(sea.wind = 0.4, ROOM, MGT_ERROR_SCENE, "sea.wind is 0.4; allowed is ");
    WITH(sea.wind = (double)NAN, ROOM, MGT_ERROR_SCENE, "sea.wind is nan");
    WITH(sea.wind = 76, ROOM, MGT_ERROR_SCENE, "sea.wind is 76");
    WITH(sea.wind_height = 1.5e-4, ROOM, MGT_ERROR_SCENE, "sea.wind_height is 0.00015; allowed is a number, 0 or 0.5 to 200 m");
    WITH(sea.wind_height = 0.49, ROOM, MGT_ERROR_SCENE, "sea.wind_height is 0.49");
    WITH(sea.wind_height = -1, ROOM, MGT_ERROR_SCENE, "sea.wind_height is -1");
    WITH(sea.wind_height = (double)NAN, ROOM, MGT_ERROR_SCENE, "sea.wind_height is nan");
    WITH(sea.fetch = 3, ROOM, MGT_ERROR_SCENE, "sea.fetch is 3");
    WITH(sea.shortest = 5e-5, ROOM, MGT_ERROR_SCENE, "sea.shortest is 5e-5; allowed is a number, 0 or 0.0001 to 1000 m");
    WITH(sea.fetch = 200, ROOM, MGT_ERROR_SCENE, "sea.fetch is 200 m, too short");
    WITH(sea.spectrum = (mgt_spectrum)9, ROOM, MGT_ERROR_SCENE, "sea.spectrum");
    WITH(sea.spreading = (mgt_spreading)-1, ROOM, MGT_ERROR_SCENE, "sea.spreading");
    WITH(sea.spectrum = MGT_SPECTRUM_JONSWAP, ROOM, MGT_ERROR_SCENE, "sea.fetch is 0; spectrum jonswap needs one");
    WITH((sea.spectrum = MGT_SPECTRUM_TMA, sea.fetch = 1e5), ROOM, MGT_ERROR_SCENE, "sea.depth is 0");
    WITH(sea.count = 0, ROOM, MGT_ERROR_SCENE, "sea.count is 0");
    WITH(sea.choppiness = 1.5f, ROOM, MGT_ERROR_SCENE, "sea.choppiness is 1.5");
    WITH(sea.foam = -1, ROOM, MGT_ERROR_SCENE, "sea.foam is -1");
    WITH(sea.cox_munk = 2, ROOM, MGT_ERROR_SCENE, "sea.cox_munk is 2");
    WITH(sea.swell_count = 1, ROOM, MGT_ERROR_ARGUMENT, "sea.swells is NULL");
    WITH((sea.swell_count = 17, sea.swells = &swell), ROOM, MGT_ERROR_SCENE, "sea.swell_count is 17");
    WITH((sea.swell_count = 1, sea.swells = &swell, swell.period = 0), ROOM, MGT_ERROR_SCENE, "sea.swells[0].period is 0");
    swell.period = 12;
    WITH((sea.swell_count = 1, sea.swells = &swell, sea.count = MGT_MAX_WAVES), ROOM, MGT_ERROR_SCENE, "at most");
    WITH((void)0, 159, MGT_ERROR_ARGUMENT, "the sea has 160 waves, and there is room for 159");
    WITH(sea.struct_size = 8, ROOM, MGT_ERROR_ARGUMENT, "struct_size is 8");
    assert_int_equal(mgt_sea_waves(NULL, NULL, 0), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_sea_wave_count(NULL), 0);
    mgt_sea sea = sea_now();
    sea.choppiness = 1.5f;
    assert_int_equal(mgt_sea_wave_count(&sea), 0);
    sea = sea_now();
    assert_int_equal(mgt_sea_waves(&sea, NULL, ROOM), MGT_ERROR_ARGUMENT);
    static mgt_wave waves[ROOM];
    assert_int_equal(mgt_sea_scene(&sea, waves, ROOM, NULL), MGT_ERROR_ARGUMENT);
    mgt_swell_init(NULL);
    mgt_sea_init(NULL, 0);
}

/* A program of a later version has a larger struct: what this library does not know must be 0. */
static void other_versions_are_served(void **unused)
{
    (void)unused;
    static mgt_wave waves[ROOM];
    union {
        mgt_sea sea;
        unsigned char bytes[sizeof(mgt_sea) + 64];
    } later;
    memset(&later, 0x7e, sizeof later);
    mgt_sea_init(&later.sea, sizeof(mgt_sea) + 32);
    for (size_t i = sizeof(mgt_sea); i < sizeof(mgt_sea) + 32; i++)
        assert_int_equal(later.bytes[i], 0);
    assert_int_equal(later.bytes[sizeof(mgt_sea) + 32], 0x7e);
    assert_int_equal(mgt_sea_waves(&later.sea, waves, ROOM), MGT_OK);
    later.bytes[sizeof(mgt_sea) + 8] = 1;
    assert_int_equal(mgt_sea_waves(&later.sea, waves, ROOM), MGT_ERROR_ARGUMENT);

    /* The first version of a scene ends where sample_slots does. */
    const size_t first = offsetof(mgt_scene, quality.sample_slots) + sizeof(uint64_t);
    mgt_scene *scene = malloc(sizeof *scene);
    assert_non_null(scene);
    memset(scene, 0x7e, sizeof *scene);
    mgt_scene_init(scene, first);
    const mgt_sea sea = sea_now();
    assert_int_equal(mgt_sea_scene(&sea, waves, ROOM, scene), MGT_OK);
    assert_true(scene->water.wave_count == 160 && scene->aerial && scene->foam > 0);
    for (size_t i = first; i < sizeof *scene; i++)
        assert_int_equal(((const unsigned char *)scene)[i], 0x7e);
    free(scene);
}

/* Foam of mgt_water_query() against foam that method `none` draws at the same points, seen straight down. */
static void foam_is_where_it_is_drawn(void **unused)
{
    (void)unused;
    enum { SIDE = 96 };
    static mgt_wave waves[ROOM];
    static float drawn[SIDE * SIDE], asked[SIDE * SIDE];
    static double rays[SIDE * SIDE][6], distance[SIDE * SIDE], points[SIDE * SIDE][2];
    mgt_sea sea = sea_now();
    sea.wind = 16;
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    assert_int_equal(mgt_sea_scene(&sea, waves, ROOM, &scene), MGT_OK);
    scene.image = (mgt_image){.width = SIDE, .height = SIDE};
    scene.camera = (mgt_camera){.position = {500, 40, -300}, .target = {500, 0, -300}, .up = {0, 0, -1}, .fov_y_deg = 60};
    scene.time = 7;
    scene.quality.method = MGT_METHOD_NONE;
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.layer = MGT_LAYER_FOAM;
    target.format = MGT_FORMAT_R32F;
    target.pixels = drawn;
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_OK);
    mgt_context_destroy(context);

    const double pixel = 2 * tan(30 * 3.14159265358979323846 / 180) / SIDE;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double ray[6] = {500, 40, -300, (i % SIDE + 0.5 - SIDE / 2) * pixel, -1, (i / SIDE + 0.5 - SIDE / 2) * pixel};
        memcpy(rays[i], ray, sizeof ray);
    }
    assert_int_equal(mgt_water_trace(&scene.water, scene.time, rays[0], SIDE * SIDE, 100, distance), MGT_OK);
    for (int i = 0; i < SIDE * SIDE; i++)
        for (int c = 0; c < 2; c++)
            points[i][c] = rays[i][2 * c] + distance[i] * rays[i][3 + 2 * c];
    mgt_water_answers answers;
    mgt_water_answers_init(&answers, sizeof answers);
    answers.exact = 1;
    answers.foam = asked;
    answers.foam_share = scene.foam;
    assert_int_equal(mgt_water_query(&scene.water, scene.time, points[0], SIDE * SIDE, &answers), MGT_OK);
    double mean = 0;
    int off = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        mean += (double)asked[i] / (SIDE * SIDE);
        off += fabsf(asked[i] - drawn[i]) > 0.01f;
    }
    assert_true(mean > 0.01 && mean < 0.2);
    if (off > SIDE * SIDE / 1000) /* edges of fresh foam are steps */
        fail_msg("%d of %d points are off", off, SIDE * SIDE);

    /* In blocks of points, without choppiness, with foam_share 0, and for a point that is not finite. */
    float some[3], height[3];
    memset(height, 0, sizeof height);
    answers.foam = some;
    assert_int_equal(mgt_water_query(&scene.water, scene.time, points[4000], 3, &answers), MGT_OK);
    assert_memory_equal(some, asked + 4000, sizeof some);
    answers.foam_share = 0;
    assert_int_equal(mgt_water_query(&scene.water, scene.time, points[0], 3, &answers), MGT_OK);
    assert_memory_equal(some, height, sizeof some);
    answers.foam_share = 0.1f;
    scene.water.choppiness = 0;
    points[1][0] = (double)NAN;
    assert_int_equal(mgt_water_query(&scene.water, scene.time, points[0], 3, &answers), MGT_OK);
    assert_true(some[0] == 0 && isnan(some[1]) && some[2] == 0);
    answers.foam_share = 0.6f;
    assert_int_equal(mgt_water_query(&scene.water, scene.time, points[0], 3, &answers), MGT_ERROR_ARGUMENT);
    answers.foam_share = 0.1f;
    answers.foam_persistence = (float)NAN;
    assert_int_equal(mgt_water_query(&scene.water, scene.time, points[0], 3, &answers), MGT_ERROR_ARGUMENT);
}

static void names_go_both_ways(void **unused)
{
    (void)unused;
    mgt_spectrum spectrum = MGT_SPECTRUM_AUTO;
    mgt_spreading spreading = MGT_SPREADING_MITSUYASU;
    assert_true(mgt_spectrum_from_name("elfouhaily", &spectrum) && spectrum == MGT_SPECTRUM_ELFOUHAILY);
    assert_true(mgt_spreading_from_name("fixed", &spreading) && spreading == MGT_SPREADING_FIXED);
    assert_string_equal(mgt_spectrum_name(MGT_SPECTRUM_PIERSON_MOSKOWITZ), "pierson-moskowitz");
    assert_string_equal(mgt_spreading_name(MGT_SPREADING_DONELAN_BANNER), "donelan-banner");
    assert_false(mgt_spectrum_from_name("buoy", &spectrum));
    assert_null(mgt_spectrum_name((mgt_spectrum)5));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(seas_are_those_of_files),
                                       cmocka_unit_test(foam_follows_the_wind_at_ten_metres),
                                       cmocka_unit_test(night_is_set_under_the_moon_alone),
                                       cmocka_unit_test(every_wind_makes_a_sea),
                                       cmocka_unit_test(bad_seas_are_refused),
                                       cmocka_unit_test(other_versions_are_served),
                                       cmocka_unit_test(foam_is_where_it_is_drawn),
                                       cmocka_unit_test(names_go_both_ways)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
