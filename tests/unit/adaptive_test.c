/* SPDX-License-Identifier: MIT
 *
 * Method adaptive: what its layers add up to, that more samples are nearer to brute force, and that every way to end is kept.
 */
#include "api_sea.h"

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT };

typedef struct layers {
    float coverage[PIXELS], water[PIXELS], samples[PIXELS], importance[PIXELS], detail[PIXELS];
} layers;

static void render_layers(mgt_context *context, const mgt_scene *scene, layers *out)
{
    const mgt_target targets[] = {
        sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, out->coverage, 0), sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, out->water, 0),
        sea_target(MGT_LAYER_SAMPLES, MGT_FORMAT_R32F, out->samples, 0),   sea_target(MGT_LAYER_IMPORTANCE, MGT_FORMAT_R32F, out->importance, 0),
        sea_target(MGT_LAYER_DETAIL, MGT_FORMAT_R32F, out->detail, 0),
    };
    sea_render(context, scene, targets, sizeof targets / sizeof *targets);
}

static double sum_of(const float *plane)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        sum += (double)plane[i];
    return sum;
}

static double rmse_of(const float *a, const float *b)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return sqrt(sum / PIXELS);
}

/* A black sky: only the glitter counts. */
static mgt_scene glitter_scene(mgt_wave waves[SEA_WAVES], mgt_method method)
{
    mgt_scene scene = sea_scene(waves);
    scene.sky.model = MGT_SKY_BLACK;
    scene.quality.method = method;
    return scene;
}

static void render_truth(mgt_context *context, const mgt_scene *like, layers *truth)
{
    mgt_scene scene = *like;
    mgt_quality_init(&scene.quality, sizeof scene.quality);
    scene.quality.method = MGT_METHOD_REFERENCE;
    scene.quality.spatial_samples = 16;
    scene.quality.time_samples = 8;
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, truth->coverage, 0);
    sea_render(context, &scene, &target, 1);
}

static void samples_are_those_asked_for(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers l;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE);
    static const double asked[] = {0, 6, 12, 40};
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        scene.quality.samples = asked[i];
        render_layers(context, &scene, &l);
        const double mean = sum_of(l.samples) / sum_of(l.water), wanted = asked[i] > 0 ? asked[i] : 8;
        if (!(fabs(mean / wanted - 1) < 0.02))
            fail_msg("%g samples a pixel of water were asked for, %g taken", wanted, mean);
        for (int p = 0; p < PIXELS; p++) {
            assert_true(l.coverage[p] >= 0 && l.coverage[p] <= 1 && l.importance[p] >= 0 && l.importance[p] <= 1);
            assert_true(l.detail[p] >= 0 && l.detail[p] <= l.coverage[p] * 1.0001f && (l.water[p] > 0) == (l.samples[p] > 0));
        }
    }
    mgt_context_destroy(context);
}

static void more_samples_are_nearer_to_brute_force(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers truth, l;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_MANGATA);
    render_truth(context, &scene, &truth);
    render_layers(context, &scene, &l);
    const double model = rmse_of(l.coverage, truth.coverage);
    scene.quality.method = MGT_METHOD_ADAPTIVE;
    static const double samples[] = {4, 8, 32, 128};
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        scene.quality.samples = samples[i];
        render_layers(context, &scene, &l);
        const double error = rmse_of(l.coverage, truth.coverage);
        print_message("%g samples: RMSE %.5f, of the analytic picture's %.5f\n", samples[i], error, model);
        assert_true(error < (samples[i] < 32 ? 0.7 : 0.55) * model); /* most of what is left is the noise of 2,048 samples */
    }
    mgt_context_destroy(context);
}

/* The shutter's halves: a fast sea, so that paths bend. */
static void shutters_of_any_length_converge(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers truth, l;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE);
    static const double shutters[] = {0, 0.02, 0.2};
    for (size_t i = 0; i < sizeof shutters / sizeof *shutters; i += 1 + MGT_SANITIZED) {
        scene.shutter = shutters[i];
        render_truth(context, &scene, &truth);
        scene.quality.method = MGT_METHOD_MANGATA;
        scene.quality.samples = 0;
        render_layers(context, &scene, &l);
        const double model = rmse_of(l.coverage, truth.coverage);
        scene.quality.method = MGT_METHOD_ADAPTIVE;
        scene.quality.samples = 64;
        render_layers(context, &scene, &l);
        const double error = rmse_of(l.coverage, truth.coverage);
        print_message("shutter %g s: RMSE %.5f, of the analytic picture's %.5f\n", shutters[i], error, model);
        assert_true(error < 0.75 * model);
    }
    mgt_context_destroy(context);
}

static void a_target_error_is_met(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers truth, l;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE);
    render_truth(context, &scene, &truth);
    static const double targets[] = {0.02, 0.01, 0.005};
    double before = 0;
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        scene.quality.target_rmse = targets[i];
        render_layers(context, &scene, &l);
        const double error = rmse_of(l.coverage, truth.coverage), spent = sum_of(l.samples) / sum_of(l.water);
        print_message("target %g: RMSE %.5f with %.1f samples\n", targets[i], error, spent);
        assert_true(error < 1.3 * targets[i] && spent >= before);
        before = spent;
    }
    mgt_context_destroy(context);
}

static void a_small_target_has_its_samples(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers l;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE);
    /* Half the error takes more than half as many samples again. No leaf that such an error needs may be settled in the first rounds. */
    static const double targets[] = {0.004, 0.002, 0.001};
    double before = 0;
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        scene.quality.target_rmse = targets[i];
        render_layers(context, &scene, &l);
        const double spent = sum_of(l.samples) / sum_of(l.water);
        print_message("target %g: %.1f samples\n", targets[i], spent);
        assert_true(spent > 1.5 * before);
        before = spent;
    }
    mgt_context_destroy(context);
}

enum { DISPLAYED = 4 * PIXELS };

static void render_displayed(mgt_context *context, const mgt_scene *scene, uint8_t rgba[DISPLAYED])
{
    const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, rgba, 0);
    sea_render(context, scene, &target, 1);
}

static double displayed_at(const uint8_t *rgba, int pixel)
{
    return (0.2126 * rgba[4 * pixel] + 0.7152 * rgba[4 * pixel + 1] + 0.0722 * rgba[4 * pixel + 2]) / 255;
}

/* Freed of the references' noise. */
static double displayed_rmse(const uint8_t *rgba, const uint8_t *first, const uint8_t *second)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        sum += (displayed_at(rgba, i) - displayed_at(first, i)) * (displayed_at(rgba, i) - displayed_at(second, i));
    return sqrt(fmax(sum, 0) / PIXELS);
}

/* Seas under a sky: with the road of a light that the references can follow, and grazing water from two heights without it. */
static mgt_scene sky_scene(mgt_wave waves[SEA_WAVES], int which)
{
    mgt_scene scene = sea_scene(waves);
    scene.post.glare = 0;
    for (int k = 0; k < 3; k++)
        scene.light.radiance[k] = which == 0 ? 100 : 0;
    if (which == 0)
        return scene;
    scene.camera.position[1] = which == 1 ? 1.5 : 8;
    scene.camera.target[1] = scene.camera.position[1] - 0.16;
    for (int i = 0; i < SEA_WAVES; i++)
        waves[i].amplitude *= 2.5;
    return scene;
}

static void a_displayed_target_is_met_and_no_picture_gets_worse(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static uint8_t first[DISPLAYED], second[DISPLAYED], rgba[DISPLAYED];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int which = 0; which < 3; which += 1 + MGT_SANITIZED) {
        mgt_scene scene = sky_scene(waves, which);
        scene.quality.method = MGT_METHOD_REFERENCE;
        scene.quality.spatial_samples = 12;
        scene.quality.time_samples = 4;
        render_displayed(context, &scene, first);
        scene.quality.seed = 1;
        render_displayed(context, &scene, second);
        mgt_quality_init(&scene.quality, sizeof scene.quality);
        render_displayed(context, &scene, rgba);
        const double model = displayed_rmse(rgba, first, second);
        scene.quality.method = MGT_METHOD_ADAPTIVE;
        render_displayed(context, &scene, rgba);
        const double eight = displayed_rmse(rgba, first, second);
        print_message("sea %d: displayed RMSE %.5f, of the analytic picture's %.5f\n", which, eight, model);
        assert_true(eight < 0.9 * model);
        static const double targets[] = {0.02, 0.01};
        for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
            scene.quality.target_displayed = targets[i];
            render_displayed(context, &scene, rgba);
            const double error = displayed_rmse(rgba, first, second);
            print_message("sea %d: target %g, displayed RMSE %.5f\n", which, targets[i], error);
            assert_true(error < 2 * targets[i]);
        }
    }
    mgt_context_destroy(context);
}

/* Under a black sky the error of coverage is the only one. */
static void a_displayed_target_is_one_of_coverage_under_a_black_sky(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers l;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE);
    static const double targets[] = {0.02, 0.005};
    double spent[2];
    for (int i = 0; i < 2; i++) {
        scene.quality.target_displayed = targets[i];
        render_layers(context, &scene, &l);
        spent[i] = sum_of(l.samples);
    }
    assert_true(spent[1] > spent[0]);
    mgt_context_destroy(context);
}

/* Frames do not know of each other, though they share memory: sizes, cameras and ends change in between. */
static void history_leaves_no_trace(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers first, again;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE), other = scene;
    render_layers(context, &scene, &first);
    other.camera_moves = true;
    other.camera_open = other.camera;
    other.camera_open.position[0] -= 0.1;
    other.quality.samples = 40;
    render_layers(context, &other, &again);
    assert_true(memcmp(&first, &again, sizeof first) != 0);
    other.image.width = other.image.height = 20;
    other.quality.samples = 0;
    other.quality.budget_ms = 5;
    render_layers(context, &other, &again);
    render_layers(context, &scene, &again);
    assert_memory_equal(&first, &again, sizeof first);
    mgt_context_destroy(context);
}

static void nothing_to_find_costs_nothing(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static layers l, model;
    mgt_context *context = sea_context(1, MGT_ISA_AUTO);
    mgt_scene scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE);
    scene.light.elevation_deg = -5;
    render_layers(context, &scene, &l);
    scene.quality.method = MGT_METHOD_MANGATA;
    render_layers(context, &scene, &model);
    assert_memory_equal(l.coverage, model.coverage, sizeof l.coverage);
    assert_true(sum_of(l.coverage) == 0 && sum_of(l.samples) < 3 * sum_of(l.water));
    scene = glitter_scene(waves, MGT_METHOD_ADAPTIVE);
    scene.water.wave_count = 0;
    render_layers(context, &scene, &l);
    assert_true(isfinite(sum_of(l.coverage)));
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_those_asked_for),
        cmocka_unit_test(more_samples_are_nearer_to_brute_force),
        cmocka_unit_test(shutters_of_any_length_converge),
        cmocka_unit_test(a_target_error_is_met),
        cmocka_unit_test(a_small_target_has_its_samples),
        cmocka_unit_test(history_leaves_no_trace),
        cmocka_unit_test(nothing_to_find_costs_nothing),
        cmocka_unit_test(a_displayed_target_is_met_and_no_picture_gets_worse),
        cmocka_unit_test(a_displayed_target_is_one_of_coverage_under_a_black_sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
