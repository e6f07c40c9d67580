/* SPDX-License-Identifier: MIT
 *
 * Every allocation of the metrics' life fails once: an error comes back, nothing leaks, and frames are added whole or not at all. The
 * linker hands malloc, calloc, realloc and free to the functions below (--wrap).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>

#include "image/metrics_clip.h"
#include "image/metrics_texture.h"
#include "unit/wrapped_memory.h"

static long calls, fail_at, outstanding; /* fail_at: number of the call that fails, from 1; 0: none */

static void *counted(void *memory)
{
    outstanding += memory != NULL;
    return memory;
}

void *__wrap_malloc(size_t size) { return ++calls == fail_at ? NULL : counted(__real_malloc(size)); }

void *__wrap_calloc(size_t count, size_t size) { return ++calls == fail_at ? NULL : counted(__real_calloc(count, size)); }

void *__wrap_realloc(void *memory, size_t size)
{
    if (++calls == fail_at)
        return NULL;
    return memory ? __real_realloc(memory, size) : counted(__real_realloc(memory, size));
}

void __wrap_free(void *memory)
{
    outstanding -= memory != NULL;
    __real_free(memory);
}

enum { SIDE = 12, FRAMES = 70 }; /* more frames than the counts' first allocation holds */

/* A clip's life. Returns its first failure; a frame that failed is added again and must then be taken. */
static file_status live(void)
{
    static float pixels[2][SIDE * SIDE];
    const clip_metrics_desc desc = {.width = SIDE,
                                    .height = SIDE,
                                    .channels = 1,
                                    .srgb_encoded = true,
                                    .metrics = CLIP_ALL_METRICS & ~(1u << CLIP_YEE | 1u << CLIP_HDR_FLIP)};
    clip_metrics *m = NULL;
    clip_scores scores;
    file_error error;
    file_status status = clip_metrics_create(&m, &desc, &error), first = status;
    if (status != FILE_OK) {
        assert_null(m);
        return status;
    }
    for (int f = 0; f < FRAMES; f++) {
        for (int i = 0; i < SIDE * SIDE; i++) {
            pixels[0][i] = (float)((i * 7 + f * 3) % 11) / 11;
            pixels[1][i] = (float)((i * 5 + f) % 13) / 13;
        }
        const float_image a = {SIDE, SIDE, 1, pixels[0]}, b = {SIDE, SIDE, 1, pixels[1]};
        status = clip_metrics_add(m, &a, &b, NULL, NULL, &error);
        if (status != FILE_OK) {
            first = status;
            assert_int_equal(clip_metrics_sums(m)->frames, f);
            assert_int_equal(clip_metrics_add(m, &a, &b, NULL, NULL, &error), FILE_OK);
        }
    }
    status = clip_metrics_scores(m, &scores, &error);
    first = first != FILE_OK ? first : status;
    assert_int_equal(clip_metrics_sums(m)->frames, FRAMES);
    clip_metrics_free(m);
    return first;
}

static void allocations_may_fail(void **state)
{
    (void)state;
    calls = fail_at = outstanding = 0;
    assert_int_equal(live(), FILE_OK);
    const long count = calls;
    assert_true(count >= 15); /* else the linker has not wrapped anything */
    assert_int_equal(outstanding, 0);
    for (long k = 1; k <= count; k++) {
        calls = 0;
        fail_at = k;
        const file_status status = live();
        fail_at = 0;
        if (status != FILE_MEMORY)
            fail_msg("allocation %ld of %ld failed and the status is %d", k, count, status);
        if (outstanding != 0)
            fail_msg("allocation %ld of %ld failed and %ld blocks leaked", k, count, outstanding);
    }
    print_message("  each of %ld allocations failed once\n", count);
}

static void texture_may_fail(void **state)
{
    (void)state;
    texture *t = NULL;
    file_error error;
    calls = outstanding = 0;
    fail_at = 1;
    assert_int_equal(texture_create(&t, SIDE, SIDE, &error), FILE_MEMORY);
    assert_null(t);
    fail_at = 0;
    assert_int_equal(texture_create(&t, SIDE, SIDE, &error), FILE_OK);
    assert_int_equal(outstanding, 1);
    texture_free(t);
    assert_int_equal(outstanding, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(allocations_may_fail), cmocka_unit_test(texture_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
