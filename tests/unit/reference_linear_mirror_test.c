/* SPDX-License-Identifier: MIT
 *
 * Gaussians of slopes through the mirror: the share in the light's disk against drawn slopes, and where the linear map must and must not agree with
 * it.
 */
#include "kernel_lane.h"

#include "reference/linear_mirror.h"

static const double pi = 3.14159265358979323846;

typedef struct setting {
    double to_eye[3], light[3], radius, mirror[2];
    slope_law law;
} setting;

static setting random_setting(random_state *r, double least, double most)
{
    setting s = {.radius = tan(random_range(r, 0.5, 3) * pi / 180)};
    const double x = random_range(r, least, most), z = random_range(r, least, most);
    direction_of(random_range(r, 5, 60), 180 + random_range(r, -20, 20), s.to_eye);
    direction_of(random_range(r, 10, 50), 0, s.light);
    s.law = (slope_law){{random_range(r, -0.1, 0.1), random_range(r, -0.1, 0.1)}, {x * x, 0.5 * x * z, z * z}};
    mirror_slope(s.to_eye, s.light, s.mirror);
    return s;
}

/* By Box and Muller. */
static void draw(random_state *r, const slope_law *law, double slope[2])
{
    const double radius = sqrt(-2 * log(1 - random_unit(r))), angle = 2 * pi * random_unit(r), u = radius * cos(angle), v = radius * sin(angle);
    const double l00 = sqrt(law->covariance[0]), l10 = law->covariance[1] / l00, l11 = sqrt(law->covariance[2] - l10 * l10);
    slope[0] = law->mean[0] + l00 * u;
    slope[1] = law->mean[1] + l10 * u + l11 * v;
}

static void shares_are_those_of_drawn_slopes(void **state)
{
    (void)state;
    enum { DRAWS = 400000 };
    random_state r = {7};
    double worst = 0;
    for (int i = 0; i < 12; i++) {
        const setting s = random_setting(&r, 0.05, 0.2);
        int hits = 0;
        for (int k = 0; k < DRAWS; k++) {
            double slope[2], point[2];
            draw(&r, &s.law, slope);
            hits += mirror_map(s.to_eye, s.light, slope, point) && point[0] * point[0] + point[1] * point[1] < s.radius * s.radius;
        }
        const double share = mirror_disk_fraction(s.to_eye, s.light, &s.law, s.radius), noise = sqrt(share * (1 - share) / DRAWS) + 1e-6;
        worst = fmax(worst, fabs(share - (double)hits / DRAWS) / noise);
    }
    expect_below("share in the disk against drawn slopes, deviations of their noise", worst, 3.5);
}

/* The light is small: at its mirror slope the map is straight, however wide the slopes; at their mean it is not. */
static void the_mirror_slope_is_the_better_place(void **state)
{
    (void)state;
    random_state r = {8};
    double at_mean = 0, at_mirror = 0, sum = 0;
    for (int i = 0; i < 200; i++) {
        const setting s = random_setting(&r, 0.08, 0.25);
        const double share = mirror_disk_fraction(s.to_eye, s.light, &s.law, s.radius);
        at_mean += fabs(linear_disk_fraction(s.to_eye, s.light, &s.law, s.radius, s.law.mean) - share);
        at_mirror += fabs(linear_disk_fraction(s.to_eye, s.light, &s.law, s.radius, s.mirror) - share);
        sum += share;
    }
    expect_below("mean error over mean share, Jacobian at the mirror slope", at_mirror / sum, 0.01);
    print_message("  at the mean slope %.3f\n", at_mean / sum);
    assert_true(at_mean > 10 * at_mirror);
}

/* Narrow slopes see a straight map, wherever it is expanded; wide ones are the further from it the wider. */
static void densities_part_as_slopes_widen(void **state)
{
    (void)state;
    const double flat[2] = {0, 0};
    double to_eye[3], light[3], last = 0;
    direction_of(40, 150, to_eye);
    mirror_direction(to_eye, flat, light);
    for (double deviation = 0.002; deviation < 0.3; deviation *= 2) {
        const slope_law law = {{0, 0}, {deviation * deviation, 0, deviation * deviation}};
        const double error = linear_density_error(to_eye, light, &law);
        print_message("  deviation %.3f: densities %.4f apart\n", deviation, error);
        assert_true(error > last && error <= 2);
        assert_true(deviation > 0.003 || error < 0.01);
        last = error;
    }
    assert_true(last > 0.2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_are_those_of_drawn_slopes),
        cmocka_unit_test(the_mirror_slope_is_the_better_place),
        cmocka_unit_test(densities_part_as_slopes_widen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
