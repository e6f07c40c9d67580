/* SPDX-License-Identifier: MIT
 *
 * What defines tndf, tokuyoshi, bruneton and leadr, at one lane.
 */
#include "kernel_lane.h"

static SlopeState random_state_of_slopes(random_state *r)
{
    SlopeState s = {.view = vec3(0, 0.3f, 0.95394f),
                    .variance_xx = (float)random_range(r, 0, 0.01),
                    .variance_zz = (float)random_range(r, 0, 0.01),
                    .bend_xx = (float)random_range(r, 0, 0.01),
                    .bend_zz = (float)random_range(r, 0, 0.01)};
    s.open = vec2((float)random_range(r, -0.3, 0.3), (float)random_range(r, -0.3, 0.3));
    s.close = vec2((float)random_range(r, -0.3, 0.3), (float)random_range(r, -0.3, 0.3));
    s.mirror.slope = vec2((float)random_range(r, -0.3, 0.3), (float)random_range(r, -0.3, 0.3));
    return s;
}

/* The moments of a Gaussian that moves evenly from one end of the shutter to the other. */
static void tndf_has_the_moments_of_the_path(void **state)
{
    (void)state;
    const struct kernel_context cx = {.frame = &(FrameData){.slope_floor = 0}};
    random_state r = {2};
    double worst = 0;
    for (int k = 0; k < 200; k++) {
        const SlopeState s = random_state_of_slopes(&r);
        const SlopeGaussian g = tndf_slopes(&cx, s, s);
        double mean[2] = {0}, square[3] = {0};
        for (int i = 0; i < 1000; i++) {
            const double t = (i + 0.5) / 1000;
            const double x = (double)s.open.x + t * (double)(s.close.x - s.open.x), z = (double)s.open.y + t * (double)(s.close.y - s.open.y);
            mean[0] += x / 1000, mean[1] += z / 1000;
            square[0] += x * x / 1000, square[1] += x * z / 1000, square[2] += z * z / 1000;
        }
        const double ours[5] = {(double)g.mean.x, (double)g.mean.y, (double)g.xx, (double)g.xz, (double)g.zz};
        const double exact[5] = {mean[0], mean[1], square[0] - mean[0] * mean[0] + (double)(s.variance_xx + s.bend_xx), square[1] - mean[0] * mean[1],
                                 square[2] - mean[1] * mean[1] + (double)(s.variance_zz + s.bend_zz)};
        for (int i = 0; i < 5; i++)
            worst = fmax(worst, fabs(ours[i] - exact[i]));
    }
    expect_below("moments over the shutter", worst, 1e-6);
}

/* The roughness added is that of half a pixel, and bounded. */
static void tokuyoshi_counts_half_vector_steps(void **state)
{
    (void)state;
    random_state r = {9};
    mgt_wave waves[12];
    double largest = 0, flattest = 1, worst = 0;
    for (int k = 0; k < 40; k++) {
        random_waves(&r, waves, 12, 0.05, 8, 0.4);
        const mgt_scene scene = black_scene(160, 90, waves, k % 4 == 0 ? 0 : 12);
        kernel_bench *b = kernel_bench_create(&scene);
        for (uint32_t y = 48; y < 90; y += 6) {
            kernel_bench_tile(b, false, false, 80, y);
            const vec3 ray = kernel_bench_ray(b, 80, y), view = scale(normalize(ray), -1.0f);
            const SampleHit hit = sample_hit(&b->cx, ray, (HitEstimate){0, 0, 1, {0, 0}, {0, 0}});
            const Mirror m = mirror_at(&b->cx, view);
            const SlopeGaussian g = tokuyoshi_slopes(&b->cx, ray, hit, m, view);
            const double half = 0.5 * ((double)g.xx + (double)g.zz), gap = 0.5 * ((double)g.xx - (double)g.zz);
            largest = fmax(largest, half + sqrt(gap * gap + (double)(g.xz * g.xz)));
            if (scene.water.wave_count > 0)
                continue;
            /* On still water only the mirror slope turns: by finite differences over whole pixels. */
            double dx[2][2];
            for (int i = 0; i < 2; i++) {
                const vec3 next = pixel_ray_at(&b->cx, (float)(80 % TILE_WIDTH + (i == 0)), (float)(y % TILE_HEIGHT + (i == 1)));
                const Mirror n = mirror_at(&b->cx, scale(normalize(next), -1.0f));
                dx[i][0] = (double)(n.slope.x - m.slope.x), dx[i][1] = (double)(n.slope.y - m.slope.y);
            }
            const double xx = 0.25 * (dx[0][0] * dx[0][0] + dx[1][0] * dx[1][0]), zz = 0.25 * (dx[0][1] * dx[0][1] + dx[1][1] * dx[1][1]);
            worst = fmax(worst, fmax(fabs((double)g.xx - xx), fabs((double)g.zz - zz)) / (xx + zz));
            flattest = fmin(flattest, (double)g.xx + (double)g.zz);
        }
        kernel_bench_destroy(b);
    }
    expect_below("largest variance added", largest, 0.0901);
    expect_below("on still water, against differences of mirror slopes", worst, 0.1);
    assert_true(largest > 0.08 && flattest > 0);
}

/* A light far smaller than the slopes' spread is a point: its share of the disk, by Smith's masking and shadowing, is the same. */
static void bruneton_is_the_limit_of_small_lights(void **state)
{
    (void)state;
    random_state r = {4};
    double worst = 0;
    int compared = 0;
    for (int k = 0; k < 300; k++) {
        mgt_scene scene = black_scene(160, 90, NULL, 0);
        scene.light.angular_radius_deg = 0.05;
        scene.light.elevation_deg = random_range(&r, 5, 60);
        kernel_bench *b = kernel_bench_create(&scene);
        const double elevation = random_range(&r, 0.1, 1.2);
        const vec3 view = vec3((float)(0.3 * cos(elevation)), (float)sin(elevation), (float)(sqrt(1 - 0.09) * cos(elevation)));
        const Mirror m = mirror_at(&b->cx, view);
        const double sx = random_range(&r, 0.05, 0.2), sz = random_range(&r, 0.05, 0.2);
        const vec2 mean = vec2((float)random_range(&r, -0.05, 0.05), (float)random_range(&r, -0.05, 0.05));
        const SlopeGaussian g = slope_gaussian(&b->cx, mean, (Symmetric){(float)(sx * sx), (float)(0.3 * sx * sz), (float)(sz * sz)});
        const double disk = (double)leadr_coverage(&b->cx, view, m, g), point = (double)bruneton_coverage(&b->cx, view, m, g);
        if (disk > 1e-7 && (double)visible_weight(&b->cx, view, g.mean) > 0.02) {
            worst = fmax(worst, fabs(point / disk - 1));
            compared++;
        }
        kernel_bench_destroy(b);
    }
    print_message("  %d pairs\n", compared);
    assert_true(compared > 100);
    expect_below("point against disk of 0.05 degrees, relative", worst, 0.03);
}

/* Waves turn from geometry to Gaussian, and no variance is lost on the way. */
static void bruneton_splits_by_pixels_a_wavelength(void **state)
{
    (void)state;
    const struct kernel_context cx = {0};
    assert_true((double)bruneton_fraction(&cx, (float)(1 / (2.5 * 2.5))) > 0.9999 && bruneton_fraction(&cx, 1.0f) == 0 && bruneton_fraction(&cx, 9.0f) == 0);
    assert_true(fabs((double)bruneton_fraction(&cx, (float)(1 / (1.75 * 1.75))) - 0.5) < 1e-5);
    double last = 1;
    for (double f = 0.1; f < 3; f += 0.01) {
        const double share = (double)bruneton_fraction(&cx, (float)(f * f));
        assert_true(share <= last && share >= 0);
        last = share;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tndf_has_the_moments_of_the_path),
        cmocka_unit_test(tokuyoshi_counts_half_vector_steps),
        cmocka_unit_test(bruneton_is_the_limit_of_small_lights),
        cmocka_unit_test(bruneton_splits_by_pixels_a_wavelength),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
