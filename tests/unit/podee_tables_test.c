/* SPDX-License-Identifier: MIT
 *
 * The tables of podee-* with kernels, read by podee_mixture.k at one lane, against quadrature; and what they cost.
 */
#include "kernel_lane.h"

#include <time.h>

#include "base/thread_pool.h"
#include "frame/podee_tables.h"

static podee_tables tables;

typedef struct index_loop {
    void (*body)(void *, size_t);
    void *argument;
} index_loop;

static void run_index(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const index_loop *l = argument;
    l->body(l->argument, index);
}

static void run_indices(void *pool, size_t count, void (*body)(void *, size_t), void *argument)
{
    index_loop l = {body, argument};
    const thread_loop loop = {count, run_index, &l, NULL};
    thread_pool_run(pool, &loop);
}

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int make_tables(void **state)
{
    thread_pool *pool = thread_pool_create(2);
    *state = pool;
    return pool && podee_tables_build(&tables, run_indices, pool) ? 0 : -1;
}

static int free_tables(void **state)
{
    podee_tables_free(&tables);
    thread_pool_destroy(*state);
    return 0;
}

/* In units of the disk's radius. */
static double exact_mean(const double p0[2], const double p1[2], double deviation)
{
    const double covariance[3] = {deviation * deviation, 0, deviation * deviation};
    return disk_path_quadrature(p0, p1, covariance, 1);
}

/* Anywhere within the tables' reach; half of them where the disk's edge makes them steep. */
static double random_coordinate(random_state *r, double deviation)
{
    const double reach = 1 + 4 * deviation;
    const double c = random_unit(r) < 0.5 ? random_range(r, 0, reach) : fabs(1 + random_range(r, -2, 2) * deviation);
    return random_unit(r) < 0.5 ? c : -c;
}

static double random_deviation(random_state *r) { return 0.02 * pow(400, random_unit(r)); }

static void texels_are_the_integrals(void **state)
{
    (void)state;
    random_state r = {51};
    double sweep = 0, share = 0;
    for (int i = 0; i < 1500; i++) {
        const int slice = (int)(random_unit(&r) * PODEE_SLICES), row = (int)(random_unit(&r) * PODEE_ROWS), column = (int)(random_unit(&r) * PODEE_COLUMNS);
        const double deviation = podee_slice_deviation(slice), spacing = podee_slice_reach(slice) / (PODEE_ROWS - 1);
        const double from[2] = {0, column * spacing}, to[2] = {row * spacing, column * spacing}, on[2] = {0, column * spacing};
        const double s = row * spacing * exact_mean(from, to, deviation);
        sweep = fmax(sweep, fabs((double)tables.sweep[((size_t)slice * PODEE_ROWS + (size_t)row) * PODEE_COLUMNS + (size_t)column] - s));
        share = fmax(share, fabs((double)tables.share[(size_t)slice * PODEE_COLUMNS + (size_t)column] - exact_mean(on, on, deviation)));
    }
    expect_below("texels of S against quadrature", sweep, 1e-5);
    expect_below("texels of F", share, 1e-6);
}

static void look_ups_hold_over_the_whole_range(void **state)
{
    (void)state;
    random_state r = {52};
    const struct kernel_context cx = {.podee = &tables};
    double sweep = 0, share = 0;
    for (int i = 0; i < 4000; i++) {
        const double deviation = random_deviation(&r), u = random_coordinate(&r, deviation), v = random_coordinate(&r, deviation);
        const TablePlace place = table_place(&cx, (float)deviation);
        const double from[2] = {0, v}, to[2] = {u, v}, at[2] = {hypot(u, v), 0};
        sweep = fmax(sweep, fabs((double)table_sweep(&cx, place, (float)u, (float)v) - u * exact_mean(from, to, deviation)));
        share = fmax(share, fabs((double)table_fraction(&cx, place, (float)at[0]) - exact_mean(at, at, deviation)));
    }
    expect_below("S(u, v) over ±R, σ .02 to 8", sweep, 2e-3);
    expect_below("F(r)", share, 2e-3);
}

/* Segments of any length, from a still reflection to one that jumps over the whole table. */
static void paths_hold_over_the_whole_range(void **state)
{
    (void)state;
    random_state r = {53};
    const struct kernel_context cx = {.podee = &tables};
    double worst = 0, wide = 0;
    for (int i = 0; i < 4000; i++) {
        const double deviation = random_deviation(&r), length = (1 + deviation) * pow(10, random_range(&r, -4, 0.7)), heading = random_range(&r, -3.2, 3.2);
        const double from[2] = {random_coordinate(&r, deviation), random_coordinate(&r, deviation)};
        const double step[2] = {length * cos(heading), length * sin(heading)}, to[2] = {from[0] + step[0], from[1] + step[1]};
        const float mean = circular_kernel(&cx, vec2((float)from[0], (float)from[1]), vec2((float)step[0], (float)step[1]), (float)deviation);
        worst = fmax(worst, fabs((double)mean - exact_mean(from, to, deviation)));
        /* Far wider than the tables: a disk that is a point. */
        const double factor = 8 / deviation * pow(10, random_range(&r, 0, 2));
        const double far_from[2] = {from[0] * factor, from[1] * factor}, far_to[2] = {to[0] * factor, to[1] * factor};
        const double exact = exact_mean(far_from, far_to, deviation * factor);
        const float far = circular_kernel(&cx, vec2((float)far_from[0], (float)far_from[1]), vec2((float)(step[0] * factor), (float)(step[1] * factor)),
                                          (float)(deviation * factor));
        wide = fmax(wide, fabs((double)far - exact) * pow(deviation * factor, 2));
    }
    expect_below("mean over a path", worst, 2e-3);
    expect_below("the same, σ 8 to 800, times σ²", wide, 2e-3);
}

/* The whole way from slopes' covariance on the light plane: a circle is one kernel of weight 1. */
static void any_light_radius_uses_the_same_tables(void **state)
{
    (void)state;
    random_state r = {54};
    double worst = 0;
    for (int i = 0; i < 3000; i++) {
        const double radius = pow(10, random_range(&r, -5, -0.44)), deviation = random_deviation(&r), length = random_range(&r, 0, 2 + deviation);
        const FrameData data = {.podee_kernels = MGT_MIXTURE_1, .podee_elongation = 1e6f, .lights[0].disk_radius = (float)radius};
        const struct kernel_context cx = {.frame = &data, .podee = &tables};
        const double heading = random_range(&r, -3.2, 3.2), from[2] = {random_coordinate(&r, deviation), random_coordinate(&r, deviation)};
        const double to[2] = {from[0] + length * cos(heading), from[1] + length * sin(heading)};
        const float variance = (float)(deviation * deviation * radius * radius);
        const float share = mixture_disk_path(&cx, vec2((float)(from[0] * radius), (float)(from[1] * radius)),
                                              vec2((float)(to[0] * radius), (float)(to[1] * radius)), (Symmetric){variance, 0, variance}, (float)radius);
        worst = fmax(worst, fabs((double)share - exact_mean(from, to, deviation)));
    }
    expect_below("circles through the whole way, radius 1e-5 to .36", worst, 2e-3);
}

/* Half of the processor time that two threads take is what two free processors need, however busy this machine is. */
static void tables_are_cheap(void **state)
{
    double least = 1e9, least_busy = 1e9;
    for (int i = 0; i < 5; i++) {
        podee_tables other = {0};
        const double start = seconds(CLOCK_MONOTONIC), start_busy = seconds(CLOCK_PROCESS_CPUTIME_ID);
        assert_true(podee_tables_build(&other, run_indices, *state));
        least = fmin(least, seconds(CLOCK_MONOTONIC) - start);
        least_busy = fmin(least_busy, (seconds(CLOCK_PROCESS_CPUTIME_ID) - start_busy) / 2);
        assert_memory_equal(other.sweep + 12345678, tables.sweep + 12345678, 65536);
        podee_tables_free(&other);
    }
    const double bytes = 4.0 * PODEE_SLICES * PODEE_COLUMNS * (PODEE_ROWS + 1);
    expect_below("megabytes", 1e-6 * bytes, 70);
    print_message("  built in %.0f ms on two threads, the best of five\n", 1e3 * least);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    expect_below("milliseconds of two processors", 1e3 * least_busy, 150);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_are_the_integrals),
        cmocka_unit_test(look_ups_hold_over_the_whole_range),
        cmocka_unit_test(paths_hold_over_the_whole_range),
        cmocka_unit_test(any_light_radius_uses_the_same_tables),
        cmocka_unit_test(tables_are_cheap),
    };
    return cmocka_run_group_tests(tests, make_tables, free_tables);
}
