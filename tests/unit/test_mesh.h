/* SPDX-License-Identifier: MIT
 * Meshes of tests. Include it after <cmocka.h>. */
#ifndef MANGATA_TESTS_TEST_MESH_H
#define MANGATA_TESTS_TEST_MESH_H

#include "mangata/mangata.h"

/* `texcoords` may be NULL. */
static inline mgt_mesh *test_mesh(const float *positions, const float *texcoords, uint32_t vertices, const uint32_t *indices, uint32_t triangles)
{
    mgt_mesh_desc desc;
    mgt_mesh_desc_init(&desc, sizeof desc);
    desc.positions = positions;
    desc.texcoords = texcoords;
    desc.vertex_count = vertices;
    desc.indices = indices;
    desc.triangle_count = triangles;
    mgt_mesh *mesh = NULL;
    assert_int_equal(mgt_mesh_create(&mesh, &desc), MGT_OK);
    return mesh;
}

#endif
