/* SPDX-License-Identifier: MIT
 *
 * What a frame may depend on: sample ranges add up, places far from the origin look like those near it, limits render, unusual scenes too.
 */
#include "api_sea.h"

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT };

static void render_coverage(mgt_context *context, const mgt_scene *scene, float *coverage)
{
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage, 0);
    sea_render(context, scene, &target, 1);
}

/* The mean of the samples [first, first + count) and of the others, weighted by their numbers, is the mean of all. */
static void sample_ranges_add_up(void **state)
{
    (void)state;
    static const mgt_method methods[] = {MGT_METHOD_SSAA, MGT_METHOD_REFERENCE};
    static float whole[PIXELS], low[PIXELS], high[PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.quality.spatial_samples = 3;
    scene.quality.time_samples = 4;
    scene.quality.seed = 5;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int m = 0; m < 2; m++) {
        scene.quality.method = methods[m];
        scene.quality.sample_first = scene.quality.sample_count = 0;
        render_coverage(context, &scene, whole);
        static const unsigned splits[] = {18, 5, 35};
        for (size_t k = 0; k < sizeof splits / sizeof *splits; k++) {
            scene.quality.sample_first = 0;
            scene.quality.sample_count = splits[k];
            render_coverage(context, &scene, low);
            scene.quality.sample_first = splits[k];
            scene.quality.sample_count = 0; /* all that remain */
            render_coverage(context, &scene, high);
            double worst = 0, apart = 0;
            for (int i = 0; i < PIXELS; i++) {
                const double mean = (splits[k] * (double)low[i] + (36 - splits[k]) * (double)high[i]) / 36;
                worst = fmax(worst, fabs(mean - (double)whole[i]));
                apart = fmax(apart, fabs((double)low[i] - (double)high[i]));
            }
            assert_true(worst < 1e-6);
            assert_true(apart > 0.05);
        }
    }
    mgt_context_destroy(context);
}

/* A sample of a range is the same whoever asks for it: 36 single samples are the whole. */
static void single_samples_are_zero_or_one(void **state)
{
    (void)state;
    static float whole[PIXELS], one[PIXELS];
    double sum[PIXELS] = {0};
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.quality.method = MGT_METHOD_REFERENCE;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    render_coverage(context, &scene, whole);
    for (unsigned k = 0; k < 8; k++) {
        scene.quality.sample_first = k;
        scene.quality.sample_count = 1;
        render_coverage(context, &scene, one);
        for (int i = 0; i < PIXELS; i++) {
            assert_true(one[i] == 0 || one[i] == 1);
            sum[i] += (double)one[i] / 8;
        }
    }
    for (int i = 0; i < PIXELS; i++)
        assert_true(fabs(sum[i] - (double)whole[i]) < 1e-6);
    mgt_context_destroy(context);
}

static void seeds_change_the_jitter_alone(void **state)
{
    (void)state;
    static float a[PIXELS], b[PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int m = 0; m < SEA_METHODS; m++) {
        sea_take_method(&scene, m);
        scene.quality.seed = 1;
        render_coverage(context, &scene, a);
        scene.quality.seed = 2;
        render_coverage(context, &scene, b);
        const bool sampled =
            sea_methods[m].method == MGT_METHOD_SSAA || sea_methods[m].method == MGT_METHOD_REFERENCE || sea_methods[m].adaptive == MGT_ADAPTIVE_PODEE;
        assert_int_equal(memcmp(a, b, sizeof a) != 0, sampled);
    }
    mgt_context_destroy(context);
}

/* The whole scene shifted by (x, z) with phases to match. */
static mgt_scene shifted(mgt_scene scene, mgt_wave waves[SEA_WAVES], double x, double z)
{
    for (size_t i = 0; i < scene.water.wave_count; i++) {
        waves[i] = scene.water.waves[i];
        waves[i].phase -= waves[i].kx * x + waves[i].kz * z;
    }
    scene.water.waves = waves;
    mgt_camera *cameras[2] = {&scene.camera, &scene.camera_open};
    for (int i = 0; i < 2; i++) {
        cameras[i]->position[0] += x, cameras[i]->target[0] += x;
        cameras[i]->position[2] += z, cameras[i]->target[2] += z;
    }
    return scene;
}

/* Phases of up to 60 rad/m · 100 km are 6e6 rad, kept to 1e-9; the camera's axes to 1e-11: rays within 1e-9 of a pixel. A point sample on
 * the edge of a glint or a crest may flip, which counts as one pixel of all. */
static void far_from_the_origin_nothing_changes(void **state)
{
    (void)state;
    static float near[PIXELS], far[PIXELS];
    mgt_wave waves[SEA_WAVES], moved[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int moves = 0; moves < 2; moves++) {
        scene.camera_moves = moves;
        scene.camera_open.position[0] = 0.2 * moves;
        for (int m = 0; m < SEA_METHODS; m++) {
            sea_take_method(&scene, m);
            render_coverage(context, &scene, near);
            const mgt_scene there = shifted(scene, moved, 1e5, -7e4);
            render_coverage(context, &there, far);
            int changed = 0;
            double sum = 0;
            for (int i = 0; i < PIXELS; i++) {
                const double d = fabs((double)near[i] - (double)far[i]);
                changed += d > 1e-3;
                sum += d;
            }
            if (changed > 2 || sum / PIXELS > 3e-4)
                fail_msg("method %d%s: %d pixels changed by more than .001, mean %g", m, moves ? ", moving" : "", changed, sum / PIXELS);
        }
    }
    mgt_context_destroy(context);
}

static void the_most_waves_render(void **state)
{
    (void)state;
    static mgt_wave waves[MGT_MAX_WAVES];
    static float coverage[PIXELS], first[PIXELS];
    for (int i = 0; i < MGT_MAX_WAVES; i++) {
        const double k = 0.3 * pow(1000, i / (MGT_MAX_WAVES - 1.0)), direction = 2.4 * i;
        waves[i] = (mgt_wave){0.006 / k, k * cos(direction), k * sin(direction), -sqrt(9.81 * k), 1.7 * i};
    }
    mgt_wave few[SEA_WAVES];
    mgt_scene scene = sea_scene(few);
    scene.water.waves = waves;
    scene.water.wave_count = MGT_MAX_WAVES;
    scene.quality.spatial_samples = 1;
    for (int m = 0; m < SEA_METHODS; m++) {
        sea_take_method(&scene, m);
        double sum = 0;
        for (uint32_t threads = 1; threads < 4; threads += 2) {
            mgt_context *context = sea_context(threads, MGT_ISA_AUTO);
            render_coverage(context, &scene, threads == 1 ? first : coverage);
            mgt_context_destroy(context);
        }
        assert_memory_equal(first, coverage, sizeof first);
        for (int i = 0; i < PIXELS; i++)
            sum += (double)coverage[i];
        assert_true(sum > 1 && sum < PIXELS / 4);
    }
}

/* Scenes without waves, shutter, light or day, and views of every kind: all finite, by every method. */
static void unusual_scenes_render(void **state)
{
    (void)state;
    enum { KINDS = 12 };
    static float rgb[PIXELS * 3], coverage[PIXELS], normal[PIXELS * 3];
    static unsigned char shown[PIXELS * 4];
    const mgt_target targets[] = {sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, rgb, 0), sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage, 0),
                                  sea_target(MGT_LAYER_NORMAL, MGT_FORMAT_RGB32F, normal, 0), sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, shown, 0)};
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int kind = 0; kind < KINDS; kind++) {
        mgt_wave waves[SEA_WAVES];
        mgt_scene s = sea_scene(waves);
        bool dark = false;
        switch (kind) {
        case 0:
            s.water.waves = NULL, s.water.wave_count = 0;
            break;
        case 1:
            s.shutter = 0;
            break;
        case 2:
            s.light.elevation_deg = -4, s.sky.model = MGT_SKY_ATMOSPHERE, dark = true;
            break;
        case 3:
            s.light.elevation_deg = -90, dark = true;
            break;
        case 4:
            s.light.elevation_deg = 90;
            break;
        case 5:
            memset(s.light.radiance, 0, sizeof s.light.radiance), s.sky.model = MGT_SKY_BLACK;
            break;
        case 6:
            s.camera.target[0] = 0, s.camera.target[1] = 0, s.camera.target[2] = 0, s.camera.up[1] = 0, s.camera.up[2] = -1;
            break;
        case 7:
            s.camera.up[0] = 1, s.camera.up[1] = 0;
            break;
        case 8:
            s.camera.target[1] = 9, s.camera.fov_y_deg = 178, dark = false;
            break;
        case 9:
            s.camera.target[1] = 5000, s.camera.target[2] = -100;
            break; /* only sky */
        case 10:
            s.camera.position[1] = 1e-4, s.camera.target[1] = 0;
            break; /* among the waves */
        case 11:
            s.camera.position[1] = 1e6, s.camera.target[1] = 1e6 - 10, s.camera.target[2] = -50, s.water.index_of_refraction = 1;
            break;
        }
        for (int m = 0; m < SEA_METHODS + SEA_BASELINES; m++) {
            sea_take_method(&s, m < SEA_METHODS ? m : 0);
            if (m >= SEA_METHODS)
                s.quality.method = sea_baselines[m - SEA_METHODS];
            sea_render(context, &s, targets, 4);
            for (int i = 0; i < PIXELS; i++) {
                bool finite = coverage[i] >= 0 && coverage[i] <= 1 && !(dark && coverage[i] > 0);
                for (int c = 0; c < 3; c++)
                    finite = finite && rgb[3 * i + c] >= 0 && isfinite(rgb[3 * i + c]) && isfinite(normal[3 * i + c]);
                if (!finite)
                    fail_msg("scene %d, method %d, pixel %d: coverage %g, colour %g %g %g, normal %g %g %g", kind, (int)s.quality.method, i,
                             (double)coverage[i], (double)rgb[3 * i], (double)rgb[3 * i + 1], (double)rgb[3 * i + 2], (double)normal[3 * i],
                             (double)normal[3 * i + 1], (double)normal[3 * i + 2]);
            }
        }
    }
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sample_ranges_add_up),          cmocka_unit_test(single_samples_are_zero_or_one),
        cmocka_unit_test(seeds_change_the_jitter_alone), cmocka_unit_test(far_from_the_origin_nothing_changes),
        cmocka_unit_test(the_most_waves_render),         cmocka_unit_test(unusual_scenes_render),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
