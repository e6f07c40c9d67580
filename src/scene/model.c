/* SPDX-License-Identifier: MIT
 *
 * Models: what their makers share.
 */
#include "scene/model.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool model_fault_set(model_fault *fault, scene_error_kind kind, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    fault->kind = kind;
    return false;
}

bool model_fault_memory(model_fault *fault) { return model_fault_set(fault, SCENE_ERROR_MEMORY, "out of memory while reading the scene"); }

bool mesh_data_allocate(mesh_data *mesh, size_t vertex_count, size_t triangle_count)
{
    *mesh = (mesh_data){.positions = malloc(vertex_count * 3 * sizeof(float)),
                        .normals = malloc(vertex_count * 3 * sizeof(float)),
                        .texcoords = malloc(vertex_count * 2 * sizeof(float)),
                        .indices = malloc(triangle_count * 3 * sizeof(uint32_t)),
                        .vertex_count = vertex_count,
                        .triangle_count = triangle_count};
    if (mesh->positions != NULL && mesh->normals != NULL && mesh->texcoords != NULL && mesh->indices != NULL)
        return true;
    mesh_data_free(mesh);
    return false;
}

void mesh_data_free(mesh_data *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->texcoords);
    free(mesh->indices);
    *mesh = (mesh_data){0};
}

bool mesh_data_smooth(mesh_data *mesh)
{
    free(mesh->normals);
    mesh->normals = NULL;
    double(*sums)[3] = calloc(mesh->vertex_count, sizeof *sums);
    float *normals = malloc(mesh->vertex_count * 3 * sizeof *normals);
    if (sums == NULL || normals == NULL) {
        free(sums);
        free(normals);
        return false;
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * i;
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            const double origin = (double)mesh->positions[3 * (size_t)corner[0] + k];
            a[k] = (double)mesh->positions[3 * (size_t)corner[1] + k] - origin;
            b[k] = (double)mesh->positions[3 * (size_t)corner[2] + k] - origin;
        }
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            for (int v = 0; v < 3; v++)
                sums[corner[v]][k] += a[l] * b[m] - a[m] * b[l];
        }
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const double *n = sums[i], length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++)
            normals[3 * i + k] = length > 0 ? (float)(n[k] / length) : (float)(k == 1);
    }
    free(sums);
    mesh->normals = normals;
    return true;
}

bool model_of_mesh(scene_model *out, const mesh_data *mesh, const char *name, bool dry, model_fault *fault)
{
    *out = (scene_model){.meshes = calloc(1, sizeof *out->meshes), .parts = calloc(1, sizeof *out->parts)};
    if (out->meshes == NULL || out->parts == NULL) {
        model_free(out);
        return model_fault_memory(fault);
    }
    mgt_mesh_desc desc;
    mgt_mesh_desc_init(&desc, sizeof desc);
    desc.positions = mesh->positions;
    desc.normals = mesh->normals;
    desc.texcoords = mesh->texcoords;
    desc.vertex_count = (uint32_t)mesh->vertex_count;
    desc.indices = mesh->indices;
    desc.triangle_count = (uint32_t)mesh->triangle_count;
    desc.dry = dry;
    const mgt_status status = mgt_mesh_create(&out->meshes[0], &desc);
    if (status != MGT_OK) {
        model_free(out);
        return status == MGT_ERROR_MEMORY ? model_fault_memory(fault) : model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: %s", name, mgt_last_error(NULL));
    }
    out->mesh_count = out->part_count = 1;
    out->parts[0] = (model_part){.mesh = out->meshes[0], .transform = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, .material = scene_material_defaults()};
    out->triangles = mesh->triangle_count;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        out->reach = fmax(out->reach, fabs((double)mesh->positions[i]));
    return true;
}

void model_free(scene_model *model)
{
    for (size_t i = 0; i < model->mesh_count; i++)
        mgt_mesh_destroy(model->meshes[i]);
    for (size_t i = 0; i < model->texture_count; i++)
        mgt_texture_destroy(model->textures[i]);
    free(model->meshes);
    free(model->textures);
    free(model->parts);
    *model = (scene_model){0};
}

/* Eight bytes a step, multiplied and folded; the order of bytes is the machine's, as that of the floats is. */
uint64_t model_hash(uint64_t hash, const void *bytes, size_t length)
{
    const unsigned char *at = bytes;
    hash ^= 0x9e3779b97f4a7c15u + length;
    while (length > 0) {
        uint64_t word = 0;
        const size_t step = length < sizeof word ? length : sizeof word;
        memcpy(&word, at, step);
        hash = (hash ^ word) * 0xd6e8feb86659fd93u;
        hash ^= hash >> 32;
        at += step;
        length -= step;
    }
    hash *= 0xd6e8feb86659fd93u;
    return hash ^ hash >> 29;
}
