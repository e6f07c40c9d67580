/* SPDX-License-Identifier: MIT
 *
 * first_hit.k and the last steps of sample.k at one lane against the brute-force first hit, on random rays over a rough sea.
 */
#include "kernel_lane.h"

enum { WIDTH = 640, HEIGHT = 360, WAVES = 48, RAYS = 500 };

typedef struct search_figures {
    double before, beyond; /* how far the search stops before the hit, and goes beyond it, in its own tolerance */
    double off;            /* share of the hits off by more than max(1%, 5 mm) */
    double median, slope;  /* of the distance's relative error and the slope's */
    double missed;         /* share of rays that disagree on there being water at all */
} search_figures;

static search_figures search_random_rays(const mgt_scene *scene, uint64_t seed, double lowest_row)
{
    kernel_bench *b = kernel_bench_create(scene);
    random_state r = {seed};
    static double error[RAYS], slope_error[RAYS];
    search_figures f = {0};
    size_t count = 0;
    int off = 0, missed = 0;
    for (int i = 0; i < RAYS; i++) {
        const uint32_t x = (uint32_t)random_range(&r, 0, WIDTH), y = (uint32_t)random_range(&r, lowest_row, HEIGHT);
        kernel_bench_tile(b, false, false, x, y);
        const vec3 ray = kernel_bench_ray(b, x, y);
        const double length = sqrt((double)(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z));
        const SampleHit hit = sample_hit(&b->cx, ray, (HitEstimate){0, 0, 1, {0, 0}, {0, 0}});
        const water_hit exact = first_hit_brute_force(scene, x + 0.5, y + 0.5, scene->time);
        if ((hit.found > 0) != exact.hit) {
            missed++;
            continue;
        }
        if (!exact.hit)
            continue;
        const double distance = (double)hit.along * length, wrong = fabs(distance - exact.distance);
        error[count] = wrong / exact.distance;
        slope_error[count++] = hypot((double)hit.slope.x - exact.water.slope[0], (double)hit.slope.y - exact.water.slope[1]);
        if (!(wrong <= fmax(0.01 * exact.distance, 0.005))) {
            off++;
            continue;
        }
        const SearchHit search_hit = search(&b->cx, ray, 0, 1);
        const double horizontal = sqrt((double)(ray.x * ray.x + ray.z * ray.z)) / length;
        const double gap = (exact.distance - (double)search_hit.along * length) * horizontal / (double)b->tile.data.search_tolerance;
        f.before = fmax(f.before, gap);
        f.beyond = fmax(f.beyond, -gap);
    }
    kernel_bench_destroy(b);
    f.off = (double)off / RAYS;
    f.missed = (double)missed / RAYS;
    f.median = quantile(error, count, 0.5);
    f.slope = quantile(slope_error, count, 0.95);
    return f;
}

static mgt_scene rough_sea(mgt_wave *waves, double slope_rms)
{
    random_state r = {41};
    random_waves(&r, waves, WAVES, 0.15, 15, slope_rms);
    mgt_scene s = black_scene(WIDTH, HEIGHT, waves, WAVES);
    s.camera.position[1] = 6;
    s.camera.target[1] = 5.9;
    return s;
}

static void steep_views_meet_the_surface(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = rough_sea(waves, 0.18);
    const search_figures f = search_random_rays(&scene, 42, 250);
    expect_below("steep: share off by more than max(1%, 5 mm)", f.off, 0.004);
    expect_below("steep: rays missed", f.missed, 0);
    expect_below("steep: distance, relative, median", f.median, 2e-6);
    expect_below("steep: slope, 95 of 100", f.slope, 1e-4);
    expect_below("steep: search beyond the hit, in its tolerance", f.beyond, 0.01);
}

static void grazing_views_meet_the_first_crest(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = rough_sea(waves, 0.18);
    const search_figures f = search_random_rays(&scene, 43, 168);
    expect_below("grazing: share off by more than max(1%, 5 mm)", f.off, 0.005);
    expect_below("grazing: rays missed", f.missed, 0.002);
    expect_below("grazing: distance, relative, median", f.median, 2e-6);
    expect_below("grazing: search beyond the hit, in its tolerance", f.beyond, 0.01);
}

/* walks_coarsely() reckons with how far sincos_coarse() moves the surface: 3e-4 of the search's bound over many waves. At most it is the error of a sine times
 * the sum of all amplitudes. */
static void coarse_sines_move_the_surface_little(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = rough_sea(waves, 0.18);
    kernel_bench *b = kernel_bench_create(&scene);
    random_state r = {45};
    double squares = 0, most = 0, sum = 0;
    for (int i = 0; i < WAVES; i++)
        sum += waves[i].amplitude;
    for (int i = 0; i < RAYS; i++) {
        const uint32_t x = (uint32_t)random_range(&r, 0, WIDTH), y = (uint32_t)random_range(&r, 190, HEIGHT);
        kernel_bench_tile(b, false, false, x, y);
        const vec3 ray = kernel_bench_ray(b, x, y);
        const int count = b->tile.data.search_count;
        const float along = 6 / -ray.y;
        const double moved =
            (double)(search_gap(&b->cx, ray, along, vec2(0, 0), count, true).gap - search_gap(&b->cx, ray, along, vec2(0, 0), count, false).gap);
        squares += pow(moved / (double)b->tile.data.search_bound, 2) / RAYS;
        most = fmax(most, fabs(moved) / sum);
    }
    kernel_bench_destroy(b);
    expect_below("coarse sines: height, over the search's bound", sqrt(squares), 3e-4);
    expect_below("coarse sines: height, over the sum of amplitudes", most, 1e-3);
    assert_true(most > 1e-5);
}

/* Crests above the camera can only be met by searching from the camera on. */
static void low_cameras_see_crests_above_them(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    mgt_scene scene = rough_sea(waves, 0.1);
    double crest = 0;
    for (int i = 0; i < WAVES; i++)
        crest += waves[i].amplitude;
    const double above = water_surface(&scene.water, 0, 0, scene.time).height;
    scene.camera.position[1] = fmax(above, 0) + 0.15;
    scene.camera.target[1] = scene.camera.position[1] - 0.05;
    assert_true(scene.camera.position[1] < crest);
    const search_figures f = search_random_rays(&scene, 44, 0);
    expect_below("among crests: share off by more than max(1%, 5 mm)", f.off, 0.01);
    expect_below("among crests: rays missed", f.missed, 0.01);
}

/* Without a search the estimate is all there is: a height some millimetres off is mended by Newton's steps, and the slope with it. A
 * slope's error is then of second order, half of the third derivative A k³ times the step squared. */
static void good_estimates_are_mended(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = rough_sea(waves, 0.1);
    kernel_bench *b = kernel_bench_create(&scene);
    random_state r = {45};
    static double error[RAYS], before[RAYS], distance[RAYS];
    for (int i = 0; i < RAYS; i++) {
        const uint32_t x = (uint32_t)random_range(&r, 0, WIDTH), y = (uint32_t)random_range(&r, 300, HEIGHT);
        const water_hit exact = first_hit_brute_force(&scene, x + 0.5, y + 0.5, scene.time);
        kernel_bench_tile(b, false, false, x, y);
        const vec3 ray = kernel_bench_ray(b, x, y);
        const double off = random_range(&r, -0.001, 0.001);
        const SampleHit hit = sample_hit(&b->cx, ray, (HitEstimate){(float)(exact.water.height + off), 0, 0, {0, 0}, {0, 0}});
        const double length = sqrt((double)(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z)), reach = exact.distance + off * length / (double)ray.y;
        const double *camera = scene.camera.position;
        const water_point there =
            water_surface(&scene.water, camera[0] + (double)ray.x / length * reach, camera[2] + (double)ray.z / length * reach, scene.time);
        before[i] = hypot(there.slope[0] - exact.water.slope[0], there.slope[1] - exact.water.slope[1]);
        error[i] = hypot((double)hit.slope.x - exact.water.slope[0], (double)hit.slope.y - exact.water.slope[1]);
        distance[i] = fabs((double)hit.along * length - exact.distance) / exact.distance;
    }
    kernel_bench_destroy(b);
    const double whole = quantile(before, RAYS, 0.9), left = quantile(error, RAYS, 0.9);
    assert_true(whole > 0.001);
    expect_below("estimate 1 mm off: slope's error, of that at the estimate", left / whole, 0.08);
    expect_below("estimate 1 mm off: distance, relative, nine of ten", quantile(distance, RAYS, 0.9), 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steep_views_meet_the_surface),
        cmocka_unit_test(grazing_views_meet_the_first_crest),
        cmocka_unit_test(coarse_sines_move_the_surface_little),
        cmocka_unit_test(low_cameras_see_crests_above_them),
        cmocka_unit_test(good_estimates_are_mended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
