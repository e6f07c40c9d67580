/* SPDX-License-Identifier: MIT
 *
 * Questions about the water at points, against sums in long double; lanes, threads, and what is refused.
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
#include <pthread.h>

#include "cpu/query_lanes.h"
#include "mangata/mangata.h"

enum { WAVES = 64, POINTS = 5003 };

static const double farthest = 1e4; /* metres */

static double random_unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Lengths from half a metre to 200 m, steep as a sea is, in all directions. */
static mgt_water sea(mgt_wave waves[WAVES])
{
    uint64_t state = 5;
    for (int i = 0; i < WAVES; i++) {
        const double k = 2 * M_PI / (0.5 * pow(400, random_unit(&state))), heading = 2 * M_PI * random_unit(&state);
        waves[i] = (mgt_wave){.amplitude = 0.03 / k * random_unit(&state),
                              .kx = k * cos(heading),
                              .kz = k * sin(heading),
                              .omega = sqrt(9.81 * k),
                              .phase = 100 * random_unit(&state)};
    }
    return (mgt_water){.waves = waves, .wave_count = WAVES, .index_of_refraction = 1.333, .level = 12.5};
}

static void scatter(double points[2 * POINTS])
{
    uint64_t state = 11;
    for (int i = 0; i < 2 * POINTS; i++)
        points[i] = farthest * (2 * random_unit(&state) - 1);
}

typedef struct truth {
    long double height, slope[2], rise;
} truth;

static truth truth_at(const mgt_water *water, double time, double x, double z, double least)
{
    truth t = {(long double)water->level, {0, 0}, 0};
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        if (hypot(w->kx, w->kz) * least > 2 * M_PI)
            continue;
        const long double psi = (long double)w->kx * x + (long double)w->kz * z + (long double)w->omega * time + (long double)w->phase;
        const long double a = (long double)w->amplitude, steep = a * cosl(psi);
        t.height += a * sinl(psi);
        t.slope[0] += steep * (long double)w->kx;
        t.slope[1] += steep * (long double)w->kz;
        t.rise += steep * (long double)w->omega;
    }
    return t;
}

static double amplitudes(const mgt_water *water)
{
    double sum = 0;
    for (size_t i = 0; i < water->wave_count; i++)
        sum += water->waves[i].amplitude;
    return sum;
}

typedef struct answer_set {
    double height[POINTS];
    float normal[3 * POINTS], velocity[3 * POINTS];
} answer_set;

static mgt_water_answers ask(answer_set *to)
{
    mgt_water_answers a;
    mgt_water_answers_init(&a, sizeof a);
    a.height = to->height;
    a.normal = to->normal;
    a.velocity = to->velocity;
    return a;
}

static void sums_are_exact(void **state)
{
    (void)state;
    static double points[2 * POINTS];
    static answer_set got;
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves);
    scatter(points);
    const double times[] = {0, 3.25, -86400.5}, leasts[] = {0, 0, 5};
    for (int exact = 0; exact < 2; exact++)
        for (int k = 0; k < 3; k++) {
            mgt_water_answers a = ask(&got);
            a.exact = (uint32_t)exact;
            a.least_wavelength = leasts[k];
            assert_int_equal(mgt_water_query(&water, times[k], points, POINTS, &a), MGT_OK);
            double height = 0, normal = 0, rise = 0;
            for (int i = 0; i < POINTS; i++) {
                const truth t = truth_at(&water, times[k], points[2 * i], points[2 * i + 1], leasts[k]);
                const long double inverse = 1 / sqrtl(1 + t.slope[0] * t.slope[0] + t.slope[1] * t.slope[1]);
                const long double expected[3] = {-t.slope[0] * inverse, inverse, -t.slope[1] * inverse};
                height = fmax(height, fabs((double)((long double)got.height[i] - t.height)));
                for (int c = 0; c < 3; c++)
                    normal = fmax(normal, fabs((double)((long double)got.normal[3 * i + c] - expected[c])));
                rise = fmax(rise, fabs((double)((long double)got.velocity[3 * i + 1] - t.rise)));
                assert_true(got.velocity[3 * i] == 0 && got.velocity[3 * i + 2] == 0);
            }
            print_message("  %s, t = %g s, from %g m: height %.1e m (%.1e of all amplitudes), normal %.1e, velocity %.1e m/s\n", exact ? "double" : "single",
                          times[k], leasts[k], height, height / amplitudes(&water), normal, rise);
            assert_true(height <= (exact ? 1e-9 : 1e-6 * amplitudes(&water)) && normal <= 1e-6 && rise <= 3e-6);
        }
}

static void short_waves_are_a_covariance(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves);
    mgt_water_answers a;
    mgt_water_answers_init(&a, sizeof a);
    double whole[3] = {0}, least = 3;
    for (int i = 0; i < WAVES; i++)
        if (2 * M_PI / hypot(waves[i].kx, waves[i].kz) < least) {
            const double v = waves[i].amplitude * waves[i].amplitude / 2;
            whole[0] += v * waves[i].kx * waves[i].kx, whole[1] += v * waves[i].kx * waves[i].kz, whole[2] += v * waves[i].kz * waves[i].kz;
        }
    a.least_wavelength = least;
    assert_int_equal(mgt_water_query(&water, 0, NULL, 0, &a), MGT_OK);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(a.covariance[i] - whole[i]) <= 1e-14 && (i == 1 || whole[i] > 0));
}

/* With fused multiply-adds the same to the bit; SSE2 has none. */
static void lanes_agree(void **state)
{
    (void)state;
    static double points[2 * POINTS];
    static answer_set expected, got;
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves);
    double none[3];
    water_term room[WAVES];
    const water_terms taken = water_terms_at(&water, 0, 0, room, none);
    assert_int_equal(taken.count, WAVES);
    scatter(points);
    for (uint32_t exact = 0; exact < 2; exact++) {
        mgt_water_answers a = ask(&expected), b = ask(&got);
        a.exact = b.exact = exact;
        query_lanes_1(&taken, water.level, points, POINTS, &a, NULL);
        query_lanes_4(&taken, water.level, points, POINTS, &b, NULL);
        for (int i = 0; i < POINTS; i++)
            assert_true(fabs(got.height[i] - expected.height[i]) <= (exact ? 1e-9 : 1e-6));
#if defined(__x86_64__)
        query_function *const wide[] = {mgt_isa_available(MGT_ISA_AVX2) ? query_lanes_8 : NULL, mgt_isa_available(MGT_ISA_AVX512) ? query_lanes_16 : NULL};
        for (int i = 0; i < 2; i++)
            if (wide[i]) {
                memset(&got, 0, sizeof got);
                wide[i](&taken, water.level, points, POINTS, &b, NULL);
                assert_memory_equal(&got, &expected, sizeof got);
            }
#endif
    }
}

typedef struct asker {
    const mgt_water *water;
    const double *points;
    answer_set got;
    mgt_status status;
} asker;

static void *run_asker(void *user)
{
    asker *self = user;
    mgt_water_answers a = ask(&self->got);
    self->status = mgt_water_query(self->water, 7.5, self->points, POINTS, &a);
    return NULL;
}

/* The same to the bit from eight threads at once, and one point at a time. */
static void threads_agree(void **state)
{
    (void)state;
    enum { THREADS = 8 };
    static double points[2 * POINTS];
    static asker askers[THREADS];
    static answer_set alone;
    pthread_t threads[THREADS];
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves);
    scatter(points);
    for (int i = 0; i < THREADS; i++) {
        askers[i].water = &water;
        askers[i].points = points;
        assert_int_equal(pthread_create(&threads[i], NULL, run_asker, &askers[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        assert_int_equal(askers[i].status, MGT_OK);
        assert_memory_equal(&askers[i].got, &askers[0].got, sizeof alone);
    }
    for (int i = 0; i < POINTS; i += 7) {
        mgt_water_answers a = ask(&alone);
        assert_int_equal(mgt_water_query(&water, 7.5, points + 2 * i, 1, &a), MGT_OK);
        assert_true(alone.height[0] == askers[0].got.height[i] && memcmp(alone.normal, askers[0].got.normal + 3 * i, 3 * sizeof(float)) == 0);
    }
}

/* In double, whose phases are 1e-11 off there. */
static double gap_at(const mgt_water *water, double time, const double ray[6], double along)
{
    const double x = ray[0] + along * ray[3], z = ray[2] + along * ray[5];
    double gap = ray[1] + along * ray[4] - water->level;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        gap -= w->amplitude * sin(w->kx * x + w->kz * z + w->omega * time + w->phase);
    }
    return gap;
}

/* The first change of sides, looked for in small steps. */
static double first_crossing(const mgt_water *water, double time, const double ray[6], double reach, double step)
{
    double before = 0, gap_before = 0;
    for (double along = 0; along <= reach; along += step) {
        const double gap = gap_at(water, time, ray, along);
        if (along > 0 && (gap > 0) != (gap_before > 0)) {
            double low = before, high = along;
            for (int i = 0; i < 60; i++) {
                const double middle = 0.5 * (low + high), there = gap_at(water, time, ray, middle);
                if ((there > 0) == (gap_before > 0))
                    low = middle;
                else
                    high = middle;
            }
            return low;
        }
        before = along;
        gap_before = gap;
    }
    return (double)INFINITY;
}

static void rays_meet_the_first_crest(void **state)
{
    (void)state;
    enum { RAYS = 240 };
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves);
    uint64_t lot = 9;
    static double rays[6 * RAYS], distance[RAYS];
    for (int i = 0; i < RAYS; i++) {
        double *r = rays + 6 * i;
        const double heading = 2 * M_PI * random_unit(&lot), fall = pow(10, -2 * random_unit(&lot)), length = 0.2 + 2 * random_unit(&lot);
        const bool under = i % 3 == 2;
        r[0] = farthest * random_unit(&lot), r[2] = farthest * random_unit(&lot);
        r[1] = water.level + (under ? -1 : 1) * (0.5 + 4 * random_unit(&lot));
        r[3] = length * cos(heading), r[4] = length * fall * (under ? 1 : -1), r[5] = length * sin(heading);
    }
    assert_int_equal(mgt_water_trace(&water, 3.5, rays, RAYS, 40, distance), MGT_OK);
    int hits = 0;
    double worst = 0;
    for (int i = 0; i < RAYS; i++) {
        const double expected = first_crossing(&water, 3.5, rays + 6 * i, 40, 0.01);
        if (isinf(expected) || isinf(distance[i])) {
            assert_true(expected == distance[i]);
            continue;
        }
        hits++;
        worst = fmax(worst, fabs(distance[i] - expected));
    }
    print_message("  %d of %d rays meet the water, off by %.1e at most\n", hits, RAYS, worst);
    assert_true(hits > RAYS / 2 && hits < RAYS && worst <= 1e-6);
}

/* Gap between a ray and choppy water whose waves run along x, which does not fold. The place of rest is found by halving. */
static double gap_at_crests(const mgt_water *water, const double ray[6], double along)
{
    const double x = ray[0] + along * ray[3];
    double low = x - 10, high = x + 10;
    for (int i = 0; i < 50; i++) {
        const double middle = 0.5 * (low + high);
        double to = middle;
        for (size_t j = 0; j < water->wave_count; j++)
            to += (double)water->choppiness * water->waves[j].amplitude * cos(water->waves[j].kx * middle + water->waves[j].phase);
        if (to < x)
            low = middle;
        else
            high = middle;
    }
    double gap = ray[1] + along * ray[4];
    for (size_t j = 0; j < water->wave_count; j++)
        gap -= water->waves[j].amplitude * sin(water->waves[j].kx * low + water->waves[j].phase);
    return gap;
}

/* One wave, and a long one with a short one on its crests, up to nearly upright: no ray from above or from below passes through a crest. */
static void rays_meet_sharp_crests(void **state)
{
    (void)state;
    enum { RAYS = 120 };
    uint64_t lot = 12;
    for (int count = 1; count <= 2; count++)
        for (int steep = 0; steep < 3; steep++) {
            const double pressed = (const double[]){0.3, 0.7, 0.95}[steep], part = count == 1 ? 1 : 0.7;
            const mgt_wave waves[2] = {{.amplitude = part * pressed / 0.6, .kx = 0.6}, {.amplitude = (1 - part) * pressed / 3.1, .kx = 3.1, .phase = 1}};
            const mgt_water water = {.waves = waves, .wave_count = (size_t)count, .choppiness = 1};
            double rays[6 * RAYS], distance[RAYS], worst = 0;
            for (int i = 0; i < RAYS; i++) {
                double *r = rays + 6 * i;
                const double side = i % 2 ? 1 : -1;
                r[0] = 50 * random_unit(&lot), r[1] = side * (2 + 2 * random_unit(&lot)), r[2] = 0;
                r[3] = 2 * random_unit(&lot) - 1, r[4] = -side * pow(10, -1.5 * random_unit(&lot)), r[5] = 0.3;
            }
            assert_int_equal(mgt_water_trace(&water, 0, rays, RAYS, 30, distance), MGT_OK);
            for (int i = 0; i < RAYS; i++) {
                const double *r = rays + 6 * i, start = gap_at_crests(&water, r, 0), end = isinf(distance[i]) ? 30 : distance[i];
                for (double along = 0; along < end - 1e-6; along += 0.02) /* a crest that was passed */
                    worst = fmax(worst, start > 0 ? -gap_at_crests(&water, r, along) : gap_at_crests(&water, r, along));
                if (!isinf(distance[i]))
                    worst = fmax(worst, fabs(gap_at_crests(&water, r, distance[i])));
            }
            print_message("  %d waves pressed by %.2f: off by %.1e m at most\n", count, pressed, worst);
            assert_true(worst <= 1e-8);
        }
}

static void odd_rays_end(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves);
    const double rays[] = {0,
                           100,
                           0,
                           0,
                           -1,
                           0,
                           0,
                           100,
                           0,
                           0,
                           1,
                           0,
                           0,
                           100,
                           0,
                           1,
                           0,
                           0,
                           0,
                           -100,
                           0,
                           0,
                           2,
                           0,
                           0,
                           100,
                           0,
                           0,
                           0,
                           0,
                           (double)NAN,
                           1,
                           0,
                           0,
                           -1,
                           0,
                           0,
                           100,
                           0,
                           0,
                           (double)-INFINITY,
                           0,
                           0,
                           100,
                           0,
                           1e-9,
                           -1e-9,
                           0};
    double distance[8];
    assert_int_equal(mgt_water_trace(&water, 0, rays, 8, 1e9, distance), MGT_OK);
    assert_true(fabs(distance[0] - (100 - 12.5)) < 6 && isinf(distance[1]) && isinf(distance[2]) && fabs(distance[3] - 56.25) < 3);
    assert_true(isnan(distance[4]) && isnan(distance[5]) && isnan(distance[6]) && isinf(distance[7]));
    assert_int_equal(mgt_water_trace(&water, 0, rays, 1, 10, distance), MGT_OK);
    assert_true(isinf(distance[0]));
    const mgt_water flat = {.level = 2, .index_of_refraction = 1.333};
    assert_int_equal(mgt_water_trace(&flat, 0, rays, 1, 1000, distance), MGT_OK);
    assert_true(fabs(distance[0] - 98) < 1e-6);
    assert_int_equal(mgt_water_trace(&flat, 0, rays, 1, -1, distance), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(mgt_last_error(NULL), "reach is -1"));
    assert_int_equal(mgt_water_trace(&flat, 0, NULL, 1, 1, distance), MGT_ERROR_ARGUMENT);
    const double far[] = {0, 9, 0, 0, -1, 0, 0, 9, 2e9, 0, -1, 0};
    distance[0] = -5;
    assert_int_equal(mgt_water_trace(&flat, 0, far, 2, 100, distance), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(mgt_last_error(NULL), "mgt_water_trace: origin 1: coordinate 2 is 2e+09 m"));
    assert_true(distance[0] == -5);
    assert_int_equal(mgt_water_trace(&flat, 0, far, 1, 100, distance), MGT_OK);
    assert_int_equal(mgt_water_trace(NULL, 0, rays, 1, 1, distance), MGT_ERROR_ARGUMENT);
}

static void expect_refused(const mgt_water *water, double time, const double *points, mgt_water_answers a, mgt_status status, const char *words)
{
    double before = -5;
    a.height = &before;
    assert_int_equal(mgt_water_query(water, time, points, 1, &a), status);
    if (!strstr(mgt_last_error(NULL), words))
        fail_msg("'%s' lacks '%s'", mgt_last_error(NULL), words);
    assert_true(before == -5);
}

static void bad_questions_are_refused(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    mgt_water water = sea(waves);
    mgt_water_answers a;
    mgt_water_answers_init(&a, sizeof a);
    const double point[2] = {1, 2};
    expect_refused(NULL, 0, point, a, MGT_ERROR_ARGUMENT, "the water is NULL");
    expect_refused(&water, 0, NULL, a, MGT_ERROR_ARGUMENT, "the list of points is NULL");
    expect_refused(&water, (double)NAN, point, a, MGT_ERROR_ARGUMENT, "the time is nan s");
    expect_refused(&water, 2e9, point, a, MGT_ERROR_ARGUMENT, "allowed is -1e9 to 1e9");
    static const double far[][2] = {{1.001e9, 0}, {0, -2e9}, {-1e300, 1}, {(double)NAN, 1e10}};
    for (size_t i = 0; i < sizeof far / sizeof *far; i++)
        expect_refused(&water, 0, far[i], a, MGT_ERROR_ARGUMENT, "m; allowed is -1e9 to 1e9");
    expect_refused(&water, 0, far[1], a, MGT_ERROR_ARGUMENT, "mgt_water_query: point 0: coordinate 1 is -2e+09 m");
    mgt_water_answers wrong = a;
    wrong.least_wavelength = -1;
    expect_refused(&water, 0, point, wrong, MGT_ERROR_ARGUMENT, "least_wavelength is -1 m");
    wrong = a;
    wrong.exact = 2;
    expect_refused(&water, 0, point, wrong, MGT_ERROR_ARGUMENT, "exact is 2");
    wrong = a;
    wrong.struct_size = 3;
    expect_refused(&water, 0, point, wrong, MGT_ERROR_ARGUMENT, "struct_size is 3");
    waves[3].kx = (double)NAN;
    expect_refused(&water, 0, point, a, MGT_ERROR_SCENE, "water.waves[3].kx is nan");
    waves[3].kx = 0;
    water.level = (double)INFINITY;
    expect_refused(&water, 0, point, a, MGT_ERROR_SCENE, "water.level is inf");
    assert_int_equal(mgt_water_query(&water, 0, point, 1, NULL), MGT_ERROR_ARGUMENT);
}

static void what_is_not_finite_gets_nan(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    mgt_water water = sea(waves);
    const double points[] = {1, 2, (double)NAN, 0, 3, (double)INFINITY, 5, 6};
    double height[4];
    for (uint32_t exact = 0; exact < 2; exact++) {
        mgt_water_answers a;
        mgt_water_answers_init(&a, sizeof a);
        a.height = height;
        a.exact = exact;
        assert_int_equal(mgt_water_query(&water, 0, points, 4, &a), MGT_OK);
        assert_true(isfinite(height[0]) && isnan(height[1]) && isnan(height[2]) && isfinite(height[3]));
        water.wave_count = 0;
        assert_int_equal(mgt_water_query(&water, 0, points, 1, &a), MGT_OK);
        assert_true(height[0] == water.level);
        assert_int_equal(mgt_water_query(&water, 0, points + 2, 1, &a), MGT_OK);
        assert_true(isnan(height[0]));
        water.wave_count = WAVES;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_exact), cmocka_unit_test(short_waves_are_a_covariance), cmocka_unit_test(lanes_agree),
        cmocka_unit_test(threads_agree),  cmocka_unit_test(rays_meet_the_first_crest),    cmocka_unit_test(rays_meet_sharp_crests),
        cmocka_unit_test(odd_rays_end),   cmocka_unit_test(bad_questions_are_refused),    cmocka_unit_test(what_is_not_finite_gets_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
