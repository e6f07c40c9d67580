/* SPDX-License-Identifier: MIT
 *
 * mirror.k at one lane against the exact mirror map, its finite differences and quadratures.
 */
#include "kernel_lane.h"
#include "unit/light_data.h"

#include "reference/quadrature.h"

static const double pi = 3.14159265358979323846;

typedef struct mirror_case {
    double view[3], light[3];
    FrameData frame;
    struct kernel_context cx;
} mirror_case;

/* A view from 2 to 60 degrees above the water and a sun at 3 to 50, up to 40 degrees apart in azimuth. */
static void make_case(mirror_case *c, random_state *r, double radius_deg)
{
    memset(c, 0, sizeof *c);
    direction_of(random_range(r, 2, 60), 180 + random_range(r, -40, 40), c->view);
    direction_of(random_range(r, 3, 50), 0, c->light);
    double e[3], f[3];
    light_plane_axes(c->light, e, f);
    c->frame = (FrameData){.lights[0] = light_data(c->light, e, f), .index_of_refraction = 1.333f};
    c->frame.lights[0].disk_radius = (float)tan(radius_deg * pi / 180);
    c->frame.lights[0].light_visible = 1;
    c->cx.frame = &c->frame;
}

static Mirror mirror_of(const mirror_case *c) { return mirror_at(&c->cx, vec3((float)c->view[0], (float)c->view[1], (float)c->view[2])); }

/* Float keeps 6e-8 of each coordinate of v + L; dividing by its y, at least sin 5° = .087 here, and the handful of operations
 * after it leave 1e-5 of slopes up to 10. */
static void mirror_slope_is_exact(void **state)
{
    (void)state;
    random_state r = {1};
    double slope_error = 0, cosine_error = 0, centre = 0;
    for (int i = 0; i < 2000; i++) {
        mirror_case c;
        make_case(&c, &r, 1);
        const Mirror m = mirror_of(&c);
        double s[2];
        mirror_slope(c.view, c.light, s);
        const double size = 1 + hypot(s[0], s[1]);
        slope_error = fmax(slope_error, hypot((double)m.slope.x - s[0], (double)m.slope.y - s[1]) / size);
        double back[2];
        assert_true(mirror_map(c.view, c.light, (double[]){(double)m.slope.x, (double)m.slope.y}, back));
        centre = fmax(centre, hypot(back[0], back[1]));
        const double h = sqrt(0.5 * (1 + c.view[0] * c.light[0] + c.view[1] * c.light[1] + c.view[2] * c.light[2]));
        cosine_error = fmax(cosine_error, fabs((double)m.fresnel_cosine - h));
        assert_true(m.possible > 0);
    }
    expect_below("mirror slope, relative to 1 + |s|", slope_error, 2e-6);
    expect_below("its image on the light plane, from the centre", centre, 2e-6);
    expect_below("cosine of incidence", cosine_error, 1e-6);
}

static void jacobian_is_that_of_the_exact_map(void **state)
{
    (void)state;
    random_state r = {2};
    double largest = 0, determinant = 0;
    for (int i = 0; i < 2000; i++) {
        mirror_case c;
        make_case(&c, &r, 1);
        const Mirror m = mirror_of(&c);
        double s[2], exact[2][2];
        mirror_slope(c.view, c.light, s);
        assert_true(mirror_map_jacobian(c.view, c.light, s, exact));
        const double ours[2][2] = {{(double)m.j.ex, (double)m.j.ez}, {(double)m.j.fx, (double)m.j.fz}};
        double size = 0, off = 0;
        for (int j = 0; j < 4; j++) {
            size = fmax(size, fabs(exact[j / 2][j % 2]));
            off = fmax(off, fabs(ours[j / 2][j % 2] - exact[j / 2][j % 2]));
        }
        largest = fmax(largest, off / size);
        /* |det J| = 4 (h·v) h.y³ */
        const double hy = 1 / sqrt(1 + s[0] * s[0] + s[1] * s[1]);
        const double expected = 4 * (double)m.fresnel_cosine * hy * hy * hy;
        const double det = fabs(ours[0][0] * ours[1][1] - ours[0][1] * ours[1][0]);
        determinant = fmax(determinant, fabs(det - expected) / expected);
    }
    expect_below("Jacobian, of its largest entry", largest, 1e-5);
    expect_below("determinant, relative", determinant, 1e-4);
}

static void light_point_is_the_exact_map(void **state)
{
    (void)state;
    random_state r = {33};
    double position = 0, jacobian = 0;
    for (int i = 0; i < 2000; i++) {
        double view[3], light[3], e[3], f[3], exact[2], exact_jacobian[2][2];
        direction_of(random_range(&r, 2, 80), random_range(&r, 130, 230), view);
        direction_of(random_range(&r, 3, 80), 0, light);
        light_plane_axes(light, e, f);
        const FrameData data = {.lights[0] = light_data(light, e, f)};
        const struct kernel_context cx = {.frame = &data};
        const double slope[2] = {random_range(&r, -0.3, 0.3), random_range(&r, -0.3, 0.3)};
        if (!mirror_map(view, light, slope, exact) || hypot(exact[0], exact[1]) > 3 || !mirror_map_jacobian(view, light, slope, exact_jacobian))
            continue;
        const LightPoint p = light_point(&cx, vec3((float)view[0], (float)view[1], (float)view[2]), vec2((float)slope[0], (float)slope[1]));
        position = fmax(position, hypot((double)p.position.x - exact[0], (double)p.position.y - exact[1]));
        const double ours[4] = {(double)p.j.ex, (double)p.j.ez, (double)p.j.fx, (double)p.j.fz};
        double size = 0, off = 0;
        for (int k = 0; k < 4; k++) {
            size = fmax(size, fabs(exact_jacobian[k / 2][k % 2]));
            off = fmax(off, fabs(ours[k] - exact_jacobian[k / 2][k % 2]));
        }
        jacobian = fmax(jacobian, off / size);
    }
    expect_below("light point within 3 of the centre", position, 1e-5);
    expect_below("its Jacobian, of the largest entry", jacobian, 1e-5);
}

/* About any slope that shows the light the linear map has its point and its Jacobian. About a slope that the eye sees from behind there is no light. */
static void map_about_a_slope_meets_it(void **state)
{
    (void)state;
    random_state r = {6};
    double there = 0, back = 0;
    int shown = 0;
    for (int i = 0; i < 2000; i++) {
        mirror_case c;
        make_case(&c, &r, 20);
        const vec3 view = vec3((float)c.view[0], (float)c.view[1], (float)c.view[2]);
        const Mirror m = mirror_of(&c);
        const vec2 at = add(m.slope, vec2((float)random_range(&r, -0.4, 0.4), (float)random_range(&r, -0.1, 0.1)));
        const LightPoint to = light_point(&c.cx, view, at);
        const float behind = 2 * view.y / (view.x * view.x + view.z * view.z);
        const Mirror about = mirror_about(&c.cx, view, m, at), hidden = mirror_about(&c.cx, view, m, vec2(behind * view.x, behind * view.z));
        assert_true(hidden.possible == 0);
        if (to.ahead < 0.2f || hypot((double)to.position.x, (double)to.position.y) > 0.5)
            continue;
        const vec2 point = mirror_to_light(&c.cx, about, sub(at, about.slope)), slope = slope_from_light(&c.cx, about, point);
        assert_memory_equal(&about.j, &to.j, sizeof to.j);
        there = fmax(there, hypot((double)(point.x - to.position.x), (double)(point.y - to.position.y)));
        back = fmax(back, hypot((double)(slope.x - at.x), (double)(slope.y - at.y)));
        shown++;
    }
    assert_true(shown > 1000);
    expect_below("point of the light plane", there, 1e-5);
    expect_below("the slope back from it", back, 1e-5);
}

/* The slope that mirrors the light plane's point r into the eye. */
static void slope_to(const mirror_case *c, const double e[3], const double f[3], double x, double y, double slope[2])
{
    double h[3];
    const double length = sqrt(1 + x * x + y * y);
    for (int i = 0; i < 3; i++)
        h[i] = c->view[i] + (c->light[i] + x * e[i] + y * f[i]) / length;
    slope[0] = -h[0] / h[1];
    slope[1] = -h[2] / h[1];
}

/* P(slopes that mirror the disk) for slopes N(mean, covariance): the slopes' density over the disk's preimage. */
static double exact_probability(const mirror_case *c, const double mean[2], const double cov[3], double radius)
{
    enum { RINGS = 24, SPOKES = 48 };
    double e[3], f[3];
    light_plane_axes(c->light, e, f);
    const double det = cov[0] * cov[2] - cov[1] * cov[1], step = 1e-5;
    double sum = 0;
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SPOKES; j++) {
            /* Equal areas by rings' midpoints in r². */
            const double rho = radius * sqrt((i + 0.5) / RINGS), angle = 2 * pi * (j + 0.5 * (i % 2)) / SPOKES;
            const double x = rho * cos(angle), y = rho * sin(angle);
            double s[2], sx[2], sy[2], tx[2], ty[2];
            slope_to(c, e, f, x, y, s);
            slope_to(c, e, f, x + step, y, sx);
            slope_to(c, e, f, x - step, y, tx);
            slope_to(c, e, f, x, y + step, sy);
            slope_to(c, e, f, x, y - step, ty);
            const double jacobian = fabs((sx[0] - tx[0]) * (sy[1] - ty[1]) - (sx[1] - tx[1]) * (sy[0] - ty[0])) / (4 * step * step);
            const double u = s[0] - mean[0], v = s[1] - mean[1];
            sum += jacobian * exp(-0.5 * (cov[2] * u * u - 2 * cov[1] * u * v + cov[0] * v * v) / det) / (2 * pi * sqrt(det));
        }
    return sum * pi * radius * radius / (RINGS * SPOKES);
}

/* The map linearised at the mirror slope: over views 2–60°, suns 3–50°, slopes of rms .02–.25 and radii .27–3° its P(in disk) is off by
 * .0007 (median) and .015 (nine of ten). */
static void linear_map_keeps_the_probability(void **state)
{
    (void)state;
    enum { CASES = 733 };
    static double error[CASES];
    random_state r = {3};
    for (int n = 0; n < CASES;) {
        mirror_case c;
        const double radius_deg = 0.27 * pow(3 / 0.27, random_unit(&r));
        make_case(&c, &r, radius_deg);
        const double radius = tan(radius_deg * pi / 180), major = 0.02 * pow(12.5, random_unit(&r)), minor = major * random_range(&r, 0.3, 1);
        const double turn = random_range(&r, 0, pi), co = cos(turn), si = sin(turn);
        const double cov[3] = {major * major * co * co + minor * minor * si * si, (major * major - minor * minor) * co * si,
                               major * major * si * si + minor * minor * co * co};
        const double mean[2] = {random_range(&r, -0.1, 0.1), random_range(&r, -0.1, 0.1)};
        const double exact = exact_probability(&c, mean, cov, radius);
        if (exact < 1e-6)
            continue;
        const Mirror m = mirror_of(&c);
        const vec2 at = mirror_to_light(&c.cx, m, vec2((float)mean[0] - m.slope.x, (float)mean[1] - m.slope.y));
        const double j[2][2] = {{(double)m.j.ex, (double)m.j.ez}, {(double)m.j.fx, (double)m.j.fz}};
        double on_plane[3];
        for (int k = 0; k < 3; k++) {
            const double *p = j[k == 2], *q = j[k > 0];
            on_plane[k] = p[0] * (cov[0] * q[0] + cov[1] * q[1]) + p[1] * (cov[1] * q[0] + cov[2] * q[1]);
        }
        const double linear = disk_probability((double[]){(double)at.x, (double)at.y}, on_plane, radius);
        error[n++] = fabs(linear - exact) / exact;
    }
    expect_below("P(in disk), relative error, median of 733", quantile(error, CASES, 0.5), 0.0015);
    expect_below("P(in disk), relative error, nine of ten", quantile(error, CASES, 0.9), 0.03);
}

/* n² − 1 + c² is rounded to 6e-8. At n = 1 that is all there is, and
 * g = √(c² ± 6e-8) is off from c by 3e-8/c, which reflects ((g − c)/(2c))² ≈ (1.5e-8/c²)² of the light: 3.6e-3 at c = 5e-4; from n = 1.02 on it is lost in n² − 1. */
static void fresnel_is_exact(void **state)
{
    (void)state;
    static const double indices[] = {1, 1.02, 1.333, 1.5, 2, 3};
    double largest[2] = {0, 0};
    for (size_t k = 0; k < sizeof indices / sizeof *indices; k++)
        for (int i = k == 0 ? 1 : 0; i <= 2000; i++) { /* n = 1 has no value at cosine 0 */
            FrameData data = {.index_of_refraction = (float)indices[k]};
            const struct kernel_context cx = {.frame = &data};
            const float cosine = (float)(i / 2000.0);
            const double error = fabs((double)fresnel(&cx, cosine) - fresnel_dielectric((double)cosine, (double)data.index_of_refraction));
            largest[k > 0] = fmax(largest[k > 0], error);
        }
    expect_below("Fresnel reflectance, absolute, n from 1.02", largest[1], 2e-6);
    expect_below("Fresnel reflectance, absolute, n = 1", largest[0], 3.6e-3);
}

static void one_level_weight_is_smiths(void **state)
{
    (void)state;
    random_state r = {4};
    double mean_error = 0, weight_error = 0;
    const struct kernel_context cx = {.frame = 0};
    for (int i = 0; i < 2000; i++) {
        const double mean = random_range(&r, 0.01, 0.9), deviation = random_range(&r, 0.002, 0.3), mirror = random_range(&r, 0.01, 1.2);
        const double exact = mean_visible_weight((double)(float)mean, (double)(float)deviation);
        mean_error = fmax(mean_error, fabs((double)visible_mean(&cx, (float)mean, (float)deviation) - exact) / exact);
        const double weight = (double)visible_slope_weight(&cx, (float)mean, (float)deviation, (float)mirror, 0);
        weight_error = fmax(weight_error, fabs(weight * exact / mirror - 1));
    }
    expect_below("E[max(w, 0)], relative", mean_error, 5e-6);
    expect_below("weight of one level, relative", weight_error, 5e-6);
}

typedef struct long_wave {
    double mean, deviation;
} long_wave;

/* Density of a long wave's height of standing times what it lets the eye see, 1 − exp(−√(2π) x). */
static double long_wave_integrand(double x, const void *user)
{
    const long_wave *w = user;
    const double t = (x - w->mean) / w->deviation;
    return -expm1(-sqrt(2 * pi) * x) * exp(-0.5 * t * t) / (w->deviation * sqrt(2 * pi));
}

/* F of half the variance in long waves, from its definition as a mean over them. */
static double two_level_factor(double mean, double deviation, double mirror)
{
    const double f = 0.5;
    const long_wave w = {(mean + f * (mirror - mean)) / (deviation * sqrt(1 - f)), sqrt(f)};
    const double seen = integrate(long_wave_integrand, &w, 0, fmax(w.mean, 0) + 9 * w.deviation, 1e-12);
    return mean_visible_weight(mean, deviation) / mean_visible_weight(mean, deviation * sqrt(f)) * seen;
}

static void two_level_weight_is_its_integral(void **state)
{
    (void)state;
    random_state r = {5};
    double largest = 0;
    const struct kernel_context cx = {.frame = 0};
    for (int i = 0; i < 2000; i++) {
        const float mean = (float)random_range(&r, 0.02, 0.9), deviation = (float)random_range(&r, 0.005, 0.3), mirror = (float)random_range(&r, 0.02, 1.2);
        const float power = (float)random_range(&r, 0, 1);
        const double factor = fmin(fmax(two_level_factor((double)mean, (double)deviation, (double)mirror), 1e-4), 4);
        const double exact = (double)mirror / mean_visible_weight((double)mean, (double)deviation) * pow(factor, (double)power);
        const double ours = (double)visible_slope_weight(&cx, mean, deviation, mirror, power);
        largest = fmax(largest, fabs(ours - exact) / exact);
    }
    expect_below("weight of two levels, relative", largest, 5e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirror_slope_is_exact),
        cmocka_unit_test(jacobian_is_that_of_the_exact_map),
        cmocka_unit_test(linear_map_keeps_the_probability),
        cmocka_unit_test(fresnel_is_exact),
        cmocka_unit_test(one_level_weight_is_smiths),
        cmocka_unit_test(two_level_weight_is_its_integral),
        cmocka_unit_test(light_point_is_the_exact_map),
        cmocka_unit_test(map_about_a_slope_meets_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
