/* SPDX-License-Identifier: MIT
 * The ground truth of refraction against closed forms and against first hits by exhaustive steps. Shading here tells where rays ended. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "reference/equations.h"
#include "cpu/path_traced.h"
#include "unit/test_mesh.h"

enum { WIDTH = 64, HEIGHT = 32, COLUMNS = WIDTH / TILE_WIDTH, ROWS = HEIGHT / TILE_HEIGHT };

static char error_text[REPORTER_TEXT];
static const reporter silent = {.error = error_text};

/* What the tests' shading returns. */
typedef enum answer_kind { TOLD_POSITION, TOLD_DIRECTION, TOLD_LENGTHS, TOLD_GAIN, TOLD_SPREAD, TOLD_ONE } answer_kind;

static void tell(const shade_scene *user, const shade_hits *h, float *rgb)
{
    const answer_kind what = *(const answer_kind *)(const void *)user;
    for (size_t i = 0; i < h->count; i++) {
        const float lengths[3] = {h->before[i], h->after[i], h->water[i]};
        for (int k = 0; k < 3; k++)
            rgb[3 * i + (size_t)k] = what == TOLD_ONE         ? 1
                                     : what == TOLD_POSITION  ? (h->triangle[i] >= 0 ? h->position[k][i] : NAN)
                                     : what == TOLD_DIRECTION ? h->direction[k][i]
                                     : what == TOLD_GAIN      ? h->gain[i]
                                     : what == TOLD_SPREAD    ? h->spread[k][i]
                                                              : lengths[k];
    }
}

typedef struct setup {
    mgt_scene scene;
    mgt_object object;
    mgt_mesh *mesh;
    thread_pool *pool;
    world *world;
    trace_scene *trace;
} setup;

/* One horizontal square of 400 × 400 m at a height over the mean surface. */
static void begin(setup *s, double camera_height, double plane_height)
{
    *s = (setup){.pool = thread_pool_create(1)};
    mgt_scene_init(&s->scene, sizeof s->scene);
    static const float positions[] = {-200, 0, -200, 200, 0, -200, 200, 0, 200, -200, 0, 200};
    static const uint32_t indices[] = {0, 2, 1, 0, 3, 2};
    s->mesh = test_mesh(positions, NULL, 4, indices, 2);
    s->object = (mgt_object){.mesh = s->mesh, .transform = {{1, 0, 0, 3}, {0, 1, 0, plane_height}, {0, 0, 1, -7}}};
    s->scene.objects = &s->object;
    s->scene.object_count = 1;
    s->scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    s->scene.camera = (mgt_camera){{5, camera_height, 2}, {5.5, 0.9 * camera_height, 1}, {0, 1, 0}, 40};
    s->scene.quality.refraction_samples = 1;
    assert_int_equal(world_update(&s->world, &s->scene, s->pool), MGT_OK);
    const trace_triangles triangles = {s->world->triangle_count, s->world->vertex_count, s->world->positions, s->world->indices, s->world->version};
    assert_int_equal(trace_scene_update(&s->trace, &triangles, 1, &silent), MGT_OK);
}

static void end(setup *s)
{
    trace_scene_free(s->trace);
    world_free(s->world);
    thread_pool_destroy(s->pool);
    mgt_mesh_destroy(s->mesh);
}

static path_traced *truth_of(const setup *s, const answer_kind *what, mgt_isa isa, uint32_t workers)
{
    path_traced *truth;
    const path_traced_job job = {.scene = &s->scene,
                                 .camera = camera_rays_of(&s->scene.camera, WIDTH, HEIGHT),
                                 .world = s->world,
                                 .trace = s->trace,
                                 .shade = tell,
                                 .user = (const shade_scene *)(const void *)what,
                                 .isa = isa,
                                 .workers = workers};
    assert_int_equal(path_traced_create(&truth, &job), MGT_OK);
    return truth;
}

static path_traced_pixels *render_behind(const setup *s, answer_kind what, mgt_isa isa, uint32_t worker, const float front[TILE_PIXELS])
{
    path_traced *truth = truth_of(s, &what, isa, worker + 1);
    path_traced_pixels *tiles = calloc(COLUMNS * ROWS, sizeof *tiles);
    assert_non_null(tiles);
    for (uint32_t i = 0; i < COLUMNS * ROWS; i++)
        path_traced_tile(truth, i % COLUMNS, i / COLUMNS, worker, true, front, &tiles[i]);
    path_traced_free(truth);
    return tiles;
}

static path_traced_pixels *render(const setup *s, answer_kind what, mgt_isa isa, uint32_t worker)
{
    float hidden[TILE_PIXELS];
    for (int i = 0; i < TILE_PIXELS; i++)
        hidden[i] = 1;
    return render_behind(s, what, isa, worker, hidden);
}

typedef struct answer {
    double water, through[3], mirrored[3];
} answer;

static answer answer_at(const path_traced_pixels *tiles, uint32_t x, uint32_t y)
{
    const path_traced_pixels *t = &tiles[y / TILE_HEIGHT * COLUMNS + x / TILE_WIDTH];
    const size_t i = y % TILE_HEIGHT * TILE_WIDTH + x % TILE_WIDTH;
    return (answer){(double)t->water[i],
                    {(double)t->red[i], (double)t->green[i], (double)t->blue[i]},
                    {(double)t->mirrored_red[i], (double)t->mirrored_green[i], (double)t->mirrored_blue[i]}};
}

/* The world's origin is the objects'; positions here are the scene's. */
static void assert_position(const setup *s, const double told[3], const double exact[3], double tolerance)
{
    const double place[3] = {told[0] + s->world->origin[0], told[1], told[2] + s->world->origin[1]};
    for (int k = 0; k < 3; k++)
        if (!(fabs(place[k] - exact[k]) <= tolerance))
            fail_msg("(%g, %g, %g) where (%g, %g, %g) is right", place[0], place[1], place[2], exact[0], exact[1], exact[2]);
}

/* Of a thin bundle of rays through a level surface. */
static double etendue(const double a[3], const double b[3], const double c[3])
{
    const double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    return fabs(0.5 * volume * (a[1] + b[1] + c[1]) / 3);
}

/* What a lossless surface lets through stays the same power: radiance changes as the bundle's etendue does. */
static void radiance_keeps_the_power_of_a_bundle(void **state)
{
    (void)state;
    for (int below = 0; below < 2; below++) {
        setup s;
        begin(&s, below ? -3 : 3, below ? 2 : -2);
        s.scene.camera = (mgt_camera){{5, below ? -3 : 3, 2}, {6, 0, 1}, {0, 1, 0}, 40};
        path_traced_pixels *directions = render(&s, TOLD_DIRECTION, MGT_ISA_AUTO, 0), *gains = render(&s, TOLD_GAIN, MGT_ISA_AUTO, 0);
        int seen = 0;
        for (uint32_t y = 0; y + 1 < HEIGHT; y++)
            for (uint32_t x = 0; x + 1 < WIDTH; x++) {
                double o[3], v[3][3];
                answer a[3];
                bool through = true;
                for (uint32_t k = 0; k < 3; k++) {
                    camera_ray(&s.scene, x + (k == 1) + 0.5, y + (k == 2) + 0.5, 0, o, v[k]);
                    a[k] = answer_at(directions, x + (k == 1), y + (k == 2));
                    through = through && a[k].water > 0 && (a[k].through[1] > 0) == (below > 0) && fmin(fabs(v[k][1]), fabs(a[k].through[1])) > 0.4;
                }
                if (!through)
                    continue;
                const double exact = etendue(a[0].through, a[1].through, a[2].through) / etendue(v[0], v[1], v[2]);
                assert_true(fabs(answer_at(gains, x, y).through[0] / exact - 1) < 0.02);
                assert_true(answer_at(gains, x, y).mirrored[0] == 1);
                seen++;
            }
        assert_true(seen > 100);
        free(directions);
        free(gains);
        end(&s);
    }
}

static void flat_water_shows_a_floor_where_snell_says(void **state)
{
    (void)state;
    static const double depths[] = {0.5, 2, 10};
    for (int d = 0; d < 3; d++) {
        setup s;
        begin(&s, 3, -depths[d]);
        path_traced_pixels *places = render(&s, TOLD_POSITION, MGT_ISA_AUTO, 0), *lengths = render(&s, TOLD_LENGTHS, MGT_ISA_AUTO, 0);
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                double o[3], v[3];
                camera_ray(&s.scene, x + 0.5, y + 0.5, 0, o, v);
                const answer a = answer_at(places, x, y);
                assert_true(a.water == (v[1] < 0 ? 1 : 0));
                if (!(v[1] < 0))
                    continue;
                const double before = -o[1] / v[1], sine = hypot(v[0], v[2]), refracted = asin(sine / 1.333), after = depths[d] / cos(refracted);
                const double reach = before + depths[d] * tan(refracted) / sine;
                const double exact[3] = {o[0] + reach * v[0], -depths[d], o[2] + reach * v[2]};
                if (fabs(exact[0] - 3) > 199 || fabs(exact[2] + 7) > 199)
                    continue;
                assert_position(&s, a.through, exact, 1e-5 + 2e-7 * reach);
                const answer l = answer_at(lengths, x, y);
                const double exact_lengths[3] = {before, after, after};
                for (int k = 0; k < 3; k++)
                    assert_true(fabs(l.through[k] - exact_lengths[k]) < 1e-6 * (before + after));
            }
        free(places);
        free(lengths);
        end(&s);
    }
}

/* Where every ray meets an object before the surface, pixels whose water is not wholly hidden show that object. */
static void waterlines_show_the_object(void **state)
{
    (void)state;
    static const float shown[TILE_PIXELS];
    for (int below = 0; below < 2; below++) {
        setup s;
        begin(&s, below ? -3 : 3, below ? -1 : 1);
        path_traced_pixels *places = render_behind(&s, TOLD_POSITION, MGT_ISA_AUTO, 0, shown), *hidden = render(&s, TOLD_POSITION, MGT_ISA_AUTO, 0);
        path_traced_pixels *lengths = render_behind(&s, TOLD_LENGTHS, MGT_ISA_AUTO, 0, shown);
        int seen = 0;
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                double o[3], v[3];
                camera_ray(&s.scene, x + 0.5, y + 0.5, 0, o, v);
                const answer a = answer_at(places, x, y), none = answer_at(hidden, x, y), l = answer_at(lengths, x, y);
                const double reach = ((below ? -1 : 1) - o[1]) / v[1], exact[3] = {o[0] + reach * v[0], below ? -1 : 1, o[2] + reach * v[2]};
                if (!(reach > 0) || fabs(exact[0] - 3) > 199 || fabs(exact[2] + 7) > 199)
                    continue;
                assert_true(a.water == 0 && none.water == 0 && none.through[0] == 0 && none.mirrored[0] == 0);
                assert_position(&s, a.through, exact, 1e-5 + 2e-7 * reach);
                assert_position(&s, a.mirrored, exact, 1e-5 + 2e-7 * reach);
                assert_true(fabs(l.through[0] - reach) < 1e-6 * reach && l.through[1] == 0);
                assert_true(below ? fabs(l.through[2] - reach) < 1e-6 * reach : l.through[2] == 0);
                seen++;
            }
        assert_true(seen > 300);
        free(places);
        free(hidden);
        free(lengths);
        end(&s);
    }
}

/* From below: the sky through Snell's window, and the pool's floor mirrored beyond it. */
static void snells_window_ends_at_its_angle(void **state)
{
    (void)state;
    setup s;
    begin(&s, -2, -5);
    s.scene.camera = (mgt_camera){{5, -2, 2}, {5, 0, 0}, {0, 1, 0}, 70};
    path_traced_pixels *directions = render(&s, TOLD_DIRECTION, MGT_ISA_AUTO, 0), *places = render(&s, TOLD_POSITION, MGT_ISA_AUTO, 0);
    int inside = 0, outside = 0;
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            double o[3], v[3];
            camera_ray(&s.scene, x + 0.5, y + 0.5, 0, o, v);
            if (!(v[1] > 0)) {
                assert_true(answer_at(places, x, y).water == 0);
                continue;
            }
            const double sine = hypot(v[0], v[2]), reach = 2 / v[1];
            const answer told = answer_at(directions, x, y), place = answer_at(places, x, y);
            const bool window = sine * 1.333 < 1;
            inside += window;
            outside += !window;
            const double up = window ? sqrt(1 - sine * sine * 1.333 * 1.333) : -v[1], level = window ? 1.333 : 1;
            const double exact[3] = {level * v[0], up, level * v[2]};
            for (int k = 0; k < 3; k++)
                assert_true(fabs(told.through[k] - exact[k]) < 2e-6);
            const double mirrored = reach + 5 / v[1], floor[3] = {o[0] + mirrored * v[0], -5, o[2] + mirrored * v[2]};
            if (fabs(floor[0] - 3) < 199 && fabs(floor[2] + 7) < 199)
                assert_position(&s, place.mirrored, floor, 2e-4);
        }
    assert_true(inside > 400 && outside > 400);
    free(directions);
    free(places);
    end(&s);
}

static const mgt_wave waves[] = {{0.05, 1.5, 0.4, -3.8, 0.7}, {0.03, -0.8, 2.5, 4.0, 2.1}, {0.008, 6, -5, 8.0, 1.1}};

static void set_waves(setup *s)
{
    s->scene.water.waves = waves;
    s->scene.water.wave_count = sizeof waves / sizeof waves[0];
    s->scene.time = 12.5;
}

/* Of one sample. */
static double middle_of_shutter(const mgt_scene *scene) { return scene->time - scene->shutter / 2; }

/* Snell's law for vectors: what lies along the surface grows by `ratio`, the index before it over that behind. False: nothing is let through. */
static bool refract(const double view[3], const double slope[2], double ratio, double out[3])
{
    const double n[3] = {-slope[0], 1, -slope[1]}, length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double along = 0, square = 0;
    for (int k = 0; k < 3; k++)
        along += view[k] * n[k] / length;
    for (int k = 0; k < 3; k++) {
        out[k] = ratio * (view[k] - along * n[k] / length);
        square += out[k] * out[k];
    }
    for (int k = 0; k < 3 && square < 1; k++)
        out[k] += copysign(sqrt(1 - square), along) * n[k] / length;
    return square < 1;
}

/* Where the refracted ray does not meet the surface again it ends on the floor. */
static void waves_bend_rays_at_their_first_hit(void **state)
{
    (void)state;
    setup s;
    begin(&s, 3, -2);
    set_waves(&s);
    path_traced_pixels *places = render(&s, TOLD_POSITION, MGT_ISA_AUTO, 0);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const water_hit hit = first_hit_brute_force(&s.scene, x + 0.5, y + 0.5, middle_of_shutter(&s.scene));
            const answer a = answer_at(places, x, y);
            if (!hit.hit || hit.distance > 60)
                continue;
            assert_true(a.water == 1);
            double o[3], v[3], d[3];
            camera_ray(&s.scene, x + 0.5, y + 0.5, s.scene.time, o, v);
            assert_true(refract(v, hit.water.slope, 1 / 1.333, d));
            const double reach = (-2 - hit.position[1]) / d[1];
            const double exact[3] = {hit.position[0] + reach * d[0], -2, hit.position[2] + reach * d[2]};
            assert_position(&s, a.through, exact, 1e-4);
        }
    free(places);
    end(&s);
}

/* Where a ray through the waves ends on the floor, relative to another end; false: it is no ordinary ray. */
static bool floor_end(const setup *s, double pixel_x, double pixel_y, double end[3], double direction[3])
{
    const water_hit hit = first_hit_brute_force(&s->scene, pixel_x, pixel_y, middle_of_shutter(&s->scene));
    double o[3], v[3];
    camera_ray(&s->scene, pixel_x, pixel_y, s->scene.time, o, v);
    if (!hit.hit || hit.distance > 25 || hit.water.slope[0] * v[0] + hit.water.slope[1] * v[2] - v[1] < -0.4 * v[1])
        return false;
    if (!refract(v, hit.water.slope, 1 / 1.333, direction))
        return false;
    for (int k = 0; k < 3; k++)
        end[k] = hit.position[k] + (-2 - hit.position[1]) / direction[1] * direction[k];
    return true;
}

/* What a ray covers of the floor is told by how far its neighbours' ends are. */
static void footprints_follow_the_rays(void **state)
{
    (void)state;
    setup s;
    begin(&s, 3, -2);
    set_waves(&s);
    path_traced_pixels *spreads = render(&s, TOLD_SPREAD, MGT_ISA_AUTO, 0);
    static const double h = 0.002; /* pixels: they are large */
    int seen = 0;
    for (uint32_t y = 0; y < HEIGHT; y += 3)
        for (uint32_t x = 0; x < WIDTH; x += 3) {
            double at[3], d[3], ends[4][3], turned[3], exact[3] = {0};
            bool ordinary = floor_end(&s, x + 0.5, y + 0.5, at, d);
            for (int i = 0; i < 4 && ordinary; i++)
                ordinary = floor_end(&s, x + 0.5 + (i < 2 ? (i ? h : -h) : 0), y + 0.5 + (i < 2 ? 0 : i == 3 ? h : -h), ends[i], turned);
            if (!ordinary)
                continue;
            seen++;
            const double level = hypot(d[0], d[2]), side[3] = {-d[2] / level, 0, d[0] / level};
            const double rise[3] = {-d[0] * d[1] / level, level, -d[2] * d[1] / level};
            for (int i = 0; i < 4; i += 2) {
                double across[2] = {0};
                for (int k = 0; k < 3; k++) {
                    across[0] += (ends[i + 1][k] - ends[i][k]) / (2 * h) * side[k];
                    across[1] += (ends[i + 1][k] - ends[i][k]) / (2 * h) * rise[k];
                }
                exact[0] += across[0] * across[0] / 12, exact[1] += across[0] * across[1] / 12, exact[2] += across[1] * across[1] / 12;
            }
            const answer a = answer_at(spreads, x, y);
            for (int k = 0; k < 3; k++)
                if (!(fabs(a.through[k] - exact[k]) < 3e-3 * (exact[0] + exact[2])))
                    fail_msg("(%u, %u): %g where %g is right", x, y, a.through[k], exact[k]);
        }
    assert_true(seen > 100);
    free(spreads);
    end(&s);
}

/* The surface as a ray from below meets it: where the ray's mirror image meets the mirrored surface from above, on the other half of the picture. */
static water_hit first_hit_from_below(const mgt_scene *scene, double pixel_x, double pixel_y)
{
    mgt_scene mirror = *scene;
    mgt_wave turned[16];
    for (size_t i = 0; i < scene->water.wave_count; i++) {
        turned[i] = scene->water.waves[i];
        turned[i].phase += 3.14159265358979323846;
    }
    mirror.water.waves = turned;
    mirror.camera.position[1] *= -1;
    mirror.camera.target[1] *= -1;
    mirror.camera.up[1] *= -1;
    water_hit hit = first_hit_brute_force(&mirror, scene->image.width - pixel_x, pixel_y, middle_of_shutter(scene));
    hit.position[1] *= -1;
    hit.water.slope[0] *= -1;
    hit.water.slope[1] *= -1;
    return hit;
}

/* A ceiling 1.5 m over the water is seen through waves; what lies beyond their critical angle is the floor of the world, which has none. */
static void waves_bend_rays_from_below(void **state)
{
    (void)state;
    setup s;
    begin(&s, -2, 1.5);
    set_waves(&s);
    s.scene.camera = (mgt_camera){{5, -2, 2}, {5, 0, 0.5}, {0, 1, 0}, 70};
    path_traced_pixels *places = render(&s, TOLD_POSITION, MGT_ISA_AUTO, 0);
    int through = 0;
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const water_hit hit = first_hit_from_below(&s.scene, x + 0.5, y + 0.5);
            double o[3], v[3], d[3];
            camera_ray(&s.scene, x + 0.5, y + 0.5, s.scene.time, o, v);
            /* Rays that are bent far down meet another wave. */
            if (!hit.hit || hit.distance > 30 || !refract(v, hit.water.slope, 1.333, d) || d[1] < 0.4)
                continue;
            through++;
            for (int k = 0; k < 3; k++)
                assert_true(fabs(hit.position[k] - o[k] - hit.distance * v[k]) < 1e-6);
            const double reach = (1.5 - hit.position[1]) / d[1];
            const double exact[3] = {hit.position[0] + reach * d[0], 1.5, hit.position[2] + reach * d[2]};
            assert_position(&s, answer_at(places, x, y).through, exact, 1e-4);
        }
    assert_true(through > 400);
    free(places);
    end(&s);
}

/* However often rays cross the surface: what is let go is little. */
static void shares_add_up(void **state)
{
    (void)state;
    static const double heights[] = {2, 0.3, -2, -0.3};
    for (int i = 0; i < 4; i++) {
        setup s;
        begin(&s, heights[i], -3);
        set_waves(&s);
        s.scene.camera.target[1] = heights[i] * 0.85;
        path_traced_pixels *ones = render(&s, TOLD_ONE, MGT_ISA_AUTO, 0);
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                const answer a = answer_at(ones, x, y);
                assert_true(a.water == 0 || a.water == 1);
                assert_true(a.water == 0 ? a.through[0] == 0 && a.mirrored[0] == 0 : fabs(a.through[0] - 1) < 0.006 && fabs(a.mirrored[0] - 1) < 0.006);
            }
        free(ones);
        end(&s);
    }
}

static void bits_depend_on_the_tile_alone(void **state)
{
    (void)state;
    setup s;
    begin(&s, 0.5, -2);
    set_waves(&s);
    s.scene.quality.refraction_samples = 3;
    s.scene.quality.seed = 5;
    path_traced_pixels *first = render(&s, TOLD_LENGTHS, MGT_ISA_SCALAR, 0);
    static const mgt_isa isas[] = {MGT_ISA_AUTO, MGT_ISA_AVX2, MGT_ISA_AVX512};
    for (int i = 0; i < 3; i++) {
        if (!mgt_isa_available(isas[i]))
            continue;
        path_traced_pixels *other = render(&s, TOLD_LENGTHS, isas[i], (uint32_t)i);
        assert_memory_equal(first, other, COLUMNS * ROWS * sizeof *first);
        free(other);
    }
    free(first);
    end(&s);
}

/* The places of many samples lie evenly in the pixel: the mean is its centre's. */
static void samples_fill_the_pixel(void **state)
{
    (void)state;
    setup s;
    begin(&s, 3, -2);
    s.scene.camera = (mgt_camera){{5, 3, 2}, {5, 0, 2}, {0, 0, -1}, 40};
    path_traced_pixels *centre = render(&s, TOLD_POSITION, MGT_ISA_AUTO, 0);
    s.scene.quality.refraction_samples = 16;
    path_traced_pixels *mean = render(&s, TOLD_POSITION, MGT_ISA_AUTO, 0);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const answer a = answer_at(centre, i % WIDTH, i / WIDTH), b = answer_at(mean, i % WIDTH, i / WIDTH);
        for (int k = 0; k < 3; k++)
            assert_true(fabs(a.through[k] - b.through[k]) < 0.002); /* a pixel is 0.1 m wide */
    }
    free(centre);
    free(mean);
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_water_shows_a_floor_where_snell_says),
        cmocka_unit_test(radiance_keeps_the_power_of_a_bundle),
        cmocka_unit_test(waterlines_show_the_object),
        cmocka_unit_test(snells_window_ends_at_its_angle),
        cmocka_unit_test(waves_bend_rays_at_their_first_hit),
        cmocka_unit_test(footprints_follow_the_rays),
        cmocka_unit_test(waves_bend_rays_from_below),
        cmocka_unit_test(shares_add_up),
        cmocka_unit_test(bits_depend_on_the_tile_alone),
        cmocka_unit_test(samples_fill_the_pixel),
    };
    if (!trace_available()) {
        print_message("skipped: this build traces no rays\n");
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
