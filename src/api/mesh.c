/* SPDX-License-Identifier: MIT
 * Meshes and textures. They are checked and copied when they are created. */
#include "frame/mesh.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "api/context.h"
#include "api/structs.h"
#include "api/validate.h"

static atomic_uint_fast64_t last_id;

static uint64_t next_id(void) { return atomic_fetch_add(&last_id, 1) + 1; }

/* ---- meshes ---- */

static mgt_status check_mesh(const reporter *r, const mgt_mesh_desc *d)
{
    if (!d->positions || d->vertex_count == 0)
        return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "the mesh has no vertices");
    if (!d->indices || d->triangle_count == 0)
        return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "the mesh has no triangles");
    if (d->triangle_count > MGT_MAX_TRIANGLES)
        return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "the mesh has %u triangles; at most %d are allowed", d->triangle_count, MGT_MAX_TRIANGLES);
    if (d->dry > 1 || d->reserved != 0)
        return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "dry is %u and reserved %u; allowed is dry 0 or 1 and reserved 0", d->dry, d->reserved);
    for (size_t i = 0; i < 3 * (size_t)d->vertex_count; i++)
        if (!(fabsf(d->positions[i]) <= 1e6f))
            return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "vertex %zu lies at %g; allowed is -1e6 to 1e6 m", i / 3, (double)d->positions[i]);
    for (size_t i = 0; d->normals && i < 3 * (size_t)d->vertex_count; i++)
        if (!isfinite(d->normals[i]))
            return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "the normal of vertex %zu is not finite", i / 3);
    for (size_t i = 0; d->texcoords && i < 2 * (size_t)d->vertex_count; i++)
        if (!(fabsf(d->texcoords[i]) <= 1e6f))
            return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "the texture coordinate of vertex %zu is %g; allowed is -1e6 to 1e6", i / 2,
                                (double)d->texcoords[i]);
    for (size_t i = 0; i < 3 * (size_t)d->triangle_count; i++)
        if (d->indices[i] >= d->vertex_count)
            return report_error(r, MGT_ERROR_ARGUMENT, "mesh.desc", "triangle %zu refers to vertex %u of %u", i / 3, d->indices[i], d->vertex_count);
    return MGT_OK;
}

static bool has_area(const float *positions, const uint32_t corner[3])
{
    double a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)positions[3 * (size_t)corner[1] + i] - (double)positions[3 * (size_t)corner[0] + i];
        b[i] = (double)positions[3 * (size_t)corner[2] + i] - (double)positions[3 * (size_t)corner[0] + i];
    }
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return x * x + y * y + z * z > 1e-30;
}

static void *copy_of(const void *source, size_t count, size_t size)
{
    void *copy = source ? malloc(count * size) : NULL;
    if (copy)
        memcpy(copy, source, count * size);
    return copy;
}

/* Normalises normals. A normal of length 0 becomes (0, 1, 0). */
static void normalize_all(float *normals, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        float *n = normals + 3 * i;
        const double length = sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] + (double)n[2] * (double)n[2]);
        if (length > 1e-30)
            for (int k = 0; k < 3; k++)
                n[k] = (float)((double)n[k] / length);
        else
            n[0] = 0, n[1] = 1, n[2] = 0;
    }
}

static void keep_triangles(mgt_mesh *m, const mgt_mesh_desc *d)
{
    for (int k = 0; k < 3; k++)
        m->low[k] = 1e6f, m->high[k] = -1e6f;
    for (size_t i = 0; i < d->triangle_count; i++) {
        const uint32_t *corner = d->indices + 3 * i;
        if (!has_area(d->positions, corner))
            continue;
        memcpy(m->indices + 3 * (size_t)m->triangle_count++, corner, 3 * sizeof *corner);
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++) {
                const float x = d->positions[3 * (size_t)corner[v] + k];
                m->low[k] = x < m->low[k] ? x : m->low[k];
                m->high[k] = x > m->high[k] ? x : m->high[k];
            }
    }
}

mgt_status mgt_mesh_create(mgt_mesh **mesh, const mgt_mesh_desc *desc)
{
    const reporter r = creation_reporter();
    mgt_mesh_desc own;
    if (!mesh)
        return report_error(&r, MGT_ERROR_ARGUMENT, "mesh.create", "mgt_mesh_create: the pointer to fill is NULL");
    *mesh = NULL;
    mgt_status status = struct_take(&r, &mesh_desc_kind, &own, desc, 1);
    if (status == MGT_OK)
        status = check_mesh(&r, &own);
    if (status != MGT_OK)
        return status;
    mgt_mesh *m = calloc(1, sizeof *m);
    if (!m)
        goto out_of_memory;
    m->id = next_id();
    m->dry = own.dry != 0;
    m->vertex_count = own.vertex_count;
    m->positions = copy_of(own.positions, own.vertex_count, 3 * sizeof *m->positions);
    m->normals = copy_of(own.normals, own.vertex_count, 3 * sizeof *m->normals);
    m->texcoords = copy_of(own.texcoords, own.vertex_count, 2 * sizeof *m->texcoords);
    m->indices = malloc(own.triangle_count * 3 * sizeof *m->indices);
    if (!m->positions || !m->indices || (own.normals && !m->normals) || (own.texcoords && !m->texcoords))
        goto out_of_memory;
    keep_triangles(m, &own);
    if (m->triangle_count == 0) {
        mgt_mesh_destroy(m);
        return report_error(&r, MGT_ERROR_ARGUMENT, "mesh.create", "none of the mesh's %u triangles has an area", own.triangle_count);
    }
    if (!mesh_find_neighbours(m))
        goto out_of_memory;
    if (m->normals)
        normalize_all(m->normals, m->vertex_count);
    *mesh = m;
    return MGT_OK;
out_of_memory:
    mgt_mesh_destroy(m);
    return report_error(&r, MGT_ERROR_MEMORY, "mesh.create", "out of memory for a mesh of %u triangles", own.triangle_count);
}

void mgt_mesh_destroy(mgt_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->texcoords);
    free(mesh->indices);
    free(mesh->neighbours);
    free(mesh);
}

/* ---- textures ---- */

static double to_linear(uint32_t byte)
{
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static uint32_t to_byte(double linear)
{
    const double v = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
    return (uint32_t)(255 * v + 0.5);
}

static uint32_t side(uint32_t size, uint32_t level) { return size >> level ? size >> level : 1; }

/* A texel of level `to`: the mean of the 2 × 2 texels that it covers in the level above. The last texel of an odd side covers three. */
static uint32_t shrunk(const mgt_texture *t, const double linear[256], uint32_t to, uint32_t x, uint32_t y)
{
    const uint32_t width = side(t->width, to - 1), height = side(t->height, to - 1);
    const uint32_t x1 = x + 1 == side(t->width, to) ? width : 2 * x + 2, y1 = y + 1 == side(t->height, to) ? height : 2 * y + 2;
    const uint32_t *from = t->texels + t->level_start[to - 1];
    double sum[3] = {0};
    for (uint32_t j = 2 * y; j < y1; j++)
        for (uint32_t i = 2 * x; i < x1; i++)
            for (int k = 0; k < 3; k++)
                sum[k] += linear[from[(size_t)j * width + i] >> 8 * k & 255];
    const double count = (double)(x1 - 2 * x) * (y1 - 2 * y);
    return to_byte(sum[0] / count) | to_byte(sum[1] / count) << 8 | to_byte(sum[2] / count) << 16 | 255u << 24;
}

static void fill_levels(mgt_texture *t)
{
    double linear[256];
    for (uint32_t i = 0; i < 256; i++)
        linear[i] = to_linear(i);
    for (uint32_t level = 1; level < t->levels; level++) {
        const uint32_t width = side(t->width, level), height = side(t->height, level);
        for (uint32_t y = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++)
                t->texels[t->level_start[level] + (size_t)y * width + x] = shrunk(t, linear, level, x, y);
    }
}

static void fill_linear(mgt_texture *t, size_t count)
{
    float linear[256];
    for (uint32_t i = 0; i < 256; i++)
        linear[i] = (float)to_linear(i);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++)
            t->linear[4 * i + (size_t)k] = k < 3 ? linear[t->texels[i] >> 8 * k & 255] : 0;
}

static mgt_status check_texture(const reporter *r, const mgt_texture_desc *d)
{
    if (d->width < 1 || d->width > 16384 || d->height < 1 || d->height > 16384)
        return report_error(r, MGT_ERROR_ARGUMENT, "texture.desc", "the texture is %u x %u pixels; allowed is 1 to 16384 a side", d->width, d->height);
    const size_t step = stride_length(d->row_stride);
    if (!d->pixels || (step != 0 && step < 4 * (size_t)d->width))
        return report_error(r, MGT_ERROR_ARGUMENT, "texture.desc", "pixels is NULL or row_stride %td shorter than a row of %u pixels", d->row_stride, d->width);
    if (step > PTRDIFF_MAX / d->height)
        return report_error(r, MGT_ERROR_ARGUMENT, "texture.desc", "row_stride %td: no memory holds %u such rows", d->row_stride, d->height);
    return MGT_OK;
}

mgt_status mgt_texture_create(mgt_texture **texture, const mgt_texture_desc *desc)
{
    const reporter r = creation_reporter();
    mgt_texture_desc own;
    if (!texture)
        return report_error(&r, MGT_ERROR_ARGUMENT, "texture.create", "mgt_texture_create: the pointer to fill is NULL");
    *texture = NULL;
    mgt_status status = struct_take(&r, &texture_desc_kind, &own, desc, 1);
    if (status == MGT_OK)
        status = check_texture(&r, &own);
    if (status != MGT_OK)
        return status;
    mgt_texture *t = calloc(1, sizeof *t);
    size_t count = 0;
    if (t) {
        t->id = next_id();
        t->width = own.width;
        t->height = own.height;
        do {
            t->level_start[t->levels] = (uint32_t)count;
            count += (size_t)side(t->width, t->levels) * side(t->height, t->levels);
            t->levels++;
        } while (t->width >> t->levels || t->height >> t->levels);
        t->texels = malloc(count * sizeof *t->texels);
        t->linear = count <= LINEAR_TEXELS ? malloc(count * 4 * sizeof *t->linear) : NULL;
    }
    if (!t || !t->texels || (count <= LINEAR_TEXELS && !t->linear)) {
        mgt_texture_destroy(t);
        return report_error(&r, MGT_ERROR_MEMORY, "texture.create", "out of memory for a texture of %u x %u pixels", own.width, own.height);
    }
    for (uint32_t y = 0; y < t->height; y++) {
        const uint8_t *row = own.pixels + (own.row_stride ? own.row_stride : 4 * (ptrdiff_t)t->width) * (ptrdiff_t)y;
        for (uint32_t x = 0; x < t->width; x++)
            t->texels[(size_t)y * t->width + x] = row[4 * x] | (uint32_t)row[4 * x + 1] << 8 | (uint32_t)row[4 * x + 2] << 16 | 255u << 24;
    }
    fill_levels(t);
    if (t->linear)
        fill_linear(t, count);
    *texture = t;
    return MGT_OK;
}

void mgt_texture_destroy(mgt_texture *texture)
{
    if (!texture)
        return;
    free(texture->texels);
    free(texture->linear);
    free(texture);
}
