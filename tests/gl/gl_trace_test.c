/* SPDX-License-Identifier: MIT
 *
 * Rays that a shader traces: what they meet against all triangles in double precision, seams without leaks, triangles that lie on each other.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "gl/gl_egl.h"
#include "gl/gl_renderer.h"
#include "mangata/mangata.h"
#include "unit/test_mesh.h"

enum { SOUP = 2000, SIDE = 100, SHEET = 2 * SIDE * SIDE, RAYS = 8192, BIND_RAYS = 6, BIND_HITS = 7 };

typedef struct ray {
    float from[3], direction[3];
} ray;

typedef struct hit {
    int32_t triangle;
    float along;
} hit;

/* In place of the pass that hybrid traces with. */
static const char program_text[] = "#define OBJECTS_PASS\n"
                                   "#include \"gl_data.glsl\"\n"
                                   "#include \"objects_pixel.glsl\"\n"
                                   "#include \"bvh.glsl\"\n"
                                   "layout(local_size_x = 64) in;\n"
                                   "layout(std430, binding = 6) readonly buffer RayBlock { float ray_numbers[]; };\n"
                                   "layout(std430, binding = 7) writeonly buffer HitBlock { ivec2 hits[]; };\n"
                                   "void main()\n"
                                   "{\n"
                                   "    int i = int(gl_GlobalInvocationID.x), at = 6 * i;\n"
                                   "    TreeHit h = trace_nearest(vec3(ray_numbers[at], ray_numbers[at + 1], ray_numbers[at + 2]),\n"
                                   "                              vec3(ray_numbers[at + 3], ray_numbers[at + 4], ray_numbers[at + 5]));\n"
                                   "    hits[i] = ivec2(h.triangle, floatBitsToInt(h.along));\n"
                                   "}\n";

static float unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (float)(*state >> 40) / 16777216.0f;
}

/* ---- meshes ---- */

static mgt_mesh *soup(void)
{
    static float positions[9 * SOUP];
    static uint32_t indices[3 * SOUP];
    uint64_t state = 3;
    for (uint32_t i = 0; i < SOUP; i++) {
        float centre[3];
        for (int k = 0; k < 3; k++)
            centre[k] = 10 * unit(&state) - 5;
        for (uint32_t k = 0; k < 9; k++)
            positions[9 * i + k] = centre[k % 3] + 1.5f * (unit(&state) - 0.5f);
        for (uint32_t k = 0; k < 3; k++)
            indices[3 * i + k] = 3 * i + k;
    }
    return test_mesh(positions, NULL, 3 * SOUP, indices, SOUP);
}

/* Two triangles a cell of 0.1 m. */
static mgt_mesh *sheet(void)
{
    static float positions[3 * (SIDE + 1) * (SIDE + 1)];
    static uint32_t indices[3 * SHEET];
    for (uint32_t i = 0; i < (SIDE + 1) * (SIDE + 1); i++) {
        const float x = (float)(i % (SIDE + 1)), z = (float)(i / (SIDE + 1)), place[3] = {0.1f * x, 0.01f * sinf(x) * cosf(z), 0.1f * z};
        memcpy(positions + 3 * i, place, sizeof place);
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE, cell[6] = {a, a + SIDE + 1, a + 1, a + 1, a + SIDE + 1, a + SIDE + 2};
        memcpy(indices + 6 * i, cell, sizeof cell);
    }
    return test_mesh(positions, NULL, (SIDE + 1) * (SIDE + 1), indices, SHEET);
}

/* ---- the shader ---- */

typedef struct setup {
    gl_egl *egl;
    gl_egl_scope scope;
    gl_renderer *renderer;
    GLuint program;
    gl_buffer rays, hits;
    char error[REPORTER_TEXT];
} setup;

static int start(void **state)
{
    setup *s = calloc(1, sizeof *s);
    const reporter r = {.error = s->error};
    *state = s;
    if (gl_egl_create(&s->egl, 0, &r) != MGT_OK)
        return 0;
    mgt_status status = gl_egl_enter(s->egl, &s->scope, &r);
    if (status == MGT_OK)
        status = gl_renderer_create(&s->renderer, gl_egl_get_proc, &r);
    gl_programs programs = {0};
    const mgt_gl_source source = {"objects_traced.comp", program_text};
    if (status == MGT_OK) {
        programs = (gl_programs){.gl = &s->renderer->gl, .defines = s->renderer->programs.defines};
        assert_true(gl_replacements_copy(&programs.replaced, &source, 1));
        s->program = gl_program_get(&programs, PROGRAM_OBJECTS_TRACED, &r, &status);
        gl_replacements_free(&programs.replaced);
    }
    if (status == MGT_OK)
        status = gl_buffer_reserve(&s->renderer->gl, &s->rays, RAYS * sizeof(ray), GL_MAP_WRITE_BIT, &r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(&s->renderer->gl, &s->hits, RAYS * sizeof(hit), GL_MAP_READ_BIT, &r);
    if (status != MGT_OK)
        print_error("%s\n", s->error);
    return status != MGT_OK;
}

static int stop(void **state)
{
    setup *s = *state;
    if (s->egl) {
        s->renderer->gl.DeleteProgram(s->program);
        gl_buffer_free(&s->renderer->gl, &s->rays);
        gl_buffer_free(&s->renderer->gl, &s->hits);
        gl_renderer_destroy(s->renderer);
        gl_egl_leave(s->egl, &s->scope);
        gl_egl_destroy(s->egl);
    }
    free(s);
    return 0;
}

/* The world of `count` copies of a mesh in the same place. */
static const world *place(setup *s, const mgt_mesh *mesh, size_t count)
{
    static mgt_object objects[4];
    const reporter r = {.error = s->error};
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    for (size_t i = 0; i < count; i++)
        objects[i] = (mgt_object){.mesh = (mgt_mesh *)mesh, .transform = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    scene.objects = objects;
    scene.object_count = count;
    gl_renderer *g = s->renderer;
    mgt_status status = gl_objects_update(&g->gl, &g->objects, &scene, 2, g->limits.table_texels, &r);
    if (status == MGT_OK)
        status = gl_objects_update_tree(&g->gl, &g->objects, g->limits.table_texels, &r);
    if (status != MGT_OK)
        fail_msg("%s", s->error);
    return g->objects.world;
}

static void trace(setup *s, const ray *rays, hit *hits)
{
    const gl_api *gl = &s->renderer->gl;
    const gl_objects *o = &s->renderer->objects;
    const GLuint units[][2] = {{UNIT_VERTICES, o->vertices.texture}, {UNIT_INDICES, o->indices.texture}, {UNIT_TREE, o->tree.texture}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        gl->BindTextureUnit(units[i][0], units[i][1]);
    void *map = gl->MapNamedBufferRange(s->rays.name, 0, RAYS * sizeof *rays, GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    assert_non_null(map);
    memcpy(map, rays, RAYS * sizeof *rays);
    gl->UnmapNamedBuffer(s->rays.name);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_RAYS, s->rays.name);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_HITS, s->hits.name);
    gl->UseProgram(s->program);
    gl->DispatchCompute(RAYS / 64, 1, 1);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    map = gl->MapNamedBufferRange(s->hits.name, 0, RAYS * sizeof *hits, GL_MAP_READ_BIT);
    assert_non_null(map);
    memcpy(hits, map, RAYS * sizeof *hits);
    gl->UnmapNamedBuffer(s->hits.name);
    assert_int_equal(gl->GetError(), GL_NO_ERROR);
}

/* ---- what rays meet ---- */

typedef struct answer {
    double along;
    int32_t triangle;
    bool clear; /* neither an edge nor a second triangle is so near that rounding could decide */
} answer;

static void add_triangle(const world *w, size_t triangle, const ray *r, answer *a)
{
    double p[3][3], e[3], f[3], o[3], q[3], s[3], det = 0, u = 0, v = 0, along = 0;
    for (size_t c = 0; c < 3; c++)
        for (size_t k = 0; k < 3; k++)
            p[c][k] = (double)w->positions[3 * (size_t)w->indices[3 * triangle + c] + k];
    for (int k = 0; k < 3; k++)
        e[k] = p[1][k] - p[0][k], f[k] = p[2][k] - p[0][k], o[k] = (double)r->from[k] - p[0][k];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        q[k] = (double)r->direction[i] * f[j] - (double)r->direction[j] * f[i];
        s[k] = o[i] * e[j] - o[j] * e[i];
    }
    for (int k = 0; k < 3; k++)
        det += e[k] * q[k], u += o[k] * q[k], v += (double)r->direction[k] * s[k], along += f[k] * s[k];
    u /= det, v /= det, along /= det;
    const double margin = fmin(fmin(u, v), 1 - u - v);
    if (!(margin > -1e-4) || !(along > -1e-4))
        return;
    a->clear = a->clear && margin > 1e-4 && fabs(along) > 1e-4 && fabs(along - a->along) > 1e-4;
    if (along > 0 && along < a->along)
        a->along = along, a->triangle = (int32_t)triangle;
}

static void rays_meet_what_they_meet_among_all(void **state)
{
    setup *s = *state;
    if (!s->egl)
        skip();
    static ray rays[RAYS];
    static hit hits[RAYS];
    mgt_mesh *mesh = soup();
    const world *w = place(s, mesh, 1);
    uint64_t random = 5;
    for (int i = 0; i < RAYS; i++)
        for (int k = 0; k < 3; k++) {
            rays[i].from[k] = 14 * unit(&random) - 7;
            /* Some along the axes. */
            rays[i].direction[k] = i % 8 ? 2 * unit(&random) - 1 : k == i / 8 % 3 ? 1.0f : 0.0f;
        }
    trace(s, rays, hits);
    int clear = 0, met = 0;
    double worst = 0;
    for (int i = 0; i < RAYS; i++) {
        answer expected = {INFINITY, -1, true};
        for (size_t t = 0; t < w->triangle_count; t++)
            add_triangle(w, t, &rays[i], &expected);
        if (!expected.clear)
            continue;
        clear++;
        met += expected.triangle >= 0;
        assert_int_equal(hits[i].triangle, expected.triangle);
        if (expected.triangle >= 0)
            worst = fmax(worst, fabs((double)hits[i].along - expected.along) / fmax(1, expected.along));
    }
    print_message("  %d of %d rays are clear of edges, %d meet something; distances within %.1e\n", clear, RAYS, met, worst);
    assert_true(clear > RAYS * 9 / 10 && met > RAYS / 4 && worst < 1e-4);
    mgt_mesh_destroy(mesh);
}

/* From above the sheet at a vertex, or at a place of an edge; of triangles inside of it. */
static ray at_seam(const world *w, bool edge, uint64_t *random)
{
    for (;;) {
        const size_t triangle = (size_t)(unit(random) * SHEET), from = (size_t)(unit(random) * 3), to = (from + 1) % 3;
        const float share = edge ? 0.1f + 0.8f * unit(random) : 0;
        const float *a = w->positions + 3 * (size_t)w->indices[3 * triangle + from], *b = w->positions + 3 * (size_t)w->indices[3 * triangle + to];
        ray r = {.from = {10 * unit(random), 3, 10 * unit(random)}};
        bool inside = true;
        for (int k = 0; k < 3; k++) {
            const float target = a[k] + share * (b[k] - a[k]);
            r.from[k] += k == 1 ? 0 : w->low[k];
            r.direction[k] = target - r.from[k];
            inside = inside && (k == 1 || (target > w->low[k] + 0.01f && target < w->high[k] - 0.01f));
        }
        if (inside)
            return r;
    }
}

static void seams_do_not_leak(void **state)
{
    setup *s = *state;
    if (!s->egl)
        skip();
    static ray rays[RAYS];
    static hit hits[RAYS];
    mgt_mesh *mesh = sheet();
    const world *w = place(s, mesh, 1);
    uint64_t random = 11;
    int leaks[2] = {0};
    for (int edge = 0; edge < 2; edge++)
        for (int round = 0; round < 4; round++) {
            for (int i = 0; i < RAYS; i++)
                rays[i] = at_seam(w, edge, &random);
            trace(s, rays, hits);
            for (int i = 0; i < RAYS; i++)
                leaks[edge] += hits[i].triangle < 0;
        }
    print_message("  leaks of %d rays at edges: %d, at vertices: %d\n", 4 * RAYS, leaks[1], leaks[0]);
    assert_int_equal(leaks[0] + leaks[1], 0);
    mgt_mesh_destroy(mesh);
}

static void the_first_of_equals_counts(void **state)
{
    setup *s = *state;
    if (!s->egl)
        skip();
    static ray rays[RAYS];
    static hit hits[RAYS], alone[RAYS];
    mgt_mesh *mesh = sheet();
    const world *w = place(s, mesh, 1);
    uint64_t random = 13;
    for (int i = 0; i < RAYS; i++)
        rays[i] = at_seam(w, true, &random);
    trace(s, rays, alone);
    place(s, mesh, 3);
    trace(s, rays, hits);
    assert_memory_equal(hits, alone, sizeof hits);
    mgt_mesh_destroy(mesh);
}

/* Of no triangle, and of one. */
static void trees_may_be_empty(void **state)
{
    setup *s = *state;
    if (!s->egl)
        skip();
    static const float corners[] = {-1, -1, -1, 1, -1, -1, 0, -1, 1};
    static const uint32_t indices[] = {0, 1, 2};
    static ray rays[RAYS];
    static hit hits[RAYS];
    mgt_mesh *mesh = test_mesh(corners, NULL, 3, indices, 1);
    for (size_t count = 0; count < 2; count++) {
        const world *w = place(s, mesh, count);
        for (int i = 0; i < RAYS; i++)
            rays[i] = (ray){{0, i % 2 ? 1.0f : -3.0f, count ? w->low[2] + 1 : 0}, {0, -1, 0}};
        trace(s, rays, hits);
        for (int i = 0; i < RAYS; i++)
            assert_int_equal(hits[i].triangle, count == 1 && i % 2 ? 0 : -1);
    }
    mgt_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_what_they_meet_among_all),
        cmocka_unit_test(seams_do_not_leak),
        cmocka_unit_test(the_first_of_equals_counts),
        cmocka_unit_test(trees_may_be_empty),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
