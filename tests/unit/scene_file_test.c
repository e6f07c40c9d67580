/* SPDX-License-Identifier: MIT
 *
 * Scene files that are good: values, defaults, frames, camera paths, overrides, the canonical text.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_file.h"
#include "scene/scene_tree.h"

#define DATA MGT_SOURCE_DIR "/tests/data/scenes/"
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static scene_file *load(const char *path, const char *const *overrides, size_t count)
{
    scene_error error;
    scene_file *file = scene_file_load(path, overrides, count, &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    assert_int_equal(error.kind, SCENE_ERROR_NONE);
    return file;
}

static scene_file *parse(const char *text, const char *const *overrides, size_t count)
{
    scene_error error;
    scene_file *file = scene_file_parse(text, strlen(text), "test", overrides, count, &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    return file;
}

static mgt_scene frame_of(const scene_file *file, int frame)
{
    mgt_scene scene;
    assert_true(scene_file_frame(file, frame, &scene));
    return scene;
}

static void assert_vector(const double vector[3], double x, double y, double z) { assert_true(vector[0] == x && vector[1] == y && vector[2] == z); }

static void assert_color(const float color[3], float r, float g, float b) { assert_true(color[0] == r && color[1] == g && color[2] == b); }

static void smallest_file_has_every_default(void **state)
{
    (void)state;
    scene_file *file = parse("mangata: 1", NULL, 0);
    mgt_scene scene = frame_of(file, 0), defaults;
    mgt_scene_init(&defaults, sizeof defaults);
    assert_int_equal(scene.struct_size, sizeof scene);
    assert_int_equal(scene.image.width, 1280);
    assert_int_equal(scene.image.height, 720);
    assert_vector(scene.camera.position, 0, 4, 0);
    assert_vector(scene.camera.target, 0, 3.84, -0.987);
    assert_vector(scene.camera.up, 0, 1, 0);
    assert_true(scene.camera.fov_y_deg == 50);
    assert_false(scene.camera_moves);
    assert_true(scene.time == 0);
    assert_true(scene.shutter == 1.0 / 30);
    assert_int_equal(scene.light.body, defaults.light.body);
    assert_true(scene.light.elevation_deg == defaults.light.elevation_deg);
    assert_true(scene.light.azimuth_deg == defaults.light.azimuth_deg);
    assert_true(scene.light.angular_radius_deg == defaults.light.angular_radius_deg);
    assert_memory_equal(scene.light.radiance, defaults.light.radiance, sizeof defaults.light.radiance);
    assert_memory_equal(&scene.sky, &defaults.sky, sizeof scene.sky);
    assert_null(scene.water.waves);
    assert_int_equal(scene.water.wave_count, 0);
    assert_true(scene.water.index_of_refraction == 1.333);
    assert_memory_equal(scene.water.body_albedo, defaults.water.body_albedo, sizeof defaults.water.body_albedo);
    assert_int_equal(scene.post.auto_exposure, defaults.post.auto_exposure);
    assert_true(scene.post.exposure_ev == defaults.post.exposure_ev);
    assert_int_equal(scene.post.tone_map, defaults.post.tone_map);
    assert_true(scene.post.glare == defaults.post.glare);
    assert_memory_equal(&scene.quality, &defaults.quality, sizeof scene.quality);
    assert_int_equal(scene_file_frame_count(file), 1);
    assert_string_equal(scene_file_description(file), "");
    assert_string_equal(scene_file_path(file), "test");
    scene_file_free(file);
}

static void every_key_is_read(void **state)
{
    (void)state;
    scene_file *file = load(DATA "full.yaml", NULL, 0);
    mgt_scene scene = frame_of(file, 24);
    assert_string_equal(scene_file_description(file), "every key");
    assert_int_equal(scene_file_frame_count(file), 48);
    assert_true(scene_file_fps(file) == 23.976);
    assert_true(scene_file_start(file) == 2.5);
    assert_true(scene.time == 2.5 + 24 / 23.976);
    assert_true(scene.shutter == 0.5 / 23.976);
    assert_int_equal(scene.image.width, 320);
    assert_int_equal(scene.image.height, 180);
    assert_vector(scene.camera.position, 1, 5, 2);
    assert_vector(scene.camera.target, 1.5, 4.5, -7);
    assert_vector(scene.camera.up, 0.1, 1, 0);
    assert_true(scene.camera.fov_y_deg == 35.5);
    assert_int_equal(scene.light.body, MGT_SOURCE_MOON);
    assert_true(scene.light.elevation_deg == 12 && scene.light.azimuth_deg == -20);
    assert_true(scene.light.angular_radius_deg == 0.5);
    assert_color(scene.light.radiance, 3, 2, 1);
    assert_int_equal(scene.sky.model, MGT_SKY_GRADIENT);
    assert_true(scene.sky.turbidity == 4);
    assert_color(scene.sky.zenith, 0.1f, 0.2f, 0.3f);
    assert_color(scene.sky.horizon, 0.4f, 0.5f, 0.6f);
    assert_color(scene.sky.night, 1e-3f, 2e-3f, 3e-3f);
    assert_int_equal(scene.water.wave_count, 2);
    assert_int_equal(scene_file_wave_count(file), 2);
    const mgt_wave *waves = scene.water.waves;
    assert_true(waves[0].amplitude == 0.02 && waves[0].kx == 1.5 && waves[0].kz == 0.3 && waves[0].omega == -3.8 && waves[0].phase == 0.7);
    assert_true(waves[1].amplitude == 0.01 && waves[1].kx == -2 && waves[1].kz == 0.5 && waves[1].omega == 4 && waves[1].phase == 0);
    assert_true(scene.water.index_of_refraction == 1.34);
    assert_color(scene.water.body_albedo, 0.1f, 0.2f, 0.3f);
    assert_false(scene.post.auto_exposure);
    assert_true(scene.post.exposure_ev == -2.5);
    assert_int_equal(scene.post.tone_map, MGT_TONE_ACES);
    assert_true(scene.post.glare == 0.25f);
    scene_file_free(file);
}

static void standard_scenes_load(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        size_t waves;
        double position_y, angular_radius, elevation;
    } scenes[] = {
        {"simple", 5, 4, 2, 18},      {"smooth", 64, 4, 2, 18},        {"medium", 48, 4, 2, 18},     {"high", 32, 4, 2, 18},
        {"sunset", 64, 6, 0.2665, 7}, {"moonlit", 48, 12, 0.2590, 35}, {"rough", 64, 6, 0.2665, 12},
    };
    for (size_t i = 0; i < COUNT(scenes); i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/scenes/%s.json", MGT_SOURCE_DIR, scenes[i].name);
        scene_file *file = load(path, NULL, 0);
        mgt_scene scene = frame_of(file, 59);
        assert_int_equal(scene.water.wave_count, scenes[i].waves);
        assert_true(scene.camera.position[1] == scenes[i].position_y);
        assert_true(scene.light.angular_radius_deg == scenes[i].angular_radius);
        assert_true(scene.light.elevation_deg == scenes[i].elevation);
        assert_int_equal(scene_file_frame_count(file), 60);
        assert_true(scene.time == 10 + 59 / 30.0);
        scene_file_free(file);
    }
}

static void unusual_scenes_are_legal(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "mangata: 1\nwater: {waves: []}",
        "mangata: 1\nwater: {}",
        "mangata: 1\nlight: {elevation_deg: -18}",
        "mangata: 1\ntime: {shutter: 0}",
        "mangata: 1\nlight: {radiance: [0, 0, 0]}",
        "mangata: 1\ntime: {fps: 29.97}",
        "mangata: 1.0",
        "mangata: 1\ncamera: {path: []}",
        "{\n\t\"mangata\": 1,\n\t\"image\": {\n\t\t\"width\": 4\n\t}\n}\n",
        "\xef\xbb\xbfmangata: 1\r\nimage:\r\n  width: 5\r\n",
        "%YAML 1.2\n---\nmangata: 1\n...\n",
        "mangata: 1\ndescription: |\n  Several lines:\n  {of: text}\n",
        "mangata: 1\nimage: {width: 16384, height: 16384}",
        "mangata: 1\npost: {exposure: auto, exposure_offset: 1.5}",
        "mangata: 1\npost: {exposure: 2, exposure_offset: 0}",
        "mangata: 1\ncamera: {position: [0, 9, 0], target: [0, 0, 0], up: [0, 0, -1]}",
    };
    for (size_t i = 0; i < COUNT(texts); i++) {
        scene_file *file = parse(texts[i], NULL, 0);
        frame_of(file, 0);
        scene_file_free(file);
    }
}

static void body_sets_the_defaults_of_the_light(void **state)
{
    (void)state;
    mgt_light moon;
    mgt_light_init(&moon, MGT_SOURCE_MOON);
    scene_file *file = parse("mangata: 1\nlight: {elevation_deg: 4, body: moon}", NULL, 0);
    mgt_scene scene = frame_of(file, 0);
    assert_true(scene.light.elevation_deg == 4);
    assert_true(scene.light.angular_radius_deg == moon.angular_radius_deg);
    assert_memory_equal(scene.light.radiance, moon.radiance, sizeof moon.radiance);
    scene_file_free(file);
}

static void overrides_replace_add_and_append(void **state)
{
    (void)state;
    static const char *const overrides[] = {
        "light.elevation_deg=3",     "light.body=moon",  "water.waves[1].amplitude=.1",
        "camera.position=[0, 9, 1]", "camera.up[0]=0",   "water.waves[2]={amplitude: 1, a: 1, b: 1, c: 1}",
        "sky={model: black}",        "image.width=0x10", "image.width=64",
        "description='a=b'",
    };
    scene_file *file = load(DATA "full.yaml", overrides, COUNT(overrides));
    mgt_scene scene = frame_of(file, 0), defaults;
    mgt_scene_init(&defaults, sizeof defaults);
    assert_true(scene.light.elevation_deg == 3 && scene.light.azimuth_deg == -20);
    assert_int_equal(scene.light.body, MGT_SOURCE_MOON);
    assert_true(scene.water.waves[0].amplitude == 0.02 && scene.water.waves[1].amplitude == 0.1);
    assert_true(scene.water.waves[1].kx == -2);
    assert_int_equal(scene.water.wave_count, 3);
    assert_vector(scene.camera.position, 0, 9, 1);
    assert_vector(scene.camera.up, 0, 1, 0);
    assert_int_equal(scene.sky.model, MGT_SKY_BLACK);
    assert_true(scene.sky.turbidity == defaults.sky.turbidity); /* the whole mapping was replaced */
    assert_int_equal(scene.image.width, 64);
    assert_string_equal(scene_file_description(file), "a=b");
    scene_file_free(file);

    static const char *const from_nothing[] = {"light.body=moon", "water.waves[0]={amplitude: .1, a: 1, b: 0, c: 1}", "time.frames=3"};
    file = parse("mangata: 1", from_nothing, COUNT(from_nothing));
    scene = frame_of(file, 2);
    assert_true(scene.light.angular_radius_deg == 0.2590);
    assert_int_equal(scene.water.wave_count, 1);
    assert_int_equal(scene_file_frame_count(file), 3);
    scene_file_free(file);
}

/* Methods have the names of the command, and a number in the name is the number beside it. */
static void methods_have_the_names_of_the_command(void **state)
{
    (void)state;
    static const struct {
        const char *quality, *override;
        mgt_method method;
        uint32_t spatial, time;
    } cases[] = {
        {"{method: ssaa7}", NULL, MGT_METHOD_SSAA, 7, 1},
        {"{method: \"ssaa1024\", time_samples: 3}", NULL, MGT_METHOD_SSAA, 1024, 3},
        {"{method: ssaa}", NULL, MGT_METHOD_SSAA, 4, 1},
        {"{spatial: 7, method: ssaa}", NULL, MGT_METHOD_SSAA, 7, 1},
        {"{method: ssaa7}", "quality.spatial=3", MGT_METHOD_SSAA, 3, 1},
        {"{method: none}", "quality.method=ssaa2", MGT_METHOD_SSAA, 2, 1},
        {"{method: ssaa7}", "quality.method=reference", MGT_METHOD_REFERENCE, 8, 8},
        {"{method: reference, spatial: 5}", NULL, MGT_METHOD_REFERENCE, 5, 8},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char text[128];
        snprintf(text, sizeof text, "mangata: 1\nquality: %s\n", cases[i].quality);
        scene_file *file = parse(text, &cases[i].override, cases[i].override != NULL ? 1 : 0);
        const mgt_quality q = frame_of(file, 0).quality;
        if (q.method != cases[i].method || q.spatial_samples != cases[i].spatial || q.time_samples != cases[i].time)
            fail_msg("%s: %s with %u and %u samples", cases[i].quality, mgt_method_name(q.method), q.spatial_samples, q.time_samples);
        scene_file_free(file);
    }
}

/* Seeds have all their 64 bits, however they are written. */
static void large_numbers_are_not_rounded(void **state)
{
    (void)state;
    static const struct {
        const char *override;
        uint64_t seed;
    } cases[] = {{"quality.seed=11400714819323198485", 0x9e3779b97f4a7c15},
                 {"quality.seed=0x9E3779B97f4a7c15", 0x9e3779b97f4a7c15},
                 {"quality.seed=0xffffffffffffffff", UINT64_MAX},
                 {"quality.seed=0o1777777777777777777777", UINT64_MAX},
                 {"quality.seed=0000000000000000000000007", 7},
                 {"quality.seed=1e3", 1000}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        scene_file *file = parse("mangata: 1\n", &cases[i].override, 1);
        if (frame_of(file, 0).quality.seed != cases[i].seed)
            fail_msg("%s: %llu", cases[i].override, (unsigned long long)frame_of(file, 0).quality.seed);
        scene_file_free(file);
    }
}

static void camera_path_passes_its_keyframes(void **state)
{
    (void)state;
    scene_file *file = load(DATA "path.yaml", NULL, 0);
    mgt_scene scene = frame_of(file, 0);
    assert_vector(scene.camera.position, 0, 0.5, 0);
    assert_false(scene.camera_moves); /* before the first keyframe it rests */
    scene = frame_of(file, 10);
    assert_true(scene.camera_moves);
    assert_vector(scene.camera.position, 1, 8, 0);
    assert_true(scene.camera.fov_y_deg == 40);
    scene = frame_of(file, 30);
    assert_vector(scene.camera.position, 5, 0.5, 2);
    assert_vector(scene.camera.target, 0, 0, -12);
    assert_true(scene.camera.fov_y_deg == 60);
    scene = frame_of(file, 90);
    assert_vector(scene.camera.position, 6, 0.5, 2);
    assert_false(scene.camera_moves);

    scene = frame_of(file, 15);
    mgt_scene earlier = frame_of(file, 14);
    assert_true(scene.camera_open.position[0] > earlier.camera.position[0]); /* half a frame before 15 */
    assert_true(scene.camera_open.position[0] < scene.camera.position[0]);
    scene_file_free(file);
}

static void camera_path_is_smooth_and_never_leaves_its_heights(void **state)
{
    (void)state;
    static const char *const fine[] = {"time.fps=1000", "time.frames=4001", "time.shutter=1"};
    scene_file *file = load(DATA "path.yaml", fine, COUNT(fine));
    double last_step[3] = {0};
    for (int frame = 1; frame <= 4000; frame++) {
        mgt_scene scene = frame_of(file, frame);
        assert_true(scene.camera.position[1] >= 0.5 && scene.camera.position[1] <= 8);
        assert_true(scene.camera.fov_y_deg >= 40 && scene.camera.fov_y_deg <= 60);
        for (int i = 0; i < 3; i++) {
            double step = scene.camera.position[i] - scene.camera_open.position[i];
            if (frame > 1)
                assert_true(fabs(step - last_step[i]) < 2e-4); /* a velocity's jump of 0.2 m/s at most, where speeds reach 11 */
            last_step[i] = step;
        }
    }
    scene_file_free(file);
}

static void evenly_spaced_keyframes_make_a_straight_steady_path(void **state)
{
    (void)state;
    scene_file *file = parse("mangata: 1\ntime: {fps: 8, frames: 25}\ncamera:\n  path:\n"
                             "    - {time: 0, position: [0, 1, 0], target: [0, 1, -1]}\n"
                             "    - {time: 1, position: [2, 3, 4], target: [2, 3, 3]}\n"
                             "    - {time: 3, position: [6, 7, 12], target: [6, 7, 11]}\n",
                             NULL, 0);
    for (int frame = 0; frame <= 24; frame++) {
        mgt_scene scene = frame_of(file, frame);
        double t = frame / 8.0;
        assert_true(fabs(scene.camera.position[0] - 2 * t) < 1e-12);
        assert_true(fabs(scene.camera.position[1] - (1 + 2 * t)) < 1e-12);
        assert_true(fabs(scene.camera.target[2] - (4 * t - 1)) < 1e-12);
    }
    scene_file_free(file);
}

static void negative_frames_are_refused(void **state)
{
    (void)state;
    scene_file *file = parse("mangata: 1", NULL, 0);
    mgt_scene scene = {.struct_size = 77};
    assert_false(scene_file_frame(file, -1, &scene));
    assert_int_equal(scene.struct_size, 77);
    assert_true(scene_file_frame(file, 1000, &scene));
    scene_file_free(file);
    scene_file_free(NULL);
}

static char *canonical(const char *text, const char *override)
{
    scene_file *file = parse(text, &override, override != NULL ? 1 : 0);
    size_t length = 0;
    char *result = scene_file_canonical(file, &length);
    assert_non_null(result);
    assert_int_equal(length, strlen(result));
    scene_file_free(file);
    return result;
}

static bool same_canonical(const char *left, const char *left_override, const char *right, const char *right_override)
{
    char *a = canonical(left, left_override), *b = canonical(right, right_override);
    bool same = strcmp(a, b) == 0;
    free(a);
    free(b);
    return same;
}

static void canonical_text_knows_values_not_spelling(void **state)
{
    (void)state;
    static const char base[] = "mangata: 1\nlight: {elevation_deg: 3, azimuth_deg: 0}\n";
    assert_true(same_canonical(base, NULL, "{\"light\": {\"azimuth_deg\": -0.0, \"elevation_deg\": 3e0}, \"mangata\": 1}", NULL));
    assert_true(same_canonical(base, NULL, "mangata: 1", "light={elevation_deg: 3}"));
    assert_true(same_canonical(base, NULL, base, "description=words"));
    assert_true(same_canonical(base, NULL, base, "time.frames=900"));
    assert_true(same_canonical(base, NULL, base, "image.width=1280"));
    static const char *const changes[] = {
        "image.width=1281",
        "image.height=1",
        "camera.position=[0, 4.000000000000001, 0]",
        "camera.target=[0, 0, -1]",
        "camera.up=[0.1, 1, 0]",
        "camera.fov_y_deg=50.5",
        "time.start=1e-9",
        "time.fps=30.001",
        "time.shutter=0",
        "light.body=moon",
        "light.elevation_deg=3.0000000000000004",
        "light.azimuth_deg=1",
        "light.angular_radius_deg=1",
        "light.radiance=[0, 0, 0]",
        "sky.model=black",
        "sky.turbidity=1.5",
        "sky.zenith=[0, 0, 0]",
        "sky.horizon=[0, 0, 0]",
        "sky.night=[0, 0, 0]",
        "water.waves=[{amplitude: 0, a: 0, b: 0, c: 0}]",
        "water.ior=1.34",
        "water.body_albedo=[0, 0, 0]",
        "post.exposure=0",
        "post.exposure_offset=1",
        "post.tone_map=none",
        "post.glare=0.5",
        "camera.path=[{time: 0, position: [0, 1, 0], target: [0, 1, -1]}]",
    };
    for (size_t i = 0; i < COUNT(changes); i++)
        if (same_canonical(base, NULL, base, changes[i]))
            fail_msg("%s does not change the canonical text", changes[i]);
    static const char waves[] = "mangata: 1\nwater: {waves: [{amplitude: 1, a: 1, b: 1, c: 1}, {amplitude: 2, a: 1, b: 1, c: 1}]}";
    static const char *const wave_changes[] = {"water.waves[1].amplitude=3", "water.waves[1].a=3", "water.waves[0].b=3", "water.waves[1].c=3",
                                               "water.waves[0].phase=3"};
    for (size_t i = 0; i < COUNT(wave_changes); i++)
        if (same_canonical(waves, NULL, waves, wave_changes[i]))
            fail_msg("%s does not change the canonical text", wave_changes[i]);
}

static void the_most_waves_are_read(void **state)
{
    (void)state;
    static const char wave[] = "{amplitude: 0.001, a: 1, b: 2, c: 3, phase: 4},";
    char *text = malloc(MGT_MAX_WAVES * sizeof wave + 100);
    assert_non_null(text);
    char *at = text + sprintf(text, "mangata: 1\nwater: {waves: [");
    for (int i = 0; i < MGT_MAX_WAVES; i++)
        at += sprintf(at, "%s", wave);
    strcpy(at, "]}\n");
    scene_file *file = parse(text, NULL, 0);
    assert_int_equal(frame_of(file, 0).water.wave_count, MGT_MAX_WAVES);
    assert_true(frame_of(file, 0).water.waves[MGT_MAX_WAVES - 1].phase == 4);
    scene_file_free(file);
    free(text);
}

/* Writes keys and texts in their order, with a '|' between two. */
static void list_texts(const tree_node *node, char *out)
{
    const char *const texts[] = {node->key, node->text};
    for (size_t i = 0; i < COUNT(texts); i++)
        if (texts[i] != NULL)
            sprintf(out + strlen(out), "%s%s", out[0] != '\0' ? "|" : "", texts[i]);
    for (const tree_node *child = node->first; child != NULL; child = child->next)
        list_texts(child, out);
}

static void quoted_texts_are_read_by_yamls_rules(void **state)
{
    (void)state;
    static const struct {
        const char *text, *texts;
    } cases[] = {
        {"'plain \\n \"text\" # {}'", "plain \\n \"text\" # {}"},
        {"'it''s'", "it's"},
        {"'x''''y'", "x''y"},
        {"'x''''y''''''z''w'", "x''y'''z'w"},
        {"'''''start'", "''start"},
        {"'end'''''", "end''"},
        {"''''", "'"},
        {"''''''''''''", "'''''"},
        {"''", ""},
        {"' '", " "},
        {"k: ' a \t\n  b''''c\r\n \td '", "k| a b''c d "},
        {"k: 'a\n \t\n\n  ''''b\r  '", "k|a\n\n''b "},
        {"'\n\n'", "\n"},
        {"'x''''y': 'a''''b'\n? '''''z'\n: ''''", "x''y|a''b|''z|'"},
        {"{'''''': ['a''''b', 'c''''''''''d', {'''k''''': ''}], 'é''''ü': '''''水'}", "''|a''b|c'''''d|'k''||é''ü|''水"},
        {"\"plain '' # {}\"", "plain '' # {}"},
        {"\"\"", ""},
        {"{\"\\\"\\\"\\\"\\\"\": [\"x\\\"\\\"\", \"\\\\\\\\\\n\"]}", "\"\"\"\"|x\"\"|\\\\\n"},
        {"\"\\a\\b\\t\\\t\\v\\f\\r\\e\\ \\/\\N\\_\\L\\P\"", "\a\b\t\t\v\f\r\x1b /\xc2\x85\xc2\xa0\xe2\x80\xa8\xe2\x80\xa9"},
        {"\"\\x41\\xe9\\u6C34\\U0001f30a\\ud83c\\uDF0A\"", "Aé水🌊🌊"},
        {"\" a \t\n  b\\ \n\\ c\\t \r\n \td \"", " a b   c\t d "},
        {"\"a \\\n\t  b\\\\\\\r\n  \\\"\\\"\"", "a b\\\"\""},
        {"k: \"a \\\n\n \n  b\n\n\n  c\n \"", "k|a \n\nb\n\nc "},
        {"\xef\xbb\xbf- '~'\n- 'a''''b' # '\n- \"c''''d\"\n- e''''f\n", "~|a''b|c''''d|e''''f"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        scene_tree tree = {.file_name = "test"};
        scene_error error;
        char texts[128] = "";
        const tree_node *root = tree_parse(&tree, cases[i].text, strlen(cases[i].text), NULL, &error);
        if (root == NULL)
            fail_msg("%s: %s", cases[i].text, error.text);
        list_texts(root, texts);
        assert_string_equal(texts, cases[i].texts);
        tree_free(&tree);
    }
    static const char *const override = "description='a''''b'''''";
    scene_file *file = parse("mangata: 1", &override, 1);
    assert_string_equal(scene_file_description(file), "a''b''");
    scene_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smallest_file_has_every_default),
        cmocka_unit_test(every_key_is_read),
        cmocka_unit_test(standard_scenes_load),
        cmocka_unit_test(unusual_scenes_are_legal),
        cmocka_unit_test(methods_have_the_names_of_the_command),
        cmocka_unit_test(large_numbers_are_not_rounded),
        cmocka_unit_test(body_sets_the_defaults_of_the_light),
        cmocka_unit_test(overrides_replace_add_and_append),
        cmocka_unit_test(camera_path_passes_its_keyframes),
        cmocka_unit_test(camera_path_is_smooth_and_never_leaves_its_heights),
        cmocka_unit_test(evenly_spaced_keyframes_make_a_straight_steady_path),
        cmocka_unit_test(negative_frames_are_refused),
        cmocka_unit_test(canonical_text_knows_values_not_spelling),
        cmocka_unit_test(the_most_waves_are_read),
        cmocka_unit_test(quoted_texts_are_read_by_yamls_rules),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
