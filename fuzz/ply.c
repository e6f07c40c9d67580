/* SPDX-License-Identifier: MIT
 *
 * PLY files, and meshes made of them.
 */
#include "fuzz.h"
#include "scene/model_ply.h"

void fuzz_input(const uint8_t *bytes, size_t size)
{
    model_fault fault = {0};
    mesh_data mesh = {0};
    scene_model model = {0};
    bool good = ply_parse(&mesh, (const char *)bytes, size, "fuzz.ply", &fault);
    for (size_t i = 0; good && i < 3 * mesh.triangle_count; i++)
        fuzz_require(mesh.indices[i] < mesh.vertex_count, "a triangle refers to a vertex that does not exist");
    good = good && model_of_mesh(&model, &mesh, "fuzz.ply", size % 2 == 1, &fault);
    if (!good)
        fuzz_require_message(fault.text);
    model_free(&model);
    mesh_data_free(&mesh);
}
