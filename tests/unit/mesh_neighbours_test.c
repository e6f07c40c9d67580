/* SPDX-License-Identifier: MIT
 * Which triangles share an edge: of closed, open, mirrored and pathological meshes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "frame/mesh.h"
#include "frame/world.h"
#include "unit/test_mesh.h"

/* Every neighbour has the same edge the other way round, by positions. Returns how many edges have none. */
static size_t check_neighbours(const float *positions, const uint32_t *indices, const int32_t *neighbours, size_t triangles)
{
    size_t borders = 0;
    for (size_t i = 0; i < 3 * triangles; i++) {
        const float *begin = positions + 3 * (size_t)indices[i], *end = positions + 3 * (size_t)indices[i % 3 == 2 ? i - 2 : i + 1];
        if (neighbours[i] < 0) {
            borders++;
            continue;
        }
        assert_true((size_t)neighbours[i] < triangles);
        bool found = false;
        for (size_t k = 0; k < 3; k++) {
            const uint32_t *corner = indices + 3 * (size_t)neighbours[i];
            found = found || (memcmp(positions + 3 * (size_t)corner[k], end, 3 * sizeof *end) == 0 &&
                              memcmp(positions + 3 * (size_t)corner[(k + 1) % 3], begin, 3 * sizeof *end) == 0);
        }
        assert_true(found);
    }
    return borders;
}

static const float corners[4][3] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

static void shared_and_split_vertices(void **state)
{
    (void)state;
    float split[12][3];
    uint32_t numbers[12];
    for (uint32_t i = 0; i < 12; i++) {
        memcpy(split[i], corners[faces[i]], sizeof split[i]);
        numbers[i] = i;
    }
    mgt_mesh *meshes[2] = {test_mesh(corners[0], NULL, 4, faces, 4), test_mesh(split[0], NULL, 12, numbers, 4)};
    for (int k = 0; k < 2; k++) {
        assert_int_equal(check_neighbours(meshes[k]->positions, meshes[k]->indices, meshes[k]->neighbours, 4), 0);
        mgt_mesh_destroy(meshes[k]);
    }
}

static void borders_have_none(void **state)
{
    (void)state;
    static const float square[] = {0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1};
    static const uint32_t halves[] = {0, 2, 1, 0, 3, 2};
    mgt_mesh *mesh = test_mesh(square, NULL, 4, halves, 2);
    assert_int_equal(check_neighbours(mesh->positions, mesh->indices, mesh->neighbours, 2), 4);
    mgt_mesh_destroy(mesh);
}

/* A million triangles on one edge take no longer than others. */
static void hostile_meshes_end(void **state)
{
    (void)state;
    enum { COUNT = 1 << 20 };
    static uint32_t same[3 * COUNT];
    for (size_t i = 0; i < 3 * COUNT; i++)
        same[i] = (uint32_t)(i % 3);
    mgt_mesh *mesh = test_mesh(corners[0], NULL, 4, same, COUNT);
    assert_int_equal(mesh->neighbours[0], -1);
    mgt_mesh_destroy(mesh);
}

static void worlds_keep_them(void **state)
{
    (void)state;
    mgt_mesh *mesh = test_mesh(corners[0], NULL, 4, faces, 4);
    const mgt_object objects[] = {{.mesh = mesh, .transform = {{1, 0, 0, 3}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
                                  {.mesh = mesh, .transform = {{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 5}}}};
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.objects = objects;
    scene.object_count = 2;
    thread_pool *pool = thread_pool_create(1);
    world *w = NULL;
    assert_int_equal(world_update(&w, &scene, pool), MGT_OK);
    assert_int_equal(check_neighbours(w->positions, w->indices, w->neighbours, w->triangle_count), 0);
    for (size_t i = 0; i < 24; i++)
        assert_int_equal(w->neighbours[i] / 4, i / 12);
    world_free(w);
    thread_pool_destroy(pool);
    mgt_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shared_and_split_vertices),
        cmocka_unit_test(borders_have_none),
        cmocka_unit_test(hostile_meshes_end),
        cmocka_unit_test(worlds_keep_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
