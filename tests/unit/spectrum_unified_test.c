/* SPDX-License-Identifier: MIT */
/* The spectrum of Elfouhaily et al. against sums of its own formulas, against measured seas, and the waves drawn from it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "scene/scene_fields.h"
#include "sea/spectrum_sample.h"
#include "unit/test_spectrum.h"

static const double PI = 3.14159265358979323846, G = 9.80665;
static const double winds[] = {3, 5, 7, 10, 12, 15};
enum { WINDS = sizeof winds / sizeof winds[0] };

static void assert_between(const char *what, double value, double low, double high)
{
    if (!(value >= low && value <= high))
        fail_msg("%s: %g is not in %g … %g", what, value, low, high);
}

/* The paper's equations once more, as plainly as they can be said. */
static double plain_density(double k, double wind, double age)
{
    const double cm = 0.23, km = 2 * G / (cm * cm), kp = G / (wind * wind) * age * age, c = sqrt(G / k * (1 + pow(k / km, 2))), cp = wind / age;
    const double friction = 0.4 * wind / log(10 / (3.7e-5 * wind * wind / G * pow(age, 0.9)));
    const double alpha_m = 0.01 * (friction < cm ? 1 + log(friction / cm) : 1 + 3 * log(friction / cm)), alpha_p = 0.006 * pow(age, 0.55);
    const double gamma = age < 1 ? 1.7 : 1.7 + 6 * log10(age), sigma = 0.08 * (1 + 4 * pow(age, -3));
    const double peak = exp(-1.25 * pow(kp / k, 2)) * pow(gamma, exp(-pow(sqrt(k / kp) - 1, 2) / (2 * sigma * sigma)));
    const double low = alpha_p / 2 * cp / c * peak * exp(-age / sqrt(10) * (sqrt(k / kp) - 1));
    const double high = alpha_m / 2 * cm / c * peak * exp(-pow(k / km - 1, 2) / 4);
    return (low + fmax(high, 0)) / pow(k, 3);
}

typedef struct moments {
    double height, slope; /* variances */
} moments;

static moments plain_moments(double wind, double age, double shortest)
{
    enum { STEPS = 4000 };
    const double low = log(0.09 * G * age * age / (wind * wind)), step = (log(2 * PI / shortest) - low) / STEPS;
    moments sum = {0};
    for (int i = 0; i < STEPS; i++) {
        const double k = exp(low + (i + 0.5) * step), part = plain_density(k, wind, age) * k * step;
        sum.height += part;
        sum.slope += k * k * part;
    }
    return sum;
}

static wave_spectrum unified(double wind, double fetch, double shortest)
{
    return make(&(spectrum_settings){.kind = SPECTRUM_ELFOUHAILY, .wind = wind, .fetch = fetch, .shortest = shortest});
}

static void it_has_the_moments_of_its_formulas(void **state)
{
    (void)state;
    static const double fetches[] = {0, 5e4, 2e5};
    static const double shortest[] = {0.05, 0.002};
    for (int i = 0; i < WINDS; i++)
        for (int k = 0; k < 6; k++) {
            const wave_spectrum s = unified(winds[i], fetches[k % 3], shortest[k / 3]);
            const moments expected = plain_moments(winds[i], unified_age(winds[i], fetches[k % 3]), shortest[k / 3]);
            const sea_statistics found = statistics(&s);
            assert_near(found.height, 4 * sqrt(expected.height), 1e-5);
            assert_near(found.slope, expected.slope, 1e-5);
        }
}

/* Cox and Munk's clean sea, by all waves down to 1 mm, in the winds that they measured. */
static void its_slopes_are_those_of_a_clean_sea(void **state)
{
    (void)state;
    for (int i = 0; i < WINDS; i++) {
        const wave_spectrum s = unified(winds[i], 0, 1e-3);
        const sea_statistics sea = statistics(&s);
        const cox_munk clean = cox_munk_slopes(wind_at_height(winds[i], 10, 12.5));
        assert_between("slope over Cox and Munk's", sea.slope / clean.total, 1, winds[i] < 5 ? 1.25 : 1.12);
        assert_between("slope upwind over Cox and Munk's", sea.upwind / clean.upwind, 1, winds[i] < 5 ? 1.5 : 1.2);
        assert_true(sea.upwind > sea.crosswind);
    }
}

/* 0.235 U²/g of Pierson and Moskowitz, U at 10 m; the unified spectrum gives a tenth more. */
static void a_developed_sea_has_the_known_height(void **state)
{
    (void)state;
    for (int i = 0; i < WINDS; i++) {
        const wave_spectrum s = unified(winds[i], 0, 0.05), long_fetch = unified(winds[i], 1e7, 0.05);
        const double unit = winds[i] * winds[i] / G, height = statistics(&s).height / unit;
        assert_between("height over U²/g", height, 0.235, 0.235 * 1.12);
        assert_near(statistics(&long_fetch).height / unit, height, 0.05);
        assert_near(wave_spectrum_peak(&s), 0.84 * G / winds[i], 0.08);
    }
}

/* Measured growth with fetch (Hasselmann et al. 1973): 0.0016 (g F / U²)^½ U²/g, for young seas. */
static void a_young_sea_grows_with_its_fetch(void **state)
{
    (void)state;
    for (double fetch = 2e3; fetch < 1e5; fetch *= 2) {
        const wave_spectrum s = unified(10, fetch, 0.05);
        assert_between("height over JONSWAP's", statistics(&s).height / (0.0016 * sqrt(G * fetch / 100) * 100 / G), 0.7, 1.3);
    }
    assert_near(unified_age(7, unified_fetch(7, 3)), 3, 1e-12);
    assert_near(unified_age(20, unified_fetch(20, 1)), 1, 1e-12);
    assert_near(unified_age(7, 0), 0.84, 0);
}

static void it_spreads_as_published(void **state)
{
    (void)state;
    const wave_spectrum s = unified(10, 0, 0.002);
    for (double k = 0.02; k < 3000; k *= 3) {
        const double f = dispersion_frequency(k, 0), c = sqrt(G / k * (1 + pow(k * 0.23 * 0.23 / (2 * G), 2))), cp = 10 / 0.84;
        const double delta = tanh(log(2) / 4 + 4 * pow(c / cp, 2.5) + 0.13 * s.unified.friction / 0.23 * pow(0.23 / c, 2.5));
        double sum = 0, second = 0;
        for (int i = -1800; i < 1800; i++) {
            const double angle = (i + 0.5) * PI / 1800, share = wave_spectrum_spreading(&s, f, s.downwind + angle);
            sum += share;
            second += share * cos(2 * angle);
            assert_true(share >= 0 && (share > 0) == (fabs(angle) < PI / 2));
        }
        assert_near(second / sum, delta / 2, 1e-5);
    }
}

static void its_waves_have_its_variances(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    mgt_wave waves[COUNT];
    wave_spectrum s = unified(8, 1e5, 0.05);
    const sea_statistics sea = statistics(&s);
    assert_true(spectrum_sample(&s, 3, COUNT, waves));
    const sea_statistics drawn = waves_statistics(waves, COUNT, s.downwind);
    assert_near(drawn.height, sea.height, 1e-5);
    assert_near(drawn.slope, sea.slope, 1e-5);
    assert_near(drawn.upwind, sea.upwind, 0.03);
    for (int i = 0; i < COUNT; i++)
        assert_true(waves[i].kz > 0); /* from -z towards +z */

    const cox_munk clean = cox_munk_slopes(wind_at_height(8, 10, 12.5));
    spectrum_fault fault;
    assert_true(spectrum_bend_tail(&s, clean, &fault));
    assert_near(statistics(&s).slope, clean.total, 1e-3);
    assert_near(statistics(&s).upwind, clean.total * clean.upwind / (clean.upwind + clean.crosswind), 0.02);
    assert_near(statistics(&s).height, sea.height, 0.02);
}

static void a_fetch_may_be_too_short(void **state)
{
    (void)state;
    const spectrum_settings settings = {.kind = SPECTRUM_ELFOUHAILY, .wind = 20, .fetch = 500};
    wave_spectrum s;
    spectrum_fault fault = {0};
    assert_false(wave_spectrum_make(&s, &settings, NULL, &fault));
    assert_string_equal(fault.key, "fetch");
    assert_string_equal(fault.text, "is 500 m, too short for the spectrum in this wind; allowed: at least 2365 m");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_has_the_moments_of_its_formulas),
        cmocka_unit_test(its_slopes_are_those_of_a_clean_sea),
        cmocka_unit_test(a_developed_sea_has_the_known_height),
        cmocka_unit_test(a_young_sea_grows_with_its_fetch),
        cmocka_unit_test(it_spreads_as_published),
        cmocka_unit_test(its_waves_have_its_variances),
        cmocka_unit_test(a_fetch_may_be_too_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
