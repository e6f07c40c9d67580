/* SPDX-License-Identifier: MIT
 *
 * Method adaptive, scheme podee: the paper's equations one by one, and a picture taken apart by them.
 */
#include "kernel_lane.h"

#include "api_sea.h"
#include "cpu/adaptive_podee.h"

/* ---- Eq. 1 ---- */

static void importance_is_the_papers_gaussian(void **state)
{
    (void)state;
    static const double centers[] = {0.1, 0.5, 1}, widths[] = {1e-6, 0.04, 0.3, 1};
    for (int c = 0; c < 3; c++)
        for (int w = 0; w < 4; w++) {
            const podee_rules rules = {centers[c], widths[w], 0};
            const double variance = widths[w] * widths[w], peak = 1 / sqrt(2 * 3.14159265358979323846 * variance);
            for (int i = 0; i <= 1000; i++) {
                const float value = (float)i / 1000;
                const double x = (double)value - centers[c], density = peak * exp(-x * x / (2 * variance));
                assert_true(fabs((double)podee_importance(&rules, value) - density / peak) < 1e-7);
            }
            assert_true(podee_importance(&rules, (float)centers[c]) > 0.999f || widths[w] < 1e-5);
        }
}

/* What GPUs take for it, in single precision. */
static void shaders_importance_is_the_same(void **state)
{
    (void)state;
    static const double centers[] = {0.1, 0.5, 0.003}, widths[] = {0.0012, 0.04, 0.3, 1};
    double worst = 0;
    for (int c = 0; c < 3; c++)
        for (int w = 0; w < 4; w++) {
            const podee_rules rules = {centers[c], widths[w], 0};
            const float center = (float)centers[c], low = (float)(centers[c] - (double)center), width = (float)widths[w];
            for (int i = 0; i <= 1000; i++) {
                const float value = (float)i / 1000;
                worst = fmax(worst, fabs((double)podee_importance(&rules, value) - (double)slot_importance(NULL, value, center, low, width)));
            }
        }
    expect_below("Eq. 1 in single precision", worst, 4e-7);
}

/* "Any pixel that is not in that reflection at all is ignored": with c and ρ as printed the threshold must be above exp(−c²/2ρ²) = .044. */
static void defaults_ignore_dark_pixels(void **state)
{
    (void)state;
    mgt_quality quality;
    mgt_quality_init(&quality, sizeof quality);
    const podee_rules rules = podee_rules_of(&quality);
    assert_true(rules.center == 0.1 && rules.width == 0.04);
    assert_true((double)podee_importance(&rules, 0) > 0.043 && (double)podee_importance(&rules, 0) < rules.threshold);
    assert_true((double)podee_importance(&rules, 0.01f) > rules.threshold);
}

/* ---- Eq. 2 ---- */

enum { TASKS = 5000 };

static double make_tasks(random_state *r, double *value, double *before)
{
    double sum = 0;
    for (int i = 0; i < TASKS; i++) {
        value[i] = (double)(float)(random_unit(r) < 0.1 ? random_range(r, 0.5, 1) : random_range(r, 5e-4, 0.02));
        before[i] = sum;
        sum += value[i];
    }
    return sum;
}

static void slots_are_shared_in_proportion(void **state)
{
    (void)state;
    random_state r = {7};
    static double value[TASKS], before[TASKS];
    static uint64_t count[TASKS];
    const double sum = make_tasks(&r, value, before);
    static const uint64_t many[] = {1, 3, 999, 100003, 3000000};
    for (int m = 0; m < 5; m++) {
        const uint64_t slots = many[m];
        memset(count, 0, sizeof count);
        for (uint64_t k = 0; k < slots; k++)
            count[podee_task_at(before, TASKS, podee_slot_place(k, slots, sum))]++;
        uint64_t all = 0;
        for (int i = 0; i < TASKS; i++) {
            const double share = (double)slots * value[i] / sum;
            if (fabs((double)count[i] - share) > 1 + 1e-6)
                fail_msg("task %d of %llu slots has %llu instead of %g", i, (unsigned long long)slots, (unsigned long long)count[i], share);
            assert_true(podee_first_slot(before[i], slots, sum) == all); /* those before it */
            all += count[i];
        }
        assert_true(all == slots && podee_first_slot(sum, slots, sum) == slots);
        /* Large enough a number reaches every task: the whole prefix sum is searched, its end too. */
        if (slots == 3000000)
            for (int i = 0; i < TASKS; i++)
                assert_true(count[i] > 0);
    }
}

static void searches_end_where_they_must(void **state)
{
    (void)state;
    random_state r = {11};
    static double value[TASKS], before[TASKS];
    const double sum = make_tasks(&r, value, before);
    for (size_t count = 1; count <= 40; count++)
        for (size_t i = 0; i < count; i++) {
            assert_int_equal(podee_task_at(before, count, before[i]), i);
            assert_int_equal(podee_task_at(before, count, before[i] + 0.5 * value[i]), i);
        }
    assert_int_equal(podee_task_at(before, 40, -1), 0);
    const uint64_t most = (uint64_t)1 << 32;
    assert_true(podee_slot_place(most - 1, most, sum) < sum && podee_slot_place(0, most, sum) > 0);
    for (int i = 0; i < 1000; i++) {
        const uint64_t k = podee_first_slot(before[i], most, sum);
        assert_true(podee_slot_place(k, most, sum) >= before[i] && (k == 0 || podee_slot_place(k - 1, most, sum) < before[i]));
    }
}

static void slots_follow_the_water(void **state)
{
    (void)state;
    mgt_quality q;
    mgt_quality_init(&q, sizeof q);
    assert_true(podee_slots_of(&q, 1000) == 8000 && podee_slots_of(&q, 0) == 1);
    q.samples = 2.5;
    assert_true(podee_slots_of(&q, 1000) == 2500);
    q.samples = 0;
    q.sample_slots = 77;
    assert_true(podee_slots_of(&q, 1000) == 77);
}

/* ---- Eq. 3 ---- */

static void weights_are_the_nyquist_share(void **state)
{
    (void)state;
    assert_true(podee_detail_weight(0, 3) == 0);
    assert_true(podee_detail_weight(6, 3) == 1 && podee_detail_weight(1e9, 3) == 1); /* two samples a wave */
    assert_true(fabs(podee_detail_weight(3, 3) - 0.5) < 1e-15);
    assert_true(podee_detail_weight(0.1, 0) == 1 && podee_detail_weight(0, 0) == 0);
    static const double samples[] = {0, 0.1, 0.7, 3, 6, 1e9}, frequencies[] = {0, 1e-7, 0.4, 3, 200};
    for (int s = 0; s < 6; s++)
        for (int f = 0; f < 5; f++) {
            const real weight = slot_weight(NULL, (float)samples[s], (float)frequencies[f]);
            assert_true(fabs(podee_detail_weight(samples[s], frequencies[f]) - (double)weight) < 2e-7);
        }
}

/* ---- §3.1 ---- */

static void light_share_is_a_ratio_of_lengths(void **state)
{
    (void)state;
    random_state r = {3};
    double worst = 0, near_arc = 0;
    const int steps = 20000;
    for (int i = 0; i < 300; i++) {
        const double radius = random_range(&r, 0.005, 0.4), reach = random_range(&r, 0.1, 5) * radius;
        const vec2 from = vec2((float)random_range(&r, -reach, reach), (float)random_range(&r, -reach, reach));
        const vec2 to = i % 10 == 0 ? from : vec2((float)random_range(&r, -reach, reach), (float)random_range(&r, -reach, reach));
        int inside = 0;
        for (int k = 0; k < steps; k++) {
            const double t = (k + 0.5) / steps, x = from.x + t * (to.x - from.x), y = from.y + t * (to.y - from.y);
            inside += x * x + y * y < radius * radius;
        }
        const double share = (double)light_length_fraction(NULL, from, to, (float)radius);
        assert_true(share >= 0 && share <= 1);
        worst = fmax(worst, fabs(share - (double)inside / steps));
        if (reach < 0.05)
            near_arc = fmax(near_arc, fabs(share - (double)light_arc_fraction(NULL, from, to, (float)radius)));
    }
    expect_below("share of the segment in the disk, against counting", worst, 2e-4);
    expect_below("ratio of lengths against that of arcs, short paths", near_arc, 2e-3);
}

/* ---- pictures ---- */

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT };

typedef struct layers {
    float coverage[PIXELS], water[PIXELS], samples[PIXELS], importance[PIXELS], detail[PIXELS], color[3 * PIXELS];
} layers;

static void render_layers(mgt_context *context, const mgt_scene *scene, layers *out)
{
    const mgt_target targets[] = {sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, out->coverage, 0),
                                  sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, out->water, 0),
                                  sea_target(MGT_LAYER_SAMPLES, MGT_FORMAT_R32F, out->samples, 0),
                                  sea_target(MGT_LAYER_IMPORTANCE, MGT_FORMAT_R32F, out->importance, 0),
                                  sea_target(MGT_LAYER_DETAIL, MGT_FORMAT_R32F, out->detail, 0),
                                  sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, out->color, 0)};
    sea_render(context, scene, targets, 6);
}

/* The scene by scheme podee and, for comparison, its approximate picture. */
typedef struct sea_pictures {
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene;
    layers adaptive, approximate;
} sea_pictures;

static sea_pictures *make_pictures(mgt_context *context, double samples, uint64_t slots, double threshold)
{
    sea_pictures *p = calloc(1, sizeof *p);
    assert_non_null(p);
    p->scene = sea_scene(p->waves);
    p->scene.quality.method = MGT_METHOD_PODEE_UNIFORM;
    render_layers(context, &p->scene, &p->approximate);
    p->scene.quality.method = MGT_METHOD_ADAPTIVE;
    p->scene.quality.adaptive = MGT_ADAPTIVE_PODEE;
    p->scene.quality.samples = samples;
    p->scene.quality.sample_slots = slots;
    p->scene.quality.importance_threshold = threshold;
    render_layers(context, &p->scene, &p->adaptive);
    return p;
}

/* Of the finest wave at a pixel of full water, in double: the change of phase over steps of a pixel, on the mean surface. */
static double finest_frequency(const mgt_scene *scene, int x, int y)
{
    const camera_rays c = camera_rays_of(&scene->camera, scene->image.width, scene->image.height);
    double at[3][2], most = 0;
    const double step = 1e-4;
    for (int k = 0; k < 3; k++) {
        const double column = x + (k == 1 ? step : 0), row = y + (k == 2 ? step : 0);
        double ray[3];
        for (int i = 0; i < 3; i++)
            ray[i] = c.corner[i] + column * c.right[i] + row * c.down[i];
        at[k][0] = -ray[0] / ray[1] * c.position[1];
        at[k][1] = -ray[2] / ray[1] * c.position[1];
    }
    for (size_t w = 0; w < scene->water.wave_count; w++) {
        const mgt_wave *v = &scene->water.waves[w];
        const double right = (v->kx * (at[1][0] - at[0][0]) + v->kz * (at[1][1] - at[0][1])) / step;
        const double down = (v->kx * (at[2][0] - at[0][0]) + v->kz * (at[2][1] - at[0][1])) / step;
        most = fmax(most, hypot(right, down) / (2 * 3.14159265358979323846));
    }
    return most;
}

/* Eqs. 1 to 4 once more, from the layers alone. */
static void pictures_are_put_together_as_printed(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    sea_pictures *p = make_pictures(context, 0, 9001, 0);
    const layers *a = &p->adaptive, *u = &p->approximate;
    const podee_rules rules = podee_rules_of(&p->scene.quality);
    double slots = 0, sum = 0, worst_share = 0, worst_blend = 0, worst_color = 0;
    int tasks = 0, between = 0;
    for (int i = 0; i < PIXELS; i++) {
        slots += (double)a->samples[i];
        sum += (double)a->importance[i];
    }
    assert_true(slots == 9001);
    for (int i = 0; i < PIXELS; i++) {
        const float v = podee_importance(&rules, u->coverage[i]);
        assert_true(a->importance[i] == (u->water[i] > 0 && (double)v > rules.threshold ? v : 0));
        const double share = 9001 * (double)a->importance[i] / sum;
        worst_share = fmax(worst_share, fabs((double)a->samples[i] - share));
        tasks += a->importance[i] > 0;
        if (a->samples[i] == 0) {
            assert_true(a->coverage[i] == u->coverage[i] && a->detail[i] == 0 && memcmp(a->color + 3 * i, u->color + 3 * i, 12) == 0);
            continue;
        }
        if (u->water[i] < 1)
            continue;
        const double weight = fmin(share * 0.5 / finest_frequency(&p->scene, i % SEA_WIDTH, i / SEA_WIDTH), 1);
        const double blend = (1 - weight) * (double)u->coverage[i] + weight * (double)a->detail[i];
        between += weight < 1;
        worst_blend = fmax(worst_blend, fabs(blend - (double)a->coverage[i]));
        worst_color += fabs((double)(a->color[3 * i] - u->color[3 * i]));
    }
    print_message("  %d tasks, %d of them with less than the Nyquist share\n", tasks, between);
    assert_true(tasks > 100 && between > 20 && between < tasks - 20);
    expect_below("slots of a pixel against M v/Σv", worst_share, 1 + 1e-6);
    expect_below("Eq. 4 from the layers, coverage", worst_blend, 2e-5);
    assert_true(worst_color > 0);
    free(p);
    mgt_context_destroy(context);
}

/* Nothing above the threshold: the approximate picture to the bit. */
static void no_tasks_leave_the_picture(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    sea_pictures *p = make_pictures(context, 0, 0, 1);
    for (int i = 0; i < PIXELS; i++)
        assert_true(p->adaptive.samples[i] == 0 && p->adaptive.importance[i] == 0 && p->adaptive.detail[i] == 0);
    assert_memory_equal(p->adaptive.coverage, p->approximate.coverage, sizeof p->adaptive.coverage);
    assert_memory_equal(p->adaptive.water, p->approximate.water, sizeof p->adaptive.water);
    assert_memory_equal(p->adaptive.color, p->approximate.color, sizeof p->adaptive.color);
    free(p);
    mgt_context_destroy(context);
}

/* Enough slots: where Eq. 3 is 1 the picture is the detail image, and that is the brute-force one as long as paths are straight: the
 * shutter is short. */
static void many_samples_reach_the_reference(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    sea_pictures *p = calloc(1, sizeof *p);
    layers *truth = calloc(1, sizeof *truth);
    assert_true(p && truth);
    p->scene = sea_scene(p->waves);
    p->scene.shutter = 0.005;
    p->scene.light.angular_radius_deg = 6; /* light for many pixels: sums of less noise */
    p->scene.light.body = MGT_SOURCE_MOON; /* as bright at its rim as in the middle, which is what the paper's lights are */
    for (int moves = 0; moves < 2; moves++) {
        p->scene.camera_moves = moves;
        p->scene.camera_open = p->scene.camera;
        p->scene.camera_open.position[0] -= 0.05;
        p->scene.camera_open.target[0] -= 0.05;
        mgt_quality_init(&p->scene.quality, sizeof p->scene.quality);
        p->scene.quality.method = MGT_METHOD_REFERENCE;
        p->scene.quality.spatial_samples = 12;
        p->scene.quality.time_samples = 8;
        render_layers(context, &p->scene, truth);
        mgt_quality_init(&p->scene.quality, sizeof p->scene.quality);
        p->scene.quality.method = MGT_METHOD_ADAPTIVE;
        p->scene.quality.adaptive = MGT_ADAPTIVE_PODEE;
        p->scene.quality.importance_width = 1;
        p->scene.quality.samples = 300;
        render_layers(context, &p->scene, &p->adaptive);
        double square = 0, sum = 0, true_sum = 0, color = 0, true_color = 0;
        int count = 0;
        for (int i = 0; i < PIXELS; i++) {
            const bool whole = p->adaptive.water[i] == 1 && truth->water[i] == 1;
            if (!whole || (double)p->adaptive.samples[i] < 2.1 * finest_frequency(&p->scene, i % SEA_WIDTH, i / SEA_WIDTH))
                continue;
            const double difference = (double)(p->adaptive.coverage[i] - truth->coverage[i]);
            square += difference * difference;
            sum += (double)p->adaptive.coverage[i];
            true_sum += (double)truth->coverage[i];
            color += (double)p->adaptive.color[3 * i + 1];
            true_color += (double)truth->color[3 * i + 1];
            count++;
        }
        assert_true(count > PIXELS / 3);
        expect_below("RMSE of coverage, 300 samples a pixel, against the reference", sqrt(square / count), 0.012);
        expect_below("light over the reference's, away from 1", fabs(sum / true_sum - 1), 0.02);
        expect_below("radiance over the reference's, away from 1", fabs(color / true_color - 1), 0.02);
    }
    free(truth);
    free(p);
    mgt_context_destroy(context);
}

/* A moving camera, and a shutter that never opens: every machine the same, nothing out of range. */
static void bits_do_not_depend_on_machines(void **state)
{
    (void)state;
    static const struct {
        uint32_t threads;
        mgt_isa isa;
    } machines[] = {{1, MGT_ISA_SCALAR}, {3, MGT_ISA_AVX2}, {7, MGT_ISA_AVX512}};
    static layers first, again;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.quality.method = MGT_METHOD_ADAPTIVE;
    scene.quality.adaptive = MGT_ADAPTIVE_PODEE;
    for (int kind = 0; kind < 2; kind++) {
        scene.camera_moves = kind == 0;
        scene.camera_open = scene.camera;
        scene.camera_open.target[0] += 0.02;
        scene.shutter = kind == 0 ? 0.02 : 0;
        for (size_t m = 0; m < 3; m++) {
            if (!mgt_isa_available(machines[m].isa))
                continue;
            mgt_context *context = sea_context(machines[m].threads, machines[m].isa);
            render_layers(context, &scene, m == 0 ? &first : &again);
            if (m > 0)
                assert_memory_equal(&again, &first, sizeof first);
            mgt_context_destroy(context);
        }
        for (int i = 0; i < PIXELS; i++)
            assert_true(first.coverage[i] >= 0 && first.coverage[i] <= first.water[i] && first.water[i] <= 1 && first.detail[i] >= 0 && first.detail[i] <= 1);
    }
}

static bool stop(void *user, double fraction)
{
    double *last = user;
    assert_true(fraction >= *last && fraction <= 1);
    *last = fraction;
    return fraction < 0.3;
}

static void a_long_picture_can_be_cancelled(void **state)
{
    (void)state;
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    double last = 0;
    desc.threads = 2;
    desc.progress = stop;
    desc.progress_user = &last;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.quality.method = MGT_METHOD_ADAPTIVE;
    scene.quality.adaptive = MGT_ADAPTIVE_PODEE;
    scene.quality.sample_slots = (uint64_t)1 << 32; /* minutes */
    static float pixels[PIXELS];
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels, 0);
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_CANCELLED);
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(importance_is_the_papers_gaussian),    cmocka_unit_test(shaders_importance_is_the_same),
        cmocka_unit_test(defaults_ignore_dark_pixels),          cmocka_unit_test(slots_are_shared_in_proportion),
        cmocka_unit_test(searches_end_where_they_must),         cmocka_unit_test(slots_follow_the_water),
        cmocka_unit_test(weights_are_the_nyquist_share),        cmocka_unit_test(light_share_is_a_ratio_of_lengths),
        cmocka_unit_test(pictures_are_put_together_as_printed), cmocka_unit_test(no_tasks_leave_the_picture),
        cmocka_unit_test(many_samples_reach_the_reference),     cmocka_unit_test(bits_do_not_depend_on_machines),
        cmocka_unit_test(a_long_picture_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
