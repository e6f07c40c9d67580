/* SPDX-License-Identifier: MIT
 *
 * What OpenGL draws of objects against rays in double precision that a flat surface bends.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "cpu/raster_lanes.h"
#include "cpu/gbuffer.h"
#include "gl/gl_egl.h"
#include "gl/gl_renderer.h"
#include "unit/test_mesh.h"

enum { WIDTH = 160, HEIGHT = 90, CELLS = 8, VERTICES = 5 * (CELLS + 1) * (CELLS + 1), TRIANGLES = 5 * 2 * CELLS * CELLS };

static const double index_of_water = 1.333;

/* Floor and walls of a pool 8 m long and wide, from 2 m under the surface to 1.5 m over it. */
static mgt_mesh *pool_mesh(void)
{
    static float positions[3 * VERTICES];
    static uint32_t indices[3 * TRIANGLES];
    static const float corner[5][3] = {{-4, -2, -4}, {-4, -2, -4}, {4, -2, -4}, {-4, -2, -4}, {-4, -2, 4}};
    static const float across[5][3] = {{8, 0, 0}, {0, 0, 8}, {0, 0, 8}, {8, 0, 0}, {8, 0, 0}};
    static const float up[5][3] = {{0, 0, 8}, {0, 3.5f, 0}, {0, 3.5f, 0}, {0, 3.5f, 0}, {0, 3.5f, 0}};
    size_t vertex = 0, index = 0;
    for (int face = 0; face < 5; face++) {
        const uint32_t first = (uint32_t)vertex;
        for (int j = 0; j <= CELLS; j++)
            for (int i = 0; i <= CELLS; i++, vertex++)
                for (int k = 0; k < 3; k++)
                    positions[3 * vertex + (size_t)k] = corner[face][k] + across[face][k] * (float)i / CELLS + up[face][k] * (float)j / CELLS;
        for (int j = 0; j < CELLS; j++)
            for (int i = 0; i < CELLS; i++) {
                const uint32_t a = first + (uint32_t)(j * (CELLS + 1) + i), quad[6] = {a, a + 1, a + CELLS + 1, a + 1, a + CELLS + 2, a + CELLS + 1};
                for (int k = 0; k < 6; k++)
                    indices[index++] = quad[k];
            }
    }
    return test_mesh(positions, NULL, VERTICES, indices, TRIANGLES);
}

/* ---- rays ---- */

typedef struct hit {
    double along;
    int triangle;
} hit;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Distance along the ray to a triangle; infinite where it is missed or the ray's point has `side`·y below 0. */
static double meet(const world *w, size_t triangle, const double from[3], const double direction[3], double side)
{
    double e[2][3], p[3], q[3], s[3];
    const float *corner[3];
    for (int c = 0; c < 3; c++)
        corner[c] = w->positions + 3 * (size_t)w->indices[3 * triangle + (size_t)c];
    for (int k = 0; k < 3; k++) {
        const double a = (double)corner[0][k] + (k == 0 ? w->origin[0] : k == 2 ? w->origin[1] : 0);
        e[0][k] = (double)corner[1][k] - (double)corner[0][k];
        e[1][k] = (double)corner[2][k] - (double)corner[0][k];
        s[k] = from[k] - a;
    }
    cross(direction, e[1], p);
    cross(s, e[0], q);
    const double det = dot(e[0], p), u = dot(s, p) / det, v = dot(direction, q) / det, along = dot(e[1], q) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && along > 0) || (from[1] + along * direction[1]) * side < 0)
        return INFINITY;
    return along;
}

static hit nearest(const world *w, const double from[3], const double direction[3], double side)
{
    hit best = {INFINITY, -1};
    for (size_t t = 0; t < w->triangle_count; t++) {
        const double along = meet(w, t, from, direction, side);
        if (along < best.along)
            best = (hit){along, (int)t};
    }
    return best;
}

/* What the pixel shows on the far side of the flat surface: the triangle, and the depth of its sagittal image. */
static hit far_truth(const world *w, const camera_rays *c, const double ray[3])
{
    const double side = c->position[1] >= 0 ? 1 : -1, length = sqrt(dot(ray, ray)), n = side > 0 ? index_of_water : 1 / index_of_water;
    if (ray[1] * side >= 0)
        return (hit){INFINITY, -1};
    const double to_surface = -c->position[1] / ray[1], cosine = fabs(ray[1]) / length, sine2 = (1 - cosine * cosine) / (n * n);
    if (sine2 >= 1)
        return (hit){INFINITY, -1};
    const double from[3] = {c->position[0] + to_surface * ray[0], 0, c->position[2] + to_surface * ray[2]};
    const double bent[3] = {ray[0] / length / n, -side * sqrt(1 - sine2), ray[2] / length / n};
    hit h = nearest(w, from, bent, -side);
    if (h.triangle >= 0) /* the image stands over the point */
        h.along = to_surface + h.along * sqrt((bent[0] * bent[0] + bent[2] * bent[2]) / (ray[0] * ray[0] + ray[2] * ray[2]));
    return h;
}

/* ---- comparison ---- */

static mgt_camera camera_towards(double x, double y, double z, double target_y)
{
    mgt_scene defaults;
    mgt_scene_init(&defaults, sizeof defaults);
    mgt_camera camera = defaults.camera;
    const double position[3] = {x, y, z}, target[3] = {0.3, target_y, -0.2};
    for (int k = 0; k < 3; k++)
        camera.position[k] = position[k], camera.target[k] = target[k];
    return camera;
}

static void read_layer(const gl_renderer *g, const gl_gbuffer *layer, float *depth, int *triangle)
{
    const gl_gbuffers *b = &g->gbuffers;
    const GLsizei size = (GLsizei)(b->width * b->height * sizeof(float));
    g->gl.GetTextureSubImage(layer->depth.name, 0, 0, 0, 0, (GLsizei)b->width, (GLsizei)b->height, 1, GL_DEPTH_COMPONENT, GL_FLOAT, size, depth);
    g->gl.GetTextureSubImage(layer->triangle.name, 0, 0, 0, 0, (GLsizei)b->width, (GLsizei)b->height, 1, GL_RED_INTEGER, GL_INT, size, triangle);
    for (size_t i = 0; i < (size_t)b->width * b->height; i++)
        depth[i] = depth[i] > 0 ? b->least_depth / depth[i] : INFINITY;
}

static void compare(const gl_renderer *g, const camera_rays *c, const gbuffer *cpu, bool far)
{
    const gl_gbuffers *b = &g->gbuffers;
    float *depth = malloc((size_t)b->width * b->height * sizeof *depth);
    int *triangle = malloc((size_t)b->width * b->height * sizeof *triangle);
    assert_true(depth && triangle);
    assert_true(cpu->width == b->width && cpu->height == b->height && cpu->left == b->left && cpu->top == b->top);
    read_layer(g, far ? &b->refracted : &b->front, depth, triangle);
    const double side = c->position[1] >= 0 ? 1 : -1;
    size_t shown = 0, others = 0, cpu_others = 0, unlike_cpu = 0;
    double worst = 0, worst_to_cpu = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double ray[3];
            for (int k = 0; k < 3; k++)
                ray[k] = c->corner[k] + x * c->right[k] + y * c->down[k];
            const hit truth = far ? far_truth(g->objects.world, c, ray) : nearest(g->objects.world, c->position, ray, side);
            const size_t i = ((size_t)y + b->top) * b->width + b->left + (size_t)x;
            shown += truth.triangle >= 0;
            others += triangle[i] != truth.triangle;
            cpu_others += cpu->triangle[i] != truth.triangle;
            unlike_cpu += triangle[i] != cpu->triangle[i];
            if (triangle[i] == truth.triangle && truth.triangle >= 0)
                worst = fmax(worst, fabs((double)depth[i] - truth.along) / truth.along);
            if (triangle[i] == cpu->triangle[i] && triangle[i] >= 0)
                worst_to_cpu = fmax(worst_to_cpu, fabs((double)depth[i] - (double)cpu->depth[i]) / truth.along);
        }
    print_message("%s layer, camera at %g m: %zu of %d pixels show something, %zu another triangle (CPU %zu, between them %zu), depths within %.1e (%.1e)\n",
                  far ? "far" : "near", c->position[1], shown, WIDTH * HEIGHT, others, cpu_others, unlike_cpu, worst, worst_to_cpu);
    assert_true(shown > WIDTH * HEIGHT / 50);
    /* From below, images stretch without bounds at the waterline, which even parts of an edge follow less well. */
    const size_t most = 3 + (far && side < 0 ? shown / 20 : shown / 200);
    assert_true(others <= most && unlike_cpu <= most);
    assert_true(worst < 2e-3 && worst_to_cpu < 2e-3);
    free(depth);
    free(triangle);
}

static void layers_are_those_of_rays(void **state)
{
    (void)state;
    const reporter r = {.error = (char[REPORTER_TEXT]){0}};
    gl_egl *egl = NULL;
    gl_egl_scope scope;
    if (gl_egl_create(&egl, 0, &r) != MGT_OK)
        skip();
    assert_int_equal(gl_egl_enter(egl, &scope, &r), MGT_OK);
    gl_renderer *g = NULL;
    gbuffers cpu = {0};
    assert_int_equal(gl_renderer_create(&g, gl_egl_get_proc, &r), MGT_OK);
    mgt_object object = {.mesh = pool_mesh(), .transform = {{1, 0, 0, 100}, {0, 1, 0, 0}, {0, 0, 1, -50}}};
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.objects = &object;
    scene.object_count = 1;
    const mgt_camera cameras[] = {camera_towards(-3, 3, 5, -1), camera_towards(0.2, 8, 0.1, -2), camera_towards(-7, 0.9, 3, 0),
                                  camera_towards(1, -1.5, 2, 0.15)};
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++) {
        gbuffer_job job = {.camera = camera_rays_of(&cameras[i], WIDTH, HEIGHT),
                           .width = WIDTH,
                           .height = HEIGHT,
                           .index = index_of_water,
                           .map = MAP_SAGITTAL,
                           .error = 0.02};
        job.camera.position[0] += 100;
        job.camera.position[2] -= 50;
        mgt_status status = gl_objects_update(&g->gl, &g->objects, &scene, 1, g->limits.table_texels, &r);
        if (status == MGT_OK)
            status = gl_gbuffers_draw(g, &job, NULL, &r);
        if (status != MGT_OK)
            fail_msg("%s", r.error);
        if (status == MGT_OK)
            status = gbuffers_draw(&cpu, g->objects.world, &job, &raster_kernels_1, g->objects.pool);
        assert_int_equal(status, MGT_OK);
        compare(g, &job.camera, &cpu.front, false);
        compare(g, &job.camera, &cpu.refracted, true);
    }
    gbuffers_free(&cpu);
    gl_renderer_destroy(g);
    gl_egl_leave(egl, &scope);
    gl_egl_destroy(egl);
    mgt_mesh_destroy((mgt_mesh *)object.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(layers_are_those_of_rays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
