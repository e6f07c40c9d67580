/* SPDX-License-Identifier: MIT
 * Exact sums: terms, and pictures from sums whose samples were taken in parts.
 */
#include <float.h>

#include "api_sea.h"
#include "cpu/sample_sums.h"
#include "random_numbers.h"

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT, WORDS = PIXELS * MGT_SUM_WORDS };

static double value_of(exact_sum sum) { return exact_mean(sum, 1); }

static void terms_are_cut_to_multiples(void **state)
{
    (void)state;
    const double most = 0x1p40;
    assert_true(exact_term(0, most) == 0 && exact_term(-0.0, most) == 0);
    assert_true(exact_term(1, most) == exact_count(1) && exact_term(-1, most) == -exact_count(1));
    assert_true(exact_term(0x1p-56, most) == 1 && exact_term(0x1.fp-57, most) == 0 && exact_term(0x1p-1074, most) == 0);
    assert_true(exact_term(NAN, most) == 0);
    assert_true(exact_term(INFINITY, most) == exact_term(most, most) && exact_term(-INFINITY, most) == -exact_term(most, most));
    assert_true(value_of(exact_term(EXACT_SUM_MOST, EXACT_SUM_MOST)) == 0x1p70);
    random_state random = {5};
    for (int i = 0; i < 100000; i++) {
        const double x = ldexp(random_range(&random, -1, 1), (int)random_range(&random, -60, 41));
        const exact_sum term = exact_term(x, most);
        const double back = value_of(term);
        assert_true(fabs(back) <= fabs(x) && fabs(x - back) < 0x1p-56);
        assert_true(fabs(x) < 1 || back == x);
        assert_true(term == exact_term_any(x, most));
    }
}

static void words_carry(void **state)
{
    (void)state;
    uint64_t words[2] = {UINT64_MAX, 4};
    exact_add(words, 1);
    assert_true(words[0] == 0 && words[1] == 5);
    exact_add(words, -(exact_sum)1);
    assert_true(words[0] == UINT64_MAX && words[1] == 4);
    uint64_t two[24] = {[0] = UINT64_MAX, [22] = 7}, more[24] = {[0] = 2, [23] = 1};
    mgt_sums_add(two, more, 2);
    assert_true(two[0] == 1 && two[1] == 1 && two[22] == 7 && two[23] == 1);
}

typedef struct picture {
    float color[3 * PIXELS], coverage[PIXELS], mask[PIXELS], foam[PIXELS], depth[PIXELS], normal[3 * PIXELS], samples[PIXELS];
    uint8_t shown[4 * PIXELS];
} picture;

enum { LAYERS = 8 };

static void list_targets(picture *p, mgt_target targets[LAYERS])
{
    const mgt_target list[LAYERS] = {sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, p->color, 0),
                                     sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, p->coverage, 0),
                                     sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, p->mask, 0),
                                     sea_target(MGT_LAYER_FOAM, MGT_FORMAT_R32F, p->foam, 0),
                                     sea_target(MGT_LAYER_DEPTH, MGT_FORMAT_R32F, p->depth, 0),
                                     sea_target(MGT_LAYER_NORMAL, MGT_FORMAT_RGB32F, p->normal, 0),
                                     sea_target(MGT_LAYER_SAMPLES, MGT_FORMAT_R32F, p->samples, 0),
                                     sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, p->shown, 0)};
    memcpy(targets, list, sizeof list);
}

/* The sums of [first, first + count), added to what is there. */
static void add_range(mgt_context *context, mgt_scene scene, uint64_t first, uint64_t count, uint64_t *sums)
{
    scene.quality.sample_first = first;
    scene.quality.sample_count = count;
    const mgt_status status = mgt_sum_samples(context, &scene, sums);
    if (status != MGT_OK)
        fail_msg("mgt_sum_samples: %s", mgt_last_error(context));
}

static void compare_parts(mgt_context *context, const mgt_scene *scene, uint64_t total)
{
    static picture whole, merged;
    static uint64_t sums[WORDS], part[WORDS];
    mgt_target targets[LAYERS];
    memset(&whole, 0, sizeof whole);
    list_targets(&whole, targets);
    sea_render(context, scene, targets, LAYERS);
    for (uint64_t parts = 2; parts <= 7; parts += 5) {
        memset(sums, 0, sizeof sums);
        memset(&merged, 0, sizeof merged);
        /* The last part first, and every other one in memory of its own. */
        for (uint64_t i = parts; i-- > 0;) {
            const uint64_t first = total * i * i / (parts * parts), end = total * (i + 1) * (i + 1) / (parts * parts);
            if (first == end)
                continue;
            memset(part, 0, sizeof part);
            add_range(context, *scene, first, end - first, i % 2 ? part : sums);
            mgt_sums_add(sums, part, PIXELS);
        }
        list_targets(&merged, targets);
        assert_int_equal(mgt_render_sums(context, scene, sums, targets, LAYERS), MGT_OK);
        assert_memory_equal(&whole, &merged, sizeof whole);
    }
}

/* Terms of all sizes in planes of a tile, by every lane width, against sums of exact terms. */
static void planes_are_summed_exactly(void **state)
{
    (void)state;
    static sample_sums sums;
    static tile_pixels pixels;
    static const struct {
        mgt_isa isa;
        const lane_kernels *kernels;
    } widths[] =
    { {MGT_ISA_SCALAR, &lane_kernels_1},
#if defined(__x86_64__)
      {MGT_ISA_AVX2, &lane_kernels_8},
      {MGT_ISA_AVX512, &lane_kernels_16},
#endif
      {MGT_ISA_AUTO, &lane_kernels_4} };
    const float special[] = {0, -0.0f, NAN, INFINITY, -INFINITY, 0x1p-57f, -0x1p-57f, 0x1.8p-56f, 1e12f, -3, FLT_MAX, FLT_TRUE_MIN};
    enum { SPECIAL = sizeof special / sizeof *special, TERMS = 3 * SAMPLE_TERMS_MOST + 1 };
    for (size_t w = 0; w < sizeof widths / sizeof *widths; w++) {
        if (!mgt_isa_available(widths[w].isa))
            continue;
        random_state random = {9};
        exact_sum expected[2] = {0};
        sample_sums_clear(&sums);
        for (int term = 0; term < TERMS; term++) {
            for (size_t i = 0; i < TILE_PIXELS; i++) {
                pixels.red[i] = i < SPECIAL ? special[i] : (float)ldexp(random_range(&random, -1, 1), (int)random_range(&random, -31, 42));
                pixels.foam[i] = pixels.red[i];
            }
            /* 24 digits from 2⁻³² on are multiples of 2⁻⁵⁶. */
            expected[0] += exact_term((double)pixels.red[TILE_PIXELS - 1], SAMPLE_TERM_MOST);
            expected[1] += exact_term((double)pixels.red[SPECIAL], SAMPLE_TERM_MOST);
            sample_sums_add(&sums, widths[w].kernels, &pixels, true, false);
        }
        sample_sums_settle(&sums);
        assert_true(exact_load(sums.words + SAMPLE_SUM_WORDS * (TILE_PIXELS - 1)) == expected[0]);
        assert_true(exact_load(sums.words + SAMPLE_SUM_WORDS * SPECIAL) == expected[1]);
        const double values[SPECIAL] = {0, 0, 0, SAMPLE_TERM_MOST, -SAMPLE_TERM_MOST, 0, 0, 0x1p-55, (double)1e12f, -3, SAMPLE_TERM_MOST, 0};
        for (size_t i = 0; i < SPECIAL; i++) {
            assert_true(value_of(exact_load(sums.words + SAMPLE_SUM_WORDS * i)) == TERMS * values[i]);
            assert_true(exact_load(sums.words + SAMPLE_SUM_WORDS * i + 2 * EXACT_FOAM) == 0);
        }
        sample_sums_mean(&sums, TERMS, &pixels);
        assert_true(pixels.red[9] == -3 && pixels.red[8] == 1e12f && pixels.foam[9] == 0);
    }
}

static void parts_make_the_bytes_of_the_whole(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    scene.quality.method = MGT_METHOD_REFERENCE;
    scene.quality.spatial_samples = 2;
    scene.quality.time_samples = 5;
    scene.shutter = 1.0 / 30;
    scene.post.glare = 0.1f;
    compare_parts(context, &scene, 20);
    scene.quality.light_cells = 2;
    compare_parts(context, &scene, 20);
    scene.quality.light_cells = 0;
    scene.water.choppiness = 0.7f;
    scene.foam = 0.3f;
    scene.foam_persistence = 4;
    compare_parts(context, &scene, 20);
    scene.quality.method = MGT_METHOD_SSAA;
    compare_parts(context, &scene, 20);
    scene.foam = scene.water.choppiness = 0;
    compare_parts(context, &scene, 20);
    scene.quality.method = MGT_METHOD_ADAPTIVE;
    scene.quality.adaptive = MGT_ADAPTIVE_PODEE;
    scene.quality.sample_slots = 1999;
    compare_parts(context, &scene, 1999);
    mgt_context_destroy(context);
}

static void what_has_no_sums_is_refused(void **state)
{
    (void)state;
    static uint64_t sums[WORDS];
    static uint8_t shown[4 * PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(1, MGT_ISA_AUTO);
    mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, shown, 0);
    scene.quality.method = MGT_METHOD_MANGATA;
    assert_int_equal(mgt_sum_samples(context, &scene, sums), MGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(mgt_last_error(context), "method mangata has no sums"));
    assert_int_equal(mgt_render_sums(context, &scene, sums, &target, 1), MGT_ERROR_UNSUPPORTED);
    scene.quality.method = MGT_METHOD_ADAPTIVE;
    scene.quality.adaptive = MGT_ADAPTIVE_PODEE;
    scene.quality.sample_first = 3;
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_ERROR_SCENE);
    assert_non_null(strstr(mgt_last_error(context), "adaptive by podee needs sample_slots"));
    scene.quality.sample_slots = 4;
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_OK);
    assert_false(mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR));
    scene.quality.sample_first = 4;
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_ERROR_SCENE);
    scene.quality.sample_first = scene.quality.sample_slots = 0;
    assert_int_equal(mgt_sum_samples(context, &scene, sums), MGT_ERROR_UNSUPPORTED);
    scene.quality.method = MGT_METHOD_REFERENCE;
    scene.quality.adaptive = MGT_ADAPTIVE_CELLS;
    assert_int_equal(mgt_sum_samples(context, &scene, NULL), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_sum_samples(NULL, &scene, sums), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_render_sums(context, &scene, NULL, &target, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_render_sums(NULL, &scene, sums, &target, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_render_sums(context, &scene, sums, NULL, 1), MGT_ERROR_ARGUMENT);
    for (int sum = 0; sum < EXACT_COUNT; sum++) { /* what no samples sum up to: less than 0, and more than one a sample */
        memset(sums, 0, sizeof sums);
        sums[MGT_SUM_WORDS + 2 * sum] = UINT64_MAX;
        sums[MGT_SUM_WORDS + 2 * sum + 1] = sum < EXACT_COVERAGE ? UINT64_MAX : 0xffff;
        assert_int_equal(mgt_render_sums(context, &scene, sums, &target, 1), MGT_ERROR_ARGUMENT);
        assert_non_null(strstr(mgt_last_error(context), "the sums of pixel 1, 0 are not those of"));
    }
    memset(sums, 0, sizeof sums);
    scene.image.crop_width = scene.image.crop_height = 8;
    scene.post.glare = 0.1f;
    assert_int_equal(mgt_render_sums(context, &scene, sums, &target, 1), MGT_ERROR_UNSUPPORTED);
    scene.post.glare = 0;
    assert_int_equal(mgt_render_sums(context, &scene, sums, &target, 1), MGT_OK);
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(terms_are_cut_to_multiples),  cmocka_unit_test(words_carry),
        cmocka_unit_test(planes_are_summed_exactly),   cmocka_unit_test(parts_make_the_bytes_of_the_whole),
        cmocka_unit_test(what_has_no_sums_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
