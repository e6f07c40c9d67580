/* SPDX-License-Identifier: MIT
 *
 * Scene files that are bad: one line that says what is wrong, where, and what is allowed; hostile files do no harm.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "scene/scene_file.h"

#define DATA MGT_SOURCE_DIR "/tests/data/scenes/"
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* Fails unless the text is refused with a proper one-line error. */
static scene_error refused_bytes(const char *text, size_t length, const char *override)
{
    scene_error error;
    memset(&error, 'x', sizeof error);
    scene_file *file = scene_file_parse(text, length, "s.yaml", &override, override != NULL ? 1 : 0, &error);
    if (file != NULL) {
        scene_file_free(file);
        fail_msg("accepted: %.60s %s", text, override != NULL ? override : "");
    }
    assert_int_not_equal(error.kind, SCENE_ERROR_NONE);
    assert_non_null(memchr(error.text, '\0', sizeof error.text));
    assert_null(strchr(error.text, '\n'));
    assert_true(strlen(error.text) > 10);
    return error;
}

static scene_error refused(const char *text, const char *override) { return refused_bytes(text, strlen(text), override); }

static void assert_error(scene_error error, scene_error_kind kind, const char *expected)
{
    if (error.kind != kind || strcmp(error.text, expected) != 0)
        fail_msg("kind %d: %s\n  expected kind %d: %s", (int)error.kind, error.text, (int)kind, expected);
}

#define NUMBER_TWICE "quality.spatial stands beside the method ssaa4, which says the number already; allowed: one of them, ssaaN or ssaa with spatial: N"
#define METHODS                                                                                                                                             \
    "one of none, ssaa, podee-uniform, podee-pixel, mangata, reference, msaa32, lean, leadr, tokuyoshi, bruneton, fxaa, taa, tndf, adaptive, ggx-moments, " \
    "or ssaaN (N from 1 to 1024)"

static void messages_say_what_where_and_what_is_allowed(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        /* syntax */
        {"mangata: 1\nimage: {width: 12, height: 3\ncamera:\n",
         "s.yaml:3:7: not valid YAML or JSON: a comma or a closing bracket is missing; allowed: a \"}\" for the \"{\" of line 2, column 8"},
        {"mangata: 1\nlight: [1, 2\n", "s.yaml:3:1: not valid YAML or JSON: a closing bracket is missing; allowed: a \"]\" for the \"[\" of line 2, column 8"},
        {"mangata: \"1\n", "s.yaml:1:11: not valid YAML or JSON: double-quoted scalar without closing quote; allowed: YAML 1.2 or JSON"},
        {"", "s.yaml:1:1: the file is empty; allowed: a scene, at least \"mangata: 1\""},
        {"# only a comment\n", "s.yaml:1:1: the file is empty; allowed: a scene, at least \"mangata: 1\""},
        {"mangata: 1\n---\nmangata: 1\n", "s.yaml:2:1: a second document begins here; allowed: one"},
        {"mangata: &one 1\n", "s.yaml:1:15: anchors (&name) are not supported; allowed: the value written out"},
        {"mangata: 1\nsky: *dusk\n", "s.yaml:2:6: aliases (*name) are not supported; allowed: the value written out"},
        {"mangata: !!int 1\n", "s.yaml:1:16: tags (!type) are not supported; allowed: a plain value"},
        {"? [mangata]\n: 1\n", "s.yaml:1:3: a list or mapping stands as a key; allowed: a plain word"},
        {"mangata: 1\ndescription: caf\xe9\n", "s.yaml:2:17: not a text file: a byte that is not printable UTF-8; allowed: YAML or JSON in UTF-8"},
        {"{\"mangata\": 1, \"description\": \"\\u0000\"}", "s.yaml:1:31: a text holds a NUL character; allowed: any other"},
        /* keys */
        {"mangata: 1\nligth: {}\n",
         "s.yaml:2:1: unknown key \"ligth\" in the scene; did you mean \"light\"? allowed: mangata, description, image, camera, time, "
         "light, sky, water, objects, post, quality"},
        {"mangata: 1\nlight: {elevation: 3}\n",
         "s.yaml:2:9: unknown key \"elevation\" in light; did you mean \"elevation_deg\"? allowed: body, elevation_deg, azimuth_deg, "
         "angular_radius_deg, radiance"},
        {"mangata: 1\nquality: {wibble: 3}\n",
         "s.yaml:2:11: unknown key \"wibble\" in quality; allowed: method, spatial, time_samples, sample_first, sample_count, seed, ndf_mean, "
         "kernels, elongation, path_segments, transition, transition_width, adaptive, samples, target_rmse, target_displayed, budget_ms, "
         "importance_center, importance_width, importance_threshold, slots, refraction, tess_error, refraction_samples, caustics, roughness_floor, "
         "light_cells"},
        {"mangata: 1\nwater: {waves: [{amplitude: 1, a: 1, b: 1, c: 1, wibble: 2}]}\n",
         "s.yaml:2:50: unknown key \"wibble\" in water.waves[0]; allowed: amplitude, a, b, c, phase; or wavelength, direction_deg, height, phase"},
        {"mangata: 1\nwater: {waves: [{wavelenght: 4, height: 1}]}\n",
         "s.yaml:2:18: unknown key \"wavelenght\" in water.waves[0]; did you mean \"wavelength\"? allowed: wavelength, direction_deg, height, phase"},
        {"mangata: 1\nwater: {waves: [{wavelength: 4, height: 1, a: 2}]}\n",
         "s.yaml:2:44: water.waves[0].a stands beside wavelength, which is of another form; allowed: one form, the other one is wavelength, "
         "direction_deg, height, phase"},
        {"mangata: 1\nwater: {waves: [{amplitude: 1, a: 1, b: 1, c: 1, direction_deg: 40}]}\n",
         "s.yaml:2:50: water.waves[0].direction_deg stands beside amplitude, which is of another form; allowed: one form, the other one is wavelength, "
         "direction_deg, height, phase"},
        {"mangata: 1\nwater: {waves: [{wavelength: 4}]}\n", "s.yaml:2:17: water.waves[0].height is missing; required: height: a number, 0 to 2000 m"},
        {"mangata: 1\nwater: {waves: [{wavelength: 0, height: 1}]}\n", "s.yaml:2:30: water.waves[0].wavelength is 0; allowed: a number, 0.0001 to 100000 m"},
        {"mangata: 1\nwater: {waves: [{wavelength: 4, height: -1}]}\n", "s.yaml:2:41: water.waves[0].height is -1; allowed: a number, 0 to 2000 m"},
        {"mangata: 1\nlight:\n  body: sun\n  body: moon\n", "s.yaml:4:3: key \"body\" stands twice, first at line 3, column 3; allowed: once"},
        {"mangata: 1\nlight: {body: sun, source: moon}\n",
         "s.yaml:2:20: key \"source\" stands beside \"body\" at line 2, column 9; \"source\" is the new name of \"body\"; allowed: one of them"},
        {"mangata: 1\nlight:\n  source: moon\n  body: moon\n",
         "s.yaml:4:3: key \"body\" stands beside \"source\" at line 3, column 3; \"source\" is the new name of \"body\"; allowed: one of them"},
        {"mangata: 1\nlight: {source: sun, source: sun}\n", "s.yaml:2:22: key \"source\" stands twice, first at line 2, column 9; allowed: once"},
        {"mangata: 1\nquality: {method: podee-pixel, kernels: 9, mixture: 9}\n",
         "s.yaml:2:44: key \"mixture\" stands beside \"kernels\" at line 2, column 32; \"mixture\" is the new name of \"kernels\"; allowed: one of them"},
        {"mangata: 1\nquality: {method: ssaa4, spatial: 4}\n", "s.yaml:2:35: " NUMBER_TWICE},
        {"mangata: 1\nquality: {spatial: 3, method: ssaa4}\n", "s.yaml:2:20: " NUMBER_TWICE},
        {"mangata: 1\nquality: {method: ssaa0}\n", "s.yaml:2:19: quality.method is ssaa0; allowed: " METHODS},
        {"mangata: 1\nquality: {method: ssaa1025}\n", "s.yaml:2:19: quality.method is ssaa1025; allowed: " METHODS},
        {"mangata: 1\nquality: {method: ssaa-4}\n", "s.yaml:2:19: quality.method is ssaa-4; allowed: " METHODS},
        {"mangata: 1\nquality: {method: mangata4}\n", "s.yaml:2:19: quality.method is mangata4; allowed: " METHODS},
        {"mangata: 1\nquality: {method: [ssaa4]}\n", "s.yaml:2:19: quality.method is a list of 1; allowed: " METHODS},
        {"mangata: 1\nlight: {sources: sun}\n",
         "s.yaml:2:9: unknown key \"sources\" in light; did you mean \"source\"? allowed: body, elevation_deg, azimuth_deg, "
         "angular_radius_deg, radiance"},
        {"light: {}\n", "s.yaml:1:1: mangata is missing; required: mangata: 1"},
        {"mangata: 2\n", "s.yaml:1:10: mangata is 2; allowed: 1"},
        {"mangata: 1\nwater: {waves: [{a: 1, b: 1, c: 1}]}\n", "s.yaml:2:17: water.waves[0].amplitude is missing; required: amplitude: a number, 0 to 1000 m"},
        /* types */
        {"- mangata\n", "s.yaml:1:1: the scene is a list of 1; allowed: a mapping {key: value, ...}"},
        {"mangata: 1\nlight: sun\n", "s.yaml:2:8: light is sun; allowed: a mapping {key: value, ...}"},
        {"mangata: 1\nlight:\n", "s.yaml:2:1: light is empty; allowed: a mapping {key: value, ...}, or no such key"},
        {"mangata: 1\nlight: {elevation_deg: high}\n", "s.yaml:2:24: light.elevation_deg is high; allowed: a number, -90 to 90 degrees"},
        {"mangata: 1\nlight: {elevation_deg: \"3\"}\n", "s.yaml:2:24: light.elevation_deg is the text \"3\"; allowed: a number, -90 to 90 degrees"},
        {"{\"mangata\": 1,\n \"lihgt\": 3}",
         "s.yaml:2:2: unknown key \"lihgt\" in the scene; did you mean \"light\"? allowed: mangata, description, image, camera, time, "
         "light, sky, water, objects, post, quality"},
        {"{\"mangata\": 1,\n \"description\": \"\\u00e9\", \"light\": 'x'}", "s.yaml:2:36: light is the text \"x\"; allowed: a mapping {key: value, ...}"},
        {"mangata: 1\ndescription: 'a''''\n\n  é'''''\nlight: 'x''''y'''\n", "s.yaml:5:8: light is the text \"x''y'\"; allowed: a mapping {key: value, ...}"},
        {"mangata: 1\ndescription: \"\\\n a\\\"\n\n  é\\\\\\\n \"\nlight: \"\\\"\\\"\"\n",
         "s.yaml:7:8: light is the text \"\"\"\"; allowed: a mapping {key: value, ...}"},
        {"mangata: 1\ndescription: >\n  a\n\n   b\n",
         "s.yaml:3:1: a text behind > has an empty line before one that is indented by one more; allowed: by two or more, or such a text behind |"},
        {"{mangata: 1, description: 'é''''', 'x''''y': 1}",
         "s.yaml:1:36: unknown key \"x''y\" in the scene; allowed: mangata, description, image, camera, time, light, sky, water, objects, post, quality"},
        {"mangata: 1\nlight: {elevation_deg: [3]}\n", "s.yaml:2:24: light.elevation_deg is a list of 1; allowed: a number, -90 to 90 degrees"},
        {"mangata: 1\nlight: {body: star}\n", "s.yaml:2:15: light.body is star; allowed: one of sun, moon"},
        {"mangata: 1\nlight: {source: star}\n", "s.yaml:2:17: light.source is star; allowed: one of sun, moon"},
        {"mangata: 1\nquality: {method: podee-pixel, mixture: 2}\n", "s.yaml:2:41: quality.mixture is 2; allowed: one of exact, 1, 3, 5, 9, feline, riemann"},
        {"mangata: 1\nquality: {refraction: path-trace}\n",
         "s.yaml:2:23: quality.refraction is path-trace; allowed: one of two-phase, hybrid, liu, broad, narrow, screen-space, distance-field, off, "
         "truth (also called path-traced)"},
        {"mangata: 1\npost: {exposure: bright}\n", "s.yaml:2:18: post.exposure is bright; allowed: auto or a number, -60 to 60 stops"},
        {"mangata: 1\nlight: {radiance: [1, 2]}\n",
         "s.yaml:2:19: light.radiance is a list of 2; allowed: a list of 3 numbers [r, g, b], each 0 to 1e12 kcd/m²"},
        {"mangata: 1\nlight: {radiance: [1, 2, red]}\n", "s.yaml:2:26: light.radiance[2] is red; allowed: a number, 0 to 1e12 kcd/m²"},
        {"mangata: 1\nwater: {waves: {a: 1}}\n", "s.yaml:2:16: water.waves is a mapping; allowed: a list of at most 2048 mappings"},
        {"mangata: 1\ndescription: [a]\n", "s.yaml:2:14: description is a list of 1; allowed: text"},
        /* ranges */
        {"mangata: 1\nlight: {elevation_deg: .nan}\n", "s.yaml:2:24: light.elevation_deg is .nan; allowed: a number, -90 to 90 degrees"},
        {"mangata: 1\ntime: {start: -.inf}\n", "s.yaml:2:15: time.start is -.inf; allowed: a number, -1e8 to 1e8 s"},
        {"mangata: 1\ntime: {start: 1e999}\n", "s.yaml:2:15: time.start is 1e999; allowed: a number, -1e8 to 1e8 s"},
        {"mangata: 1\nimage: {width: 0}\n", "s.yaml:2:16: image.width is 0; allowed: a whole number, 1 to 32768 pixels"},
        {"mangata: 1\nimage: {height: -720}\n", "s.yaml:2:17: image.height is -720; allowed: a whole number, 1 to 32768 pixels"},
        {"mangata: 1\nimage: {width: 12.5}\n", "s.yaml:2:16: image.width is 12.5; allowed: a whole number, 1 to 32768 pixels"},
        {"mangata: 1\nimage: {width: 100000, height: 100000}\n", "s.yaml:2:16: image.width is 100000; allowed: a whole number, 1 to 32768 pixels"},
        {"mangata: 1\nimage: {width: 32768, height: 32768}\n",
         "s.yaml:2:31: image is 32768 x 32768 = 1073741824 pixels; allowed: width x height at most 268435456"},
        {"mangata: 1\ncamera: {fov_y_deg: 179}\n", "s.yaml:2:21: camera.fov_y_deg is 179; allowed: a number, above 0 and below 179 degrees"},
        {"mangata: 1\ntime: {shutter: -1}\n", "s.yaml:2:17: time.shutter is -1; allowed: a number, 0 to 1000 frames"},
        /* cameras */
        {"mangata: 1\ncamera: {position: [0, 5, 0], target: [0, 5, 0]}\n",
         "s.yaml:2:39: camera: the camera looks at its own position; allowed: a target apart from position"},
        {"mangata: 1\ncamera: {position: [0, 3.84, -0.987]}\n",
         "s.yaml:2:20: camera: the camera looks at its own position; allowed: a target apart from position"},
        {"mangata: 1\ncamera: {up: [0, 0, 0]}\n",
         "s.yaml:2:14: camera: up is zero or parallel to the view (target - position); allowed: a direction across the view"},
        {"mangata: 1\ncamera:\n  position: [0, 5, 0]\n  target: [0, -5, 0]\n",
         "s.yaml:4:11: camera: up is zero or parallel to the view (target - position); allowed: a direction across the view"},
        {"mangata: 1\ncamera:\n  path:\n  - {time: 1, position: [0, 5, 0], target: [0, 0, -9]}\n  - {time: 1, position: [0, 6, 0], target: [0, 0, -9]}\n",
         "s.yaml:5:12: camera.path[1].time is 1; allowed: later than camera.path[0].time, 1 s, by at least 1e-6 s"},
        {"mangata: 1\ncamera:\n  position: [0, 2, 0]\n  path:\n  - {time: 1, position: [0, 5, 0], target: [0, 0, -9]}\n",
         "s.yaml:3:3: camera.position stands beside camera.path, which replaces it; allowed: one of them"},
        {"mangata: 1\ncamera:\n  path:\n  - {time: 1, position: [0, 5, 0], target: [0, 5, 0]}\n",
         "s.yaml:4:44: camera.path: the camera looks at its own position; allowed: a target apart from position"},
        {"mangata: 1\ntime: {fps: 4, frames: 9}\ncamera:\n  path:\n  - {time: 0, position: [0, 5, 0], target: [4, 5, 0]}\n"
         "  - {time: 2, position: [2, 5, 0], target: [-2, 5, 0]}\n",
         "s.yaml:5:3: camera.path at 1 s (frame 4): the camera looks at its own position; allowed: a target apart from position"},
        /* seas */
        {"mangata: 1\nwater:\n  spectrum: {wind: 12}\n",
         "s.yaml:3:13: water.spectrum.model is missing; required: model: one of none, pierson-moskowitz, jonswap, tma, elfouhaily, buoy"},
        {"mangata: 1\nwater: {spectrum: {}}\n",
         "s.yaml:2:19: water.spectrum.model is missing; required: model: one of none, pierson-moskowitz, jonswap, tma, elfouhaily, buoy"},
        {"mangata: 1\nwater: {wind: -3}\n", "s.yaml:2:15: water.wind is -3; allowed: a number, 0 or 0.5 to 75 m/s, or a mapping {key: value, ...}"},
        {"mangata: 1\nwater: {wind: strong}\n", "s.yaml:2:15: water.wind is strong; allowed: a number, 0 or 0.5 to 75 m/s, or a mapping {key: value, ...}"},
        {"mangata: 1\nwater: {wind: \"8\"}\n",
         "s.yaml:2:15: water.wind is the text \"8\"; allowed: a number, 0 or 0.5 to 75 m/s, or a mapping {key: value, ...}"},
        {"mangata: 1\nwater: {wind: .nan}\n", "s.yaml:2:15: water.wind is .nan; allowed: a number, 0 or 0.5 to 75 m/s, or a mapping {key: value, ...}"},
        {"mangata: 1\nwater: {wind: [8]}\n", "s.yaml:2:15: water.wind is a list of 1; allowed: a number, 0 or 0.5 to 75 m/s, or a mapping {key: value, ...}"},
        {"mangata: 1\nwater: {wind: {speed: 76}}\n", "s.yaml:2:23: water.wind.speed is 76; allowed: a number, 0 or 0.5 to 75 m/s"},
        {"mangata: 1\nwater: {wind: {sped: 7}}\n",
         "s.yaml:2:16: unknown key \"sped\" in water.wind; did you mean \"speed\"? allowed: speed, direction_deg, fetch, depth, count, seed"},
        {"mangata: 1\nwater: {swell: {height: 2}}\n", "s.yaml:2:16: water.swell is a mapping; allowed: a list of at most 16 mappings"},
        {"mangata: 1\nwater: {swell: [{period: 2}]}\n", "s.yaml:2:17: water.swell[0].height is missing; required: height: a number, 0.001 to 50 m"},
        {"mangata: 1\nwater: {swell: [{height: 2, period: 0}]}\n", "s.yaml:2:37: water.swell[0].period is 0; allowed: a number, 1 to 40 s"},
        {"mangata: 1\nwater: {wind: {speed: 8, count: 2036}, swell: [{height: 2}]}\n",
         "s.yaml:2:33: water.wind.count is 2036, with water.waves and water.swell 2060 in all; allowed: together at most 2048"},
        {"mangata: 1\nwater: {swell: [{height: 2, count: 1100}, {height: 2, count: 1100}]}\n",
         "s.yaml:2:16: water.swell.count is 2200, with water.waves 2200 in all; allowed: together at most 2048"},
        {"mangata: 1\nwater: {wind: {speed: 8, count: 2049}}\n", "s.yaml:2:33: water.wind.count is 2049; allowed: a whole number, 1 to 2048"},
        {"mangata: 1\nwater:\n  wind: 8\n  waves: [{amplitude: 1, a: 1, b: 1, c: 1}]\n",
         "s.yaml:4:3: water.waves stands beside water.wind, which replaces it; allowed: one of them"},
        {"mangata: 1\nwater:\n  spectrum: {model: jonswap}\n  wind: {speed: 8}\n",
         "s.yaml:3:3: water.spectrum stands beside water.wind, which replaces it; allowed: one of them"},
        {"mangata: 1\nwater:\n  wind: 8\n  foam: {amount: 1, share: 0.1}\n",
         "s.yaml:4:21: water.foam.share stands beside water.foam.amount; allowed: one of them"},
        {"mangata: 1\nsky: {aerial: true}\n", "s.yaml:2:15: sky.aerial is true; allowed: one of auto, off, on"},
        {"mangata: 1\nsky: {stars: many}\n", "s.yaml:2:14: sky.stars is many; allowed: one of auto, off, on"},
        {"mangata: 1\npost: {night_tint: 0.5}\n", "s.yaml:2:20: post.night_tint is 0.5; allowed: one of auto, off, on"},
        {"mangata: 1\nwater: {foam: {share: 0.6}}\n", "s.yaml:2:23: water.foam.share is 0.6; allowed: a number, 0 to 0.5"},
        {"mangata: 1\nwater: {wind: {speed: 20, fetch: 500}}\n",
         "s.yaml:2:34: water.wind.fetch is 500 m, too short for the spectrum in this wind; allowed: at least 2365 m"},
        {"mangata: 1\nwater: {wind: {speed: 0.5, fetch: 200}}\n",
         "s.yaml:2:23: water.wind.speed makes waves, after this fetch and over this depth, that are all shorter than 0.2 m; allowed: a longer fetch, deeper water, or a stronger wind"},
        {"mangata: 1\npost: {exposure: 2, exposure_offset: 1}\n",
         "s.yaml:2:21: post.exposure_offset stands beside an exposure that is a number; allowed: only with exposure: auto"},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_error(refused(cases[i].text, NULL), SCENE_ERROR_BAD_SCENE, cases[i].message);
}

static void override_messages_name_the_option(void **state)
{
    (void)state;
    static const struct {
        const char *override, *message;
    } cases[] = {
        {"light.elevation_deg=95", "light.elevation_deg is 95; allowed: a number, -90 to 90 degrees"},
        {"light.elevation_deg=", "light.elevation_deg is empty; allowed: a number, -90 to 90 degrees, or no such key"},
        {"ligth.body=sun", "unknown key \"ligth\" in the scene; did you mean \"light\"? allowed: mangata, description, image, camera, "
                           "time, light, sky, water, objects, post, quality"},
        {"light=3", "light is 3; allowed: a mapping {key: value, ...}"},
        {"light={body: sun, source: moon}",
         "key \"source\" stands beside \"body\" at line 1, column 2; \"source\" is the new name of \"body\"; allowed: one of them"},
        {"light={'x''''y': 1}", "unknown key \"x''y\" in light; allowed: body, elevation_deg, azimuth_deg, angular_radius_deg, radiance"},
        {"light.source.x=3", "source is a single value; allowed: source=value"},
        {"light.body.x=3", "body is a single value; allowed: body=value"},
        {"light[0]=3", "light is a mapping; allowed: a key, as in light.key"},
        {"water.waves.a=3", "waves is a list; allowed: an index, as in waves[0]"},
        {"water.waves[2].a=3", "waves has 1 items; allowed: an index from 0 to 1 (which appends)"},
        {"water.waves[999999999].a=3", "waves has 1 items; allowed: an index from 0 to 1 (which appends)"},
        {"water.waves[0].amplitude=-1", "water.waves[0].amplitude is -1; allowed: a number, 0 to 1000 m"},
        {"time.fps={a", "not valid YAML or JSON: a comma or a closing bracket is missing; allowed: a \"}\" for the \"{\" of line 1, column 1"},
        {"time.fps=*a", "aliases (*name) are not supported; allowed: the value written out"},
        {"water.wind=8", "water.wind stands beside water.waves of the file, which it replaces; allowed: one of them (--set water.waves=[])"},
        {"water.wind.speed=8", "water.wind stands beside water.waves of the file, which it replaces; allowed: one of them (--set water.waves=[])"},
        {"water.wind=900", "water.wind is 900; allowed: a number, 0 or 0.5 to 75 m/s, or a mapping {key: value, ...}"},
        {"camera.position=[0, 3.84, -0.987]", "camera: the camera looks at its own position; allowed: a target apart from position"},
    };
    static const char text[] = "mangata: 1\nlight: {body: sun}\nwater: {waves: [{amplitude: 1, a: 1, b: 1, c: 1}]}\n";
    assert_error(refused("mangata: 1\nquality: {method: ssaa, spatial: 3}\n", "quality.method=ssaa4"), SCENE_ERROR_BAD_SCENE,
                 "--set quality.method=ssaa4: " NUMBER_TWICE);
    /* Values of the file that one of --set excludes: the message says how they go. */
    assert_error(refused("mangata: 1\npost: {exposure_offset: -0.5}\n", "post.exposure=3"), SCENE_ERROR_BAD_SCENE,
                 "--set post.exposure=3: post.exposure_offset stands beside an exposure that is a number; allowed: only with exposure: auto "
                 "(--set post.exposure_offset=0)");
    assert_error(refused("mangata: 1\ncamera: {path: [{time: 1, position: [0, 5, 0], target: [0, 0, -9]}]}\n", "camera.position=[0, 5, 0]"),
                 SCENE_ERROR_BAD_SCENE,
                 "--set camera.position=[0, 5, 0]: camera.position stands beside camera.path, which replaces it; allowed: one of them (--set camera.path=[])");
    assert_error(refused("mangata: 1\ncamera: {target: [0, 3, -9]}\n", "camera.path=[{time: 1, position: [0, 5, 0], target: [0, 0, -9]}]"),
                 SCENE_ERROR_BAD_SCENE,
                 "--set camera.path=[{time: 1, position: [0, 5, 0], target: [0, 0, -...: camera.path stands beside camera.target of the scene, "
                 "which it replaces; allowed: one of them (--set 'camera={path: [...]}')");
    assert_error(refused("mangata: 1\ncamera: {position: [0, 5, 0]}\n", "camera.position[3]=1"), SCENE_ERROR_BAD_SCENE,
                 "--set camera.position[3]=1: camera.position is a list of 4; allowed: a list of 3 numbers [x, y, z], each -1e9 to 1e9 m");
    for (size_t i = 0; i < COUNT(cases); i++) {
        char expected[512];
        snprintf(expected, sizeof expected, "--set %s: %s", cases[i].override, cases[i].message);
        assert_error(refused(text, cases[i].override), SCENE_ERROR_BAD_SCENE, expected);
    }
    static const char *const malformed[] = {"",
                                            "=",
                                            "=3",
                                            "light",
                                            "light.=3",
                                            ".light=3",
                                            "a..b=3",
                                            "[0]=3",
                                            "water.waves[]=3",
                                            "water.waves[-1]=3",
                                            "water.waves[0=3",
                                            "water.waves[99999999999]=3",
                                            "li ght=3"};
    for (size_t i = 0; i < COUNT(malformed); i++) {
        char expected[512];
        snprintf(expected, sizeof expected,
                 "--set %s: not of the form key=value; allowed: such as light.elevation_deg=3, water.waves[0].amplitude=0.1, "
                 "camera.position=[0, 5, 0]",
                 malformed[i]);
        assert_error(refused(text, malformed[i]), SCENE_ERROR_BAD_OVERRIDE, expected);
    }
}

static scene_error load_fails(const char *path)
{
    scene_error error;
    scene_file *file = scene_file_load(path, NULL, 0, &error);
    scene_file_free(file);
    assert_null(file);
    assert_null(strchr(error.text, '\n'));
    assert_null(scene_file_load(path, NULL, 0, NULL)); /* without an error to fill */
    return error;
}

static void files_that_cannot_be_read(void **state)
{
    (void)state;
    assert_error(load_fails("/nowhere/at/all.yaml"), SCENE_ERROR_MISSING_INPUT,
                 "/nowhere/at/all.yaml: No such file or directory; allowed: a YAML or JSON file of at most 16 MiB");
    assert_error(load_fails("/tmp"), SCENE_ERROR_MISSING_INPUT, "/tmp: is a directory; allowed: a YAML or JSON file of at most 16 MiB");
    assert_error(load_fails(""), SCENE_ERROR_MISSING_INPUT, "the scene's file name is empty; allowed: the path of a YAML or JSON file");
    assert_error(load_fails("/dev/zero"), SCENE_ERROR_MISSING_INPUT,
                 "/dev/zero: is no regular file (standard input is \"-\"); allowed: a YAML or JSON file of at most 16 MiB");
    assert_error(load_fails("/nowhere/new\nline"), SCENE_ERROR_MISSING_INPUT,
                 "/nowhere/new?line: No such file or directory; allowed: a YAML or JSON file of at most 16 MiB");
    char long_name[5000];
    memset(long_name, 'n', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    assert_non_null(strstr(load_fails(long_name).text, "nnn: File name too long; allowed: "));
}

static void a_file_without_permission(void **state)
{
    (void)state;
    char folder[] = "/tmp/mangata-scene-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chmod(folder, 0755), 0);
    snprintf(path, sizeof path, "%s/secret.yaml", folder);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fclose(stream);
    chmod(path, 0);
    pid_t child = fork(); /* root may read anything: the child gives that up */
    if (child == 0) {
        if (geteuid() == 0 && setuid(65534) != 0)
            _exit(2);
        scene_error error;
        scene_file *file = scene_file_load(path, NULL, 0, &error);
        _exit(file == NULL && error.kind == SCENE_ERROR_MISSING_INPUT && strstr(error.text, ": Permission denied; allowed: ") != NULL ? 0 : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    unlink(path);
    rmdir(folder);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

static void bad_files_of_the_test_data(void **state)
{
    (void)state;
    static const struct {
        const char *name, *message;
    } cases[] = {
        {"empty.yaml", ":1:1: the file is empty; allowed: a scene, at least \"mangata: 1\""},
        {"truncated.json", ":3:35: not valid YAML or JSON: a comma or a closing bracket is missing; allowed: a \"}\" for the \"{\" of line 3, column 12"},
        {"garbage.bin", ":1:1: not a text file: a byte that is not printable UTF-8; allowed: YAML or JSON in UTF-8"},
        {"unknown_key.yaml", ":4:3: unknown key \"azimut_deg\" in light; did you mean \"azimuth_deg\"? allowed: body, elevation_deg, "
                             "azimuth_deg, angular_radius_deg, radiance"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char path[1024];
        snprintf(path, sizeof path, DATA "%s", cases[i].name);
        scene_error error = load_fails(path);
        assert_int_equal(error.kind, SCENE_ERROR_BAD_SCENE);
        const char *message = strstr(error.text, cases[i].name);
        assert_non_null(message);
        assert_string_equal(message + strlen(cases[i].name), cases[i].message);
    }
}

/* `count` copies of a piece between two ends; the caller frees it. */
static char *repeat(const char *head, const char *piece, size_t count, const char *tail)
{
    size_t length = strlen(piece), at = strlen(head);
    char *text = malloc(at + count * length + strlen(tail) + 1);
    assert_non_null(text);
    memcpy(text, head, at);
    for (size_t i = 0; i < count; i++, at += length)
        memcpy(text + at, piece, length);
    strcpy(text + at, tail);
    return text;
}

static void hostile_files_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *head, *piece;
        size_t count;
        const char *tail, *message;
    } cases[] = {
        {"mangata: 1\nwater: {waves: [", "{amplitude: .1, a: 1, b: 1, c: 1},", 10000, "]}", "s.yaml:2:16: water.waves has 10000 items; allowed: at most 2048"},
        {"mangata: 1\nwater: {waves: [", "{amplitude: .1, a: 1, b: 1, c: 1},", 2049, "]}", "s.yaml:2:16: water.waves has 2049 items; allowed: at most 2048"},
        {"", "[", 100000, "", "s.yaml:1:33: nested too deep; allowed: at most 32 levels"},
        {"", "{a: ", 100000, "", "s.yaml:1:129: nested too deep; allowed: at most 32 levels"},
        {"", "- ", 3000, "x", "s.yaml:1:65: nested too deep; allowed: at most 32 levels"},
        {"mangata: 1\ndescription: ", "x", 1000000, "\n", "s.yaml:2:14: a text is too long; allowed: at most 65536 bytes"},
        {"", "k", 1000000, ": 1\n", NULL},
        {"a: [", "1,", 1000001, "]", "s.yaml:1:2000001: too many values; allowed: at most 1000000 in a scene"},
        {"mangata: 1\n", "#", 17 * 1024 * 1024, "", "s.yaml: is larger than 16 MiB; allowed: a YAML or JSON file of at most 16 MiB"},
        {"mangata: 1\n", "\n", 100000, "x: 1", NULL},
        {"mangata: 1\ndescription: '", "\n", 60000, "'\nx: 1\n", NULL},
        {"a: &a [x, x]\nb: ", "[*a, *a, *a, *a, *a],", 20, "\n", "s.yaml:1:7: anchors (&name) are not supported; allowed: the value written out"},
        {"mangata: 1\n", "\xc3\xa9", 30000, ": 1\n", NULL},
        {"mangata: 1\nlight: {elevation_deg: ", "1", 60000, "}", NULL},
        {"mangata: 1\nlight: {elevation_deg: 0x", "f", 60000, "}", NULL},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char *text = repeat(cases[i].head, cases[i].piece, cases[i].count, cases[i].tail);
        scene_error error = refused(text, NULL);
        if (cases[i].message != NULL)
            assert_error(error, SCENE_ERROR_BAD_SCENE, cases[i].message);
        free(text);
    }
    char *override = repeat("a", ".a", 100000, "=1");
    assert_int_equal(refused("mangata: 1", override).kind, SCENE_ERROR_BAD_SCENE);
    free(override);
}

static char *read_file(const char *path, size_t *length)
{
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    char *text = malloc(1 << 20);
    assert_non_null(text);
    *length = fread(text, 1, 1 << 20, stream);
    fclose(stream);
    return text;
}

static void every_truncation_of_a_file_is_refused(void **state)
{
    (void)state;
    size_t length;
    char *text = read_file(MGT_SOURCE_DIR "/scenes/simple.json", &length);
    while (length > 0 && text[length - 1] != '}')
        length--;
    for (size_t cut = 0; cut < length; cut++) {
        char *piece = malloc(cut + 1); /* exactly as long, so that the sanitizer sees a read beyond */
        assert_non_null(piece);
        memcpy(piece, text, cut);
        assert_int_equal(refused_bytes(piece, cut, NULL).kind, SCENE_ERROR_BAD_SCENE);
        free(piece);
    }
    free(text);
}

/* Seeded changes of good files: whatever comes of it, nothing breaks and each error is one line. */
static void changed_files_do_no_harm(void **state)
{
    (void)state;
    static const char *const paths[] = {DATA "full.yaml", DATA "path.yaml"};
    static const char bytes[] = "{}[]:,-?&*!|>'\"%@`#\n\t\r \\.0e~a\0\xff\xc3";
    uint64_t random = 2026;
    for (size_t p = 0; p < COUNT(paths); p++) {
        size_t length;
        char *text = read_file(paths[p], &length), *changed = malloc(length);
        assert_non_null(changed);
        for (int round = 0; round < 1500; round++) {
            memcpy(changed, text, length);
            for (int i = 0; i < 1 + round % 4; i++) {
                random = random * 6364136223846793005u + 1442695040888963407u;
                changed[(random >> 33) % length] = bytes[(random >> 20) % (sizeof bytes - 1)];
            }
            scene_error error;
            scene_file *file = scene_file_parse(changed, length, "s.yaml", NULL, 0, &error);
            assert_int_equal(file == NULL, error.kind != SCENE_ERROR_NONE);
            if (file == NULL)
                assert_null(strchr(error.text, '\n'));
            scene_file_free(file);
        }
        free(changed);
        free(text);
    }
}

static void nothing_is_printed(void **state)
{
    (void)state;
    FILE *sink = tmpfile();
    assert_non_null(sink);
    fflush(NULL);
    int kept_error = dup(STDERR_FILENO), kept_output = dup(STDOUT_FILENO);
    dup2(fileno(sink), STDERR_FILENO);
    dup2(fileno(sink), STDOUT_FILENO);
    static const char *const texts[] = {"a: [1, 2", "\"", "a: b: c", "{a: 1, a: 2}", "%YAML 9.9\n---\nmangata: 1", "- a\nb", "@", "a: %"};
    for (size_t i = 0; i < COUNT(texts); i++) {
        scene_error error;
        scene_file_free(scene_file_parse(texts[i], strlen(texts[i]), "s.yaml", NULL, 0, &error));
    }
    fflush(NULL);
    dup2(kept_error, STDERR_FILENO);
    dup2(kept_output, STDOUT_FILENO);
    close(kept_error);
    close(kept_output);
    struct stat status;
    assert_int_equal(fstat(fileno(sink), &status), 0);
    fclose(sink);
    assert_int_equal(status.st_size, 0);
}

static const char *warning_of(const char *text, scene_file **file)
{
    scene_error error;
    *file = scene_file_parse(text, strlen(text), "s.yaml", NULL, 0, &error);
    assert_non_null(*file);
    return scene_file_warning(*file);
}

static void scenes_hardly_meant_are_warned_of(void **state)
{
    (void)state;
    static const struct {
        const char *text, *warning; /* NULL: none */
    } cases[] = {
        {"mangata: 1\ncamera: {position: [0, 2, 0], target: [0, 1, -9]}\nwater:\n  waves:\n    - {amplitude: 0.4, a: 1, b: 0, c: 1}\n", NULL},
        {"mangata: 1\ncamera: {position: [0, 2, 0], target: [0, 1, -9]}\nwater:\n  waves:\n    - {amplitude: 0.1, a: 1, b: 0, c: 1}\n    - {amplitude: 3, a: 3, b: 4, c: 1}\n",
         "s.yaml:6:7: wave 1 is 15 steep"},
        {"mangata: 1\ncamera:\n  position: [0, 2, 0]\n  target: [0, 1, -9]\nwater:\n  waves:\n    - {amplitude: 3, a: 0.1, b: 0, c: 0.5, phase: 1.5707963}\n",
         "s.yaml:3:13: in frame 0 a wave stands 3 m over the mean surface at the camera, which is at 2 m"},
        {"mangata: 1\ncamera: {position: [0, -2, 0], target: [0, -3, -9]}\nwater:\n  waves:\n    - {amplitude: 3, a: 0.1, b: 0, c: 0.5, phase: -1.5707963}\n",
         "s.yaml:2:20: in frame 0 a wave stands 3 m under the mean surface at the camera, which is at -2 m"},
        {"mangata: 1\ncamera: {position: [0, 0, 0], target: [0, 0, -9]}\nwater:\n  waves:\n    - {amplitude: 3, a: 0.1, b: 0, c: 0.5, phase: -1.5707963}\n",
         NULL},
        {"mangata: 1\ncamera: {position: [0, 0, 0], target: [0, 0, -9]}\nwater:\n  waves:\n    - {amplitude: 3, a: 0.1, b: 0, c: 0.5, phase: 1.5707963}\n",
         "s.yaml:2:20: in frame 0 a wave stands 3 m over the mean surface at the camera, which is at 0 m: it is drawn as if it were dry"},
        {"mangata: 1\ncamera: {position: [0, 5, 0], target: [0, 5, -9]}\nwater:\n  level: 5\n  waves:\n    - {amplitude: 3, a: 0.1, b: 0, c: 0.5, phase: -1.5707963}\n",
         NULL},
        {"mangata: 1\nwater:\n  choppiness: 0.5\n  waves: [{amplitude: 0.1, a: 1, b: 0, c: 1}]\n  foam: {amount: 1}\n",
         "s.yaml:5:18: water.foam.amount follows the wind"},
        {"mangata: 1\nsky: {model: gradient, aerial: on}\n", "s.yaml:2:32: sky.aerial shows the air of the model atmosphere"},
        {"mangata: 1\nsky: {aerial: on}\n", NULL},
        {"mangata: 1\nsky: {model: black, stars: on}\n", "s.yaml:2:28: sky.stars shows stars in the model atmosphere"},
        {"mangata: 1\nsky: {stars: on}\n", NULL},
        {"mangata: 1\nsky: {model: black}\n",
         "s.yaml:2:14: under a black sky the exposure follows from the light alone: glitter of a disk of 0.267 degrees is displayed nearly "
         "black; post.exposure_offset: 5.8 "},
        {"mangata: 1\nsky: {model: black}\nlight: {angular_radius_deg: 1}\n", NULL},
        {"mangata: 1\nsky: {model: black}\nlight: {radiance: [0, 0, 0]}\n", NULL},
        {"mangata: 1\nsky: {model: black}\npost: {exposure_offset: 6}\n", NULL},
        {"mangata: 1\nsky: {model: black}\npost: {exposure: -18}\n", NULL},
        {"mangata: 1\nwater:\n  waves: [{amplitude: 0.1, a: 1, b: 0, c: 1}]\n  foam: {share: 0.1}\n", "s.yaml:4:9: foam is on water that is pressed together"},
        {"mangata: 1\nwater:\n  choppiness: 0.5\n  waves: [{amplitude: 0.1, a: 1, b: 0, c: 1}]\n  foam: {share: 0.1}\n", NULL},
        {"mangata: 1\nwater: {wind: 12}\n", NULL},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        scene_file *file;
        const char *warning = warning_of(cases[i].text, &file);
        if (cases[i].warning == NULL)
            assert_string_equal(warning, "");
        else if (strncmp(warning, cases[i].warning, strlen(cases[i].warning)) != 0)
            fail_msg("%s instead of %s", warning, cases[i].warning);
        scene_file_free(file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_say_what_where_and_what_is_allowed),
        cmocka_unit_test(override_messages_name_the_option),
        cmocka_unit_test(files_that_cannot_be_read),
        cmocka_unit_test(a_file_without_permission),
        cmocka_unit_test(bad_files_of_the_test_data),
        cmocka_unit_test(hostile_files_are_refused),
        cmocka_unit_test(every_truncation_of_a_file_is_refused),
        cmocka_unit_test(changed_files_do_no_harm),
        cmocka_unit_test(nothing_is_printed),
        cmocka_unit_test(scenes_hardly_meant_are_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
