/* SPDX-License-Identifier: MIT
 *
 * The oracle's equations against closed forms, symmetries and brute sums.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "reference/equations.h"
#include "reference/light.h"
#include "reference/quadrature.h"

static const double pi = 3.14159265358979323846;

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g is not %.17g within %g", value, expected, tolerance);
}

/* A seeded stream of numbers in [0, 1). */
static double next_number(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static double between(uint64_t *state, double low, double high) { return low + (high - low) * next_number(state); }

static double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void direction_from(double elevation, double azimuth, double d[3])
{
    d[0] = sin(azimuth) * cos(elevation);
    d[1] = sin(elevation);
    d[2] = -cos(azimuth) * cos(elevation);
}

static double gaussian(double x, const void *user)
{
    (void)user;
    return exp(-x * x);
}

static double step_function(double x, const void *user)
{
    (void)user;
    return x < 0.3 ? 1 : 0;
}

static void quadrature_meets_known_integrals(void **unused)
{
    (void)unused;
    assert_near(integrate(gaussian, NULL, -9, 9, 1e-13), sqrt(pi), 1e-12);
    assert_near(integrate(step_function, NULL, -1, 1, 1e-10), 1.3, 1e-9);
    const double cuts[] = {0.3, 7, -2, 0.1};
    assert_near(integrate_pieces(step_function, NULL, -1, 1, cuts, 4, 1e-10), 1.3, 1e-14);
    assert_true(integrate(gaussian, NULL, 1, 1, 1e-9) == 0);
}

static void water_derivatives_are_those_of_its_height(void **unused)
{
    (void)unused;
    const mgt_wave waves[] = {{0.3, 0.7, -0.4, 1.1, 0.2}, {0.05, -3, 5, -4, 2}, {0.1, 0, 2, 3, 1}};
    const mgt_water water = {.waves = waves, .wave_count = 3};
    const double x = 0.37, z = -1.9, t = 12.5, h = 1e-5;
    const water_point at = water_surface(&water, x, z, t);
    const water_point east = water_surface(&water, x + h, z, t), west = water_surface(&water, x - h, z, t);
    const water_point south = water_surface(&water, x, z + h, t), north = water_surface(&water, x, z - h, t);
    assert_near(at.height, 0.3 * sin(0.7 * x - 0.4 * z + 1.1 * t + 0.2) + 0.05 * sin(-3 * x + 5 * z - 4 * t + 2) + 0.1 * sin(2 * z + 3 * t + 1), 1e-13);
    assert_near((east.height - west.height) / (2 * h), at.slope[0], 1e-8);
    assert_near((south.height - north.height) / (2 * h), at.slope[1], 1e-8);
    assert_near((east.slope[0] - west.slope[0]) / (2 * h), at.hessian[0], 1e-7);
    assert_near((south.slope[0] - north.slope[0]) / (2 * h), at.hessian[1], 1e-7);
    assert_near((south.slope[1] - north.slope[1]) / (2 * h), at.hessian[2], 1e-7);
}

static double sinc_half(double g) { return g == 0 ? 1 : sin(0.5 * g) / (0.5 * g); }

static void box_filter_meets_its_closed_form(void **unused)
{
    (void)unused;
    uint64_t seed = 7;
    for (int i = 0; i < 60; i++) {
        const double g[2] = {i == 0 ? 0 : between(&seed, -15, 15), i < 2 ? 0 : between(&seed, -15, 15)};
        const double psi = between(&seed, -pi, pi);
        const filtered_sine f = box_filter_sine(psi, g);
        const double s1 = sinc_half(g[0]) * sinc_half(g[1]), s2 = sinc_half(2 * g[0]) * sinc_half(2 * g[1]);
        assert_near(f.mean_cosine, cos(psi) * s1, 1e-9);
        assert_near(f.mean_sine, sin(psi) * s1, 1e-9);
        assert_near(f.variance_cosine, 0.5 * (1 + cos(2 * psi) * s2) - s1 * s1 * cos(psi) * cos(psi), 1e-9);
        assert_near(f.variance_sine, 0.5 * (1 - cos(2 * psi) * s2) - s1 * s1 * sin(psi) * sin(psi), 1e-9);
    }
}

static mgt_scene camera_scene(void)
{
    mgt_scene scene = {.struct_size = sizeof scene};
    scene.image.width = 160;
    scene.image.height = 90;
    scene.camera.position[1] = 4;
    scene.camera.target[1] = 3.5;
    scene.camera.target[2] = -1;
    scene.camera.up[1] = 1;
    scene.camera.fov_y_deg = 50;
    scene.water.index_of_refraction = 1.333;
    return scene;
}

static void camera_puts_pixels_where_the_conventions_say(void **unused)
{
    (void)unused;
    mgt_scene scene = camera_scene();
    double origin[3], d[3], left[3], top[3];
    camera_ray(&scene, 80, 45, 0, origin, d);
    assert_near(d[1] / d[2], 0.5, 1e-14);
    camera_ray(&scene, 0, 45, 0, origin, left);
    assert_true(left[0] < 0); /* looking north, east is on the right */
    camera_ray(&scene, 80, 0, 0, origin, top);
    assert_near(acos(dot3(top, d)) * 180 / pi, 25, 1e-10);
    assert_near(origin[1], 4, 0);

    scene.camera.target[1] = 3; /* straight down, image top to the north */
    scene.camera.target[2] = 0;
    scene.camera.up[1] = 0;
    scene.camera.up[2] = -1;
    double footprint[2][2], xz[2];
    const double metres = 2 * 4 * tan(25 * pi / 180) / 90;
    assert_true(pixel_footprint(&scene, 33.5, 70.5, 0, footprint));
    assert_near(footprint[0][0], metres, 1e-9);
    assert_near(footprint[0][1], 0, 1e-9);
    assert_near(footprint[1][0], 0, 1e-9);
    assert_near(footprint[1][1], metres, 1e-9);
    assert_true(pixel_on_plane(&scene, 90, 45, 0, xz));
    assert_near(xz[0], 10 * metres, 1e-12);
    scene.camera.target[1] = 5;
    assert_false(pixel_on_plane(&scene, 90, 45, 0, xz));
}

static void moving_camera_is_interpolated_over_the_shutter(void **unused)
{
    (void)unused;
    mgt_scene scene = camera_scene();
    scene.time = 3;
    scene.shutter = 0.5;
    scene.camera_moves = true;
    scene.camera_open = scene.camera;
    scene.camera_open.position[0] = 8;
    scene.camera_open.target[0] = 8;
    double origin[3], d[3];
    camera_ray(&scene, 80, 45, 3, origin, d);
    assert_near(origin[0], 0, 0);
    camera_ray(&scene, 80, 45, 2.5, origin, d);
    assert_near(origin[0], 8, 1e-14);
    camera_ray(&scene, 80, 45, 2.875, origin, d);
    assert_near(origin[0], 2, 1e-14);
}

static void light_plane_axes_are_orthonormal(void **unused)
{
    (void)unused;
    const double elevations[] = {-0.4, 0, 0.3, 1.2, pi / 2};
    for (int i = 0; i < 5; i++) {
        double light[3], first[3], second[3];
        direction_from(elevations[i], 0.8 * i, light);
        if (i == 4) {
            light[0] = light[2] = 0;
            light[1] = 1;
        }
        light_plane_axes(light, first, second);
        assert_near(dot3(first, first), 1, 1e-14);
        assert_near(dot3(second, second), 1, 1e-14);
        assert_near(dot3(first, second), 0, 1e-14);
        assert_near(dot3(first, light), 0, 1e-14);
        assert_near(dot3(second, light), 0, 1e-14);
        assert_near(first[1], 0, 1e-14);
        assert_true(i == 4 || second[1] > 0);
    }
}

/* Closed forms: J = 2[(v·m)(e·h) + (h·v)(e·m)] and |det J| = 4 (h·v) h.y³ at the mirror slope. */
static void mirror_map_has_the_derived_jacobian(void **unused)
{
    (void)unused;
    uint64_t seed = 3;
    for (int i = 0; i < 200; i++) {
        double eye[3], light[3], axes[2][3], slope[2], point[2], jacobian[2][2], h[3];
        direction_from(between(&seed, 0.03, 1.5), between(&seed, -pi, pi), eye);
        direction_from(between(&seed, 0.03, 1.5), between(&seed, -pi, pi), light);
        for (int k = 0; k < 3; k++)
            h[k] = eye[k] + light[k];
        const double length = sqrt(dot3(h, h));
        for (int k = 0; k < 3; k++)
            h[k] /= length;
        if (h[1] < 0.2)
            continue; /* slopes so steep that finite differences fail */
        light_plane_axes(light, axes[0], axes[1]);
        mirror_slope(eye, light, slope);
        assert_true(mirror_map(eye, light, slope, point));
        assert_near(point[0], 0, 1e-10);
        assert_near(point[1], 0, 1e-10);
        assert_true(mirror_map_jacobian(eye, light, slope, jacobian));
        for (int axis = 0; axis < 2; axis++) {
            double m[3];
            for (int k = 0; k < 3; k++)
                m[k] = -h[1] * ((k == 2 * axis) - h[k] * h[2 * axis]);
            for (int row = 0; row < 2; row++)
                assert_near(jacobian[row][axis], 2 * (dot3(eye, m) * dot3(axes[row], h) + dot3(h, eye) * dot3(axes[row], m)), 1e-6);
        }
        assert_near(fabs(jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0]), 4 * dot3(h, eye) * h[1] * h[1] * h[1], 1e-6);
    }
    double away[2];
    const double eye[3] = {0, 1, 0}, light[3] = {0.6, -0.8, 0}, flat[2] = {0, 0};
    assert_false(mirror_map(eye, light, flat, away));
}

static void fresnel_meets_its_known_values(void **unused)
{
    (void)unused;
    const double n = 1.333;
    assert_near(fresnel_dielectric(1, n), (n - 1) * (n - 1) / ((n + 1) * (n + 1)), 1e-15);
    assert_near(fresnel_dielectric(0, n), 1, 1e-15);
    assert_near(fresnel_dielectric(0.4, 1), 0, 1e-15);
    const double brewster = cos(atan(n)); /* only the perpendicular part is left */
    const double part = (1 - n * n) / (1 + n * n);
    assert_near(fresnel_dielectric(brewster, n), 0.5 * part * part, 1e-14);
    assert_near(fresnel_dielectric(0.5, n), 0.0594, 1e-3); /* 60°: about 6 % */
}

static double limb_ring(double r, const void *user) { return 2 * r * limb_profile(*(const double *)user, r); }

static void limb_darkening_keeps_the_mean(void **unused)
{
    (void)unused;
    for (double u = 0; u <= 1; u += 0.25)
        assert_near(integrate(limb_ring, &u, 0, 1, 1e-10), 1, 1e-8);
    assert_near(limb_profile(0.6, 1) / limb_profile(0.6, 0), 0.4, 1e-14);
}

static void visible_weight_meets_its_closed_form(void **unused)
{
    (void)unused;
    const double means[] = {0.3, 0.02, 0, -0.1, 1}, deviations[] = {0.05, 0.1, 0.2, 0.1, 1e-3};
    for (int i = 0; i < 5; i++) {
        const double t = means[i] / deviations[i];
        const double expected = means[i] * 0.5 * erfc(-t / sqrt(2)) + deviations[i] * exp(-0.5 * t * t) / sqrt(2 * pi);
        assert_near(mean_visible_weight(means[i], deviations[i]), expected, 1e-12);
    }
    assert_true(mean_visible_weight(0.25, 0) == 0.25 && mean_visible_weight(-1, 0) == 0);
}

static void disk_probability_meets_known_values(void **unused)
{
    (void)unused;
    const double centre[2] = {0, 0};
    for (double s = 0.02; s < 5; s *= 3) {
        const double isotropic[3] = {s * s, 0, s * s};
        assert_near(disk_probability(centre, isotropic, 1.3), 1 - exp(-0.5 * 1.69 / (s * s)), 1e-9);
    }
    /* A sum over a polar grid of an elongated, inclined Gaussian. */
    const double mean[2] = {0.4, -0.7}, covariance[3] = {0.5, 0.2, 0.15}, radius = 0.9;
    const double det = covariance[0] * covariance[2] - covariance[1] * covariance[1];
    const int rings = 1000, spokes = 100;
    double sum = 0;
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < spokes; j++) {
            const double r = radius * (i + 0.5) / rings, angle = 2 * pi * j / spokes;
            const double dx = r * cos(angle) - mean[0], dy = r * sin(angle) - mean[1];
            sum += r * exp(-0.5 * (covariance[2] * dx * dx - 2 * covariance[1] * dx * dy + covariance[0] * dy * dy) / det);
        }
    assert_near(disk_probability(mean, covariance, radius), sum * radius / (rings * spokes * sqrt(det)), 1e-6);
}

static void disk_path_is_the_mean_along_the_path(void **unused)
{
    (void)unused;
    uint64_t seed = 11;
    for (int i = 0; i < 12; i++) {
        const double minor = 0.1 * pow(10, next_number(&seed)), major = minor * between(&seed, 1, 8);
        const double angle = between(&seed, 0, pi), c = cos(angle), s = sin(angle);
        const double covariance[3] = {c * c * major * major + s * s * minor * minor, c * s * (major * major - minor * minor),
                                      s * s * major * major + c * c * minor * minor};
        const double p0[2] = {between(&seed, -2, 2), between(&seed, -2, 2)};
        const double p1[2] = {between(&seed, -2, 2), between(&seed, -2, 2)};
        double mean = 0;
        const int steps = 400;
        for (int k = 0; k <= steps; k++) { /* Simpson */
            const double at = (double)k / steps, p[2] = {p0[0] + at * (p1[0] - p0[0]), p0[1] + at * (p1[1] - p0[1])};
            mean += (k == 0 || k == steps ? 1 : k % 2 ? 4 : 2) * disk_probability(p, covariance, 1) / (3.0 * steps);
        }
        const double value = disk_path_quadrature(p0, p1, covariance, 1);
        assert_near(value, mean, 2e-7);
        assert_near(disk_path_quadrature(p1, p0, covariance, 1), value, 1e-8);
        assert_near(disk_path_quadrature(p0, p0, covariance, 1), disk_probability(p0, covariance, 1), 1e-10);
    }
    /* A narrow Gaussian on a long path through the centre: the chord's share of the path. */
    const double narrow[3] = {1e-8, 0, 1e-8}, from[2] = {-5, 0}, to[2] = {5, 0};
    assert_near(disk_path_quadrature(from, to, narrow, 1), 0.2, 1e-7);
}

static void arcs_and_chords_meet_plane_trigonometry(void **unused)
{
    (void)unused;
    const double left[2] = {-3, 0}, right[2] = {3, 0}, high_left[2] = {-3, 0.6}, high_right[2] = {3, 0.6};
    const double in0[2] = {0.1, 0.2}, in1[2] = {-0.5, 0.1}, over0[2] = {-3, 1.2}, over1[2] = {3, 1.2};
    assert_near(light_arc_ratio(left, right, 1), atan(1) / atan(3), 1e-14);
    assert_near(light_chord_ratio(left, right, 1), 1.0 / 3, 1e-14);
    assert_near(light_chord_ratio(high_left, high_right, 1), 0.8 / 3, 1e-14);
    assert_near(light_arc_ratio(high_left, high_right, 1), atan(0.8 / hypot(1, 0.6)) / atan(3 / hypot(1, 0.6)), 1e-14);
    assert_true(light_arc_ratio(in0, in1, 1) == 1 && light_chord_ratio(in0, in1, 1) == 1);
    assert_true(light_arc_ratio(over0, over1, 1) == 0 && light_chord_ratio(over0, over1, 1) == 0);
    assert_true(light_arc_ratio(in0, in0, 1) == 1 && light_arc_ratio(left, left, 1) == 0);
    assert_near(light_chord_ratio(in0, right, 1), light_chord_ratio(right, in0, 1), 1e-14);
}

static void brute_force_hits_what_can_be_solved_by_hand(void **unused)
{
    (void)unused;
    mgt_scene scene = camera_scene();
    double origin[3], d[3];
    camera_ray(&scene, 100, 80, 0, origin, d);
    water_hit hit = first_hit_brute_force(&scene, 100, 80, 0);
    assert_true(hit.hit);
    assert_near(hit.distance, -4 / d[1], 1e-9);
    scene.camera.target[1] = 4;
    assert_false(first_hit_brute_force(&scene, 100, 40, 0).hit); /* above the horizon */
    scene.camera.target[1] = 3.5;

    /* One wave along x seen along −z: its height is the same all along the ray. */
    const mgt_wave wave = {0.3, 2, 0, 1, 0.4};
    scene.water.waves = &wave;
    scene.water.wave_count = 1;
    hit = first_hit_brute_force(&scene, 80, 60, 5);
    camera_ray(&scene, 80, 60, 5, origin, d);
    assert_near(d[0], 0, 1e-15);
    assert_near(hit.distance, (0.3 * sin(5.4) - 4) / d[1], 1e-8);
    assert_near(hit.water.slope[0], 0.6 * cos(5.4), 1e-8);

    scene.camera.position[1] = -0.9;
    hit = first_hit_brute_force(&scene, 80, 60, 5);
    assert_true(hit.hit && hit.distance == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quadrature_meets_known_integrals),
        cmocka_unit_test(water_derivatives_are_those_of_its_height),
        cmocka_unit_test(box_filter_meets_its_closed_form),
        cmocka_unit_test(camera_puts_pixels_where_the_conventions_say),
        cmocka_unit_test(moving_camera_is_interpolated_over_the_shutter),
        cmocka_unit_test(light_plane_axes_are_orthonormal),
        cmocka_unit_test(mirror_map_has_the_derived_jacobian),
        cmocka_unit_test(fresnel_meets_its_known_values),
        cmocka_unit_test(limb_darkening_keeps_the_mean),
        cmocka_unit_test(visible_weight_meets_its_closed_form),
        cmocka_unit_test(disk_probability_meets_known_values),
        cmocka_unit_test(disk_path_is_the_mean_along_the_path),
        cmocka_unit_test(arcs_and_chords_meet_plane_trigonometry),
        cmocka_unit_test(brute_force_hits_what_can_be_solved_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
