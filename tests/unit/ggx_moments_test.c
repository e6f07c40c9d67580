/* SPDX-License-Identifier: MIT
 *
 * Method ggx-moments at one lane: against the engines' form of the same product in double precision, and the light that it keeps.
 */
#include "unit/kernel_lane.h"

/* A view, a light and a distribution of slopes, and what of the light the pixel mirrors. */
typedef struct ggx_case {
    double view[3], light[3], mean[2], covariance[3], radius;
} ggx_case;

static double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* α of both principal axes and the major one. */
static void principal_axes(const double c[3], double alpha[2], double axis[2])
{
    const double half = 0.5 * (c[0] + c[2]), gap = hypot(0.5 * (c[0] - c[2]), c[1]), angle = 0.5 * atan2(2 * c[1], c[0] - c[2]);
    alpha[0] = sqrt(2 * (half + gap));
    alpha[1] = sqrt(2 * (half - gap));
    axis[0] = cos(angle), axis[1] = sin(angle);
}

/* √((n·d)² + α_u² (d·u)² + α_v² (d·v)²) for n the mean normal, in units in which its height is 1. */
static double smith_root(const double direction[3], const double mean[2], const double alpha[2], const double axis[2], double *cosine)
{
    *cosine = direction[1] - direction[0] * mean[0] - direction[2] * mean[1];
    const double u = direction[0] * axis[0] + direction[2] * axis[1], v = direction[2] * axis[0] - direction[0] * axis[1];
    return sqrt(*cosine * *cosine + alpha[0] * alpha[0] * u * u + alpha[1] * alpha[1] * v * v);
}

/* D V (n·l) Ω with V = ½ / (n·l √v + n·v √l), D at the half vector of the representative point, and D spread out by the disk. `slope` mirrors the
 * light's centre; the map from slopes to the light is the kernel's linear one, J. */
static double engine_coverage(const ggx_case *c, const double slope[2], const double j[4])
{
    const double off[2] = {c->mean[0] - slope[0], c->mean[1] - slope[1]};
    const double across = hypot(j[0] * off[0] + j[1] * off[1], j[2] * off[0] + j[3] * off[1]), near = fmin(1, c->radius / across);
    const double point[2] = {slope[0] + near * off[0], slope[1] + near * off[1]};
    double alpha[2], axis[2], to_eye, to_light;
    principal_axes(c->covariance, alpha, axis);
    const double left[2] = {point[0] - c->mean[0], point[1] - c->mean[1]};
    const double u = (left[0] * axis[0] + left[1] * axis[1]) / alpha[0], v = (left[1] * axis[0] - left[0] * axis[1]) / alpha[1];
    double half[3];
    for (int i = 0; i < 3; i++)
        half[i] = c->view[i] + c->light[i];
    const double length = sqrt(dot3(half, half)), up = half[1] / length, incidence = dot3(half, c->view) / length;
    const double image = c->radius * c->radius / (4 * incidence * pow(up, 3)), rho = sqrt(image); /* of the disk among the slopes, over π */
    const double middle = 0.25 * (alpha[0] + alpha[1]) + 0.5 * sqrt(alpha[0] * alpha[1]);
    const double kept = 1 / (1 + acos(-1) / 2 * rho / middle + image / (alpha[0] * alpha[1]));
    const double density = kept / (acos(-1) * alpha[0] * alpha[1] * pow(1 + u * u + v * v, 2)), distribution = density / pow(up, 4);
    const double root_view = smith_root(c->view, c->mean, alpha, axis, &to_eye), root_light = smith_root(c->light, c->mean, alpha, axis, &to_light);
    const double toward = c->view[1] - c->view[0] * point[0] - c->view[2] * point[1];
    return distribution * 0.5 / (to_light * root_view + to_eye * root_light) * to_light * acos(-1) * c->radius * c->radius * (toward * up / incidence);
}

static kernel_bench *bench_of(double elevation, double radius)
{
    mgt_scene scene = black_scene(160, 90, NULL, 0);
    scene.light.elevation_deg = elevation;
    scene.light.angular_radius_deg = radius;
    return kernel_bench_create(&scene);
}

static void kernel_is_the_engines_product(void **state)
{
    (void)state;
    random_state r = {11};
    double worst = 0;
    int compared = 0;
    for (int k = 0; k < 400; k++) {
        kernel_bench *b = bench_of(random_range(&r, 5, 80), random_range(&r, 0.05, 5));
        const double up = random_range(&r, 0.1, 1.4), turn = random_range(&r, -1, 1), deviation[2] = {random_range(&r, 0.02, 0.2), random_range(&r, 0.02, 0.2)};
        const vec3 view = vec3((float)(cos(up) * sin(turn)), (float)sin(up), (float)(cos(up) * cos(turn)));
        const Mirror m = mirror_at(&b->cx, view);
        const vec3 light = kernel_light_direction(&b->cx, 0);
        ggx_case c = {.view = {(double)view.x, (double)view.y, (double)view.z},
                      .light = {(double)light.x, (double)light.y, (double)light.z},
                      .mean = {(double)m.slope.x + random_range(&r, -0.2, 0.2), (double)m.slope.y + random_range(&r, -0.2, 0.2)},
                      .covariance = {deviation[0] * deviation[0], random_range(&r, -0.8, 0.8) * deviation[0] * deviation[1], deviation[1] * deviation[1]},
                      .radius = (double)b->frame.data.lights[0].disk_radius};
        const SlopeGaussian g = {vec2((float)c.mean[0], (float)c.mean[1]), (float)c.covariance[0], (float)c.covariance[1], (float)c.covariance[2]};
        const double exact =
            engine_coverage(&c, (double[]){(double)m.slope.x, (double)m.slope.y}, (double[]){(double)m.j.ex, (double)m.j.ez, (double)m.j.fx, (double)m.j.fz});
        const bool faces = visible_weight(&b->cx, view, g.mean) > 0.02f && visible_weight(&b->cx, light, g.mean) > 0.02f;
        if (m.possible > 0 && faces && exact > 1e-7) {
            worst = fmax(worst, fabs((double)ggx_coverage(&b->cx, view, m, ggx_slopes(&b->cx, g)) / exact - 1));
            compared++;
        }
        kernel_bench_destroy(b);
    }
    print_message("  %d compared\n", compared);
    assert_true(compared > 200);
    expect_below("against the engines' form, relative", worst, 2e-4);
}

/* Whatever the slopes' spread, all mean slopes together mirror the light once: the area of its image among the slopes. */
static void no_light_is_added(void **state)
{
    (void)state;
    static const double deviations[][2] = {{0.002, 0.002}, {0.02, 0.02}, {0.1, 0.1}, {0.1, 0.03}, {0.1, 0.01}};
    for (size_t k = 0; k < sizeof deviations / sizeof *deviations; k++) {
        kernel_bench *b = bench_of(89.9, 2);
        const Mirror m = mirror_at(&b->cx, vec3(0, 1, 0));
        const double alpha[2] = {sqrt(2) * deviations[k][0], sqrt(2) * deviations[k][1]};
        const double rho = 0.5 * (double)b->frame.data.lights[0].disk_radius;
        double sum = 0;
        /* Logarithmic rings about the mirror slope. */
        for (int i = 0; i < 400; i++) {
            const double radius = 1e-4 * pow(1e6, (i + 0.5) / 400), width = radius * log(1e6) / 400;
            for (int a = 0; a < 64; a++) {
                const double angle = (a + 0.5) / 64 * 2 * acos(-1);
                const vec2 mean = vec2(m.slope.x + (float)(radius * cos(angle)), m.slope.y + (float)(radius * sin(angle)));
                const SlopeGaussian g = {mean, (float)(0.5 * alpha[0] * alpha[0]), 0, (float)(0.5 * alpha[1] * alpha[1])};
                sum += (double)ggx_light_fraction(&b->cx, m, ggx_slopes(&b->cx, g)) * radius * width * 2 * acos(-1) / 64;
            }
        }
        char what[64];
        snprintf(what, sizeof what, "deviations %g and %g: light kept, off 1 by", deviations[k][0], deviations[k][1]);
        expect_below(what, fabs(sum / (acos(-1) * rho * rho) - 1), 0.005);
        kernel_bench_destroy(b);
    }
}

/* A calm sea is a mirror: the share is 1 in the light and 0 beside it. */
static void still_water_is_a_mirror(void **state)
{
    (void)state;
    kernel_bench *b = bench_of(30, 1);
    const vec3 view = normalize(vec3(0.1f, 0.5f, 0.8f));
    const Mirror m = mirror_at(&b->cx, view);
    const SlopeGaussian in = slope_gaussian(&b->cx, m.slope, (Symmetric){0, 0, 0}),
                        out = slope_gaussian(&b->cx, add(m.slope, vec2(0.2f, 0)), (Symmetric){0, 0, 0});
    expect_below("in the light, off 1 by", fabs((double)ggx_coverage(&b->cx, view, m, ggx_slopes(&b->cx, in)) - 1), 0.02);
    expect_below("beside it", (double)ggx_coverage(&b->cx, view, m, ggx_slopes(&b->cx, out)), 1e-6);
    kernel_bench_destroy(b);
}

/* Thin distributions are widened along their narrow axis alone, broad ones not at all. */
static void roughness_has_a_floor(void **state)
{
    (void)state;
    kernel_bench *b = bench_of(30, 1);
    const double angle = 0.6, alpha[2] = {0.2, 0.01}, floor = 0.05;
    for (int floored = 0; floored < 2; floored++) {
        b->frame.data.roughness_floor = floored ? (float)floor : 0;
        const double major = alpha[0] * alpha[0], minor = alpha[1] * alpha[1], least = floored ? floor * floor : minor;
        const double c = cos(angle), s = sin(angle);
        const SlopeGaussian g = {vec2(0, 0), (float)(0.5 * (major * c * c + minor * s * s)), (float)(0.5 * (major - minor) * c * s),
                                 (float)(0.5 * (major * s * s + minor * c * c))};
        const GgxSlopes out = ggx_slopes(&b->cx, g);
        const double exact[3] = {major * c * c + least * s * s, (major - least) * c * s, major * s * s + least * c * c};
        expect_below("A, off by", fmax(fabs((double)out.xx - exact[0]), fmax(fabs((double)out.xz - exact[1]), fabs((double)out.zz - exact[2]))), 1e-7);
    }
    b->frame.data.roughness_floor = 0.5f;
    const GgxSlopes round = ggx_slopes(&b->cx, (SlopeGaussian){vec2(0, 0), 0, 0, 0});
    expect_below("of a mirror, alpha off by", fabs(sqrt((double)round.xx) - 0.5) + fabs((double)round.xz) + fabs(sqrt((double)round.zz) - 0.5), 1e-6);
    kernel_bench_destroy(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(kernel_is_the_engines_product), cmocka_unit_test(no_light_is_added),
                                       cmocka_unit_test(still_water_is_a_mirror), cmocka_unit_test(roughness_has_a_floor)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
