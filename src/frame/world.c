/* SPDX-License-Identifier: MIT
 * All objects of a scene as one indexed list of triangles, kept between frames. */
#include "frame/world.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "frame/dry.h"
#include "frame/mesh.h"

/* What the geometry of an object depends on. */
typedef struct object_key {
    uint64_t mesh;
    double transform[3][4];
} object_key;

/* A world and what it was made from. */
typedef struct kept_world {
    world world; /* first: callers hold its address */
    double level;
    object_key *keys;
} kept_world;

static atomic_uint_fast64_t last_version;

static kept_world *kept(world *w) { return (kept_world *)w; }

void world_free(world *w)
{
    if (!w)
        return;
    free(w->positions);
    free(w->normals);
    free(w->texcoords);
    free(w->indices);
    free(w->neighbours);
    free(w->object);
    free(w->dry);
    free(w->objects);
    free(kept(w)->keys);
    free(w);
}

size_t world_size(const world *w)
{
    return w ? w->vertex_count * 8 * sizeof(float) + w->triangle_count * (w->dry ? 9 : 7) * sizeof(uint32_t) +
                   w->object_count * (sizeof *w->objects + sizeof(object_key)) + sizeof(kept_world)
             : 0;
}

static object_key key_of(const mgt_object *object)
{
    object_key key = {.mesh = object->mesh->id};
    memcpy(key.transform, object->transform, sizeof key.transform);
    return key;
}

static bool is_unchanged(world *w, const mgt_scene *scene)
{
    if (!w || w->object_count != scene->object_count || kept(w)->level != scene->water.level)
        return false;
    for (size_t i = 0; i < scene->object_count; i++) {
        const object_key key = key_of(&scene->objects[i]);
        if (memcmp(&key, &kept(w)->keys[i], sizeof key) != 0)
            return false;
    }
    return true;
}

static void read_materials(world *w, const mgt_scene *scene)
{
    for (size_t i = 0; i < scene->object_count; i++) {
        w->objects[i].material = scene->objects[i].material;
        w->objects[i].smooth = scene->objects[i].mesh->normals != NULL;
    }
}

static void transform_point(const double m[3][4], const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3];
}

/* Places the origin at whole metres in the middle of all objects, so that positions in single precision are precise however far away the objects are. */
static void choose_origin(world *w, const mgt_scene *scene)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < scene->object_count; i++) {
        const mgt_object *object = &scene->objects[i];
        for (int corner = 0; corner < 8; corner++) {
            double p[3], at[3];
            for (int k = 0; k < 3; k++)
                p[k] = (double)(corner >> k & 1 ? object->mesh->high[k] : object->mesh->low[k]);
            transform_point(object->transform, p, at);
            for (int k = 0; k < 2; k++) {
                low[k] = fmin(low[k], at[2 * k]);
                high[k] = fmax(high[k], at[2 * k]);
            }
        }
    }
    for (int k = 0; k < 2; k++)
        w->origin[k] = scene->object_count ? rint(0.5 * (low[k] + high[k])) : 0;
}

/* ---- filling ---- */

typedef struct fill_job {
    world *world;
    const mgt_scene *scene;
    size_t *first_vertex; /* of each object */
} fill_job;

/* The matrix for normals: the transposed inverse times the determinant's absolute value. Returns whether the transform mirrors. */
static bool cofactors(const double m[3][4], double out[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            out[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    const bool mirrors = m[0][0] * out[0][0] + m[0][1] * out[0][1] + m[0][2] * out[0][2] < 0;
    for (int i = 0; i < 9 && mirrors; i++)
        out[i / 3][i % 3] = -out[i / 3][i % 3];
    return mirrors;
}

static void fill_normals(const mgt_mesh *mesh, const double matrix[3][3], float *normals)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *from = mesh->normals + 3 * i;
        double n[3];
        for (int k = 0; k < 3; k++)
            n[k] = matrix[k][0] * (double)from[0] + matrix[k][1] * (double)from[1] + matrix[k][2] * (double)from[2];
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++)
            normals[3 * i + (size_t)k] = length > 0 ? (float)(n[k] / length) : k == 1 ? 1.0f : 0.0f;
    }
}

/* Whether an object is closed and the mean surface cuts it. The vector areas of a closed mesh sum up to zero. */
static bool is_cut(const world *w, const world_object *o)
{
    double sum[3] = {0, 0, 0}, area = 0;
    float low = INFINITY, high = -INFINITY;
    for (size_t i = o->first_triangle; i < (size_t)o->first_triangle + o->triangle_count; i++) {
        const float *p[3];
        double e[2][3];
        for (int c = 0; c < 3; c++) {
            p[c] = w->positions + 3 * (size_t)w->indices[3 * i + (size_t)c];
            low = fminf(low, p[c][1]), high = fmaxf(high, p[c][1]);
        }
        for (int k = 0; k < 3; k++)
            e[0][k] = (double)p[1][k] - (double)p[0][k], e[1][k] = (double)p[2][k] - (double)p[0][k];
        const double a[3] = {e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2], e[0][0] * e[1][1] - e[0][1] * e[1][0]};
        for (int k = 0; k < 3; k++)
            sum[k] += a[k];
        area += sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    }
    return low < 0 && high > 0 && sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) < 1e-3 * area;
}

/* Copies a triangle's neighbours. A mirrored triangle has its corners in reverse order, so its edges are reversed, too. */
static void fill_neighbours(const mgt_mesh *mesh, size_t triangle, uint32_t first, bool mirrors, int32_t to[3])
{
    const int32_t *from = mesh->neighbours + 3 * triangle;
    for (int e = 0; e < 3; e++) {
        const int32_t across = from[mirrors ? 2 - e : e];
        to[e] = across < 0 ? -1 : (int32_t)first + across;
    }
}

static void find_object_bounds(const world *w, world_object *o)
{
    for (int k = 0; k < 3; k++)
        o->low[k] = INFINITY, o->high[k] = -INFINITY;
    for (size_t i = 3 * (size_t)o->first_triangle; i < 3 * ((size_t)o->first_triangle + o->triangle_count); i++)
        for (int k = 0; k < 3; k++) {
            const float x = w->positions[3 * (size_t)w->indices[i] + (size_t)k];
            o->low[k] = x < o->low[k] ? x : o->low[k];
            o->high[k] = x > o->high[k] ? x : o->high[k];
        }
}

static void fill_object(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const fill_job *job = argument;
    world *w = job->world;
    const mgt_object *object = &job->scene->objects[index];
    const mgt_mesh *mesh = object->mesh;
    const size_t first = job->first_vertex[index];
    double matrix[3][3];
    const bool mirrors = cofactors(object->transform, matrix);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const double p[3] = {(double)mesh->positions[3 * i], (double)mesh->positions[3 * i + 1], (double)mesh->positions[3 * i + 2]};
        double at[3];
        transform_point(object->transform, p, at);
        float *to = w->positions + 3 * (first + i);
        to[0] = (float)(at[0] - w->origin[0]);
        to[1] = (float)(at[1] - job->scene->water.level);
        to[2] = (float)(at[2] - w->origin[1]);
    }
    if (mesh->normals)
        fill_normals(mesh, matrix, w->normals + 3 * first);
    else
        memset(w->normals + 3 * first, 0, (size_t)mesh->vertex_count * 3 * sizeof *w->normals);
    if (mesh->texcoords)
        memcpy(w->texcoords + 2 * first, mesh->texcoords, (size_t)mesh->vertex_count * 2 * sizeof *w->texcoords);
    else
        memset(w->texcoords + 2 * first, 0, (size_t)mesh->vertex_count * 2 * sizeof *w->texcoords);
    world_object *o = &w->objects[index];
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *from = mesh->indices + 3 * i;
        uint32_t *to = w->indices + 3 * (o->first_triangle + i);
        to[0] = (uint32_t)first + from[0];
        to[1] = (uint32_t)first + from[mirrors ? 2 : 1];
        to[2] = (uint32_t)first + from[mirrors ? 1 : 2];
        fill_neighbours(mesh, i, o->first_triangle, mirrors, w->neighbours + 3 * (o->first_triangle + i));
        w->object[o->first_triangle + i] = (uint32_t)index;
    }
    find_object_bounds(w, o);
    o->cut = is_cut(w, o);
    o->dry = mesh->dry;
}

static void find_bounds(world *w)
{
    for (int k = 0; k < 3; k++) {
        w->low[k] = INFINITY, w->high[k] = -INFINITY;
        for (size_t i = 0; i < w->object_count; i++) {
            w->low[k] = fminf(w->low[k], w->objects[i].low[k]);
            w->high[k] = fmaxf(w->high[k], w->objects[i].high[k]);
        }
    }
}

static bool allocate(world *w, size_t objects, size_t vertices, size_t triangles)
{
    w->positions = malloc((vertices * 3 + 1) * sizeof *w->positions);
    w->normals = malloc((vertices * 3 + 1) * sizeof *w->normals);
    w->texcoords = malloc((vertices * 2 + 1) * sizeof *w->texcoords);
    w->indices = malloc((triangles * 3 + 1) * sizeof *w->indices);
    w->neighbours = malloc((triangles * 3 + 1) * sizeof *w->neighbours);
    w->object = malloc((triangles + 1) * sizeof *w->object);
    w->objects = calloc(objects + 1, sizeof *w->objects);
    kept(w)->keys = calloc(objects + 1, sizeof *kept(w)->keys);
    return w->positions && w->normals && w->texcoords && w->indices && w->neighbours && w->object && w->objects && kept(w)->keys;
}

static mgt_status build(world **out, const mgt_scene *scene, thread_pool *pool)
{
    kept_world *k = calloc(1, sizeof *k);
    size_t *first_vertex = malloc((scene->object_count + 1) * sizeof *first_vertex);
    size_t vertices = 0, triangles = 0;
    *out = NULL;
    if (!k || !first_vertex)
        goto fail;
    for (size_t i = 0; i < scene->object_count; i++) {
        first_vertex[i] = vertices;
        vertices += scene->objects[i].mesh->vertex_count;
        triangles += scene->objects[i].mesh->triangle_count;
    }
    /* Vertices are counted in 32 bits. */
    if (vertices > UINT32_MAX || triangles > MGT_MAX_TRIANGLES || !allocate(&k->world, scene->object_count, vertices, triangles))
        goto fail;
    world *w = &k->world;
    w->version = atomic_fetch_add(&last_version, 1) + 1;
    w->vertex_count = vertices;
    w->triangle_count = triangles;
    w->object_count = scene->object_count;
    k->level = scene->water.level;
    choose_origin(w, scene);
    uint32_t first = 0;
    for (size_t i = 0; i < scene->object_count; i++) {
        k->keys[i] = key_of(&scene->objects[i]);
        w->objects[i].first_triangle = first;
        w->objects[i].triangle_count = scene->objects[i].mesh->triangle_count;
        first += scene->objects[i].mesh->triangle_count;
    }
    w->positions[3 * vertices] = 0;
    fill_job job = {w, scene, first_vertex};
    const thread_loop loop = {scene->object_count, fill_object, &job, NULL};
    thread_pool_run(pool, &loop);
    find_bounds(w);
    if (!dry_levels(w, pool))
        goto fail;
    free(first_vertex);
    *out = w;
    return MGT_OK;
fail:
    free(first_vertex);
    world_free(k ? &k->world : NULL);
    return MGT_ERROR_MEMORY;
}

mgt_status world_update(world **w, const mgt_scene *scene, thread_pool *pool)
{
    if (!is_unchanged(*w, scene)) {
        world_free(*w);
        const mgt_status status = build(w, scene, pool);
        if (status != MGT_OK)
            return status;
    }
    read_materials(*w, scene);
    return MGT_OK;
}
