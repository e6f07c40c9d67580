/* SPDX-License-Identifier: MIT
 *
 * Mixtures of circular Gaussians in double: Eq. 25 of Podee et al. 2021 against sums over the plane, Eq. 28 as printed, Feline's probes against the
 * kernel that renders with them.
 */
#include "kernel_lane.h"

#include "cpu/mixture_lane.h"

static const double pi = 3.14159265358979323846;

/* ∬ (ellipse − mixture)² by the midpoint rule. */
static double error_on_grid(const mixture *m, double e)
{
    enum { COLUMNS = 160, ROWS = 900 };
    const double width = 16 * m->members[0].deviation, height = 12 * e + 8;
    double sum = 0;
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++) {
            const double x = width * ((column + 0.5) / COLUMNS - 0.5), y = height * ((row + 0.5) / ROWS - 0.5);
            double difference = exp(-(x * x + y * y / (e * e)) / 2) / (2 * pi * e);
            for (int i = 0; i < m->count; i++) {
                const mixture_part *p = &m->members[i];
                const double variance = p->deviation * p->deviation, away = y - p->place;
                difference -= p->weight * exp(-(x * x + away * away) / (2 * variance)) / (2 * pi * variance);
            }
            sum += difference * difference;
        }
    return sum * width / COLUMNS * height / ROWS;
}

static void errors_are_integrals(void **state)
{
    (void)state;
    static const double elongations[] = {1.3, 2, 4.7, 9};
    double worst = 0;
    for (size_t i = 0; i < sizeof elongations / sizeof *elongations; i++) {
        const double e = elongations[i], whole = 1 / (4 * pi * e);
        const mixture all[] = {mixture_fitted(1, e), mixture_fitted(3, e), mixture_fitted(5, e),
                               mixture_fitted(9, e), mixture_feline(e, 5), mixture_feline(e, 9)};
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
            worst = fmax(worst, fabs(mixture_error(&all[k], e) - error_on_grid(&all[k], e)) / whole);
            assert_true(fabs(mixture_relative_error(&all[k], e) * whole - mixture_error(&all[k], e)) < 1e-12);
        }
    }
    expect_below("Eq. 25 against a sum over the plane, over the ellipse's", worst, 1e-6);
}

/* The printed sum leaves out 1/(4π) and calls w₁ b. */
static void the_printed_sum_is_four_pi_times_the_integral(void **state)
{
    (void)state;
    double worst = 0;
    for (double e = 2; e <= 9; e += 0.5) {
        const mixture m = mixture_fitted(3, e);
        const double printed =
            mixture_error_printed(m.members[0].weight, m.members[0].deviation, m.members[1].weight, m.members[1].deviation, m.members[1].place, e);
        worst = fmax(worst, fabs(printed / (4 * pi * mixture_error(&m, e)) - 1));
    }
    expect_below("Eq. 28 over 4 pi Eq. 25, off 1", worst, 1e-9);
}

static void run_indices(void *user, size_t count, void (*body)(void *, size_t), void *argument)
{
    (void)user;
    for (size_t i = 0; i < count; i++)
        body(argument, i);
}

/* Sums of exact circular shares by both sets of formulae. */
static void feline_is_what_renders(void **state)
{
    (void)state;
    podee_tables tables;
    random_state r = {91};
    double worst = 0;
    assert_true(podee_tables_build(&tables, run_indices, NULL));
    for (int i = 0; i < 300; i++) {
        const double e = random_range(&r, 1, 14), minor = random_range(&r, 0.2, 2), turn = random_range(&r, -pi, pi), c = cos(turn), s = sin(turn);
        const double at[2] = {random_range(&r, -2, 2), random_range(&r, -2, 2)};
        const double major_variance = e * e * minor * minor, minor_variance = minor * minor;
        const double covariance[3] = {major_variance * c * c + minor_variance * s * s, (major_variance - minor_variance) * c * s,
                                      major_variance * s * s + minor_variance * c * c};
        const mixture m = mixture_feline(e, 9);
        double sum = 0, weights = 0;
        for (int k = 0; k < m.count; k++) {
            const mixture_part *p = &m.members[k];
            const double deviation = p->deviation * minor, round[3] = {deviation * deviation, 0, deviation * deviation};
            const double center[2] = {at[0] + p->place * minor * c, at[1] + p->place * minor * s};
            sum += p->weight * disk_probability(center, round, 1);
            weights += p->weight;
        }
        assert_true(fabs(weights - 1) < 1e-12);
        worst = fmax(worst, fabs(sum - mixture_path_fraction(&tables, MGT_MIXTURE_FELINE, at, at, covariance)));
    }
    podee_tables_free(&tables);
    expect_below("Feline in double against the kernel's share", worst, 2e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_integrals),
        cmocka_unit_test(the_printed_sum_is_four_pi_times_the_integral),
        cmocka_unit_test(feline_is_what_renders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
