/* SPDX-License-Identifier: MIT
 * Shadows: the kernel that reads the map against means over many places, and what the map covers. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/kernel_context.h"
#include "frame/shadow_map.h"
#include "mangata/mangata.h"
#include "unit/random_numbers.h"
#include "unit/test_mesh.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* the dialect hands cx to every function */
#pragma GCC diagnostic ignored "-Wshadow"

static ShadeData shade_data;

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#define SHADE(cx) shade_data

/* The edge of a roof over half of the map. */
static double edge_slope, edge_middle, edge_height = 10;

KERNEL real SHADOW_TEXEL(CTX cx, real column, real row)
{
    return (float)(edge_slope * ((double)row - 64) > (double)column - 64 - edge_middle ? edge_height : -edge_height);
}

static bool knows_ranges;

KERNEL vec2 SHADOW_RANGE(CTX cx, real column, real row, real width, mask dry)
{
    vec2 range = vec2(knows_ranges ? INFINITY : -INFINITY, knows_ranges ? -INFINITY : INFINITY);
    for (int y = 0; y < (int)width; y++)
        for (int x = 0; x < (int)width; x++) {
            const float height = SHADOW_TEXEL(cx, column + (float)x, row + (float)y);
            range = vec2(fminf(range.x, height), fmaxf(range.y, height));
        }
    return range;
}

#include "kernels/refraction/shadow.k"

#include "unit/kernel_words_off.h"

static random_state numbers;

static float range(double low, double high) { return (float)random_range(&numbers, low, high); }

/* The mean over a parallelogram, by many places. */
static double mean_share(vec3 at, vec3 first, vec3 second)
{
    enum { STEPS = 64 };
    double sum = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        const float a = ((float)(i % STEPS) + 0.5f) / STEPS - 0.5f, b = ((float)(i / STEPS) + 0.5f) / STEPS - 0.5f;
        sum += (double)shadow_at_point(NULL, within_parallelogram(NULL, at, first, second, a, b), 0);
    }
    return sum / (STEPS * STEPS);
}

static void shadows_are_means_over_the_footprint(void **state)
{
    (void)state;
    numbers.state = 21;
    shade_data = (ShadeData){.shadow_columns = 128, .shadow_rows = 128, .shadow_scale = 4, .shadow_texel = 0.25f, .sun_air_x = 0.6f, .sun_air_z = -0.3f};
    double worst = 0, middles = 0;
    int borders = 0;
    for (int i = 0; i < 2000; i++) {
        edge_slope = (double)range(-3, 3), edge_middle = (double)range(-3, 3);
        const float size = (float)exp((double)range(-4, 1));
        const vec3 at = vec3(16 + range(-1, 1), range(0, 0.2), 16 + range(-1, 1));
        const vec3 first = vec3(size * range(-1, 1), size * range(-0.2, 0.2), size * range(-1, 1));
        const vec3 second = vec3(size * range(-1, 1), size * range(-0.2, 0.2), size * range(-1, 1));
        const double exact = mean_share(at, first, second);
        borders += exact > 0.1 && exact < 0.9;
        worst = fmax(worst, fabs((double)shadow_over(NULL, at, first, second, 0) - exact));
        middles = fmax(middles, fabs((double)shadow_at_point(NULL, at, 0) - exact));
    }
    printf("  within %.2g of the footprint's mean, in %d cases at borders; what its middle says is off by up to %.2g\n", worst, borders, middles);
    assert_true(borders > 400 && worst < 0.08);
}

/* Blocks of texels that say the same spare looks, and change nothing. */
static void blocks_say_what_their_texels_say(void **state)
{
    (void)state;
    numbers.state = 22;
    shade_data.sun_water_x = 0.4f, shade_data.sun_water_z = -0.2f;
    int known = 0, lit = 0, wrong = 0;
    enum { CASES = 20000 };
    for (int i = 0; i < CASES; i++) {
        edge_slope = (double)range(-3, 3), edge_middle = (double)range(-8, 8), edge_height = exp((double)range(-3, 1));
        const float size = (float)exp((double)range(-4, 1));
        const vec3 at = vec3(16 + range(-2, 2), range(-1, 1), 16 + range(-2, 2));
        const vec3 first = vec3(size * range(-1, 1), size * range(-1, 1), size * range(-1, 1));
        const vec3 second = vec3(size * range(-1, 1), size * range(-1, 1), size * range(-1, 1));
        const mask dry = i % 5 == 0 ? -1 : 0;
        const real unaided = shadow_over(NULL, at, first, second, dry);
        knows_ranges = true;
        wrong += shadow_over(NULL, at, first, second, dry) != unaided;
        const mask wet = at.y < 0 && !dry ? -1 : 0;
        const real all = shadow_of_all(NULL, at, fabsf(first.y) + fabsf(second.y), shadow_texels(NULL, wet, first), shadow_texels(NULL, wet, second), dry);
        knows_ranges = false;
        known += all >= 0;
        lit += all > 0;
    }
    edge_height = 10;
    printf("  %d of %d places known from blocks, %d of them lit; %d wrong\n", known, (int)CASES, lit, wrong);
    assert_true(wrong == 0 && lit > CASES / 10 && known - lit > CASES / 10);
}

/* A triangle on end and a level ground of this size; returns the map's texel. */
static float texel_of(float ground_size, float ground_height)
{
    const float side = ground_size / 2;
    const float ground[] = {-side, 0, -side, side, 0, -side, side, 0, side, -side, 0, side};
    const float post[] = {-1, 0, 0, 1, 0, 0, 0, 2, 0.5f};
    const uint32_t ground_indices[] = {0, 2, 1, 0, 3, 2}, post_indices[] = {0, 1, 2};
    mgt_mesh *meshes[] = {test_mesh(ground, NULL, 4, ground_indices, 2), test_mesh(post, NULL, 3, post_indices, 1)};
    mgt_object objects[2] = {0};
    for (int i = 0; i < 2; i++) {
        objects[i].mesh = meshes[i];
        for (int k = 0; k < 3; k++)
            objects[i].transform[k][k] = 1;
    }
    objects[0].transform[1][3] = (double)ground_height;
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.objects = objects;
    scene.object_count = 2;
    world *w = NULL;
    shadow_map *map = NULL;
    thread_pool *pool = thread_pool_create(1);
    assert_int_equal(world_update(&w, &scene, pool), MGT_OK);
    assert_int_equal(shadow_map_update(&map, w, &(shadow_rays){{0.5, 0}, {0.3, 0}}), MGT_OK);
    const float texel = map->texel;
    shadow_map_free(map);
    world_free(w);
    thread_pool_destroy(pool);
    for (int i = 0; i < 2; i++)
        mgt_mesh_destroy(meshes[i]);
    return texel;
}

/* A ground that lies under all else casts no shadow: the map is as fine as for what stands on it. A roof does. */
static void a_ground_without_end_costs_no_resolution(void **state)
{
    (void)state;
    const float small = texel_of(4, 0), large = texel_of(4000, 0), roof = texel_of(4000, 3);
    printf("  texels: %.4g m, %.4g m with a ground of 4 km, %.4g m with a roof\n", (double)small, (double)large, (double)roof);
    assert_true(large == small && roof > 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadows_are_means_over_the_footprint),
        cmocka_unit_test(blocks_say_what_their_texels_say),
        cmocka_unit_test(a_ground_without_end_costs_no_resolution),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
