/* SPDX-License-Identifier: MIT
 *
 * Floors: a grid of heights from a grey picture.
 */
#include <math.h>
#include <string.h>

#include "image/picture.h"
#include "scene/model.h"

static bool refuse(model_fault *fault, const char *path, const char *what)
{
    return model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: %s; allowed: a grey PNG or PFM of at least 2 x 2 pixels", scene_file_name(path).text, what);
}

static bool read_heights(float_image *heights, const char *path, model_fault *fault)
{
    file_error error;
    const file_status status = picture_read(heights, path, NULL, &error);
    if (status == FILE_MEMORY)
        return model_fault_memory(fault);
    if (status != FILE_OK) {
        model_fault_set(fault, status == FILE_MISSING ? SCENE_ERROR_MISSING_INPUT : SCENE_ERROR_BAD_SCENE, "%s; allowed: a grey PNG or a PFM", error.text);
        return false;
    }
    if (heights->channels != 1)
        return refuse(fault, path, "has colours or an alpha channel");
    if (heights->width < 2 || heights->height < 2)
        return refuse(fault, path, "is too small");
    for (size_t i = 0; i < (size_t)heights->width * heights->height; i++)
        if (!(fabsf(heights->pixels[i]) <= 1e5f))
            return refuse(fault, path, "holds a height that is not finite or beyond 1e5");
    return true;
}

/* Fields along a side of `pixels`, when only the share `scale` of them is wanted. */
static size_t fields_along(uint32_t pixels, double scale)
{
    const double fields = floor((pixels - 1) * scale);
    return fields < 1 ? 1 : (size_t)fields;
}

/* Bilinear, at a place in [0, 1] of each side, the outer pixels' centres being its ends. */
static double height_at(const float_image *heights, double x, double y)
{
    const double u = x * (heights->width - 1), v = y * (heights->height - 1);
    const uint32_t i = (uint32_t)fmin(u, heights->width - 2), j = (uint32_t)fmin(v, heights->height - 2);
    const float *row = heights->pixels + (size_t)j * heights->width + i, *below = row + heights->width;
    const double s = u - i, t = v - j;
    return (1 - t) * ((1 - s) * (double)row[0] + s * (double)row[1]) + t * ((1 - s) * (double)below[0] + s * (double)below[1]);
}

static void fill(mesh_data *mesh, const scene_object *o, const float_image *heights, size_t columns, size_t rows)
{
    for (size_t j = 0; j <= rows; j++)
        for (size_t i = 0; i <= columns; i++) {
            const size_t at = j * (columns + 1) + i;
            const double s = (double)i / (double)columns, t = (double)j / (double)rows;
            const double x = (s - 0.5) * o->size[0], z = (t - 0.5) * o->size[2];
            mesh->positions[3 * at] = mesh->texcoords[2 * at] = (float)x;
            mesh->positions[3 * at + 1] = (float)(o->lowest + (o->highest - o->lowest) * height_at(heights, s, t));
            mesh->positions[3 * at + 2] = mesh->texcoords[2 * at + 1] = (float)z;
        }
    uint32_t *index = mesh->indices;
    for (size_t j = 0; j < rows; j++)
        for (size_t i = 0; i < columns; i++, index += 6) {
            const uint32_t a = (uint32_t)(j * (columns + 1) + i), b = a + 1, d = a + (uint32_t)columns + 1, c = d + 1;
            memcpy(index, (const uint32_t[6]){a, d, c, a, c, b}, 6 * sizeof *index);
        }
}

bool floor_build(mesh_data *mesh, const scene_object *object, const char *path, uint64_t *hash, model_fault *fault)
{
    float_image heights = {0};
    bool good = read_heights(&heights, path, fault);
    if (good) {
        const double most = object->triangles > 0 ? object->triangles : SCENE_SHAPE_TRIANGLES;
        const double scale = fmin(1, sqrt(most / (2.0 * (heights.width - 1) * (heights.height - 1))));
        const size_t columns = fields_along(heights.width, scale), rows = fields_along(heights.height, scale);
        *hash = model_hash(heights.width, heights.pixels, (size_t)heights.width * heights.height * sizeof *heights.pixels);
        good = mesh_data_allocate(mesh, (columns + 1) * (rows + 1), 2 * columns * rows);
        if (good)
            fill(mesh, object, &heights, columns, rows);
        good = (good && mesh_data_smooth(mesh)) || model_fault_memory(fault);
    }
    float_image_free(&heights);
    if (!good)
        mesh_data_free(mesh);
    return good;
}
