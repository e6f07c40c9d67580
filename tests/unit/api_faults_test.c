/* SPDX-License-Identifier: MIT
 *
 * Every allocation and thread of a context's life fails once: an error comes back, nothing leaks, and what is left still works. The
 * linker hands malloc, calloc, free and pthread_create of the library to the functions below (--wrap).
 */
#include "api_sea.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>

static atomic_long calls, fail_at, outstanding; /* fail_at: number of the call that fails, from 1; 0: none */
static atomic_long threads_started, thread_fails_at;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *memory);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*body)(void *), void *argument);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *memory);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*body)(void *), void *argument);

static void *counted(void *memory)
{
    outstanding += memory != NULL;
    return memory;
}

void *__wrap_malloc(size_t size) { return ++calls == fail_at ? NULL : counted(__real_malloc(size)); }

void *__wrap_calloc(size_t count, size_t size) { return ++calls == fail_at ? NULL : counted(__real_calloc(count, size)); }

void *__wrap_aligned_alloc(size_t alignment, size_t size) { return ++calls == fail_at ? NULL : counted(__real_aligned_alloc(alignment, size)); }

void __wrap_free(void *memory)
{
    outstanding -= memory != NULL;
    __real_free(memory);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*body)(void *), void *argument)
{
    return ++threads_started == thread_fails_at ? EAGAIN : __real_pthread_create(thread, attributes, body, argument);
}

static float pixels[2][SEA_WIDTH * SEA_HEIGHT];
static unsigned char shown[2][SEA_WIDTH * SEA_HEIGHT * 4];

/* A context, a frame with the atmosphere's tables and glare, a reference frame. Returns the first failure. */
static mgt_status whole_life(int which)
{
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.sky.model = MGT_SKY_ATMOSPHERE;
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = 3;
    mgt_context *context = NULL;
    mgt_status status = mgt_context_create(&context, &desc);
    if (status != MGT_OK) {
        assert_null(context);
        assert_true(strlen(mgt_last_error(NULL)) > 0);
        return status;
    }
    const mgt_target targets[2] = {sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels[which], 0),
                                   sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, shown[which], 0)};
    status = mgt_render(context, &scene, targets, 2);
    if (status == MGT_OK) {
        scene.quality.method = MGT_METHOD_REFERENCE;
        scene.quality.spatial_samples = scene.quality.time_samples = 1;
        status = mgt_render(context, &scene, targets, 2);
    }
    if (status != MGT_OK) {
        assert_true(strlen(mgt_last_error(context)) > 0);
        /* The failure was for once: the same context renders now. */
        scene.quality.method = MGT_METHOD_REFERENCE;
        scene.quality.spatial_samples = scene.quality.time_samples = 1;
        fail_at = 0;
        sea_render(context, &scene, targets, 2);
        assert_memory_equal(pixels[which], pixels[0], sizeof pixels[0]);
        assert_memory_equal(shown[which], shown[0], sizeof shown[0]);
    }
    mgt_context_destroy(context);
    return status;
}

/* The methods that allocate on their own: a map, and whole pictures. A frame that failed renders when it is asked for again. */
static mgt_status life_of_baselines(int which)
{
    static const mgt_method methods[] = {MGT_METHOD_LEAN, MGT_METHOD_FXAA, MGT_METHOD_TAA, MGT_METHOD_ADAPTIVE};
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.image = (mgt_image){.width = 24, .height = 16};
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = 2;
    mgt_context *context = NULL;
    mgt_status status = mgt_context_create(&context, &desc), first = status;
    const mgt_target targets[2] = {sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels[which], 0),
                                   sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, shown[which], 0)};
    for (size_t m = 0; m < 4 && context; m++) {
        scene.quality.method = methods[m];
        scene.quality.adaptive = methods[m] == MGT_METHOD_ADAPTIVE ? MGT_ADAPTIVE_PODEE : MGT_ADAPTIVE_CELLS;
        status = mgt_render(context, &scene, targets, 2);
        if (status != MGT_OK) {
            assert_true(strlen(mgt_last_error(context)) > 0);
            first = status;
            sea_render(context, &scene, targets, 2);
        }
    }
    if (context && which > 0) {
        assert_memory_equal(pixels[which], pixels[0], sizeof pixels[0]);
        assert_memory_equal(shown[which], shown[0], sizeof shown[0]);
    }
    mgt_context_destroy(context);
    return first;
}

static void fail_each_allocation(mgt_status (*life)(int which))
{
    calls = fail_at = outstanding = 0;
    assert_int_equal(life(0), MGT_OK);
    const long count = calls;
    assert_int_equal(outstanding, 0);
    assert_true(count >= 10); /* else the linker has not wrapped anything */
    int other = 0;
    for (long k = 1; k <= count; k += 1 + 2 * MGT_SANITIZED) {
        calls = 0;
        fail_at = k;
        const mgt_status status = life(1);
        fail_at = 0;
        if (status == MGT_OK)
            fail_msg("allocation %ld of %ld failed and nobody said so", k, count);
        assert_true(status == MGT_ERROR_MEMORY || status == MGT_ERROR_THREAD);
        other += status != MGT_ERROR_MEMORY;
        if (outstanding != 0)
            fail_msg("allocation %ld of %ld failed and %ld blocks leaked", k, count, (long)outstanding);
    }
    print_message("  each of %ld allocations%s failed once; %d were reported as a thread's\n", MGT_SANITIZED ? (count + 2) / 3 : count,
                  MGT_SANITIZED ? ", every third," : "", other);
}

static void allocations_may_fail(void **state)
{
    (void)state;
    fail_each_allocation(whole_life);
}

static void allocations_of_baselines_may_fail(void **state)
{
    (void)state;
    fail_each_allocation(life_of_baselines);
}

/* The tables that a context makes when podee-* first asks for kernels. */
static void tables_may_fail(void **state)
{
    (void)state;
    calls = fail_at = outstanding = 0;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels[0], 0);
    sea_render(context, &scene, &target, 1); /* the sky's tables are there */
    const long before = outstanding;
    scene.quality.method = MGT_METHOD_PODEE_UNIFORM;
    scene.quality.kernels = MGT_MIXTURE_3;
    for (int k = 1; k <= 2; k++) {
        fail_at = calls + k;
        assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_ERROR_MEMORY);
        assert_non_null(strstr(mgt_last_error(context), "quality.kernels"));
        assert_int_equal(outstanding, before);
    }
    fail_at = 0;
    sea_render(context, &scene, &target, 1);
    assert_int_equal(outstanding, before + 2);
    mgt_context_destroy(context);
    assert_int_equal(outstanding, 0);
}

static void threads_may_fail(void **state)
{
    (void)state;
    threads_started = thread_fails_at = calls = fail_at = outstanding = 0;
    assert_int_equal(whole_life(0), MGT_OK);
    const long count = threads_started;
    assert_true(count >= 2);
    for (long k = 1; k <= count; k++) {
        threads_started = 0;
        thread_fails_at = k;
        assert_int_equal(whole_life(1), MGT_ERROR_THREAD);
        assert_int_equal(outstanding, 0);
    }
    thread_fails_at = 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(allocations_may_fail),
        cmocka_unit_test(allocations_of_baselines_may_fail),
        cmocka_unit_test(tables_may_fail),
        cmocka_unit_test(threads_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
