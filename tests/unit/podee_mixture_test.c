/* SPDX-License-Identifier: MIT
 *
 * podee_mixture.k at one lane: mixtures of circular Gaussians against the ellipse they stand for (Podee et al. 2021, Appendix C), alone and
 * convolved with the disk and a path; Feline; the Riemann sums, and when they step in.
 */
#include "kernel_lane.h"

static const double pi = 3.14159265358979323846;
static podee_tables tables;

static void run_indices(void *user, size_t count, void (*body)(void *, size_t), void *argument)
{
    (void)user;
    for (size_t i = 0; i < count; i++)
        body(argument, i);
}

static int make_tables(void **state)
{
    (void)state;
    return podee_tables_build(&tables, run_indices, NULL) ? 0 : -1;
}

static int free_tables(void **state)
{
    (void)state;
    podee_tables_free(&tables);
    return 0;
}

/* ---- the fits themselves ---- */

static double circle(double x, double y, double deviation) { return exp(-(x * x + y * y) / (2 * deviation * deviation)) / (2 * pi * deviation * deviation); }

/* ‖ellipse − mixture‖ / ‖ellipse‖ by the midpoint rule on a grid over the plane. */
static double relative_l2(int kernels, double e)
{
    enum { COLUMNS = 120, ROWS = 800 };
    const double width = 18, height = 12 * e + 6;
    const struct kernel_context cx = {.frame = NULL};
    const double x_log = log(e), root = sqrt(e * e - 1);
    double error = 0, whole = 0;
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++) {
            const double x = width * ((column + 0.5) / COLUMNS - 0.5), y = height * ((row + 0.5) / ROWS - 0.5);
            const double exact = exp(-(x * x + y * y / (e * e)) / 2) / (2 * pi * e);
            double mixture = 0;
            for (int i = 0; i < (kernels + 1) / 2; i++) {
                const MixtureMember m = mixture_member(&cx, kernels, i, (float)x_log);
                const double deviation = exp((double)m.log_deviation), away = (double)m.distance * root;
                mixture += (double)m.weight * (circle(x, y - away, deviation) + (i ? circle(x, y + away, deviation) : 0));
            }
            error += (exact - mixture) * (exact - mixture);
            whole += exact * exact;
        }
    return sqrt(error / whole);
}

static void fits_are_near_the_ellipse(void **state)
{
    (void)state;
    static const int kernels[] = {1, 3, 5, 9};
    for (double e = 1; e <= 9; e += 1)
        print_message("  elongation %.0f: relative L2 %.4f %.4f %.4f %.4f (1, 3, 5, 9 kernels)\n", e, relative_l2(1, e), relative_l2(3, e), relative_l2(5, e),
                      relative_l2(9, e));
    expect_below("relative L2 at elongation 4, 3 kernels", relative_l2(3, 4), 0.28);
    expect_below("5 kernels", relative_l2(5, 4), 0.124);
    expect_below("9 kernels", relative_l2(9, 4), 0.022);
    for (int k = 0; k < 4; k++)
        expect_below("a circle stays one", relative_l2(kernels[k], 1), 3e-3);
}

/* The best weights, widths and places change smoothly with the elongation: no step of a hundredth of the range changes a parameter by much more
 * than its neighbour did. */
static void fits_are_smooth(void **state)
{
    (void)state;
    static const int kernels[] = {1, 3, 5, 9};
    const struct kernel_context cx = {.frame = NULL};
    double worst = 0;
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < (kernels[k] + 1) / 2; i++) {
            double last[3] = {0}, change[3] = {0};
            for (int step = 0; step <= 100; step++) {
                const MixtureMember m = mixture_member(&cx, kernels[k], i, (float)(log(9) * step / 100));
                const double now[3] = {(double)m.weight, (double)m.log_deviation, (double)m.distance};
                for (int p = 0; p < 3; p++) {
                    if (step > 1)
                        worst = fmax(worst, fabs(now[p] - last[p] - change[p]));
                    change[p] = now[p] - last[p];
                    last[p] = now[p];
                }
            }
        }
    expect_below("largest second difference of a parameter", worst, 0.03);
}

/* ---- convolved with disk and path ---- */

/* As pixels meet them: minor deviation log-uniform from .1 radii to the end of the tables' range, 8, elongation log-uniform, path log-uniform .01 to 10
 * radii in any direction from a start in the disk of 1.5 (1 + minor) radii. */
typedef struct path_case {
    double from[2], to[2], covariance[3];
    double exact;
} path_case;

enum { CASES = 600 };

static path_case random_case(random_state *r, double widest, double least_elongation, double most_elongation)
{
    const double elongation = least_elongation * pow(most_elongation / least_elongation, random_unit(r));
    const double minor = 0.1 * pow(widest / 0.1, random_unit(r)), major = minor * elongation;
    const double length = 0.01 * pow(1000, random_unit(r)), heading = random_range(r, -pi, pi), tilt = random_range(r, -pi, pi);
    const double distance = 1.5 * (1 + minor) * sqrt(random_unit(r)), around = random_range(r, -pi, pi), c = cos(tilt), s = sin(tilt);
    path_case p = {.from = {distance * cos(around), distance * sin(around)},
                   .covariance = {major * major * c * c + minor * minor * s * s, (major * major - minor * minor) * c * s,
                                  major * major * s * s + minor * minor * c * c}};
    p.to[0] = p.from[0] + length * cos(heading);
    p.to[1] = p.from[1] + length * sin(heading);
    return p;
}

static double share_of(const path_case *p, mgt_mixture kernels, double elongation_limit, bool still)
{
    const FrameData data = {.podee_kernels = (int)kernels, .podee_elongation = (float)elongation_limit, .lights[0].disk_radius = 1};
    const struct kernel_context cx = {.frame = &data, .podee = &tables};
    const double *from = still ? p->to : p->from;
    return (double)mixture_disk_path(&cx, vec2((float)from[0], (float)from[1]), vec2((float)p->to[0], (float)p->to[1]),
                                     (Symmetric){(float)p->covariance[0], (float)p->covariance[1], (float)p->covariance[2]}, 1);
}

enum { KINDS = 5 };

static const struct {
    mgt_mixture kernels;
    const char *name;
    double bound; /* of the rms; 0: none */
} kinds[KINDS] = {{MGT_MIXTURE_1, "1 kernel", 0.045},
                  {MGT_MIXTURE_3, "3 kernels", 0.0145},
                  {MGT_MIXTURE_5, "5 kernels", 0.0075},
                  {MGT_MIXTURE_9, "9 kernels", 0.0028},
                  {MGT_MIXTURE_FELINE, "Feline", 0}};

/* Root mean square errors of CASES paths. */
static void measure_kinds(double widest, double rms[KINDS])
{
    random_state r = {61};
    double squares[KINDS] = {0}, worst[KINDS] = {0}, sum[KINDS] = {0}, exact = 0;
    for (int i = 0; i < CASES; i++) {
        const path_case p = random_case(&r, widest, 1, 9);
        const double share = disk_path_quadrature(p.from, p.to, p.covariance, 1);
        exact += share;
        for (int k = 0; k < KINDS; k++) {
            const double measured = share_of(&p, kinds[k].kernels, 1e6, false);
            assert_true(measured >= 0 && measured <= 1);
            squares[k] += (measured - share) * (measured - share) / CASES;
            worst[k] = fmax(worst[k], fabs(measured - share));
            sum[k] += measured;
        }
    }
    for (int k = 0; k < KINDS; k++) {
        rms[k] = sqrt(squares[k]);
        print_message("  minor up to %g, %-9s rms %.5f, largest %.4f, sum over the exact one's %.4f\n", widest, kinds[k].name, rms[k], worst[k],
                      sum[k] / exact);
    }
}

static void mixtures_stand_for_the_ellipse(void **state)
{
    (void)state;
    double rms[KINDS], narrow[KINDS];
    measure_kinds(3, narrow); /* without the wide ones, which are easy: for comparison */
    measure_kinds(8, rms);
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].bound > 0)
            expect_below(kinds[k].name, rms[k], kinds[k].bound);
    /* Feline's formulae against five fitted kernels. */
    assert_true(rms[4] > rms[2] && narrow[4] > narrow[2]);
}

/* Where nothing moves the table F serves, and the Riemann sum is the same integral by other means. */
static void still_surfaces_and_riemann_sums(void **state)
{
    (void)state;
    random_state r = {62};
    double squares = 0, riemann = 0;
    for (int i = 0; i < CASES; i++) {
        const path_case p = random_case(&r, 8, 1, 9);
        const double share = disk_path_quadrature(p.to, p.to, p.covariance, 1), still = share_of(&p, MGT_MIXTURE_9, 1e6, true);
        squares += (still - share) * (still - share) / CASES;
        riemann = fmax(riemann, fabs(share_of(&p, MGT_MIXTURE_RIEMANN, 1e6, true) - share));
        /* Time plays no part in it. */
        assert_true(fabs(share_of(&p, MGT_MIXTURE_RIEMANN, 1e6, true) - share_of(&p, MGT_MIXTURE_RIEMANN, 1e6, false)) < 1e-5);
    }
    expect_below("9 kernels without a path, rms", sqrt(squares), 0.0028);
    expect_below("Riemann sum against the integral", riemann, 2e-3);
}

static void long_ellipses_fall_back(void **state)
{
    (void)state;
    random_state r = {63};
    double worst = 0;
    for (int i = 0; i < 200; i++) {
        const path_case p = random_case(&r, 8, 4.5, 60);
        const double riemann = share_of(&p, MGT_MIXTURE_RIEMANN, 1, false);
        assert_true(share_of(&p, MGT_MIXTURE_9, 4, false) == riemann);
        assert_true(share_of(&p, MGT_MIXTURE_FELINE, 4, false) == riemann);
        assert_true(share_of(&p, MGT_MIXTURE_9, 61, false) == share_of(&p, MGT_MIXTURE_9, 1e6, false));
        worst = fmax(worst, fabs(riemann - disk_path_quadrature(p.to, p.to, p.covariance, 1)));
        /* Longer than the fits reach, and no fallback: still a share. */
        const double forced = share_of(&p, MGT_MIXTURE_9, 1e6, false);
        assert_true(forced >= 0 && forced <= 1);
    }
    expect_below("Riemann sums of long ellipses", worst, 2e-3);
}

/* Nothing that a frame can come up with gives anything but a share. */
static void extremes_are_shares(void **state)
{
    (void)state;
    static const mgt_mixture every[] = {MGT_MIXTURE_1, MGT_MIXTURE_3, MGT_MIXTURE_5, MGT_MIXTURE_9, MGT_MIXTURE_FELINE, MGT_MIXTURE_RIEMANN};
    random_state r = {64};
    for (int i = 0; i < 20000; i++) {
        const double radius = pow(10, random_range(&r, -6, -0.4)), size = pow(10, random_range(&r, -12, 8));
        const double xx = size * random_unit(&r), yy = size * pow(10, random_range(&r, -8, 0)), xy = sqrt(xx * yy) * random_range(&r, -1, 1);
        const double away = pow(10, random_range(&r, -6, 4)), step = random_unit(&r) < 0.2 ? 0 : pow(10, random_range(&r, -8, 4));
        const FrameData data = {.podee_kernels = (int)every[i % 6], .podee_elongation = i % 2 ? 1e6f : 9};
        const struct kernel_context cx = {.frame = &data, .podee = &tables};
        const float from[2] = {(float)(away * random_range(&r, -1, 1)), (float)(away * random_range(&r, -1, 1))};
        const float share = mixture_disk_path(&cx, vec2(from[0], from[1]), vec2((float)((double)from[0] + step), (float)((double)from[1] - step / 3)),
                                              (Symmetric){(float)xx, (float)xy, (float)yy}, (float)radius);
        assert_true(share >= 0 && share <= 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fits_are_near_the_ellipse),       cmocka_unit_test(fits_are_smooth),         cmocka_unit_test(mixtures_stand_for_the_ellipse),
        cmocka_unit_test(still_surfaces_and_riemann_sums), cmocka_unit_test(long_ellipses_fall_back), cmocka_unit_test(extremes_are_shares),
    };
    return cmocka_run_group_tests(tests, make_tables, free_tables);
}
