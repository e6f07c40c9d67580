/* SPDX-License-Identifier: MIT
 * Voxels of distances against distances to all triangles, and searched rays against traced ones. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/distance_field.h"
#include "unit/test_mesh.h"

static char error_text[REPORTER_TEXT];
static const reporter silent = {.error = error_text};

enum { RINGS = 12, SECTORS = 24, VERTICES = (RINGS + 1) * SECTORS, TRIANGLES = 2 * RINGS * SECTORS };

/* A ball of 0.6 m and a floor below it. */
static mgt_mesh *ball(void)
{
    static float positions[3 * (VERTICES + 4)];
    static uint32_t indices[3 * (TRIANGLES + 2)];
    for (uint32_t i = 0; i < VERTICES; i++) {
        const float polar = 3.14159265f * (float)(i / SECTORS) / RINGS, around = 6.2831853f * (float)(i % SECTORS) / SECTORS;
        positions[3 * i] = 0.6f * sinf(polar) * cosf(around);
        positions[3 * i + 1] = 0.6f * cosf(polar);
        positions[3 * i + 2] = 0.6f * sinf(polar) * sinf(around);
    }
    const float floor[12] = {-2, -1, -1.5f, 2, -1, -1.5f, 2, -1, 1.5f, -2, -1, 1.5f};
    memcpy(positions + 3 * (size_t)VERTICES, floor, sizeof floor);
    uint32_t *t = indices;
    for (uint32_t ring = 0; ring < RINGS; ring++)
        for (uint32_t s = 0; s < SECTORS; s++) {
            const uint32_t a = ring * SECTORS + s, b = ring * SECTORS + (s + 1) % SECTORS;
            const uint32_t cell[6] = {a, b, b + SECTORS, a, b + SECTORS, a + SECTORS};
            memcpy(t, cell, sizeof cell);
            t += 6;
        }
    const uint32_t square[6] = {VERTICES, VERTICES + 2, VERTICES + 1, VERTICES, VERTICES + 3, VERTICES + 2};
    memcpy(t, square, sizeof square);
    return test_mesh(positions, NULL, VERTICES + 4, indices, TRIANGLES + 2);
}

typedef struct setup {
    mgt_mesh *mesh;
    thread_pool *pool;
    world *world;
    distance_field *field;
} setup;

static void begin(setup *s, uint32_t threads, double scale)
{
    *s = (setup){.mesh = ball(), .pool = thread_pool_create(threads)};
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    const mgt_object object = {.mesh = s->mesh, .transform = {{scale, 0, 0, 0}, {0, scale, 0, -2}, {0, 0, scale, 0}}};
    scene.objects = &object;
    scene.object_count = 1;
    assert_int_equal(world_update(&s->world, &scene, s->pool), MGT_OK);
    assert_int_equal(distance_field_update(&s->field, s->world, s->pool, &silent), MGT_OK);
}

static void end(setup *s)
{
    distance_field_free(s->field);
    world_free(s->world);
    thread_pool_destroy(s->pool);
    mgt_mesh_destroy(s->mesh);
}

/* By dense points of every triangle, spaced about a centimetre. */
static double brute_distance(const world *w, const double p[3])
{
    double best = HUGE_VAL;
    for (size_t i = 0; i < w->triangle_count; i++) {
        const float *c[3];
        for (int k = 0; k < 3; k++)
            c[k] = w->positions + 3 * (size_t)w->indices[3 * i + (size_t)k];
        const int steps = i + 2 >= w->triangle_count ? 400 : 16;
        for (int a = 0; a <= steps; a++)
            for (int b = 0; a + b <= steps; b++) {
                const double u = (double)a / steps, v = (double)b / steps;
                double square = 0;
                for (int k = 0; k < 3; k++) {
                    const double x = (1 - u - v) * (double)c[0][k] + u * (double)c[1][k] + v * (double)c[2][k] - p[k];
                    square += x * x;
                }
                best = fmin(best, square);
            }
    }
    return sqrt(best);
}

static void distances_are_exact_near_and_never_too_far(void **state)
{
    (void)state;
    setup s;
    begin(&s, 2, 1);
    const distance_field *f = s.field;
    const size_t count = (size_t)f->size[0] * f->size[1] * f->size[2];
    assert_int_equal(distance_field_bytes(f), sizeof *f + 8 * count);
    int near = 0;
    double loose = 0;
    for (size_t n = 0; n < 300; n++) {
        const size_t i = n * 7919003 % count;
        const size_t at[3] = {i % f->size[0], i / f->size[0] % f->size[1], i / f->size[0] / f->size[1]};
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = (double)f->low[k] + (double)f->voxel * (double)at[k];
        const double exact = brute_distance(s.world, p), found = (double)f->distance[i];
        assert_in_range(f->triangle[i], 0, TRIANGLES + 1);
        assert_true(found < exact + 0.0005);
        if (exact < 1.7 * (double)f->voxel) {
            near++;
            assert_true(found > exact - 0.006);
        }
        loose = fmax(loose, exact - found);
    }
    print_message("  %zu voxels of %g m; the loosest of 300 is %.3f m short, %d are near\n", count, (double)f->voxel, loose, near);
    assert_true(near > 10 && loose < 2 * (double)f->voxel);
    end(&s);
}

static void searched_rays_end_near_traced_ones(void **state)
{
    (void)state;
    if (!trace_available())
        return;
    setup s;
    begin(&s, 1, 1);
    trace_scene *trace = NULL;
    const trace_triangles triangles = {s.world->triangle_count, s.world->vertex_count, s.world->positions, s.world->indices, s.world->version};
    assert_int_equal(trace_scene_update(&trace, &triangles, 1, &silent), MGT_OK);
    int met = 0, apart = 0;
    for (int i = 0; i < 4000; i++) {
        const float x = (float)(i % 80) / 20 - 2, z = (float)(i / 80) / 25 - 1;
        const float down = 1 / sqrtf(1.04f);
        const trace_ray ray = {{x, 0, z}, {0.2f * down, -down, 0}, 0, 10};
        trace_hit exact, found;
        trace_nearest(trace, 1, &ray, &exact);
        distance_field_nearest(s.field, 1, &ray, &found);
        met += exact.triangle >= 0;
        apart += (exact.triangle >= 0) != (found.triangle >= 0) || (exact.triangle >= 0 && fabsf(exact.along - found.along) > 0.06f);
    }
    print_message("  %d of %d rays end more than 6 cm from where they should\n", apart, met);
    assert_true(met > 3000 && apart < met / 20); /* silhouettes are a voxel wide */
    trace_scene_free(trace);
    end(&s);
}

static void numbers_do_not_depend_on_threads(void **state)
{
    (void)state;
    setup a, b;
    begin(&a, 1, 1);
    begin(&b, 3, 1);
    const size_t count = (size_t)a.field->size[0] * a.field->size[1] * a.field->size[2];
    assert_memory_equal(a.field->distance, b.field->distance, count * sizeof *a.field->distance);
    assert_memory_equal(a.field->triangle, b.field->triangle, count * sizeof *a.field->triangle);
    end(&a);
    end(&b);
}

/* A large world has larger voxels. */
static void memory_is_bounded(void **state)
{
    (void)state;
    setup s;
    begin(&s, 2, 10);
    assert_true(distance_field_bytes(s.field) <= DISTANCE_FIELD_BYTES + sizeof *s.field);
    assert_true(s.field->voxel > (float)DISTANCE_FIELD_VOXEL && s.field->voxel < 0.2f);
    end(&s);
}

static void odd_rays_meet_nothing(void **state)
{
    (void)state;
    setup s;
    begin(&s, 1, 1);
    const trace_ray odd[] = {
        {{0, 9, 0}, {1, 0, 0}, 0, FLT_MAX}, {{NAN, 0, 0}, {0, -1, 0}, 0, 10}, {{0, 0, 0}, {0, -1, 0}, 5, 1},
        {{0, 0, 0}, {0, 0, 0}, 0, 10},      {{0, 0, 0}, {NAN, -1, 0}, 0, 10},
    };
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        trace_hit hit;
        distance_field_nearest(s.field, 1, &odd[i], &hit);
        assert_int_equal(hit.triangle, -1);
    }
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_exact_near_and_never_too_far),
        cmocka_unit_test(searched_rays_end_near_traced_ones),
        cmocka_unit_test(numbers_do_not_depend_on_threads),
        cmocka_unit_test(memory_is_bounded),
        cmocka_unit_test(odd_rays_meet_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
