/* SPDX-License-Identifier: MIT
 * Points seen through a flat surface (kernels/refraction/refract_point.k) in lanes, against Fermat's least path in double precision. */
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
#include "cpu/raster_lanes.h"
#include "reference/refraction.h"

enum { POINTS = 101 * 101, ROOM = (POINTS + 15) / 16 * 16 };

static const double indices[] = {1.0, 1.0001, 1.01, 1.333, 1.5, 3.0};
enum { INDICES = sizeof indices / sizeof *indices };

typedef struct points {
    float in[3][ROOM], out[3][ROOM], back[3][ROOM];
} points;

static points *new_points(void)
{
    points *p = calloc(1, sizeof *p);
    assert_non_null(p);
    return p;
}

static void map_points(const raster_kernels *kernels, const RefractData *refract, points *p)
{
    const float *in[3] = {p->in[0], p->in[1], p->in[2]};
    float *out[3] = {p->out[0], p->out[1], p->out[2]}, *back[3] = {p->back[0], p->back[1], p->back[2]};
    kernels->virtual_points(refract, ROOM, in, out);
    kernels->true_points(refract, ROOM, (const float *const *)out, back);
}

/* Depths and distances from 1e-5 to 1e5 times the camera's height, in a direction that changes. */
static void fill_grid(points *p, double height)
{
    for (int i = 0; i < POINTS; i++) {
        const double depth = fabs(height) * pow(10, -5 + 0.1 * (i % 101)), across = fabs(height) * pow(10, -5 + 0.1 * (i / 101));
        p->in[0][i] = (float)(across * cos(0.7 * i));
        p->in[1][i] = (float)(height > 0 ? -depth : depth);
        p->in[2][i] = (float)(across * sin(0.7 * i));
    }
}

static double across_of(float p[3][ROOM], int i) { return hypot((double)p[0][i], (double)p[2][i]); }

/* Radians between the vertical and the path's ray on the camera's side. */
static double exact_angle(double height, double far, double across, double index)
{
    if (height > 0)
        return reference_air_angle(height, far, across, index);
    return asin(sin(reference_air_angle(far, -height, across, index)) / index);
}

/* A refracted ray must lead from the camera to the image. */
static double worst_angle(const points *p, double height, double index)
{
    double worst = 0;
    for (int i = 0; i < POINTS; i++) {
        const double across = hypot((double)p->in[0][i], (double)p->in[2][i]), seen = hypot((double)p->out[0][i], (double)p->out[2][i]);
        const double angle = atan2(seen, fabs(height - (double)p->out[1][i]));
        worst = fmax(worst, fabs(angle - exact_angle(height, fabs((double)p->in[1][i]), across, index)));
    }
    return worst;
}

static void test_angle(void **state)
{
    (void)state;
    points *p = new_points();
    for (int map = MAP_SAGITTAL; map <= MAP_PATH; map++)
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < INDICES; i++) {
                const double height = side ? -2.5 : 2.5;
                const RefractData refract = refract_data_of(height, indices[i], (int)map);
                fill_grid(p, height);
                map_points(&raster_kernels_1, &refract, p);
                const double worst = worst_angle(p, height, indices[i]);
                print_message("  map %d, camera %s, n = %-6g: %.2e rad (<= 2e-7)\n", map, side ? "below" : "above", indices[i], worst);
                assert_true(worst <= 2e-7);
            }
    free(p);
}

static bool runs(uint32_t lanes) { return lanes <= 4 || (lanes == 8 ? mgt_isa_available(MGT_ISA_AVX2) : mgt_isa_available(MGT_ISA_AVX512)); }

static void test_lanes_agree(void **state)
{
    (void)state;
    points *p = new_points(), *q = new_points();
#if defined(__x86_64__)
    const raster_kernels *kernels[] = {&raster_kernels_8, &raster_kernels_16};
    const uint32_t lanes[] = {8, 16};
    for (int k = 0; k < 2; k++)
        for (int map = MAP_STRAIGHT; map <= MAP_PATH && runs(lanes[k]); map++)
            for (int side = 0; side < 2; side++) {
                const RefractData refract = refract_data_of(side ? -2.5 : 2.5, 1.333, (int)map);
                fill_grid(p, side ? -2.5 : 2.5);
                fill_grid(q, side ? -2.5 : 2.5);
                map_points(&raster_kernels_1, &refract, p);
                map_points(kernels[k], &refract, q);
                assert_memory_equal(p, q, sizeof *p);
            }
#endif
    /* Four lanes without fused multiply-add: near. */
    const RefractData refract = refract_data_of(2.5, 1.333, MAP_SAGITTAL);
    fill_grid(p, 2.5);
    map_points(&raster_kernels_4, &refract, p);
    assert_true(worst_angle(p, 2.5, 1.333) <= 2e-5);
    free(p);
    free(q);
}

/* From the image back to the point. */
static void test_inverse(void **state)
{
    (void)state;
    points *p = new_points();
    for (int map = MAP_SAGITTAL; map <= MAP_PATH; map++)
        for (int side = 0; side < 2; side++) {
            const double height = side ? -2 : 2;
            const RefractData refract = refract_data_of(height, 1.333, (int)map);
            for (int i = 0; i < POINTS; i++) {
                const double depth = 0.05 + 0.05 * (i % 101), across = side ? (depth + 2) * 0.008 * (i / 101) : 0.2 * (i / 101);
                p->in[0][i] = (float)(across * cos(0.7 * i));
                p->in[1][i] = (float)(side ? depth : -depth);
                p->in[2][i] = (float)(across * sin(0.7 * i));
            }
            map_points(&raster_kernels_1, &refract, p);
            double worst = 0;
            for (int i = 0; i < POINTS; i++) {
                const double size = hypot(across_of(p->in, i), fabs((double)p->in[1][i]) + 2);
                for (int k = 0; k < 3; k++)
                    worst = fmax(worst, fabs((double)p->back[k][i] - (double)p->in[k][i]) / size);
            }
            print_message("  map %d, camera %s: %.2e of the distance (<= 3e-6)\n", map, side ? "below" : "above", worst);
            assert_true(worst <= 3e-6);
        }
    free(p);
}

/* Along a refracted ray images go away from the camera as points do, and stay on one straight ray. */
static void test_monotone(void **state)
{
    (void)state;
    points *p = new_points();
    for (int map = MAP_SAGITTAL; map <= MAP_PATH; map++)
        for (int side = 0; side < 2; side++) {
            const double height = side ? -1.7 : 1.7, n = 1.333;
            const RefractData refract = refract_data_of(height, n, (int)map);
            for (int i = 0; i < POINTS; i++) { /* 101 rays of 101 points */
                const double sine = side ? 0.0074 * (i / 101) : 0.0098 * (i / 101), bent = side ? sine * n : sine / n;
                const double far = 0.01 * pow(1.08, i % 101), across = fabs(height) * sine / sqrt(1 - sine * sine) + far * bent / sqrt(1 - bent * bent);
                p->in[0][i] = (float)(across * 0.6);
                p->in[1][i] = (float)(side ? far : -far);
                p->in[2][i] = (float)(across * 0.8);
            }
            map_points(&raster_kernels_1, &refract, p);
            for (int i = 0; i < POINTS; i++) {
                const double sine = side ? 0.0074 * (i / 101) : 0.0098 * (i / 101);
                const double angle = atan2(across_of(p->out, i), fabs(height - (double)p->out[1][i]));
                assert_true(fabs(angle - asin(sine)) <= 2e-6);
                const double size = hypot(across_of(p->out, i), fabs(height - (double)p->out[1][i]));
                if (i % 101)
                    assert_true(size > hypot(across_of(p->out, i - 1), fabs(height - (double)p->out[1][i - 1])));
            }
        }
    free(p);
}

/* Nothing moves where the water bends nothing, and on the surface itself; the camera may be on it; nothing becomes NaN. */
static void test_special_places(void **state)
{
    (void)state;
    points *p = new_points();
    const double heights[] = {2, -2, 0, 1e-7, -1e-7, 1e4, -1e4};
    const double bend[] = {1, 0.9, 1.333, 3};
    for (size_t h = 0; h < sizeof heights / sizeof *heights; h++)
        for (size_t n = 0; n < 4; n++)
            for (int map = MAP_STRAIGHT; map <= MAP_PATH; map++) {
                const RefractData refract = refract_data_of(heights[h], bend[n], (int)map);
                const float values[] = {0, 1e-30f, 1e-6f, 0.5f, 2, 1e6f, -0.5f, -1e6f, -0.0f};
                int count = 0;
                for (int x = 0; x < 9; x++)
                    for (int y = 0; y < 9; y++)
                        for (int z = 0; z < 9; z++, count++)
                            p->in[0][count] = values[x], p->in[1][count] = values[y], p->in[2][count] = values[z];
                map_points(&raster_kernels_1, &refract, p);
                for (int i = 0; i < count; i++)
                    for (int k = 0; k < 3; k++) {
                        const bool level = map == MAP_PATH && fabs(heights[h]) < 1e-3; /* paths along the surface have no direction */
                        const bool same = map == MAP_STRAIGHT || (bend[n] <= 1 && !level);
                        const double size = hypot(across_of(p->in, i), fabs((double)p->in[1][i]) + fabs(heights[h]));
                        if (!isfinite(p->out[k][i]) || !isfinite(p->back[k][i]) ||
                            (same && !(fabs((double)p->out[k][i] - (double)p->in[k][i]) <= 2e-6 * size + 1e-12)))
                            fail_msg("map %d, camera at %g, n = %g: (%g %g %g) becomes (%g %g %g)", map, heights[h], bend[n], (double)p->in[0][i],
                                     (double)p->in[1][i], (double)p->in[2][i], (double)p->out[0][i], (double)p->out[1][i], (double)p->out[2][i]);
                        if (map == MAP_SAGITTAL && p->in[1][i] == 0 && heights[h] > 0)
                            assert_true(p->out[k][i] == p->in[k][i]);
                    }
            }
    free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_angle),    cmocka_unit_test(test_lanes_agree),    cmocka_unit_test(test_inverse),
        cmocka_unit_test(test_monotone), cmocka_unit_test(test_special_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
