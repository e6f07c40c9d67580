/* SPDX-License-Identifier: MIT
 * Structs of callers that were built with another version: neither overrun nor refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api_sea.h"
#include "api/structs.h"

/* A struct in its second version, which added `second` and `third`; and as the first and a later one have it. */
typedef struct now {
    size_t struct_size;
    uint64_t first, second, third;
} now;
typedef struct before {
    size_t struct_size;
    uint64_t first;
} before;
typedef struct later {
    size_t struct_size;
    uint64_t first, second, third, fourth;
} later;

static const now defaults = {sizeof(now), 1, 2, 3};
static const struct_kind kind = {"now", "test.struct", 2, sizeof(before), sizeof(now), &defaults};

static char text[REPORTER_TEXT];
static const reporter r = {.error = text};

static void earlier_structs_are_widened(void **state)
{
    (void)state;
    const before old[2] = {{sizeof *old, 10}, {sizeof *old, 20}};
    now own[2];
    assert_int_equal(struct_take(&r, &kind, own, old, 2), MGT_OK);
    for (uint64_t i = 0; i < 2; i++)
        assert_true(own[i].struct_size == sizeof(now) && own[i].first == 10 * (i + 1) && own[i].second == 2 && own[i].third == 3);
    before filled = {sizeof filled, 0};
    assert_int_equal(struct_give(&r, &kind, own, &filled), MGT_OK);
    assert_true(filled.struct_size == sizeof filled && filled.first == 10);
}

static void later_structs_are_taken_while_untouched(void **state)
{
    (void)state;
    later newer[2] = {{sizeof *newer, 10, 11, 12, 0}, {sizeof *newer, 20, 21, 22, 0}};
    now own[2];
    assert_int_equal(struct_take(&r, &kind, own, newer, 2), MGT_OK);
    assert_true(own[1].struct_size == sizeof(now) && own[1].first == 20 && own[1].third == 22);
    newer[1].fourth = 1;
    assert_int_equal(struct_take(&r, &kind, own, newer, 2), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(text, "does not know"));
    assert_int_equal(struct_give(&r, &kind, own, newer), MGT_OK);
    assert_true(newer->struct_size == sizeof *newer && newer->third == 12 && newer->fourth == 0);
}

static void impossible_sizes_are_refused(void **state)
{
    (void)state;
    static const size_t sizes[] = {0, 8, sizeof(before) - 1, sizeof(now) + 1, sizeof(now) + 4096, SIZE_MAX, SIZE_MAX - 7};
    now own, theirs = defaults;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        theirs.struct_size = sizes[i];
        assert_int_equal(struct_take(&r, &kind, &own, &theirs, 1), MGT_ERROR_ARGUMENT);
        assert_int_equal(struct_give(&r, &kind, &defaults, &theirs), MGT_ERROR_ARGUMENT);
        assert_non_null(strstr(text, "struct_size"));
    }
    const before mixed[3] = {{sizeof *mixed, 1}, {sizeof(now), 2}, {0, 0}};
    assert_int_equal(struct_take(&r, &kind, &own, mixed, 2), MGT_ERROR_ARGUMENT);
    assert_int_equal(struct_take(&r, &kind, &own, NULL, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(struct_take(&r, &kind, &own, mixed, 0), MGT_ERROR_ARGUMENT);
    assert_int_equal(struct_take(&r, &kind, &own, mixed, 3), MGT_ERROR_ARGUMENT);
}

#define INITIALISES(type, init)                                                   \
    do {                                                                          \
        union {                                                                   \
            type own;                                                             \
            unsigned char bytes[sizeof(type) + 16];                               \
        } room;                                                                   \
        for (size_t size = sizeof(size_t); size <= sizeof(type) + 8; size += 4) { \
            memset(&room, 0x5a, sizeof room);                                     \
            init(&room.own, size);                                                \
            assert_int_equal(room.own.struct_size, size);                         \
            for (size_t i = size; i < sizeof room; i++)                           \
                assert_int_equal(room.bytes[i], 0x5a);                            \
            for (size_t i = sizeof(type); i < size; i++)                          \
                assert_int_equal(room.bytes[i], 0);                               \
        }                                                                         \
        init(NULL, sizeof(type));                                                 \
    } while (0)

static void initialisers_keep_within_the_size(void **state)
{
    (void)state;
    INITIALISES(mgt_context_desc, mgt_context_desc_init);
    INITIALISES(mgt_mesh_desc, mgt_mesh_desc_init);
    INITIALISES(mgt_texture_desc, mgt_texture_desc_init);
    INITIALISES(mgt_scene, mgt_scene_init);
    INITIALISES(mgt_target, mgt_target_init);
    INITIALISES(mgt_gl_view, mgt_gl_view_init);
    INITIALISES(mgt_gl_texture, mgt_gl_texture_init);
    mgt_quality_init(NULL, sizeof(mgt_quality));
    mgt_light_init(NULL, MGT_SOURCE_SUN);
}

/* A program of a later version, whose structs are 8 bytes larger, gets the same picture. */
static void later_callers_get_the_same_bytes(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    static float pictures[2][3 * SEA_WIDTH * SEA_HEIGHT];
    struct {
        mgt_scene own;
        uint64_t unknown;
    } scene = {.own = sea_scene(waves)};
    struct {
        mgt_target own;
        uint64_t unknown;
    } targets[2] = {{.own = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, pictures[1], 0)}, {.own = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, NULL, 0)}};
    static float mask[SEA_WIDTH * SEA_HEIGHT];
    targets[1].own.pixels = mask;
    mgt_context *context = sea_context(1, MGT_ISA_AUTO);
    const mgt_target plain = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, pictures[0], 0);
    sea_render(context, &scene.own, &plain, 1);
    scene.own.struct_size = sizeof scene;
    targets[0].own.struct_size = targets[1].own.struct_size = sizeof *targets;
    sea_render(context, &scene.own, &targets[0].own, 2);
    assert_memory_equal(pictures[0], pictures[1], sizeof *pictures);
    scene.unknown = 1;
    assert_int_equal(mgt_scene_check(context, &scene.own), MGT_ERROR_ARGUMENT);
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(earlier_structs_are_widened),      cmocka_unit_test(later_structs_are_taken_while_untouched),
        cmocka_unit_test(impossible_sizes_are_refused),     cmocka_unit_test(initialisers_keep_within_the_size),
        cmocka_unit_test(later_callers_get_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
