/* SPDX-License-Identifier: MIT
 *
 * surface.k at one lane, with tiles as the backend builds them, against the sum of sines in double precision.
 */
#include "kernel_lane.h"

static const double pi = 3.14159265358979323846;

enum { WAVES = 64 };

typedef struct bounds {
    double height, slope, bend;
} bounds;

/* What float allows at (x, z) metres from the tile's origin. A phase in turns is a sum of two products and a constant, each kept to
 * 2⁻²⁴ of itself, of a wave vector kept as well: with the additions 4 roundings of |x turns_x| + |z turns_z| and 2 of the constant,
 * at most half. sincos_wave() adds 1.2e-5 to the sine and 3.5e-6 to the cosine, the sum over the waves a rounding each. */
static bounds float_bounds(const mgt_scene *scene, double x, double z)
{
    bounds b = {1e-9, 1e-9, 1e-9};
    for (size_t i = 0; i < scene->water.wave_count; i++) {
        const mgt_wave *w = &scene->water.waves[i];
        const double turns = (fabs(w->kx * x) + fabs(w->kz * z)) / (2 * pi);
        const double rounding = 2 * pi * 0x1p-24 * (4 * turns + 1) + (double)scene->water.wave_count * 0x1p-24;
        const double sine = rounding + 1.2e-5, cosine = rounding + 3.5e-6;
        const double k = hypot(w->kx, w->kz);
        b.height += w->amplitude * sine;
        b.slope += w->amplitude * k * cosine;
        b.bend += w->amplitude * k * k * sine;
    }
    return b;
}

/* The worst error over its bound, for points all over some tiles. */
static double surface_error(const kernel_bench *b, random_state *r, const double reach)
{
    double worst = 0;
    for (int i = 0; i < 200; i++) {
        const float x = (float)random_range(r, -reach, reach), z = (float)random_range(r, -reach, reach);
        const Surface s = surface_full(&b->cx, x, z, vec2(0, 0));
        const double *camera = b->scene.camera.position;
        const water_point exact = water_surface(&b->scene.water, camera[0] + (double)b->tile.data.origin_x + (double)x,
                                                camera[2] + (double)b->tile.data.origin_z + (double)z, b->scene.time);
        const bounds limit = float_bounds(&b->scene, (double)x, (double)z);
        worst = fmax(worst, fabs((double)s.height_even - exact.height) / limit.height);
        worst = fmax(worst, fabs((double)s.slope_even.x - exact.slope[0]) / limit.slope);
        worst = fmax(worst, fabs((double)s.slope_even.y - exact.slope[1]) / limit.slope);
        worst = fmax(worst, fabs((double)s.bend_xx - exact.hessian[0]) / limit.bend);
        worst = fmax(worst, fabs((double)s.bend_xz - exact.hessian[1]) / limit.bend);
        worst = fmax(worst, fabs((double)s.bend_zz - exact.hessian[2]) / limit.bend);
    }
    return worst;
}

static double surface_error_at(double east, double south, double time)
{
    random_state r = {11};
    mgt_wave waves[WAVES];
    random_waves(&r, waves, WAVES, 0.1, 20, 0.2);
    mgt_scene scene = black_scene(640, 360, waves, WAVES);
    scene.time = time;
    for (int i = 0; i < 2; i++) {
        mgt_camera *c = i ? &scene.camera_open : &scene.camera;
        c->position[0] += east, c->target[0] += east;
        c->position[2] += south, c->target[2] += south;
    }
    kernel_bench *b = kernel_bench_create(&scene);
    double worst = 0;
    for (uint32_t y = 120; y < 360; y += 48)
        for (uint32_t x = 0; x < 640; x += 160) {
            kernel_bench_tile(b, false, false, x, y);
            assert_int_equal(b->tile.data.resolved_count, WAVES);
            worst = fmax(worst, surface_error(b, &r, 10));
        }
    kernel_bench_destroy(b);
    return worst;
}

static void full_surface_is_the_sum_of_sines(void **state)
{
    (void)state;
    expect_below("height, slope, bend: worst over float's bound", surface_error_at(0, 0, 10), 1);
}

/* Phases are reduced in double, whose own rounding at 100 km and 60 rad/m is 1e5·60·1e-16 = 7e-10 radians: nothing. */
static void nothing_is_lost_far_from_the_origin(void **state)
{
    (void)state;
    expect_below("the same, 100 km away", surface_error_at(1e5, -1e5, 10), 1);
    expect_below("the same, a day later", surface_error_at(0, 0, 86400), 1);
}

static void shutter_ends_come_by_rotation(void **state)
{
    (void)state;
    random_state r = {12};
    mgt_wave waves[WAVES];
    random_waves(&r, waves, WAVES, 0.1, 20, 0.2);
    double worst = 0;
    static const double shutters[] = {0, 1.0 / 120, 1.0 / 30, 0.5};
    for (size_t k = 0; k < sizeof shutters / sizeof *shutters; k++) {
        mgt_scene scene = black_scene(640, 360, waves, WAVES);
        scene.shutter = shutters[k];
        kernel_bench *b = kernel_bench_create(&scene);
        kernel_bench_tile(b, true, false, 320, 300);
        const Footprint p = {{0, 0}, {0, 0}, {0, 0}};
        for (int i = 0; i < 500; i++) {
            const float x = (float)random_range(&r, -5, 5), z = (float)random_range(&r, -5, 5);
            const Surface s = surface_filtered(&b->cx, vec3(0, -1, 0), 1, x, z, p, vec2(0, 0));
            const double at[2] = {scene.camera.position[0] + (double)b->tile.data.origin_x + (double)x,
                                  scene.camera.position[2] + (double)b->tile.data.origin_z + (double)z};
            const bounds limit = float_bounds(&scene, (double)x, (double)z);
            for (int end = 0; end < 2; end++) {
                const double sign = end ? 1 : -1; /* close, open */
                const water_point exact = water_surface(&scene.water, at[0], at[1], end ? scene.time - scene.shutter : scene.time);
                worst = fmax(worst, fabs((double)s.slope_even.x + sign * (double)s.slope_odd.x - exact.slope[0]) / limit.slope);
                worst = fmax(worst, fabs((double)s.slope_even.y + sign * (double)s.slope_odd.y - exact.slope[1]) / limit.slope);
                worst = fmax(worst, fabs((double)s.height_even - sign * (double)s.height_odd - exact.height) / limit.height);
            }
        }
        kernel_bench_destroy(b);
    }
    /* Two sines take part in each, so twice the bound of one. */
    expect_below("slope and height at t and t - T, over the bound", worst, 2);
}

/* One wave of a given frequency, seen straight from above: a footprint of one metre a pixel. */
static kernel_bench *one_wave_bench(mgt_wave *wave, double frequency, bool mixed)
{
    *wave = (mgt_wave){.amplitude = 0.01, .kx = 2 * pi * frequency * 0.8, .kz = 2 * pi * frequency * 0.6, .phase = 0.4};
    mgt_scene scene = black_scene(64, 64, wave, 1);
    scene.shutter = 0;
    scene.time = 0;
    kernel_bench *b = kernel_bench_create(&scene);
    kernel_bench_tile(b, true, false, 0, 0);
    b->tile.data.mixed_count = mixed ? 1 : 0; /* wherever the tile would have put it */
    b->tile.data.resolved_count = mixed ? 0 : 1;
    return b;
}

/* What the filtered surface keeps of a wave's slope variance A²k²/2: the variance of its mean slope, of its bend over the pixel, and what
 * it calls unresolved. */
typedef struct variance_split {
    double mean, bend, unresolved;
} variance_split;

static variance_split split_of(const kernel_bench *b, const mgt_wave *wave, double frequency)
{
    enum { PHASES = 64 };
    const Footprint p = {{1, 0}, {0, 1}, {0, 0}};
    variance_split v = {0};
    const double k = 2 * pi * frequency;
    for (int i = 0; i < PHASES; i++) {
        const double along = (double)i / PHASES / frequency; /* metres along the wave */
        const Surface s = surface_filtered(&b->cx, vec3(0, -1, 0), 1, (float)(0.8 * along), (float)(0.6 * along), p, vec2(0, 0));
        v.mean += (double)(s.slope_even.x * s.slope_even.x + s.slope_even.y * s.slope_even.y) / PHASES;
        v.bend += (double)(s.bend_xx * s.bend_xx + 2 * s.bend_xz * s.bend_xz + s.bend_zz * s.bend_zz) / 12 / PHASES;
        v.unresolved += (double)(s.variance_xx + s.variance_zz) / PHASES;
    }
    const double whole = wave->amplitude * wave->amplitude * k * k / 2;
    v.mean /= whole, v.bend /= whole, v.unresolved /= whole;
    return v;
}

/* A ray of fall F meets a surface of height h by h/F nearer to the eye, so that the mean slope that a screen sees of a wave is off by A²k²/(2F) towards
 * the eye, to first order. Of the resolved part r it is r times that: the whole wave lifts the surface, though its slope is not seen whole. */
static void waves_lift_the_surface_whole(void **state)
{
    (void)state;
    enum { PHASES = 64 };
    const Footprint p = {{1, 0}, {0, 1}, {0, 0}};
    const double fall = 0.3;
    double worst = 0;
    for (int i = 1; i <= 10; i++) {
        const double frequency = i / 10.0, k = 2 * pi * frequency, resolved = pow(1 - frequency * frequency / 1.44, 2);
        mgt_wave wave;
        kernel_bench *b = one_wave_bench(&wave, frequency, true);
        double mean = 0;
        for (int j = 0; j < PHASES; j++) {
            const double along = (double)j / PHASES / frequency;
            const Surface s = surface_filtered(&b->cx, vec3(0, -1, 0), 1, (float)(0.8 * along), (float)(0.6 * along), p, vec2(0, 0));
            const double bend = 0.64 * (double)s.bend_xx + 0.96 * (double)s.bend_xz + 0.36 * (double)s.bend_zz;
            mean += (0.8 * (double)s.slope_even.x + 0.6 * (double)s.slope_even.y - bend * (double)s.height_even / fall) / PHASES;
        }
        worst = fmax(worst, fabs(mean / (resolved * pow(wave.amplitude * k, 2) / 2 / fall) - 1));
        kernel_bench_destroy(b);
    }
    expect_below("mean slope that a screen sees, relative", worst, 1e-3);
}

/* Up to .31 cycles a pixel the bend alone makes up for what the mean lost, and a little more: unresolved_variance() is clamped at 0. The
 * excess of (1 − f²/1.44)⁴ (1 + 3.29 f²) over 1 is .0113 at its largest, f = .21. */
static void split_keeps_the_variance(void **state)
{
    (void)state;
    double least = 2, most = 0, beyond = 0;
    for (int i = 1; i <= 150; i++) {
        mgt_wave wave;
        kernel_bench *b = one_wave_bench(&wave, i / 100.0, true);
        const variance_split v = split_of(b, &wave, i / 100.0);
        least = fmin(least, v.mean + v.bend + v.unresolved);
        most = fmax(most, v.mean + v.bend + v.unresolved);
        if (i >= 35)
            beyond = fmax(beyond, fabs(v.mean + v.bend + v.unresolved - 1));
        if (i > 120)
            assert_true(v.mean == 0 && v.bend == 0 && fabs(v.unresolved - 1) < 1e-5);
        kernel_bench_destroy(b);
    }
    expect_below("variance lost at any frequency", 1 - least, 1e-5);
    expect_below("variance changed from .35 cycles a pixel on", beyond, 1e-5);
    expect_below("variance too much at any frequency", most - 1, 0.0114);
}

/* The mean slope of a box pixel begins as A k (1 − (2πf)²/24) cos ψ; ours stays within a fiftieth of it to .2 cycles a pixel. */
static void split_follows_the_box_filter(void **state)
{
    (void)state;
    double worst = 0, total = 0;
    for (int i = 1; i <= 100; i++) {
        const double frequency = i / 100.0;
        mgt_wave wave;
        kernel_bench *b = one_wave_bench(&wave, frequency, true);
        const variance_split v = split_of(b, &wave, frequency);
        double mean = 0, spread = 0;
        for (int j = 0; j < 32; j++) {
            const filtered_sine s = box_filter_sine(2 * pi * j / 32.0, (double[]){wave.kx, wave.kz});
            mean += 2 * s.mean_cosine * s.mean_cosine / 32;
            spread += 2 * s.variance_cosine / 32;
        }
        if (frequency <= 0.2)
            worst = fmax(worst, fabs(sqrt(v.mean) - sqrt(mean)));
        if (frequency <= 0.3)
            total = fmax(total, fabs(v.bend + v.unresolved - spread));
        kernel_bench_destroy(b);
    }
    expect_below("amplitude of the mean slope against a box, f to .2", worst, 0.02);
    expect_below("variance within the pixel against a box, f to .3", total, 0.05);
}

/* Share of its amplitude with which a wave stands in a tile's list. */
static double listed_share(const WaveData *w)
{
    const double x = hypot((double)w->even_x, (double)w->odd_x), z = hypot((double)w->even_z, (double)w->odd_z);
    return hypot(x, z) / ((double)w->amplitude * hypot((double)w->k_x, (double)w->k_z));
}

/* Slope variance that a listed wave still stands for: its mean's and its bend's, at the frequency that its share tells. */
static double listed_variance(const kernel_bench *b, const WaveData *w)
{
    const double variance = (double)w->variance_xx + (double)w->variance_zz, share = listed_share(w);
    if (share > 1 - 1e-6)
        return variance;
    const double frequency = (1 - sqrt(share)) / (double)b->frame.data.ramp_scale;
    return variance * fmin(share * share * (1 + 3.2898681 * frequency), 1);
}

/* What a tile takes out of its lists is found again in its sums, and one share for a whole tile is near each pixel's own. */
static void tiles_sort_without_loss(void **state)
{
    (void)state;
    random_state r = {13};
    mgt_wave waves[WAVES];
    random_waves(&r, waves, WAVES, 0.02, 40, 0.2);
    const mgt_scene scene = black_scene(640, 360, waves, WAVES);
    double whole = 0;
    for (int i = 0; i < WAVES; i++)
        whole += waves[i].amplitude * waves[i].amplitude * (waves[i].kx * waves[i].kx + waves[i].kz * waves[i].kz) / 2;
    kernel_bench *b = kernel_bench_create(&scene);
    double lost = 0, share_error = 0;
    int resolved = 0, mixed = 0, filtered = 0;
    for (uint32_t y = 0; y < 360; y += TILE_HEIGHT)
        for (uint32_t x = 0; x < 640; x += TILE_WIDTH) {
            kernel_bench_tile(b, true, true, x, y);
            const TileData *d = &b->tile.data;
            double sum = (double)d->filtered_xx + (double)d->filtered_zz;
            for (int i = 0; i < d->resolved_count + d->mixed_count; i++)
                sum += listed_variance(b, &b->tile.waves[i]);
            lost = fmax(lost, fabs(sum / whole - 1));
            resolved += d->resolved_count > 0;
            mixed += d->mixed_count > 0;
            filtered += d->filtered_xx > 0;
            /* At every pixel the lists say what frequencies say. */
            const vec3 ray = kernel_bench_ray(b, x + 16, y + 8);
            if (ray.y > -0.01f)
                continue;
            const Footprint p = footprint_at(&b->cx, ray, d->camera_height / -ray.y);
            for (int i = 0; i < d->resolved_count; i++) {
                const real frequency = wave_frequency(&b->cx, p, b->tile.waves[i]);
                share_error = fmax(share_error, fabs(listed_share(&b->tile.waves[i]) - (double)resolved_weight(&b->cx, frequency)));
            }
        }
    kernel_bench_destroy(b);
    assert_true(resolved > 0 && mixed > 0 && filtered > 0);
    expect_below("slope variance lost by sorting", lost, 1e-5);
    expect_below("share of a tile against a pixel's", share_error, 0.04);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_surface_is_the_sum_of_sines), cmocka_unit_test(nothing_is_lost_far_from_the_origin),
        cmocka_unit_test(shutter_ends_come_by_rotation),    cmocka_unit_test(waves_lift_the_surface_whole),
        cmocka_unit_test(split_keeps_the_variance),         cmocka_unit_test(split_follows_the_box_filter),
        cmocka_unit_test(tiles_sort_without_loss),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
