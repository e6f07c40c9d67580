/* SPDX-License-Identifier: MIT
 *
 * The map of slope moments of methods lean and leadr: its slopes are the snapped waves', no level loses variance, and a filtered look-up
 * has, on average, the covariance that filtering takes from the waves.
 */
#include "kernel_lane.h"

enum { WAVES = 24 };
static const double turn = 6.28318530717958647692;

typedef struct map_state {
    mgt_wave waves[WAVES];
    kernel_bench *bench;
    thread_pool *pool;
    lean_map *map;
} map_state;

static int set_up(void **state)
{
    map_state *s = calloc(1, sizeof *s);
    assert_non_null(s);
    random_state r = {7};
    random_waves(&r, s->waves, WAVES, 0.4, 9, 0.12);
    const mgt_scene scene = black_scene(160, 90, s->waves, WAVES);
    s->bench = kernel_bench_create(&scene);
    s->pool = thread_pool_create(2);
    s->map = calloc(1, sizeof *s->map);
    assert_true(s->pool && s->map);
    assert_true(lean_map_build(s->map, &s->bench->frame, &lane_kernels_1, s->pool));
    s->bench->cx.lean = s->map;
    *state = s;
    return 0;
}

static int tear_down(void **state)
{
    map_state *s = *state;
    lean_map_free(s->map);
    thread_pool_destroy(s->pool);
    kernel_bench_destroy(s->bench);
    free(s);
    return 0;
}

static void waves_are_snapped_by_half_a_period_at_most(void **state)
{
    const map_state *s = *state;
    const double period = 1 / (double)s->map->data.turns_per_metre;
    double worst = 0, shortest = 1e9, longest = 0;
    assert_int_equal(s->map->waves.count, WAVES);
    for (int i = 0; i < WAVES; i++) {
        worst = fmax(worst, fabs(s->waves[i].kx * period / turn - s->map->waves.waves[i].periods_x));
        worst = fmax(worst, fabs(s->waves[i].kz * period / turn - s->map->waves.waves[i].periods_z));
        const double length = turn / hypot(s->waves[i].kx, s->waves[i].kz);
        shortest = fmin(shortest, length), longest = fmax(longest, length);
    }
    print_message("  map of %.1f m, %.3f m a texel, waves of %.2f to %.2f m\n", period, period / LEAN_SIZE, shortest, longest);
    expect_below("periods of the map that a wave is moved by, of each axis", worst, 0.5001);
    assert_true(shortest * LEAN_SIZE / period > 3.999 && longest < period / 7.999);
}

static void texels_are_the_snapped_waves(void **state)
{
    const map_state *s = *state;
    random_state r = {3};
    double worst = 0;
    for (int k = 0; k < 2000; k++) {
        const size_t x = (size_t)random_range(&r, 0, LEAN_SIZE), z = (size_t)random_range(&r, 0, LEAN_SIZE);
        double sx = 0, sz = 0;
        for (int i = 0; i < WAVES; i++) {
            const mgt_wave *w = &s->waves[i];
            const double phase = w->omega * s->bench->scene.time + w->phase;
            const double c = cos(phase + turn * (s->map->waves.waves[i].periods_x * (double)x + s->map->waves.waves[i].periods_z * (double)z) / LEAN_SIZE);
            sx += w->amplitude * w->kx * c, sz += w->amplitude * w->kz * c;
        }
        worst = fmax(worst, hypot((double)s->map->slope_x[z * LEAN_SIZE + x] - sx, (double)s->map->slope_z[z * LEAN_SIZE + x] - sz));
    }
    expect_below("slope of a texel", worst, 2e-6);
}

/* Mean of n samples of a cosine with m periods over LEAN_SIZE samples, over the mean's own largest. */
static double dirichlet(int m, int n)
{
    const double half = turn / 2 * m / LEAN_SIZE;
    return fabs(sin(half)) < 1e-12 ? 1 : sin(n * half) / (n * sin(half));
}

static void levels_hold_the_covariance_that_they_filter(void **state)
{
    const map_state *s = *state;
    double worst = 0;
    for (int level = 1; level < LEAN_LEVELS; level++) {
        const size_t texels = (size_t)LEAN_SIZE * LEAN_SIZE >> 2 * level;
        double ours[3] = {0}, exact[3] = {0}, whole[3] = {0}, kept[3] = {0};
        for (size_t i = 0; i < texels; i++) {
            const float *t = s->map->levels[level] + LEAN_MOMENTS * i;
            const double x = (double)t[0], z = (double)t[1];
            ours[0] += ((double)t[2] - x * x) / (double)texels, ours[1] += ((double)t[3] - x * z) / (double)texels;
            ours[2] += ((double)t[4] - z * z) / (double)texels;
            kept[0] += (double)t[2] / (double)texels, kept[1] += (double)t[3] / (double)texels, kept[2] += (double)t[4] / (double)texels;
        }
        for (int i = 0; i < WAVES; i++) {
            const mgt_wave *w = &s->waves[i];
            const double d = dirichlet(s->map->waves.waves[i].periods_x, 1 << level) * dirichlet(s->map->waves.waves[i].periods_z, 1 << level);
            const double k[3] = {w->kx * w->kx, w->kx * w->kz, w->kz * w->kz};
            for (int m = 0; m < 3; m++) {
                exact[m] += w->amplitude * w->amplitude / 2 * k[m] * (1 - d * d);
                whole[m] += w->amplitude * w->amplitude / 2 * k[m];
            }
        }
        double off = 0;
        for (int m = 0; m < 3; m++) {
            off = fmax(off, fabs(ours[m] - exact[m]) / (whole[0] + whole[2]));
            worst = fmax(worst, fabs(kept[m] - whole[m]) / (whole[0] + whole[2]));
        }
        print_message("  level %2d: covariance %.6f %.6f %.6f, of the waves %.6f %.6f %.6f\n", level, ours[0], ours[1], ours[2], exact[0], exact[1], exact[2]);
        expect_below("off, over the whole variance", off, 1e-4);
    }
    expect_below("variance that any level loses", worst, 1e-4);
}

static void looked_up_moments_are_unbiased(void **state)
{
    const map_state *s = *state;
    random_state r = {11};
    double xx = 0, zz = 0;
    for (int i = 0; i < WAVES; i++) {
        xx += pow(s->waves[i].amplitude * s->waves[i].kx, 2) / 2;
        zz += pow(s->waves[i].amplitude * s->waves[i].kz, 2) / 2;
    }
    for (int kind = 0; kind < 4; kind++) {
        /* A pixel from 2 cm to 6 m long, up to 20 times as long as wide, in any direction. */
        const double length = 0.02 * pow(300, kind / 3.0), aspect = kind == 0 ? 1 : 20, angle = 0.7 * kind;
        const Footprint p = {vec2((float)(length / aspect * cos(angle)), (float)(length / aspect * sin(angle))),
                             vec2((float)(-length * sin(angle)), (float)(length * cos(angle))), vec2(0, 0)};
        const int count = 20000;
        double mx = 0, mz = 0, vx = 0, vz = 0;
        for (int k = 0; k < count; k++) {
            const SlopeGaussian g = lean_slopes(&s->bench->cx, (float)random_range(&r, -2000, 2000), (float)random_range(&r, -2000, 2000), p);
            assert_true(g.xx >= 0 && g.zz >= 0);
            mx += ((double)g.xx + (double)(g.mean.x * g.mean.x)) / count, mz += ((double)g.zz + (double)(g.mean.y * g.mean.y)) / count;
            vx += (double)g.xx / count, vz += (double)g.zz / count;
        }
        print_message("  footprint %.2f x %.2f m: unresolved share of the variance %.3f %.3f\n", length / aspect, length, vx / xx, vz / zz);
        expect_below("second moments against the waves', relative", fmax(fabs(mx / xx - 1), fabs(mz / zz - 1)), 0.04);
        if (kind == 0)
            expect_below("a small footprint resolves nearly all", (vx + vz) / (xx + zz), 0.12);
        if (kind == 3)
            assert_true((vx + vz) / (xx + zz) > 0.8);
    }
}

static void masking_is_its_integral(void **state)
{
    (void)state;
    const struct kernel_context cx = {.frame = &(FrameData){.slope_floor = 1e-9f}};
    random_state r = {5};
    double worst = 0;
    for (int k = 0; k < 200; k++) {
        const double elevation = random_range(&r, 0.05, 1.5), azimuth = random_range(&r, -3, 3);
        const double v[3] = {cos(elevation) * cos(azimuth), sin(elevation), cos(elevation) * sin(azimuth)};
        const double mean[2] = {random_range(&r, -0.02, 0.02), random_range(&r, -0.02, 0.02)};
        const double sx = random_range(&r, 0.02, 0.2), sz = random_range(&r, 0.02, 0.2), c = random_range(&r, -0.5, 0.5);
        const SlopeGaussian g =
            slope_gaussian(&cx, vec2((float)mean[0], (float)mean[1]), (Symmetric){(float)(sx * sx), (float)(c * sx * sz), (float)(sz * sz)});
        const double mu = v[1] - v[0] * mean[0] - v[2] * mean[1];
        const double sigma = sqrt(v[0] * v[0] * sx * sx + 2 * v[0] * v[2] * c * sx * sz + v[2] * v[2] * sz * sz);
        if (mu < 0.02 * v[1])
            continue;
        double sum = 0;
        for (int i = 0; i < 4000; i++) {
            const double t = (i + 0.5) / 4000 * 16 - 8;
            sum += fmax(mu + sigma * t, 0) * exp(-t * t / 2) * (16.0 / 4000) / sqrt(turn);
        }
        const double ours = (double)masking(&cx, vec3((float)v[0], (float)v[1], (float)v[2]), g);
        worst = fmax(worst, fabs(ours / (sum / mu) - 1));
    }
    expect_below("1 + Λ, relative", worst, 2e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_are_snapped_by_half_a_period_at_most),
        cmocka_unit_test(texels_are_the_snapped_waves),
        cmocka_unit_test(levels_hold_the_covariance_that_they_filter),
        cmocka_unit_test(looked_up_moments_are_unbiased),
        cmocka_unit_test(masking_is_its_integral),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
