/* SPDX-License-Identifier: MIT
 * The rasteriser: shared edges, depths, against points in triangles in double precision; both layers at the waterline; the same bits however drawn. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/gbuffer.h"
#include "cpu/raster.h"
#include "unit/random_numbers.h"
#include "unit/test_mesh.h"

enum { SIDE = 9, GRID = SIDE * SIDE }; /* vertices of a net of triangles */

static int widths(const raster_kernels **kernels)
{
    int count = 0;
    kernels[count++] = &raster_kernels_1;
    kernels[count++] = &raster_kernels_4;
#if defined(__x86_64__)
    if (mgt_isa_available(MGT_ISA_AVX2))
        kernels[count++] = &raster_kernels_8;
    if (mgt_isa_available(MGT_ISA_AVX512))
        kernels[count++] = &raster_kernels_16;
#endif
    return count;
}

/* ---- shared edges ---- */

/* A net over the tile and beyond it, its inner vertices shaken; some exactly on pixel centres, some in a row. */
static void shake_net(float net[GRID][3], random_state *numbers, double amount)
{
    for (int i = 0; i < GRID; i++) {
        const int x = i % SIDE, y = i / SIDE;
        const bool border = x == 0 || y == 0 || x == SIDE - 1 || y == SIDE - 1;
        const double depth = 1 + 3 * random_unit(numbers);
        double px = -40 + 10 * x, py = -40 + 10 * y;
        if (!border) {
            px += amount * (random_unit(numbers) - 0.5);
            py += amount * (random_unit(numbers) - 0.5);
            if (random_unit(numbers) < 0.3)
                px = rint(px), py = rint(py);
        }
        net[i][0] = (float)(px * depth), net[i][1] = (float)(py * depth), net[i][2] = (float)depth;
    }
}

static const PictureData open_picture = {.left = -1000, .right = 1000, .top = -1000, .bottom = 1000, .least_depth = 1e-3f};

static bool set_up_one(const raster_kernels *kernels, const float a[3], const float b[3], const float c[3], raster_triangle *t)
{
    static patch_batch batch;
    static setup_batch out;
    const float *corner[3] = {a, b, c};
    batch.count = 1;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            batch.image[i][k][0] = corner[i][k];
    kernels->setups(&open_picture, &batch, &out);
    *t = (raster_triangle){.inverse_depth = out.inverse_depth[0],
                           .slope_x = out.slope_x[0],
                           .slope_y = out.slope_y[0],
                           .least = out.least[0],
                           .most = out.most[0],
                           .triangle = 7};
    for (int k = 0; k < 3; k++)
        t->x[k] = (int32_t)out.x[k][0], t->y[k] = (int32_t)out.y[k][0];
    return out.state[0] > 0;
}

/* Adds what one triangle covers of a tile. */
static void count_cover(const raster_kernels *kernels, const raster_triangle *t, raster_tile *tile, int cover[RASTER_TILE * RASTER_TILE])
{
    static float depth[RASTER_TILE];
    static int32_t triangle[RASTER_TILE];
    const uint32_t first = 0;
    kernels->tile_clear(tile);
    kernels->tile_draw(tile, t, &first, 1);
    for (int y = 0; y < tile->height; y++) {
        kernels->tile_row(tile, y, depth, triangle);
        for (int x = 0; x < tile->width; x++) {
            cover[y * RASTER_TILE + x] += triangle[x] == 7;
            assert_true((triangle[x] == 7) == isfinite(depth[x]));
        }
    }
}

static void test_shared_edges(void **state)
{
    (void)state;
    const raster_kernels *kernels[4];
    const int count = widths(kernels);
    static raster_tile tile;
    static float net[GRID][3];
    static int cover[RASTER_TILE * RASTER_TILE];
    random_state seed = {5};
    for (int round = 0; round < 40; round++) {
        shake_net(net, &seed, round % 4 == 3 ? 30 : 4); /* folded now and then: then every pixel is covered an odd number of times */
        for (int k = 0; k < count; k++) {
            memset(cover, 0, sizeof cover);
            tile.x = -32, tile.y = -32, tile.width = RASTER_TILE, tile.height = RASTER_TILE;
            for (int y = 0; y + 1 < SIDE; y++)
                for (int x = 0; x + 1 < SIDE; x++) {
                    const int i = y * SIDE + x;
                    raster_triangle t;
                    if (set_up_one(kernels[k], net[i], net[i + 1], net[i + SIDE], &t))
                        count_cover(kernels[k], &t, &tile, cover);
                    if (set_up_one(kernels[k], net[i + 1], net[i + SIDE + 1], net[i + SIDE], &t))
                        count_cover(kernels[k], &t, &tile, cover);
                }
            for (int i = 0; i < RASTER_TILE * RASTER_TILE; i++)
                if (round % 4 == 3 ? cover[i] % 2 != 1 : cover[i] != 1)
                    fail_msg("round %d, kernels %d: pixel (%d, %d) is covered %d times", round, k, i % RASTER_TILE, i / RASTER_TILE, cover[i]);
        }
    }
}

/* ---- scenes ---- */

typedef struct quad_scene {
    mgt_mesh *mesh;
    mgt_object object;
    mgt_scene scene;
} quad_scene;

/* Triangles seen from a camera in a picture of 320 × 180. */
static void make_scene(quad_scene *s, const float *positions, uint32_t vertices, const uint32_t *indices, uint32_t triangles, const double position[3],
                       const double target[3])
{
    s->mesh = test_mesh(positions, NULL, vertices, indices, triangles);
    s->object = (mgt_object){.mesh = s->mesh, .transform = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    mgt_scene_init(&s->scene, sizeof s->scene);
    s->scene.image = (mgt_image){.width = 320, .height = 180};
    memcpy(s->scene.camera.position, position, sizeof s->scene.camera.position);
    memcpy(s->scene.camera.target, target, sizeof s->scene.camera.target);
    s->scene.objects = &s->object;
    s->scene.object_count = 1;
}

static gbuffer_job job_of(const mgt_scene *scene, int map)
{
    return (gbuffer_job){.camera = camera_rays_of(&scene->camera, scene->image.width, scene->image.height),
                         .width = scene->image.width,
                         .height = scene->image.height,
                         .index = 1.333,
                         .map = map};
}

static size_t pixels_of(const gbuffers *g) { return (size_t)g->front.width * g->front.height; }

/* A wall through the waterline that fills the view: every pixel belongs to one layer. */
static void test_waterline(void **state)
{
    (void)state;
    static const double cameras[][2][3] = {
        {{0, 2, 3}, {0, -0.5, -3}},  {{1, 0.3, 3}, {0, 0, -3}},  {{0, -8, 0}, {0, 0.5, -3}},
        {{1, -6, -0.5}, {0, 0, -3}}, {{0, 1e-6, 3}, {0, 0, -3}}, {{0, 0, 3}, {0, 0, -3}},
    };
    const float wall[] = {-60, -90, -3, 60, -70, -3.2f, 60, 80, -3, -60, 90, -3};
    const float narrow[] = {-5, -90, -3, 5, -70, -3.2f, 5, 80, -3, -5, 90, -3}; /* meets the surface within Snell's window */
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    const raster_kernels *kernels[4];
    const int count = widths(kernels);
    thread_pool *pool = thread_pool_create(2);
    for (size_t c = 0; c < sizeof cameras / sizeof *cameras; c++)
        for (int k = 0; k < count; k++) {
            quad_scene s;
            world *w = NULL;
            gbuffers g = {0};
            make_scene(&s, cameras[c][0][1] < 0 ? narrow : wall, 4, indices, 2, cameras[c][0], cameras[c][1]);
            if (cameras[c][0][1] < 0)
                s.scene.camera.fov_y_deg = 12;
            const gbuffer_job job = job_of(&s.scene, MAP_SAGITTAL);
            assert_int_equal(world_update(&w, &s.scene, pool), MGT_OK);
            assert_int_equal(gbuffers_draw(&g, w, &job, kernels[k], pool), MGT_OK);
            size_t none = 0, both = 0, near = 0;
            for (size_t i = 0; i < pixels_of(&g); i++) {
                near += g.front.triangle[i] >= 0;
                none += g.front.triangle[i] < 0 && g.refracted.triangle[i] < 0;
                both += g.front.triangle[i] >= 0 && g.refracted.triangle[i] >= 0;
            }
            if (none + both > 0 || near == 0 || near == pixels_of(&g))
                fail_msg("camera %zu, kernels %d: %zu pixels without wall, %zu with two, %zu near", c, k, none, both, near);
            gbuffers_free(&g);
            world_free(w);
            mgt_mesh_destroy(s.mesh);
        }
    thread_pool_destroy(pool);
}

/* ---- against double precision ---- */

enum { SOUP = 60 };

static void random_soup(float positions[SOUP * 9], uint32_t indices[SOUP * 3], random_state *numbers)
{
    for (uint32_t i = 0; i < SOUP; i++) {
        const double at[3] = {8 * random_unit(numbers) - 4, -3 * random_unit(numbers) - 2, -1 - 8 * random_unit(numbers)};
        const double size = random_unit(numbers) < 0.2 ? 12 : 2;
        for (uint32_t k = 0; k < 9; k++)
            positions[9 * i + k] = (float)fmin(at[k % 3] + size * (random_unit(numbers) - 0.5), k % 3 == 1 ? -0.01 : 1e9);
        for (uint32_t k = 0; k < 3; k++)
            indices[3 * i + k] = 3 * i + k;
    }
}

/* Depth along the view where the ray meets the triangle; INFINITY where it does not, NAN so near an edge that rounding may decide. */
static double ray_triangle(const double from[3], const double ray[3], const float *p)
{
    double e1[3], e2[3], t[3], q[3], r[3];
    for (int k = 0; k < 3; k++)
        e1[k] = (double)p[3 + k] - (double)p[k], e2[k] = (double)p[6 + k] - (double)p[k], t[k] = from[k] - (double)p[k];
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        q[k] = ray[a] * e2[b] - ray[b] * e2[a];
        r[k] = t[a] * e1[b] - t[b] * e1[a];
    }
    const double det = e1[0] * q[0] + e1[1] * q[1] + e1[2] * q[2];
    const double u = (t[0] * q[0] + t[1] * q[1] + t[2] * q[2]) / det, v = (ray[0] * r[0] + ray[1] * r[1] + ray[2] * r[2]) / det;
    const double along = (e2[0] * r[0] + e2[1] * r[1] + e2[2] * r[2]) / det;
    if (!(along > 2e-3))
        return INFINITY;
    return u >= 0 && v >= 0 && u + v <= 1 ? along : INFINITY;
}

static double nearest_depth(const camera_rays *c, const float *positions, double x, double y, int *triangle)
{
    double ray[3], best = INFINITY;
    for (int k = 0; k < 3; k++)
        ray[k] = c->corner[k] + x * c->right[k] + y * c->down[k];
    *triangle = -1;
    for (int i = 0; i < SOUP; i++) {
        const double along = ray_triangle(c->position, ray, positions + 9 * i);
        if (along < best)
            best = along, *triangle = i;
    }
    return best;
}

/* Whether a triangle is in front within a hundredth of a pixel. */
static bool is_near(const camera_rays *c, const float *positions, double x, double y, int wanted, double depth)
{
    for (int i = 0; i < 16; i++) {
        int triangle;
        const double reach = 0.01 * (1 + i / 8), angle = 0.785398 * i;
        const double other = nearest_depth(c, positions, x + reach * cos(angle), y + reach * sin(angle), &triangle);
        if (triangle == wanted || fabs(other - depth) < 1e-4 * depth) /* or two cross there */
            return true;
    }
    return false;
}

static void test_against_rays(void **state)
{
    (void)state;
    const double position[3] = {0.3, 1.5, 3}, target[3] = {0, -2.5, -3};
    static float positions[SOUP * 9];
    static uint32_t indices[SOUP * 3];
    random_state seed = {11};
    thread_pool *pool = thread_pool_create(2);
    size_t differ = 0, covered = 0;
    double worst = 0;
    for (int round = 0; round < 4; round++) {
        quad_scene s;
        world *w = NULL;
        gbuffers g = {0};
        random_soup(positions, indices, &seed);
        make_scene(&s, positions, SOUP * 3, indices, SOUP, position, target);
        const gbuffer_job job = job_of(&s.scene, MAP_STRAIGHT);
        assert_int_equal(world_update(&w, &s.scene, pool), MGT_OK);
        assert_int_equal(gbuffers_draw(&g, w, &job, &raster_kernels_1, pool), MGT_OK);
        for (size_t i = 0; i < pixels_of(&g); i += 3) {
            const double x = (double)(i % g.refracted.width) - g.refracted.left, y = (double)(i / g.refracted.width) - g.refracted.top;
            int triangle;
            const double depth = nearest_depth(&job.camera, positions, x, y, &triangle);
            assert_int_equal(g.front.triangle[i], -1);
            covered += triangle >= 0;
            if (triangle == g.refracted.triangle[i]) {
                if (triangle >= 0)
                    worst = fmax(worst, fabs((double)g.refracted.depth[i] / depth - 1));
                continue;
            }
            differ++;
            if (!is_near(&job.camera, positions, x, y, g.refracted.triangle[i], depth))
                fail_msg("pixel (%g, %g): triangle %d, a ray meets %d", x, y, g.refracted.triangle[i], triangle);
        }
        gbuffers_free(&g);
        world_free(w);
        mgt_mesh_destroy(s.mesh);
    }
    print_message("  %zu pixels with triangles: %zu beside a border that rounding decides; depth within %.2g\n", covered, differ, worst);
    assert_true(covered > 50000 && differ * 2000 < covered && worst < 1e-2); /* depths of triangles seen edge-on change fast in 1/512 pixel */
    thread_pool_destroy(pool);
}

/* ---- the same bits ---- */

static void test_same_bits(void **state)
{
    (void)state;
    const double position[3] = {0.3, 1.5, 3}, target[3] = {0, -2.5, -3}, elsewhere[3] = {1, 0.5, 2};
    static float positions[SOUP * 9];
    static uint32_t indices[SOUP * 3];
    random_state seed = {3};
    random_soup(positions, indices, &seed);
    for (int i = 1; i < SOUP * 9; i += 3)
        positions[i] += 2.5f; /* some above the water */
    quad_scene s;
    world *w = NULL;
    make_scene(&s, positions, SOUP * 3, indices, SOUP, position, target);
    thread_pool *one = thread_pool_create(1), *three = thread_pool_create(3);
    assert_int_equal(world_update(&w, &s.scene, one), MGT_OK);
    const uint64_t version = w->version;
    assert_int_equal(world_update(&w, &s.scene, three), MGT_OK);
    assert_int_equal(w->version, version);
    for (int map = MAP_STRAIGHT; map <= MAP_PATH; map++) {
        gbuffer_job job = job_of(&s.scene, (int)map);
        job.crest = 0.1;
        gbuffers g = {0}, h = {0};
        assert_int_equal(gbuffers_draw(&g, w, &job, &raster_kernels_1, one), MGT_OK);
        gbuffer_job other = job;
        memcpy(other.camera.position, elsewhere, sizeof elsewhere);
        const raster_kernels *kernels[4];
        const int count = widths(kernels);
        for (int k = 0; k < count; k++) {
            if (kernels[k] == &raster_kernels_4)
                continue;
            assert_int_equal(gbuffers_draw(&h, w, &other, kernels[k], three), MGT_OK); /* so that there is something else to keep */
            assert_int_equal(gbuffers_draw(&h, w, &job, kernels[k], three), MGT_OK);
            const size_t size = pixels_of(&g) * 4;
            assert_int_equal(pixels_of(&h) * 4, size);
            assert_memory_equal(g.front.depth, h.front.depth, size);
            assert_memory_equal(g.front.triangle, h.front.triangle, size);
            assert_memory_equal(g.refracted.depth, h.refracted.depth, size);
            assert_memory_equal(g.refracted.triangle, h.refracted.triangle, size);
        }
        gbuffers_free(&g);
        gbuffers_free(&h);
    }
    s.scene.water.level = 1;
    assert_int_equal(world_update(&w, &s.scene, three), MGT_OK);
    assert_int_not_equal(w->version, version);
    world_free(w);
    mgt_mesh_destroy(s.mesh);
    thread_pool_destroy(one);
    thread_pool_destroy(three);
}

/* ---- where cameras should not be ---- */

static void test_odd_places(void **state)
{
    (void)state;
    static const double heights[] = {0, 1e-9, -1e-9, 0.5, -0.5, -1, 1e5, -1e5};
    static const double bends[] = {1, 0.5, 1.0000001, 1.333, 3};
    static const double levels[] = {-50, -1, 0, 50};
    const float mesh[] = {-5, -1, -5, 5, -1, -5, 5, -1, 5, -5, -1, 5, 0, 1, 0, 0, 0, 0, 1e6f, 0, 1e6f, 1e-7f, 0, 0};
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 0, 1, 4, 2, 3, 4, 5, 6, 4, 5, 7, 4, 5, 7, 6};
    thread_pool *pool = thread_pool_create(2);
    gbuffers g = {0};
    world *w = NULL;
    for (size_t i = 0; i < 8 * 5 * 4; i++) {
        quad_scene s;
        const double position[3] = {0, heights[i % 8], 0}, target[3] = {0.1, heights[i % 8] - 1, i % 3 ? -1 : -0.1};
        make_scene(&s, mesh, 8, indices, 7, position, target);
        s.scene.water.level = levels[i / 40];
        gbuffer_job job = job_of(&s.scene, (int)(i % 2 + 1));
        job.index = bends[i / 8 % 5];
        job.crest = 0.3;
        assert_int_equal(world_update(&w, &s.scene, pool), MGT_OK);
        assert_int_equal(gbuffers_draw(&g, w, &job, &raster_kernels_1, pool), MGT_OK);
        for (size_t k = 0; k < pixels_of(&g); k++) {
            assert_true(g.refracted.depth[k] > 0 && g.front.depth[k] > 0);
            assert_true(g.refracted.triangle[k] >= -1 && g.refracted.triangle[k] < 7);
        }
        mgt_mesh_destroy(s.mesh);
    }
    gbuffers_free(&g);
    world_free(w);
    thread_pool_destroy(pool);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared_edges), cmocka_unit_test(test_waterline),  cmocka_unit_test(test_against_rays),
        cmocka_unit_test(test_same_bits),    cmocka_unit_test(test_odd_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
