/* SPDX-License-Identifier: MIT
 *
 * Contexts in eight threads at once, over the same scene, mesh and waves: every method draws the bytes that it draws alone, frames are cancelled, questions are
 * answered, seas are made. The build with thread sanitizer (scripts/races) looks for races in it.
 */
#include "api_sea.h"

#include <pthread.h>
#include <stdatomic.h>
#include <sys/mman.h>

#include "unit/test_mesh.h"

enum { THREADS = 8, METHODS = SEA_METHODS + SEA_BASELINES, WIDTH = 24, HEIGHT = 16, POINTS = 16 };

typedef struct picture {
    float color[WIDTH * HEIGHT * 3];
} picture;

static struct {
    mgt_scene scene;
    mgt_wave waves[SEA_WAVES];
    mgt_object object;
    picture alone[METHODS];
    double heights[POINTS];
} shared;

typedef struct worker {
    pthread_t thread;
    int number;
    mgt_status status;
    bool same;
    char wrong[256];
} worker;

static bool stop_at_once(void *user, double fraction)
{
    (void)fraction;
    atomic_fetch_add((atomic_int *)user, 1);
    return false;
}

static mgt_status draw(mgt_context *context, int m, picture *p)
{
    mgt_scene scene = shared.scene;
    const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, p->color, 0);
    if (m < SEA_METHODS)
        sea_take_method(&scene, m);
    else
        scene.quality.method = sea_baselines[m - SEA_METHODS];
    if (scene.quality.method == MGT_METHOD_REFERENCE)
        scene.object_count = 0; /* it computes water alone */
    return mgt_render(context, &scene, &target, 1);
}

static mgt_status ask(double heights[POINTS])
{
    double points[2 * POINTS];
    mgt_water_answers answers;
    mgt_water_answers_init(&answers, sizeof answers);
    answers.height = heights;
    for (int i = 0; i < 2 * POINTS; i++)
        points[i] = 0.7 * i;
    return mgt_water_query(&shared.scene.water, 3, points, POINTS, &answers);
}

/* A frame that is cancelled, and then each method, beginning with another one in each thread. */
static mgt_status work(worker *w, mgt_context *context)
{
    picture *p = malloc(sizeof *p);
    mgt_status status = p != NULL ? MGT_OK : MGT_ERROR_MEMORY;
    w->same = true;
    for (int i = 0; i < METHODS && status == MGT_OK; i++) {
        const int m = (i + 2 * w->number) % METHODS;
        double heights[POINTS];
        status = draw(context, m, p);
        w->same &= memcmp(p, &shared.alone[m], sizeof *p) == 0;
        if (status == MGT_OK)
            status = ask(heights);
        w->same &= memcmp(heights, shared.heights, sizeof heights) == 0;
    }
    free(p);
    return status;
}

static void *run(void *argument)
{
    worker *w = argument;
    atomic_int calls = 0;
    mgt_context_desc desc;
    mgt_context *context = NULL;
    picture unused;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = 2;
    desc.progress = stop_at_once;
    desc.progress_user = &calls;
    w->status = mgt_context_create(&context, &desc);
    if (w->status == MGT_OK) {
        const mgt_status cancelled = draw(context, METHODS - 1, &unused);
        w->status = cancelled == MGT_CANCELLED || cancelled == MGT_OK ? MGT_OK : cancelled;
    }
    mgt_context_destroy(context);
    desc.progress = NULL;
    context = NULL;
    if (w->status == MGT_OK)
        w->status = mgt_context_create(&context, &desc);
    if (w->status == MGT_OK)
        w->status = work(w, context);
    if (w->status != MGT_OK)
        snprintf(w->wrong, sizeof w->wrong, "%s", mgt_last_error(context));
    mgt_context_destroy(context);
    return NULL;
}

/* The sea with a triangle in it, which the caller destroys. */
static mgt_mesh *make_scene(void)
{
    static const float positions[] = {-2, 0.3f, -6, 2, 0.3f, -6, 0, 2, -6};
    static const uint32_t indices[] = {0, 1, 2};
    mgt_mesh *mesh = test_mesh(positions, NULL, 3, indices, 1);
    shared.scene = sea_scene(shared.waves);
    shared.scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    shared.scene.sky.model = MGT_SKY_ATMOSPHERE;
    shared.object =
        (mgt_object){.mesh = mesh, .transform = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, .material = {.base_color = {0.5f, 0.4f, 0.3f}, .roughness = 0.5f}};
    shared.scene.objects = &shared.object;
    shared.scene.object_count = 1;
    return mesh;
}

static void contexts_are_independent(void **state)
{
    (void)state;
    static worker workers[THREADS];
    mgt_mesh *mesh = make_scene();
    mgt_context *context = sea_context(1, MGT_ISA_AUTO);
    for (int m = 0; m < METHODS; m++)
        if (draw(context, m, &shared.alone[m]) != MGT_OK)
            fail_msg("method %d: %s", m, mgt_last_error(context));
    mgt_context_destroy(context);
    assert_int_equal(ask(shared.heights), MGT_OK);
    for (int i = 0; i < THREADS; i++) {
        workers[i].number = i;
        assert_int_equal(pthread_create(&workers[i].thread, NULL, run, &workers[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(workers[i].thread, NULL);
        if (workers[i].status != MGT_OK)
            fail_msg("thread %d: %s", i, workers[i].wrong);
        assert_true(workers[i].same);
    }
    mgt_mesh_destroy(mesh);
}

/* ---- the stack of a caller -------------------------------------------------------------------------------------------- */

enum { STACK_ROOM = 4 << 20, STACK_NEED = 512 << 10 /* as mangata.h says */, UNTOUCHED = 0xa5, LAST_METHOD = METHODS, INSPECTION, STACK_CALLS };

/* One call on a thread that does all the work itself. */
static void *call_once(void *argument)
{
    worker *w = argument;
    mgt_context_desc desc;
    mgt_context *context = NULL;
    picture *p = malloc(sizeof *p);
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = 1;
    w->status = p != NULL ? mgt_context_create(&context, &desc) : MGT_ERROR_MEMORY;
    if (w->status == MGT_OK && w->number < METHODS) {
        w->status = draw(context, w->number, p);
    } else if (w->status == MGT_OK && w->number == INSPECTION) {
        mgt_pixel_info info = {.struct_size = sizeof info};
        w->status = mgt_inspect_pixel(context, &shared.scene, 3, HEIGHT - 1, &info);
    } else if (w->status == MGT_OK) {
        mgt_scene scene = shared.scene;
        const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, p->color, 0);
        scene.object_count = 0;
        scene.quality.method = MGT_METHOD_REFERENCE;
        scene.quality.light_cells = 64;
        w->status = mgt_render(context, &scene, &target, 1);
    }
    snprintf(w->wrong, sizeof w->wrong, "%s", mgt_last_error(context));
    mgt_context_destroy(context);
    free(p);
    return NULL;
}

/* How much of a painted stack a call has written to. */
static void callers_need_little_stack(void **state)
{
    (void)state;
    if (MGT_SANITIZED)
        skip(); /* frames are larger there */
    mgt_mesh *mesh = make_scene();
    shared.scene.water.choppiness = 0.7f;
    shared.scene.foam = 0.05f;
    size_t most = 0;
    for (int i = 0; i < STACK_CALLS; i++) {
        worker w = {.number = i};
        pthread_attr_t attributes;
        unsigned char *stack = mmap(NULL, STACK_ROOM, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        assert_ptr_not_equal(stack, MAP_FAILED);
        memset(stack, UNTOUCHED, STACK_ROOM);
        assert_int_equal(pthread_attr_init(&attributes), 0);
        assert_int_equal(pthread_attr_setstack(&attributes, stack, STACK_ROOM), 0);
        assert_int_equal(pthread_create(&w.thread, &attributes, call_once, &w), 0);
        pthread_join(w.thread, NULL);
        pthread_attr_destroy(&attributes);
        if (w.status != MGT_OK)
            fail_msg("call %d: %s", i, w.wrong);
        size_t untouched = 0;
        while (untouched < STACK_ROOM && stack[untouched] == UNTOUCHED)
            untouched++;
        print_message("  call %d: %zu KiB of stack\n", i, (STACK_ROOM - untouched) >> 10);
        most = STACK_ROOM - untouched > most ? STACK_ROOM - untouched : most;
        munmap(stack, STACK_ROOM);
    }
    assert_true(most <= STACK_NEED);
    mgt_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(contexts_are_independent), cmocka_unit_test(callers_need_little_stack)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
