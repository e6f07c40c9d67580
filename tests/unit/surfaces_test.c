/* SPDX-License-Identifier: MIT
 *
 * A ray against the triangles of a surface: surfaces.k in double precision, as the CPU evaluates it.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "unit/random_numbers.h"

#include "cpu/surface_lane.h"

/* ---- one triangle ---- */

static float coordinate(random_state *r) { return (float)random_range(r, -1, 1); }

static surface_triangle random_triangle(random_state *r)
{
    surface_triangle t = {.neighbours = {-1, -1, -1}};
    for (int k = 0; k < 9; k++)
        t.corners[k / 3][k % 3] = coordinate(r);
    const vec3 first = vec3_of(t.corners[0]), normal = cross(sub(vec3_of(t.corners[1]), first), sub(vec3_of(t.corners[2]), first));
    const double length = sqrt(dot(normal, normal));
    t.normal[0] = (float)(normal.x / length), t.normal[1] = (float)(normal.y / length), t.normal[2] = (float)(normal.z / length);
    return t;
}

static vec3 point_of(const surface_triangle *t, const double weight[3])
{
    vec3 p = scale(vec3_of(t->corners[0]), weight[0]);
    for (int k = 1; k < 3; k++)
        p = add(p, scale(vec3_of(t->corners[k]), weight[k]));
    return p;
}

/* Multiple of a ray at which it meets a triangle without neighbours; infinite: it does not. */
static double met_at(const struct kernel_context *cx, vec3 from, vec3 ray) { return surface_step(cx, 0, -1, facet_of(cx, 0, from), ray).along; }

static void rays_meet_what_they_are_sent_to(void **state)
{
    (void)state;
    random_state r = {5};
    for (int i = 0; i < 20000; i++) {
        const surface_triangle t = random_triangle(&r);
        const struct kernel_context cx = {.surface = &t};
        double weight[3] = {random_range(&r, -0.5, 1.2), random_range(&r, -0.5, 1.2), 0};
        weight[2] = 1 - weight[0] - weight[1];
        const vec3 from = vec3((double)coordinate(&r) + 3, (double)coordinate(&r), (double)coordinate(&r)), target = point_of(&t, weight);
        const double along = random_range(&r, 0.1, 10);
        const vec3 ray = scale(sub(target, from), 1 / along);
        const Crossing c = crossing_of(&cx, facet_of(&cx, 0, from), ray);
        const double flat = fabs(dot(vec3_of(t.normal), ray)) / sqrt(dot(ray, ray));
        if (flat < 1e-3)
            continue;
        assert_true(fabs(c.along - along) < 1e-9 / flat * along);
        assert_true(fabs(c.first - weight[0]) < 1e-6 / flat && fabs(c.second - weight[1]) < 1e-6 / flat && fabs(c.third - weight[2]) < 1e-6 / flat);
        const double inside = fmin(weight[0], fmin(weight[1], weight[2])), met = met_at(&cx, from, ray);
        if (fabs(inside) > 1e-6 / flat)
            assert_true(inside > 0 ? met == c.along : isinf(met));
        assert_true(isinf(met_at(&cx, from, scale(ray, -1)))); /* behind it */
    }
}

static void rays_along_a_triangle_meet_nothing(void **state)
{
    (void)state;
    const surface_triangle t = {.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .neighbours = {-1, -1, -1}, .normal = {0, 0, 1}};
    const struct kernel_context cx = {.surface = &t};
    assert_true(isinf(met_at(&cx, vec3(-1.0, 0.2, 0.0), vec3(1.0, 0.0, 0.0))));
    assert_true(isinf(met_at(&cx, vec3(0.2, 0.2, 1.0), vec3(1.0, 0.0, 0.0))));
}

/* ---- a way over a surface ---- */

enum { SQUARES = 20, TRIANGLES = 2 * SQUARES };

/* A strip of squares, two triangles each, seen from above; the last `bent` squares turn back under the others. */
static void make_strip(surface_triangle t[TRIANGLES], int bent)
{
    for (int i = 0; i < TRIANGLES; i++) {
        const int square = i / 2;
        const float down = square < SQUARES - bent ? 0 : 1;
        const float left = down > 0 ? (float)(2 * (SQUARES - bent) - square) : (float)square, right = down > 0 ? left - 1 : left + 1;
        const float odd[3][3] = {{right, -down, 0}, {left, -down, 1}, {right, -down, 1}}, even[3][3] = {{left, -down, 0}, {left, -down, 1}, {right, -down, 0}};
        memcpy(t[i].corners, i % 2 ? odd : even, sizeof even);
        t[i].normal[0] = t[i].normal[2] = 0;
        t[i].normal[1] = down > 0 ? -1 : 1;
        /* Across the edges from corner 0, 1 and 2 to the next. */
        const int32_t before = i > 0 ? i - 1 : -1, after = i + 1 < TRIANGLES ? i + 1 : -1;
        const int32_t of_even[3] = {before, after, -1}, of_odd[3] = {before, -1, after};
        memcpy(t[i].neighbours, i % 2 ? of_odd : of_even, sizeof of_even);
    }
}

/* The triangle that a way from `start` ends at; −1: it meets none. */
static int end_of_way(const surface_triangle *t, int start, vec3 from, vec3 ray)
{
    const struct kernel_context cx = {.surface = t};
    int triangle = start, before = -1;
    for (int i = 0; i < SURFACE_STEPS; i++) {
        const SurfaceStep s = surface_step(&cx, triangle, before, facet_of(&cx, triangle, from), ray);
        if (s.along < INFINITY)
            return triangle;
        if (s.next < 0)
            return -1;
        before = triangle;
        triangle = s.next;
    }
    return -2;
}

static void ways_end_where_the_ray_meets_the_surface(void **state)
{
    (void)state;
    surface_triangle t[TRIANGLES];
    random_state r = {9};
    make_strip(t, 0);
    for (int i = 0; i < 2000; i++) {
        const int wanted = (int)random_range(&r, 0, TRIANGLES - 1e-6), start = (int)random_range(&r, 0, TRIANGLES - 1e-6);
        double weight[3] = {random_range(&r, 0.01, 0.5), random_range(&r, 0.01, 0.45), 0};
        weight[2] = 1 - weight[0] - weight[1];
        const vec3 from = vec3(random_range(&r, -3, SQUARES), random_range(&r, 1, 5), random_range(&r, -3, 3));
        assert_int_equal(end_of_way(t, start, from, sub(point_of(&t[wanted], weight), from)), wanted);
    }
    /* Beside the strip the way ends at its border. */
    assert_int_equal(end_of_way(t, 3, vec3(5.0, 2.0, 0.5), vec3(0.0, -1.0, 3.0)), -1);
}

static void ways_do_not_turn_round_outlines(void **state)
{
    (void)state;
    surface_triangle t[TRIANGLES];
    make_strip(t, SQUARES / 2);
    /* Beyond the fold at x = 10 is nothing, and what lies under the strip shows the ray its back. */
    assert_int_equal(end_of_way(t, 0, vec3(5.0, 2.0, 0.5), vec3(7.0, -2.0, 0.0)), -1);
    assert_int_equal(end_of_way(t, 0, vec3(5.0, 2.0, 0.5), vec3(4.2, -2.0, 0.0)), 18);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_what_they_are_sent_to),
        cmocka_unit_test(rays_along_a_triangle_meet_nothing),
        cmocka_unit_test(ways_end_where_the_ray_meets_the_surface),
        cmocka_unit_test(ways_do_not_turn_round_outlines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
