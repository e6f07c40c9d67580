/* SPDX-License-Identifier: MIT
 * The table of methods: every row whole, names there and back, the public copy. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "params/methods.h"

static void rows_are_whole(void **state)
{
    (void)state;
    for (size_t i = 0; i < method_count; i++) {
        const method_row *row = method_of((mgt_method)i);
        assert_non_null(row->properties.name);
        assert_true(strlen(row->properties.description) > 10);
        assert_true(row->properties.backends & 1u << MGT_BACKEND_CPU);
        assert_true(row->properties.layers & 1u << MGT_LAYER_COLOR);
        assert_int_equal(row->way == METHOD_PASS, row->pass != METHOD_PASS_NONE);
        assert_int_equal(row->shader != NULL, row->way != METHOD_PASS && row->properties.backends & 1u << MGT_BACKEND_GL);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(row->properties.name, method_of((mgt_method)k)->properties.name);
    }
}

static void names_lead_back(void **state)
{
    (void)state;
    for (size_t i = 0; i < method_count; i++) {
        mgt_quality q = {.method = (mgt_method)i, .spatial_samples = 7}, again = {0};
        assert_true(method_from_name(method_name(&q).text, &again));
        assert_int_equal(again.method, i);
        assert_true(strstr(method_names().text, method_of((mgt_method)i)->properties.name));
    }
    mgt_quality q;
    assert_true(method_from_name("ssaa1024", &q));
    assert_int_equal(q.spatial_samples, 1024);
    assert_int_equal(q.time_samples, 1);
    assert_true(method_from_name("ssaa", &q));
    assert_int_equal(q.spatial_samples, 4);
    assert_true(method_from_name("reference", &q));
    assert_int_equal(q.spatial_samples * q.time_samples, 64);
    static const char *const wrong[] = {"", "ssaa0", "ssaa1025", "ssaaN", "ssaa4x", "ssaa-1", "ssaa99999999999999999999", "mangat", "mangata1", "Mangata"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_false(method_from_name(wrong[i], &q));
}

static void rows_are_public(void **state)
{
    (void)state;
    mgt_method_properties p;
    for (size_t i = 0; i < method_count; i++) {
        assert_int_equal(mgt_method_info((mgt_method)i, &p, sizeof p), MGT_OK);
        assert_string_equal(p.name, method_of((mgt_method)i)->properties.name);
        assert_int_equal(p.struct_size, sizeof p);
    }
    assert_int_equal(mgt_method_info((mgt_method)method_count, &p, sizeof p), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_method_info((mgt_method)-1, &p, sizeof p), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_method_info(MGT_METHOD_NONE, NULL, sizeof p), MGT_ERROR_ARGUMENT);
    /* Sizes that are no version's: refused as in other calls, with nothing written. */
    static const size_t sizes[] = {0, 4, sizeof(size_t), sizeof p - 1, sizeof p + 4096, SIZE_MAX};
    const mgt_method_properties before = p;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char text[120];
        assert_int_equal(mgt_method_info(MGT_METHOD_NONE, &p, sizes[i]), MGT_ERROR_ARGUMENT);
        snprintf(text, sizeof text, "mgt_method_properties 0: struct_size is %zu; this library knows %zu to %zu", sizes[i],
                 offsetof(mgt_method_properties, layers) + sizeof p.layers, sizeof p);
        assert_string_equal(mgt_last_error(NULL), text);
        assert_memory_equal(&p, &before, sizeof p);
    }
    /* A caller that was built with a larger struct. */
    struct {
        mgt_method_properties known;
        uint64_t unknown;
    } later = {.unknown = 1};
    assert_int_equal(mgt_method_info(MGT_METHOD_ADAPTIVE, &later.known, sizeof later), MGT_OK);
    assert_true(later.known.struct_size == sizeof later && later.known.waves == MGT_WAVES_SHUTTER && later.unknown == 0);
}

/* Options that a method does not read are found, though the API ignores those that are always set. */
static void options_say_who_reads_them(void **state)
{
    (void)state;
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    assert_int_equal(mgt_option_check(&scene, "seed"), MGT_OK);
    assert_int_equal(mgt_option_check(&scene, "spatial"), MGT_ERROR_SCENE);
    assert_string_equal(mgt_last_error(NULL), "spatial: it is for method ssaa or reference alone");
    assert_int_equal(mgt_option_check(&scene, "mixture"), MGT_ERROR_SCENE);
    scene.quality.method = MGT_METHOD_SSAA;
    assert_int_equal(mgt_option_check(&scene, "spatial"), MGT_OK);
    scene.quality.method = MGT_METHOD_ADAPTIVE;
    assert_int_equal(mgt_option_check(&scene, "slots"), MGT_ERROR_SCENE);
    assert_string_equal(mgt_last_error(NULL), "slots: it is for method adaptive and adaptive podee alone");
    assert_int_equal(mgt_option_check(&scene, "target_rmse"), MGT_OK);
    assert_int_equal(mgt_option_check(&scene, "colour"), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_option_check(&scene, NULL), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_option_check(NULL, "seed"), MGT_ERROR_ARGUMENT);
    scene.image.width = 0;
    assert_int_equal(mgt_option_check(&scene, "seed"), MGT_ERROR_SCENE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_are_whole), cmocka_unit_test(names_lead_back), cmocka_unit_test(rows_are_public),
                                       cmocka_unit_test(options_say_who_reads_them)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
