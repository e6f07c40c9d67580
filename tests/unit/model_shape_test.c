/* SPDX-License-Identifier: MIT
 *
 * Built-in shapes: closed where they should be, their fronts outside, their texture coordinates metres, their triangles as many as asked for.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/model.h"
#include "scene/scene_models.h"

static const double PI = 3.14159265358979323846;

static scene_object object_of(scene_shape shape, double x, double y, double z, uint32_t triangles)
{
    return (scene_object){.shape = shape, .size = {x, y, z}, .triangles = triangles, .count = 5, .rim_height = 0.15, .rim_width = 0.4};
}

static mesh_data build(const scene_object *object)
{
    mesh_data mesh;
    assert_true(shape_build(&mesh, object));
    for (size_t i = 0; i < 3 * mesh.triangle_count; i++)
        assert_true(mesh.indices[i] < mesh.vertex_count);
    return mesh;
}

static const float *corner(const mesh_data *mesh, size_t triangle, int index)
{
    return mesh->positions + 3 * (size_t)mesh->indices[3 * triangle + (size_t)index];
}

/* Twice the area as a vector on the side from which the corners run counter-clockwise. */
static void triangle_normal(const mesh_data *mesh, size_t triangle, double n[3])
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)corner(mesh, triangle, 1)[k] - (double)corner(mesh, triangle, 0)[k];
        b[k] = (double)corner(mesh, triangle, 2)[k] - (double)corner(mesh, triangle, 0)[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* ---- edges ------------------------------------------------------------------------------------------------------ */

typedef struct edge {
    float from[3], to[3];
} edge;

static int compare_edges(const void *left, const void *right) { return memcmp(left, right, sizeof(edge)); }

/* How many edges have no partner that runs the other way between the same two points, to the bit. */
static size_t open_edges(const mesh_data *mesh)
{
    const size_t count = 3 * mesh->triangle_count;
    edge *edges = calloc(count, sizeof *edges);
    assert_non_null(edges);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) { /* adding 0 makes one zero of two */
            edges[i].from[k] = corner(mesh, i / 3, (int)(i % 3))[k] + 0.0f;
            edges[i].to[k] = corner(mesh, i / 3, (int)((i + 1) % 3))[k] + 0.0f;
        }
    qsort(edges, count, sizeof *edges, compare_edges);
    size_t open = 0;
    for (size_t i = 0; i < count; i++) {
        edge back;
        memcpy(back.from, edges[i].to, sizeof back.from);
        memcpy(back.to, edges[i].from, sizeof back.to);
        open += bsearch(&back, edges, count, sizeof *edges, compare_edges) == NULL;
        assert_true(i == 0 || compare_edges(&edges[i - 1], &edges[i]) != 0);
    }
    free(edges);
    return open;
}

static double volume_of(const mesh_data *mesh)
{
    double volume = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        double n[3];
        triangle_normal(mesh, i, n);
        for (int k = 0; k < 3; k++)
            volume += n[k] * (double)corner(mesh, i, 0)[k] / 6;
    }
    return volume;
}

static double area_of(const mesh_data *mesh)
{
    double area = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        double n[3];
        triangle_normal(mesh, i, n);
        area += length_of(n) / 2;
    }
    return area;
}

static const uint32_t budgets[] = {0, 500, 1000, 4321, 16000, 128000};
enum { BUDGETS = sizeof budgets / sizeof *budgets };

static void solids_are_closed_and_hold_their_volume(void **state)
{
    (void)state;
    for (int i = 0; i < BUDGETS; i++) {
        scene_object box = object_of(SHAPE_BOX, 1.7, 0.3, 2.9, budgets[i]), steps = object_of(SHAPE_STEPS, 2, 1.6, 1.7, budgets[i]);
        scene_object sphere = object_of(SHAPE_SPHERE, 1.2, 0.7, 3, budgets[i]);
        mesh_data mesh = build(&box);
        assert_int_equal(open_edges(&mesh), 0);
        assert_true(fabs(volume_of(&mesh) - 1.7 * 0.3 * 2.9) < 1e-6);
        mesh_data_free(&mesh);
        mesh = build(&steps);
        assert_int_equal(open_edges(&mesh), 0);
        assert_true(fabs(volume_of(&mesh) - 2 * 1.6 * 1.7 * 3 / 5) < 1e-6);
        mesh_data_free(&mesh);
        mesh = build(&sphere);
        assert_int_equal(open_edges(&mesh), 0);
        const double volume = PI / 6 * 1.2 * 0.7 * 3;
        assert_true(volume_of(&mesh) < volume && volume_of(&mesh) > volume * (budgets[i] == 500 ? 0.95 : 0.98));
        mesh_data_free(&mesh);
    }
}

/* A pool's only open edges are its outer ones; its area is that of floor, walls and rim. */
static void a_pool_has_no_cracks(void **state)
{
    (void)state;
    for (int i = 0; i < BUDGETS; i++) {
        scene_object pool = object_of(SHAPE_POOL, 6, 2, 12, budgets[i]);
        mesh_data mesh = build(&pool);
        double area = 6 * 12 + 2 * (6 + 12) * 2.15 + (6.8 * 12.8 - 6 * 12);
        assert_true(fabs(area_of(&mesh) - area) < 1e-4);
        size_t outer = 0;
        for (size_t t = 0; t < mesh.triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                const float *a = corner(&mesh, t, k), *b = corner(&mesh, t, (k + 1) % 3);
                outer += (fabsf(a[0]) == 3.4f && a[0] == b[0]) || (fabsf(a[2]) == 6.4f && a[2] == b[2]);
            }
        assert_int_equal(open_edges(&mesh), outer);
        mesh_data_free(&mesh);
        pool.rim_width = 0;
        mesh = build(&pool);
        assert_true(fabs(area_of(&mesh) - (6 * 12 + 2 * (6 + 12) * 2.15)) < 1e-4);
        /* Floor and walls are seen from inside. */
        for (size_t t = 0; t < mesh.triangle_count; t++) {
            double n[3], inwards = 0;
            triangle_normal(&mesh, t, n);
            for (int k = 0; k < 3; k++)
                inwards += n[k] * ((k == 1 ? -0.9 : 0) - (double)corner(&mesh, t, 0)[k]);
            assert_true(inwards > 0);
        }
        mesh_data_free(&mesh);
    }
}

static void the_budget_is_kept_and_used(void **state)
{
    (void)state;
    static const scene_shape shapes[] = {SHAPE_PLANE, SHAPE_BOX, SHAPE_SPHERE, SHAPE_POOL};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (int i = 2; i < BUDGETS; i++) {
            scene_object object = object_of(shapes[s], 6, 2, 12, budgets[i]);
            mesh_data mesh = build(&object);
            if (mesh.triangle_count > budgets[i] || (double)mesh.triangle_count < 0.7 * budgets[i])
                fail_msg("shape %d: %zu triangles of %u", (int)shapes[s], mesh.triangle_count, budgets[i]);
            mesh_data_free(&mesh);
        }
    scene_object plane = object_of(SHAPE_PLANE, 6, 2, 12, 0), box = object_of(SHAPE_BOX, 6, 2, 12, 1);
    mesh_data mesh = build(&plane);
    assert_int_equal(mesh.triangle_count, 2);
    mesh_data_free(&mesh);
    mesh = build(&box); /* as few as its form needs */
    assert_int_equal(mesh.triangle_count, 12);
    mesh_data_free(&mesh);
}

/* Unit normals on the side of the front; on flat shapes they are the triangles' own. */
static void normals_point_to_the_front(void **state)
{
    (void)state;
    for (scene_shape shape = SHAPE_PLANE; shape <= SHAPE_POOL; shape++) {
        scene_object object = object_of(shape, 3, 1, 2, 2000);
        mesh_data mesh = build(&object);
        for (size_t t = 0; t < mesh.triangle_count; t++) {
            double n[3];
            triangle_normal(&mesh, t, n);
            const double length = length_of(n);
            assert_true(length > 0);
            for (int k = 0; k < 3; k++) {
                const float *v = mesh.normals + 3 * (size_t)mesh.indices[3 * t + (size_t)k];
                const double dot = (n[0] * (double)v[0] + n[1] * (double)v[1] + n[2] * (double)v[2]) / length;
                assert_true(fabs((double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] + (double)v[2] * (double)v[2] - 1) < 1e-5);
                assert_true(dot > (shape == SHAPE_SPHERE ? 0.95 : 0.99999));
            }
        }
        mesh_data_free(&mesh);
    }
}

/* On flat faces each edge is as long in texture coordinates as in space, and s, t and the front's normal are right-handed seen from the front,
 * t growing downwards as in a picture. */
static void texture_coordinates_are_metres(void **state)
{
    (void)state;
    for (scene_shape shape = SHAPE_PLANE; shape <= SHAPE_POOL; shape++) {
        if (shape == SHAPE_SPHERE)
            continue;
        scene_object object = object_of(shape, 3, 1, 2, 300);
        mesh_data mesh = build(&object);
        for (size_t t = 0; t < mesh.triangle_count; t++) {
            const uint32_t *index = mesh.indices + 3 * t;
            const float *st[3];
            for (int k = 0; k < 3; k++)
                st[k] = mesh.texcoords + 2 * (size_t)index[k];
            for (int k = 0; k < 3; k++) {
                const float *a = corner(&mesh, t, k), *b = corner(&mesh, t, (k + 1) % 3), *u = st[k], *v = st[(k + 1) % 3];
                const double space = hypot(hypot((double)(b[0] - a[0]), (double)(b[1] - a[1])), (double)(b[2] - a[2]));
                assert_true(fabs(space - hypot((double)(v[0] - u[0]), (double)(v[1] - u[1]))) < 1e-5);
            }
            const double turn = (double)(st[1][0] - st[0][0]) * (double)(st[2][1] - st[0][1]) - (double)(st[1][1] - st[0][1]) * (double)(st[2][0] - st[0][0]);
            assert_true(turn < 0);
        }
        mesh_data_free(&mesh);
    }
    /* A sphere's are those of its mean radius around the equator and down a meridian. */
    scene_object sphere = object_of(SHAPE_SPHERE, 2, 2, 2, 0);
    mesh_data mesh = build(&sphere);
    float most[2] = {0, 0};
    for (size_t i = 0; i < mesh.vertex_count; i++)
        for (int k = 0; k < 2; k++)
            most[k] = fmaxf(most[k], mesh.texcoords[2 * i + (size_t)k]);
    assert_true(fabs((double)most[0] - 2 * PI) < 1e-5 && fabs((double)most[1] - PI) < 1e-5);
    mesh_data_free(&mesh);
}

/* ---- floors ----------------------------------------------------------------------------------------------------- */

static void a_floor_has_the_heights_of_its_picture(void **state)
{
    (void)state;
    model_fault fault;
    uint64_t hash = 0, again = 0;
    mesh_data mesh;
    scene_object floor = object_of(SHAPE_FLOOR, 8, 1, 6, 0);
    floor.lowest = -2;
    floor.highest = 3;
    assert_true(floor_build(&mesh, &floor, MGT_SOURCE_DIR "/tests/data/scenes/floor.pfm", &hash, &fault));
    assert_int_equal(mesh.vertex_count, 9 * 7);
    assert_int_equal(mesh.triangle_count, 2 * 8 * 6);
    for (int j = 0; j < 7; j++)
        for (int i = 0; i < 9; i++) {
            const float *p = mesh.positions + 3 * (9 * j + i), *st = mesh.texcoords + 2 * (9 * j + i), *n = mesh.normals + 3 * (9 * j + i);
            const double value = 0.5 + 0.5 * sin(i * 1.1) * cos(j * 0.9);
            assert_true(fabs((double)p[0] - (i - 4)) < 1e-6 && fabs((double)p[2] - (j - 3)) < 1e-6);
            assert_true(fabs((double)p[1] - (-2 + 5 * value)) < 1e-5);
            assert_true(st[0] == p[0] && st[1] == p[2] && n[1] > 0);
        }
    mesh_data_free(&mesh);
    floor.triangles = 40;
    assert_true(floor_build(&mesh, &floor, MGT_SOURCE_DIR "/tests/data/scenes/floor.pfm", &again, &fault));
    assert_true(mesh.triangle_count <= 40 && mesh.triangle_count >= 20);
    assert_true(hash == again && hash != 0);
    mesh_data_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_are_closed_and_hold_their_volume),
        cmocka_unit_test(a_pool_has_no_cracks),
        cmocka_unit_test(the_budget_is_kept_and_used),
        cmocka_unit_test(normals_point_to_the_front),
        cmocka_unit_test(texture_coordinates_are_metres),
        cmocka_unit_test(a_floor_has_the_heights_of_its_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
