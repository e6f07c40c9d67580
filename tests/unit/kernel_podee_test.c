/* SPDX-License-Identifier: MIT
 *
 * podee.k at one lane: the span of App. A, the per-pixel mean and variance of Eqs. 21–24 as corrected, the split of Eq. 20 as published.
 */
#include "kernel_lane.h"
#include "unit/light_data.h"

static const double pi = 3.14159265358979323846;

static WaveData wave_of(double amplitude, double a, double b)
{
    return (WaveData){.turns_x = (float)(a / (2 * pi)),
                      .turns_z = (float)(b / (2 * pi)),
                      .amplitude = (float)amplitude,
                      .k_x = (float)a,
                      .k_z = (float)b,
                      .half_variance = (float)(amplitude * amplitude / 2),
                      .even_x = (float)(amplitude * a),
                      .even_z = (float)(amplitude * b),
                      .even_height = (float)amplitude,
                      .cos_half = 1,
                      .sin_half = 0};
}

static Footprint random_footprint(random_state *r)
{
    return (Footprint){{(float)random_range(r, -0.2, 0.2), (float)random_range(r, -0.2, 0.2)},
                       {(float)random_range(r, -1, 1), (float)random_range(r, -1, 1)},
                       {0, 0}};
}

/* Half of the phase from one edge of the pixel's parallelogram to the other, along the wave through its centre: walked, not solved. */
static double walked_half_phase(const Footprint *p, double a, double b)
{
    const double k = hypot(a, b), det = (double)p->right.x * (double)p->down.y - (double)p->right.y * (double)p->down.x;
    double inside = 0, outside = 100;
    for (int i = 0; i < 100; i++) {
        const double t = 0.5 * (inside + outside), x = t * a / k, z = t * b / k;
        const double u = ((double)p->down.y * x - (double)p->down.x * z) / det, v = ((double)p->right.x * z - (double)p->right.y * x) / det;
        if (fabs(u) < 0.5 && fabs(v) < 0.5)
            inside = t;
        else
            outside = t;
    }
    return inside * k;
}

static void half_span_is_walked(void **state)
{
    (void)state;
    random_state r = {31};
    double worst = 0;
    const struct kernel_context cx = {.frame = 0};
    for (int i = 0; i < 2000; i++) {
        const Footprint p = random_footprint(&r);
        const double k = exp(random_range(&r, -2, 4)), direction = random_range(&r, -pi, pi);
        const WaveData w = wave_of(0.1, k * cos(direction), k * sin(direction));
        const double exact = walked_half_phase(&p, (double)w.k_x, (double)w.k_z);
        const double det = (double)(p.right.x * p.down.y - p.right.y * p.down.x);
        if (fabs(det) < 1e-3) /* so flat that float's determinant is noise */
            continue;
        worst = fmax(worst, fabs((double)half_span(&cx, p, w) / exact - 1));
    }
    expect_below("half span, relative", worst, 2e-5);
}

/* Mean of A cos and of its square over the span by the midpoint rule. */
static void span_means(double amplitude, double phase, double half, double *mean, double *variance)
{
    enum { STEPS = 20000 };
    double first = 0, second = 0;
    for (int i = 0; i < STEPS; i++) {
        const double c = amplitude * cos(phase + half * ((2.0 * i + 1) / STEPS - 1));
        first += c / STEPS;
        second += c * c / STEPS;
    }
    *mean = first;
    *variance = second - first * first;
}

static FrameData podee_frame(bool per_pixel) { return (FrameData){.ramp_start = 0.2f, .ramp_scale = 1 / 0.3f, .ndf_per_pixel = per_pixel, .ndf_mean = 1}; }

/* J − K² in float, and the short-span form A² sin²ψ h²/3 below a half span h of .15: its next term is A² h⁴/15, 3.4e-5 A², at sin ψ = 1,
 * a share h²/5 = .0045, and A² h⁴/45 where sin ψ = 0 leaves nothing else. */
static void pixel_ndf_is_the_mean_over_the_span(void **state)
{
    (void)state;
    random_state r = {32};
    double mean_error = 0, variance_error = 0, relative = 0;
    const FrameData data = podee_frame(true);
    for (int i = 0; i < 1500; i++) {
        const Footprint p = random_footprint(&r);
        const double k = exp(random_range(&r, -1, 4)), direction = random_range(&r, -pi, pi), amplitude = 0.1;
        WaveData w = wave_of(amplitude, k * cos(direction), k * sin(direction));
        w.phase = (float)random_range(&r, -0.5, 0.5);
        const TileData tile = {.mixed_count = 1};
        const struct kernel_context cx = {.frame = &data, .tile = &tile, .waves = &w};
        const double half = (double)half_span(&cx, p, w);
        const double share = (double)podee_fraction(&cx, p, w);
        if (share == 0 || half > 100)
            continue;
        const PodeeSurface s = podee_surface(&cx, 0, 0, vec2(0, 0), p);
        double mean, variance;
        span_means(share * amplitude, 2 * pi * (double)w.phase, half, &mean, &variance);
        const double measured = (double)(s.surface.variance_xx + s.surface.variance_zz) / (k * k);
        const double measured_mean = ((double)s.mean_close.x * (double)w.k_x + (double)s.mean_close.y * (double)w.k_z) / (k * k);
        const double unit = share * amplitude;
        mean_error = fmax(mean_error, fabs(measured_mean - mean) / unit);
        variance_error = fmax(variance_error, fabs(measured - variance) / (unit * unit));
        if (variance > 1e-3 * unit * unit)
            relative = fmax(relative, fabs(measured / variance - 1));
        /* One wave: xx, xz, zz are those of k kᵀ. */
        assert_true(fabs((double)(s.surface.variance_xz * w.k_x - s.surface.variance_xx * w.k_z)) <= 1e-5 * (double)s.surface.variance_xx * k + 1e-12);
        assert_true(s.mean_open.x == s.mean_close.x && s.mean_open.y == s.mean_close.y); /* no time passes here */
    }
    expect_below("mean over the span, of the amplitude", mean_error, 2e-6);
    expect_below("variance over the span, of A²", variance_error, 3.5e-5);
    expect_below("the same, relative where above A²/1000", relative, 0.006);
}

static void split_is_as_published(void **state)
{
    (void)state;
    const FrameData data = podee_frame(false);
    double worst = 0;
    for (int i = 1; i <= 70; i++) {
        const double frequency = i / 100.0, k = 2 * pi * frequency, amplitude = 0.1;
        const Footprint p = {{1, 0}, {0, 1}, {0, 0}};
        WaveData w = wave_of(amplitude, 0.6 * k, 0.8 * k);
        w.phase = 0.13f;
        const TileData tile = {.mixed_count = 1};
        const struct kernel_context cx = {.frame = &data, .tile = &tile, .waves = &w};
        const PodeeSurface s = podee_surface(&cx, 0, 0, vec2(0, 0), p);
        const double alpha = fmin(fmax((frequency - 0.2) / 0.3, 0), 1);
        const double slope = (1 - alpha) * amplitude * k * cos(2 * pi * (double)w.phase), variance = alpha * alpha * amplitude * amplitude * k * k / 2;
        worst = fmax(worst, fabs(hypot((double)s.surface.slope_even.x, (double)s.surface.slope_even.y) - fabs(slope)) / (amplitude * k));
        worst = fmax(worst, fabs((double)(s.surface.variance_xx + s.surface.variance_zz) - variance) / (amplitude * amplitude * k * k));
        worst = fmax(worst, fabs((double)s.unresolved - alpha));
    }
    expect_below("slope, variance and share of Eq. 20", worst, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_span_is_walked),
        cmocka_unit_test(pixel_ndf_is_the_mean_over_the_span),
        cmocka_unit_test(split_is_as_published),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
