/* SPDX-License-Identifier: MIT
 *
 * Frames of podee-* with kernels, several path segments, long shutters and every kind of transition, through the API.
 */
#include "api_sea.h"

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT };

static const mgt_mixture all_kernels[] = {MGT_MIXTURE_EXACT, MGT_MIXTURE_1,      MGT_MIXTURE_3,      MGT_MIXTURE_5,
                                          MGT_MIXTURE_9,     MGT_MIXTURE_FELINE, MGT_MIXTURE_RIEMANN};
enum { KERNELS = sizeof all_kernels / sizeof *all_kernels };

typedef struct sea_state {
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene;
    mgt_context *context;
    float a[PIXELS], b[PIXELS], c[PIXELS];
} sea_state;

static int setup(void **state)
{
    sea_state *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->scene = sea_scene(s->waves);
    s->scene.quality.method = MGT_METHOD_PODEE_UNIFORM;
    s->context = sea_context(2, MGT_ISA_AUTO);
    *state = s;
    return 0;
}

static int teardown(void **state)
{
    sea_state *s = *state;
    mgt_context_destroy(s->context);
    free(s);
    return 0;
}

static void coverage(mgt_context *context, const mgt_scene *scene, float *pixels)
{
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels, 0);
    sea_render(context, scene, &target, 1);
}

static double rms_difference(const float *a, const float *b)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        sum += (double)(a[i] - b[i]) * (double)(a[i] - b[i]) / PIXELS;
    return sqrt(sum);
}

static double sum_of(const float *a)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        sum += (double)a[i];
    return sum;
}

static void expect_rms(const char *what, double measured, double low, double high)
{
    print_message("  %-64s %.3g (%.3g to %.3g)\n", what, measured, low, high);
    if (!(measured >= low && measured <= high))
        fail_msg("%s: %g is not between %g and %g", what, measured, low, high);
}

static void lanes_and_threads_change_no_bit(void **state)
{
    sea_state *s = *state;
    static const mgt_isa isas[] = {MGT_ISA_AVX2, MGT_ISA_AVX512};
    s->scene.quality.path_segments = 2;
    for (int k = 0; k < KERNELS; k++) {
        s->scene.quality.kernels = all_kernels[k];
        s->scene.quality.method = k % 2 ? MGT_METHOD_PODEE_PIXEL : MGT_METHOD_PODEE_UNIFORM;
        mgt_context *scalar = sea_context(1, MGT_ISA_SCALAR);
        coverage(scalar, &s->scene, s->a);
        mgt_context_destroy(scalar);
        assert_true(sum_of(s->a) > 1);
        for (int i = 0; i < 2; i++) {
            if (!mgt_isa_available(isas[i]))
                continue;
            mgt_context *wide = sea_context(2, isas[i]);
            coverage(wide, &s->scene, s->b);
            mgt_context_destroy(wide);
            assert_memory_equal(s->a, s->b, sizeof s->a);
        }
        /* A part of the picture is that part, whatever was rendered before. */
        mgt_scene part = s->scene;
        part.image.crop_x = 33, part.image.crop_y = 17, part.image.crop_width = 20, part.image.crop_height = 9;
        float crop[9][20];
        const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, crop, 0);
        sea_render(s->context, &part, &target, 1);
        for (int y = 0; y < 9; y++)
            assert_memory_equal(crop[y], s->a + (17 + y) * SEA_WIDTH + 33, sizeof crop[y]);
    }
}

/* Each kind approximates the exact integral, and nine kernels better than one. */
static void kernels_are_near_the_integral(void **state)
{
    sea_state *s = *state;
    double rms[KERNELS];
    coverage(s->context, &s->scene, s->a);
    for (int k = 1; k < KERNELS; k++) {
        s->scene.quality.kernels = all_kernels[k];
        s->scene.quality.elongation_limit = all_kernels[k] == MGT_MIXTURE_RIEMANN ? 0 : 1e6;
        coverage(s->context, &s->scene, s->b);
        rms[k] = rms_difference(s->a, s->b);
        print_message("  kernels %2d: rms %.4f, sum over the exact one's %.4f\n", (int)all_kernels[k], rms[k], sum_of(s->b) / sum_of(s->a));
    }
    assert_true(rms[4] < rms[3] && rms[3] < rms[2] && rms[2] < rms[1]);
    expect_rms("nine kernels", rms[4], 0, 0.01);
    /* Without a path there is nothing that the Riemann sum leaves out. */
    s->scene.shutter = 0;
    s->scene.quality.elongation_limit = 0;
    s->scene.quality.kernels = MGT_MIXTURE_EXACT;
    coverage(s->context, &s->scene, s->a);
    s->scene.quality.kernels = MGT_MIXTURE_RIEMANN;
    coverage(s->context, &s->scene, s->b);
    expect_rms("Riemann sums of a still surface", rms_difference(s->a, s->b), 0, 1e-3);
    s->scene.quality.kernels = MGT_MIXTURE_9;
    coverage(s->context, &s->scene, s->c);
    expect_rms("nine kernels there, sum over that of Riemann sums", sum_of(s->c) / sum_of(s->b), 0.97, 1.03);
}

/* A film that an eye keeps for four frames: one shutter of four, in as many pieces, is the mean of the four. */
static void persistence_is_the_mean_of_frames(void **state)
{
    sea_state *s = *state;
    const double interval = 1.0 / 30, now = s->scene.time;
    for (int moves = 0; moves < 2; moves++) {
        memset(s->b, 0, sizeof s->b);
        for (int k = 0; k < 4; k++) {
            mgt_scene part = s->scene;
            part.shutter = interval;
            part.time = now - k * interval;
            part.camera_moves = moves != 0;
            part.camera_open = part.camera;
            part.camera.position[0] += 0.1 * (4 - k), part.camera_open.position[0] += 0.1 * (3 - k);
            part.camera.target[0] += 0.1 * (4 - k), part.camera_open.target[0] += 0.1 * (3 - k);
            if (!moves)
                part.camera = part.camera_open = s->scene.camera;
            coverage(s->context, &part, s->c);
            for (int i = 0; i < PIXELS; i++)
                s->b[i] += 0.25f * s->c[i];
        }
        mgt_scene whole = s->scene;
        whole.shutter = 4 * interval;
        whole.quality.path_segments = 4;
        whole.camera_moves = moves != 0;
        whole.camera_open = whole.camera;
        if (moves)
            whole.camera.position[0] += 0.4, whole.camera.target[0] += 0.4;
        coverage(s->context, &whole, s->a);
        /* Times and camera places round differently. */
        expect_rms(moves ? "a moving camera" : "a camera at rest", rms_difference(s->a, s->b), 0, 2e-4);
    }
}

/* The path bends: more pieces come nearer to many. */
static void segments_converge(void **state)
{
    sea_state *s = *state;
    s->scene.shutter = 0.2;
    s->scene.quality.path_segments = 64;
    coverage(s->context, &s->scene, s->a);
    double last = 1;
    for (uint32_t n = 1; n <= 16; n *= 4) {
        s->scene.quality.path_segments = n;
        coverage(s->context, &s->scene, s->b);
        const double rms = rms_difference(s->a, s->b);
        print_message("  %2u segments: rms %.4f of 64\n", n, rms);
        assert_true(rms < 0.6 * last && rms > 0);
        last = rms;
    }
    s->scene.quality.path_segments = 0;
    coverage(s->context, &s->scene, s->a);
    s->scene.quality.path_segments = 1;
    coverage(s->context, &s->scene, s->b);
    assert_memory_equal(s->a, s->b, sizeof s->a);
}

static void transitions_have_widths(void **state)
{
    sea_state *s = *state;
    coverage(s->context, &s->scene, s->a);
    s->scene.quality.transition_width = 0.3;
    coverage(s->context, &s->scene, s->b);
    assert_memory_equal(s->a, s->b, sizeof s->a);
    s->scene.quality.transition_width = 0;
    s->scene.quality.transition_hard = true;
    coverage(s->context, &s->scene, s->b);
    expect_rms("hard against soft", rms_difference(s->a, s->b), 1e-3, 0.5);
    s->scene.quality.transition_hard = false;
    s->scene.quality.transition_width = 1e-5;
    coverage(s->context, &s->scene, s->c);
    expect_rms("hard against a width of 1e-5", rms_difference(s->c, s->b), 0, 1e-3);
}

static void every_light_gives_shares(void **state)
{
    sea_state *s = *state;
    static const double radii[] = {0.05, 0.2665, 2, 10};
    for (int k = 0; k < KERNELS; k++)
        for (int l = 0; l < 4; l++)
            for (int still = 0; still < 2; still++) {
                s->scene.quality.kernels = all_kernels[k];
                s->scene.quality.method = (k + l) % 2 ? MGT_METHOD_PODEE_PIXEL : MGT_METHOD_PODEE_UNIFORM;
                s->scene.quality.elongation_limit = still && k > 0 && all_kernels[k] != MGT_MIXTURE_RIEMANN ? 1e6 : 0;
                s->scene.light.angular_radius_deg = radii[l];
                s->scene.shutter = still ? 0 : 1.0 / 30;
                coverage(s->context, &s->scene, s->a);
                double sum = 0;
                for (int i = 0; i < PIXELS; i++) {
                    assert_true(s->a[i] >= 0 && s->a[i] <= 1);
                    sum += (double)s->a[i];
                }
                assert_true(sum > 0);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(lanes_and_threads_change_no_bit, setup, teardown),
        cmocka_unit_test_setup_teardown(kernels_are_near_the_integral, setup, teardown),
        cmocka_unit_test_setup_teardown(persistence_is_the_mean_of_frames, setup, teardown),
        cmocka_unit_test_setup_teardown(segments_converge, setup, teardown),
        cmocka_unit_test_setup_teardown(transitions_have_widths, setup, teardown),
        cmocka_unit_test_setup_teardown(every_light_gives_shares, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
