/* SPDX-License-Identifier: MIT
 *
 * Built-in shapes, laid out so that texture coordinates are metres and patterns of neighbouring faces meet at their edges. Faces are grids whose lines
 * meet on shared edges to the bit, so that closed shapes have no cracks.
 */
#include <math.h>
#include <string.h>

#include "scene/model.h"
#include "sea/spectrum_math.h"

typedef struct point {
    double x, y, z;
} point;

/* A rectangle along the axes: a corner and its two neighbours, u and v; its front is where (u - corner) × (v - corner) points. */
typedef struct face {
    point corner, u, v;
    double s, t; /* texture coordinates of the corner; s grows towards u, t away from v, as pictures go down */
} face;

/* Where faces go: with no mesh they are only counted. `cell`: the longest side of a grid's fields. */
typedef struct face_sink {
    mesh_data *mesh;
    double cell;
    size_t vertices, triangles;
} face_sink;

static point minus(point a, point b) { return (point){a.x - b.x, a.y - b.y, a.z - b.z}; }

static double length_of(point p) { return sqrt(p.x * p.x + p.y * p.y + p.z * p.z); }

/* Symmetric and exact at the ends, so that an edge has the same points whichever way it is walked. */
static double between(double a, double b, size_t i, size_t n) { return i == 0 ? a : i == n ? b : (a * (double)(n - i) + b * (double)i) / (double)n; }

/* Of one coordinate, which changes along one side at most. */
static float place(double corner, double u, double v, size_t i, size_t columns, size_t j, size_t rows)
{
    return (float)(u != corner ? between(corner, u, i, columns) : between(corner, v, j, rows));
}

static size_t fields_along(const face_sink *sink, double length) { return length > sink->cell ? (size_t)ceil(length / sink->cell - 1e-9) : 1; }

static void add_face(face_sink *sink, face f)
{
    const point u = minus(f.u, f.corner), v = minus(f.v, f.corner);
    const double width = length_of(u), height = length_of(v), area = width * height;
    if (area == 0)
        return;
    const size_t columns = fields_along(sink, width), rows = fields_along(sink, height);
    const size_t vertex = sink->vertices, triangle = sink->triangles;
    sink->vertices += (columns + 1) * (rows + 1);
    sink->triangles += 2 * columns * rows;
    if (sink->mesh == NULL)
        return;
    const float normal[3] = {(float)((u.y * v.z - u.z * v.y) / area), (float)((u.z * v.x - u.x * v.z) / area), (float)((u.x * v.y - u.y * v.x) / area)};
    for (size_t j = 0; j <= rows; j++)
        for (size_t i = 0; i <= columns; i++) {
            const size_t at = vertex + j * (columns + 1) + i;
            float *p = sink->mesh->positions + 3 * at, *st = sink->mesh->texcoords + 2 * at;
            p[0] = place(f.corner.x, f.u.x, f.v.x, i, columns, j, rows);
            p[1] = place(f.corner.y, f.u.y, f.v.y, i, columns, j, rows);
            p[2] = place(f.corner.z, f.u.z, f.v.z, i, columns, j, rows);
            memcpy(sink->mesh->normals + 3 * at, normal, sizeof normal);
            st[0] = (float)between(f.s, f.s + width, i, columns);
            st[1] = (float)between(f.t, f.t - height, j, rows);
        }
    uint32_t *index = sink->mesh->indices + 3 * triangle;
    for (size_t j = 0; j < rows; j++)
        for (size_t i = 0; i < columns; i++, index += 6) {
            const uint32_t a = (uint32_t)(vertex + j * (columns + 1) + i), b = a + 1, d = a + (uint32_t)columns + 1, c = d + 1;
            memcpy(index, (const uint32_t[6]){a, b, c, a, c, d}, 6 * sizeof *index);
        }
}

/* Seen from above and from below. */
static face level_face(double x0, double x1, double y, double z0, double z1)
{
    return (face){.corner = {x0, y, z1}, .u = {x1, y, z1}, .v = {x0, y, z0}, .s = x0, .t = z1};
}

static face ceiling_face(double x0, double x1, double y, double z0, double z1)
{
    return (face){.corner = {x0, y, z0}, .u = {x1, y, z0}, .v = {x0, y, z1}, .s = x0, .t = -z0};
}

/* Upright, at z and seen from +z, from -z; at x and seen from +x, from -x. */
static face south_face(double x0, double x1, double y0, double y1, double z)
{
    return (face){.corner = {x0, y0, z}, .u = {x1, y0, z}, .v = {x0, y1, z}, .s = x0, .t = -y0};
}

static face north_face(double x0, double x1, double y0, double y1, double z)
{
    return (face){.corner = {x1, y0, z}, .u = {x0, y0, z}, .v = {x1, y1, z}, .s = -x1, .t = -y0};
}

static face east_face(double x, double y0, double y1, double z0, double z1)
{
    return (face){.corner = {x, y0, z1}, .u = {x, y0, z0}, .v = {x, y1, z1}, .s = -z1, .t = -y0};
}

static face west_face(double x, double y0, double y1, double z0, double z1)
{
    return (face){.corner = {x, y0, z0}, .u = {x, y0, z1}, .v = {x, y1, z0}, .s = z0, .t = -y0};
}

/* ---- shapes of faces ---------------------------------------------------------------------------------------- */

static void add_plane(face_sink *sink, const scene_object *o)
{
    const double x = o->size[0] / 2, z = o->size[2] / 2;
    add_face(sink, level_face(-x, x, 0, -z, z));
}

static void add_box(face_sink *sink, const scene_object *o)
{
    const double x = o->size[0] / 2, y = o->size[1] / 2, z = o->size[2] / 2;
    add_face(sink, level_face(-x, x, y, -z, z));
    add_face(sink, ceiling_face(-x, x, -y, -z, z));
    add_face(sink, south_face(-x, x, -y, y, z));
    add_face(sink, north_face(-x, x, -y, y, -z));
    add_face(sink, east_face(x, -y, y, -z, z));
    add_face(sink, west_face(-x, -y, y, -z, z));
}

/* A closed flight of steps that rises towards -z, on the plane y = 0. Sides, back and ground are cut along the steps. */
static void add_steps(face_sink *sink, const scene_object *o)
{
    const size_t count = o->count;
    const double x = o->size[0] / 2, near = o->size[2] / 2;
    for (size_t i = 0; i < count; i++) {
        const double z1 = between(near, -near, i, count), z0 = between(near, -near, i + 1, count);
        const double top = between(0, o->size[1], i + 1, count), below = between(0, o->size[1], i, count);
        add_face(sink, level_face(-x, x, top, z0, z1));
        add_face(sink, south_face(-x, x, below, top, z1));
        add_face(sink, ceiling_face(-x, x, 0, z0, z1));
        add_face(sink, north_face(-x, x, below, top, -near));
        for (size_t j = 0; j <= i; j++) {
            const double low = between(0, o->size[1], j, count), high = between(0, o->size[1], j + 1, count);
            add_face(sink, east_face(x, low, high, z0, z1));
            add_face(sink, west_face(-x, low, high, z0, z1));
        }
    }
}

/* Its origin is in the middle of the water, size[1] over the floor; the walls reach rim_height over it. Walls continue the floor's pattern upwards. */
static void add_pool(face_sink *sink, const scene_object *o)
{
    const double x = o->size[0] / 2, z = o->size[2] / 2, floor = -o->size[1], rim = o->rim_height, w = o->rim_width;
    add_face(sink, level_face(-x, x, floor, -z, z));
    face north = south_face(-x, x, floor, rim, -z), south = north_face(-x, x, floor, rim, z);
    face west = east_face(-x, floor, rim, -z, z), east = west_face(x, floor, rim, -z, z);
    north.t = south.t = -z;
    west.t = east.t = -x;
    add_face(sink, north);
    add_face(sink, south);
    add_face(sink, west);
    add_face(sink, east);
    if (w == 0)
        return;
    const double xs[4] = {-x - w, -x, x, x + w}, zs[4] = {-z - w, -z, z, z + w};
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            if (i != 1 || j != 1)
                add_face(sink, level_face(xs[i], xs[i + 1], rim, zs[j], zs[j + 1]));
}

/* ---- sphere --------------------------------------------------------------------------------------------------- */

enum { SPHERE_ROWS = 24 };

static size_t sphere_triangles(size_t rows) { return 4 * rows * (rows - 1); }

/* An ellipsoid of `rows` bands with poles at top and bottom and twice as many columns; the first column stands twice, for the texture's seam. */
static bool build_sphere(mesh_data *mesh, const scene_object *o)
{
    size_t rows = SPHERE_ROWS;
    if (o->triangles > 0)
        for (rows = 2; sphere_triangles(rows + 1) <= o->triangles;)
            rows++;
    const size_t columns = 2 * rows;
    if (!mesh_data_allocate(mesh, (columns + 1) * (rows + 1), sphere_triangles(rows)))
        return false;
    const double radius[3] = {o->size[0] / 2, o->size[1] / 2, o->size[2] / 2}, mean = (radius[0] + radius[1] + radius[2]) / 3;
    for (size_t j = 0; j <= rows; j++)
        for (size_t i = 0; i <= columns; i++) {
            const size_t at = j * (columns + 1) + i, turn = i % columns;
            const double polar = SPECTRUM_PI * (double)j / (double)rows, around = 2 * SPECTRUM_PI * (double)turn / (double)columns;
            const double ring = j == 0 || j == rows ? 0 : portable_sin(polar);
            const double d[3] = {ring * portable_sin(around), j == 0 ? 1 : j == rows ? -1 : portable_cos(polar), ring * portable_cos(around)};
            const double n[3] = {d[0] / radius[0], d[1] / radius[1], d[2] / radius[2]}, length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (int k = 0; k < 3; k++) {
                mesh->positions[3 * at + (size_t)k] = (float)(radius[k] * d[k]);
                mesh->normals[3 * at + (size_t)k] = (float)(n[k] / length);
            }
            mesh->texcoords[2 * at] = (float)(mean * 2 * SPECTRUM_PI * (double)i / (double)columns);
            mesh->texcoords[2 * at + 1] = (float)(mean * polar);
        }
    uint32_t *index = mesh->indices;
    for (size_t j = 0; j < rows; j++)
        for (size_t i = 0; i < columns; i++) {
            const uint32_t a = (uint32_t)(j * (columns + 1) + i), b = a + 1, d = a + (uint32_t)columns + 1, c = d + 1;
            const uint32_t corners[6] = {a, d, c, a, c, b};
            for (int k = j + 1 == rows ? 3 : 0; k < (j == 0 ? 3 : 6); k++)
                *index++ = corners[k];
        }
    return true;
}

/* ---- all ------------------------------------------------------------------------------------------------------ */

static face_sink add_all(const scene_object *object, mesh_data *mesh, double cell)
{
    face_sink sink = {.mesh = mesh, .cell = cell};
    switch (object->shape) {
    case SHAPE_PLANE:
        add_plane(&sink, object);
        break;
    case SHAPE_BOX:
        add_box(&sink, object);
        break;
    case SHAPE_STEPS:
        add_steps(&sink, object);
        break;
    case SHAPE_POOL:
        add_pool(&sink, object);
        break;
    case SHAPE_SPHERE:
    case SHAPE_FLOOR:
    case SHAPE_MESH:
        break;
    }
    return sink;
}

/* The smallest fields that keep to the object's number of triangles. */
static double cell_of_budget(const scene_object *o)
{
    double low = 0, high = 2 * (o->size[0] + o->size[1] + o->size[2] + o->rim_width + o->rim_height);
    if (o->triangles == 0)
        return high;
    low = high * 1e-5;
    for (int i = 0; i < 60; i++) {
        const double middle = sqrt(low * high);
        if (add_all(o, NULL, middle).triangles <= o->triangles)
            high = middle;
        else
            low = middle;
    }
    return high;
}

bool shape_build(mesh_data *mesh, const scene_object *object)
{
    if (object->shape == SHAPE_SPHERE)
        return build_sphere(mesh, object);
    const double cell = cell_of_budget(object);
    const face_sink count = add_all(object, NULL, cell);
    if (!mesh_data_allocate(mesh, count.vertices, count.triangles))
        return false;
    add_all(object, mesh, cell);
    return true;
}
