/* SPDX-License-Identifier: MIT */
/* Wave spectra against their closed forms, and the waves drawn from them against the spectra. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/spectrum_table_read.h"
#include "scene/scene_edit.h"
#include "scene/scene_sea.h"
#include "sea/spectrum_math.h"
#include "unit/test_spectrum.h"

static spectrum_settings settings_of(spectrum_kind kind, double wind)
{
    return (spectrum_settings){.kind = kind, .wind = wind, .fetch = 1e5, .gamma = 3.3, .directions = DIRECTIONS_HASSELMANN, .spread = 10};
}

/* ---- functions ---------------------------------------------------------------------------------------------- */

static void portable_functions_are_those_of_the_c_library(void **state)
{
    (void)state;
    for (int i = -2000; i <= 2000; i++) {
        const double x = i * 0.05 + 1e-3;
        assert_near(portable_exp(x), exp(x), 1e-15 + 3e-16 * fabs(x));
        assert_true(fabs(portable_sin(x) - sin(x)) < 4e-16);
        assert_true(fabs(portable_cos(x) - cos(x)) < 4e-16);
        assert_near(portable_log(exp(x)), log(exp(x)), 1e-15);
        assert_near(portable_tanh(fabs(x)), tanh(fabs(x)), 5e-15);
        assert_near(portable_pow(1.7, x), pow(1.7, x), 1e-15 * (2 + fabs(x)));
    }
    for (double x = 1e-9; x < 0.1; x *= 1.1)
        assert_near(portable_tanh(x), tanh(x), 1e-14);
    assert_true(portable_exp(-1000) == 0 && portable_exp(0) == 1 && portable_log(1) == 0 && portable_pow(0, 2) == 0);
}

static void dispersion_goes_there_and_back(void **state)
{
    (void)state;
    static const double depths[] = {0, 0.05, 1, 7, 50, 4000};
    for (size_t d = 0; d < sizeof depths / sizeof depths[0]; d++)
        for (double k = 1e-4; k < 1e4; k *= 1.37) {
            const double w = dispersion_frequency(k, depths[d]);
            assert_near(dispersion_wave_number(w, depths[d]), k, 1e-13);
            const double t = depths[d] > 0 ? tanh(k * depths[d]) : 1;
            assert_near(w * w, 9.80665 * k * t, 1e-13);
        }
    /* Shallow water: every wave runs with √(g d). */
    assert_near(dispersion_frequency(1e-3, 2) / 1e-3, sqrt(9.80665 * 2), 1e-5);
}

/* Kitaigorodskii's factor by its definition, with a difference quotient. */
static void the_factor_of_depth_is_a_ratio_of_derivatives(void **state)
{
    (void)state;
    for (double depth = 0.5; depth < 100; depth *= 3)
        for (double w = 0.2; w < 5; w *= 1.5) {
            const double h = 1e-5 * w, k = dispersion_wave_number(w, depth), deep = w * w / 9.80665;
            const double slope = (dispersion_wave_number(w + h, depth) - dispersion_wave_number(w - h, depth)) / (2 * h);
            assert_near(depth_factor(w, depth), slope / (k * k * k) / (2 * w / 9.80665 / (deep * deep * deep)), 1e-7);
        }
    assert_true(depth_factor(2, 0) == 1 && depth_factor(2, 1e4) == 1);
}

/* ---- published spectra -------------------------------------------------------------------------------------- */

static void pierson_moskowitz_has_its_height_and_slope(void **state)
{
    (void)state;
    for (double wind = 2; wind < 30; wind += 3.5) {
        const spectrum_settings settings = settings_of(SPECTRUM_PIERSON_MOSKOWITZ, wind);
        const wave_spectrum s = make(&settings);
        const sea_statistics found = statistics(&s);
        /* m0 = α U⁴ / (4 β g²): the height is 0.2092 U²/g. */
        const double height = 2 * wind * wind / 9.80665 * sqrt(8.1e-3 / 0.74);
        const double cut = s.peak / s.high; /* what is shorter than the shortest wave is missing */
        assert_near(found.height, height * exp(-0.625 * cut * cut * cut * cut), 1e-7);
        assert_near(closed_form_height(s.alpha, s.peak, 1), height, 1e-12);
        assert_near(height, 0.2092 * wind * wind / 9.80665, 1e-3);
        assert_near(found.slope, closed_form_slope(s.alpha, s.peak, s.high), 1e-7);
        /* The density at one point, as the paper writes it. */
        const double w = 1.3 * s.peak, w0 = 9.80665 / wind;
        assert_near(wave_spectrum_density(&s, w), 8.1e-3 * 9.80665 * 9.80665 * pow(w, -5) * exp(-0.74 * pow(w0 / w, 4)), 1e-12);
    }
    /* 10 m/s at 10 m are 10.6 m/s at 19.5 m. */
    spectrum_settings settings = settings_of(SPECTRUM_PIERSON_MOSKOWITZ, 10);
    const double at_paper = make(&settings).peak;
    settings.wind_height = 10;
    assert_near(at_paper / make(&settings).peak, 1 + sqrt(1.3e-3) / 0.4 * log(1.95), 1e-12);
}

static void jonswap_is_pierson_moskowitz_without_its_peak(void **state)
{
    (void)state;
    spectrum_settings settings = settings_of(SPECTRUM_PIERSON_MOSKOWITZ, 9);
    const wave_spectrum pm = make(&settings);
    settings = settings_of(SPECTRUM_JONSWAP, 9);
    settings.gamma = 1;
    wave_spectrum j = make(&settings);
    /* The published growth with fetch: ω_p = 22 (g²/(U F))^⅓, α = 0.076 (U²/(F g))^0.22. */
    assert_near(j.peak, 22 * cbrt(9.80665 * 9.80665 / 9e5), 1e-12);
    assert_near(j.alpha, 0.076 * pow(81 / 9.80665e5, 0.22), 1e-12);
    assert_near(statistics(&j).height, closed_form_height(j.alpha, j.peak, 1), 1e-4);
    assert_near(statistics(&j).slope, closed_form_slope(j.alpha, j.peak, j.high), 1e-7);
    j.alpha = pm.alpha;
    j.peak = pm.peak;
    j.low = pm.low;
    for (double w = pm.low; w < pm.high; w *= 1.1)
        assert_true(wave_spectrum_density(&j, w) == wave_spectrum_density(&pm, w));
    /* γ multiplies the peak, and the variance by about 1 / (1 - 0.287 ln γ). */
    settings.gamma = 3.3;
    const wave_spectrum peaked = make(&settings);
    settings.gamma = 1;
    const wave_spectrum flat = make(&settings);
    assert_near(wave_spectrum_density(&peaked, flat.peak), 3.3 * wave_spectrum_density(&flat, flat.peak), 1e-12);
    assert_near(wave_spectrum_density(&peaked, 0.93 * flat.peak), pow(3.3, exp(-0.5)) * wave_spectrum_density(&flat, 0.93 * flat.peak), 1e-9);
    assert_near(wave_spectrum_density(&peaked, 1.09 * flat.peak), pow(3.3, exp(-0.5)) * wave_spectrum_density(&flat, 1.09 * flat.peak), 1e-9);
    assert_near(statistics(&peaked).height, closed_form_height(flat.alpha, flat.peak, 3.3), 0.02);
}

/* A very large depth changes nothing, a small one multiplies by the factor. */
static void depth_is_a_factor_on_deep_water(const spectrum_settings *of_deep, spectrum_kind kind)
{
    const wave_spectrum deep = make(of_deep);
    spectrum_settings settings = *of_deep;
    settings.kind = kind;
    settings.depth = 3000;
    const wave_spectrum deeper = make(&settings);
    for (double w = deep.low; w < deep.high; w *= 1.07)
        assert_near(wave_spectrum_density(&deeper, w), wave_spectrum_density(&deep, w), 1e-12);
    settings.depth = 5;
    const wave_spectrum shallow = make(&settings);
    assert_near(wave_spectrum_density(&shallow, deep.peak), depth_factor(deep.peak, 5) * wave_spectrum_density(&deep, deep.peak), 1e-12);
    assert_true(statistics(&shallow).height < 0.8 * statistics(&deep).height);
    assert_true(wave_spectrum_peak(&shallow) > deep.peak);
}

static void depth_leads_from_deep_water(void **state)
{
    (void)state;
    const spectrum_settings jonswap = settings_of(SPECTRUM_JONSWAP, 12), unified = settings_of(SPECTRUM_ELFOUHAILY, 12);
    depth_is_a_factor_on_deep_water(&jonswap, SPECTRUM_TMA);
    depth_is_a_factor_on_deep_water(&unified, SPECTRUM_ELFOUHAILY);
}

/* Discrete sums over an even grid, another rule than the one that the code uses. */
static void the_quadrature_is_right(void **state)
{
    (void)state;
    static const spectrum_kind kinds[] = {SPECTRUM_PIERSON_MOSKOWITZ, SPECTRUM_JONSWAP, SPECTRUM_TMA};
    for (size_t i = 0; i < 3; i++) {
        spectrum_settings settings = settings_of(kinds[i], 7);
        settings.depth = kinds[i] == SPECTRUM_TMA ? 6 : 0;
        settings.directions = (spectrum_directions)i;
        const wave_spectrum s = make(&settings);
        const int steps = 40000, angles = 360;
        double height = 0, slope = 0, upwind = 0;
        for (int j = 0; j < steps; j++) {
            const double w = s.low + (s.high - s.low) * (j + 0.5) / steps, k = dispersion_wave_number(w, s.depth);
            const double variance = wave_spectrum_density(&s, w) * (s.high - s.low) / steps;
            height += variance;
            slope += k * k * variance;
            if (j % 100 != 0)
                continue;
            double all = 0, along = 0;
            for (int a = 0; a < angles; a++) {
                const double angle = 2 * SPECTRUM_PI * (a + 0.5) / angles, share = wave_spectrum_spreading(&s, w, s.downwind + angle);
                all += share;
                along += share * cos(angle) * cos(angle);
            }
            upwind += 100 * k * k * variance * along / all;
        }
        const sea_statistics found = statistics(&s);
        assert_near(found.height, 4 * sqrt(height), 1e-5);
        assert_near(found.slope, slope, 1e-4);
        assert_near(found.upwind, upwind, 0.02);
        assert_near(found.upwind + found.crosswind, found.slope, 1e-12);
    }
}

static double mean_cosine(const wave_spectrum *s, double w, int order)
{
    double all = 0, weighted = 0;
    for (int a = 0; a < 3600; a++) {
        const double angle = 2 * SPECTRUM_PI * a / 3600, share = wave_spectrum_spreading(s, w, s->downwind + angle);
        all += share;
        weighted += share * cos(order * angle);
    }
    return weighted / all;
}

/* cos^2s of half the angle has the Fourier coefficients s/(s+1) and s(s-1)/((s+1)(s+2)). */
static void spreadings_are_the_published_ones(void **state)
{
    (void)state;
    spectrum_settings settings = settings_of(SPECTRUM_JONSWAP, 10);
    settings.directions = DIRECTIONS_FIXED;
    settings.spread = 7.5;
    wave_spectrum s = make(&settings);
    assert_near(mean_cosine(&s, 2, 1), 7.5 / 8.5, 1e-9);
    assert_near(mean_cosine(&s, 2, 2), 7.5 * 6.5 / (8.5 * 9.5), 1e-9);
    settings.directions = DIRECTIONS_MITSUYASU;
    s = make(&settings);
    const double age = 10 * s.peak / 9.80665;
    double spread = 11.5 * pow(age, -2.5) * pow(2, -2.5);
    assert_near(mean_cosine(&s, 2 * s.peak, 1), spread / (spread + 1), 1e-6);
    spread = 11.5 * pow(age, -2.5) * pow(0.8, 5);
    assert_near(mean_cosine(&s, 0.8 * s.peak, 1), spread / (spread + 1), 1e-6);
    settings.directions = DIRECTIONS_HASSELMANN;
    s = make(&settings);
    spread = 6.97 * pow(0.9, 4.06);
    assert_near(mean_cosine(&s, 0.9 * s.peak, 1), spread / (spread + 1), 1e-6);
    spread = 9.77 * pow(3, -2.33 - 1.45 * (age - 1.17));
    assert_near(mean_cosine(&s, 3 * s.peak, 1), spread / (spread + 1), 1e-4);
    settings.directions = DIRECTIONS_DONELAN_BANNER;
    s = make(&settings);
    const double beta = 2.28 * pow(1.2, -1.3);
    const double w = 1.2 * s.peak, ahead = wave_spectrum_spreading(&s, w, s.downwind), aside = wave_spectrum_spreading(&s, w, s.downwind + 0.5);
    assert_near(aside / ahead, pow(cosh(beta * 0.5), -2), 1e-12);
    assert_near(aside, wave_spectrum_spreading(&s, w, s.downwind - 0.5 - 4 * SPECTRUM_PI), 1e-12);
}

/* ---- waves -------------------------------------------------------------------------------------------------- */

static void waves_have_the_variances_of_their_spectrum(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 5, 16, 64, 511, 512, 2048};
    mgt_wave waves[MGT_MAX_WAVES];
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        for (double depth = 0; depth < 20; depth += 8) {
            spectrum_settings settings = settings_of(SPECTRUM_JONSWAP, 8);
            settings.depth = depth;
            settings.direction_deg = 60;
            const wave_spectrum s = make(&settings);
            const sea_statistics wanted = statistics(&s);
            assert_true(spectrum_sample(&s, 3, counts[i], waves));
            const sea_statistics found = waves_statistics(waves, counts[i], s.downwind);
            assert_near(found.height, wanted.height, 1e-6);
            assert_near(found.slope, wanted.slope, 1e-6);
            if (counts[i] >= 16)
                assert_near(found.upwind, wanted.upwind, counts[i] >= 64 ? 0.03 : 0.2);
            for (size_t w = 0; w < counts[i]; w++) {
                const double k = hypot(waves[w].kx, waves[w].kz);
                assert_near(waves[w].omega, -dispersion_frequency(k, depth), 1e-6);
                assert_true(waves[w].amplitude > 0 && k <= dispersion_wave_number(s.high, depth) * 1.000001);
                assert_true(w == 0 || k >= hypot(waves[w - 1].kx, waves[w - 1].kz));
                assert_true(waves[w].phase >= 0 && waves[w].phase <= 6.2831854);
            }
        }
}

static void waves_run_with_the_wind(void **state)
{
    (void)state;
    mgt_wave waves[256];
    /* Degrees where the wind comes from, and where it blows to in x and z. */
    static const double winds[][3] = {{0, 0, 1}, {90, -1, 0}, {180, 0, -1}, {270, 1, 0}, {-450, 1, 0}};
    for (size_t i = 0; i < sizeof winds / sizeof winds[0]; i++) {
        spectrum_settings settings = settings_of(SPECTRUM_JONSWAP, 8);
        settings.direction_deg = winds[i][0];
        const wave_spectrum s = make(&settings);
        assert_true(spectrum_sample(&s, 1, 256, waves));
        double x = 0, z = 0;
        for (size_t w = 0; w < 256; w++) {
            const double variance = waves[w].amplitude * waves[w].amplitude / 2, k = hypot(waves[w].kx, waves[w].kz);
            assert_true(waves[w].omega < 0);
            x += variance * waves[w].kx / k;
            z += variance * waves[w].kz / k;
        }
        const double length = hypot(x, z);
        assert_true(x / length * winds[i][1] + z / length * winds[i][2] > 0.99);
    }
}

/* Whatever the seed: the longest wave right along the wind, and all together. */
static void few_waves_run_with_the_wind(void **state)
{
    (void)state;
    static const spectrum_kind kinds[] = {SPECTRUM_PIERSON_MOSKOWITZ, SPECTRUM_JONSWAP, SPECTRUM_ELFOUHAILY};
    mgt_wave waves[4];
    for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; kind++)
        for (size_t count = 1; count <= 4; count++)
            for (uint32_t seed = 0; seed < 5; seed++) {
                spectrum_settings settings = settings_of(kinds[kind], 8);
                settings.direction_deg = 30.0 * (double)seed;
                const wave_spectrum s = make(&settings);
                assert_true(spectrum_sample(&s, seed, count, waves));
                const double x = portable_sin(s.downwind), z = -portable_cos(s.downwind);
                double along = 0, across = 0;
                for (size_t w = 0; w < count; w++) {
                    const double k = hypot(waves[w].kx, waves[w].kz), cosine = (waves[w].kx * x + waves[w].kz * z) / k;
                    const double sine = (waves[w].kx * z - waves[w].kz * x) / k;
                    if (w == 0 && !(cosine > 1 - 1e-12))
                        fail_msg("kind %zu, %zu waves, seed %u: the longest wave runs at a cosine of %.17g to the wind", kind, count, seed, cosine);
                    along += cosine;
                    across += sine;
                }
                if (!(along > 0.4 * (double)count && fabs(across) < 0.2 * along))
                    fail_msg("kind %zu, %zu waves, seed %u: %g along the wind, %g across it", kind, count, seed, along, across);
            }
}

static void seeds_make_other_seas_of_the_same_kind(void **state)
{
    (void)state;
    mgt_wave one[64], again[64], other[64];
    const spectrum_settings settings = settings_of(SPECTRUM_PIERSON_MOSKOWITZ, 6);
    const wave_spectrum s = make(&settings);
    assert_true(spectrum_sample(&s, 1, 64, one) && spectrum_sample(&s, 1, 64, again) && spectrum_sample(&s, 2, 64, other));
    assert_memory_equal(one, again, sizeof one);
    for (int i = 0; i < 64; i++)
        assert_true(one[i].amplitude == other[i].amplitude && one[i].phase != other[i].phase && one[i].kx != other[i].kx);
}

static void cox_and_munk_are_met(void **state)
{
    (void)state;
    mgt_wave waves[MGT_MAX_WAVES];
    for (double wind = 2; wind < 15; wind += 2.5)
        for (int directions = 0; directions < 4; directions++) {
            spectrum_settings settings = settings_of(directions % 2 ? SPECTRUM_JONSWAP : SPECTRUM_PIERSON_MOSKOWITZ, wind);
            settings.wind_height = 12.5;
            settings.directions = (spectrum_directions)directions;
            wave_spectrum s = make(&settings);
            const cox_munk clean = cox_munk_slopes(wind);
            spectrum_fault fault = {0};
            assert_near(clean.total, 0.003 + 0.00512 * wind, 1e-12);
            const double untouched = wave_spectrum_density(&s, 2.9 * s.peak);
            if (!spectrum_bend_tail(&s, clean, &fault))
                fail_msg("wind %g: %s %s", wind, fault.key, fault.text);
            assert_true(wave_spectrum_density(&s, 2.9 * s.peak) == untouched);
            assert_near(statistics(&s).slope, clean.total, 1e-6);
            assert_true(spectrum_sample(&s, 1, 512, waves));
            const sea_statistics found = waves_statistics(waves, 512, s.downwind);
            assert_near(found.slope, clean.total, 1e-5);
            /* In light winds the longer waves alone are more one-sided than Cox and Munk's sea: the tail then does what it can. */
            const bool clamped = s.bend_spread < 0.45;
            assert_true(!clamped || wind < 5);
            if (!clamped)
                assert_near(found.upwind, clean.total * clean.upwind / (clean.upwind + clean.crosswind), 0.02);
        }
    spectrum_settings settings = settings_of(SPECTRUM_JONSWAP, 12);
    settings.fetch = 100; /* young waves alone are steeper than that */
    wave_spectrum s = make(&settings);
    spectrum_fault fault = {0};
    assert_false(spectrum_bend_tail(&s, cox_munk_slopes(0.5), &fault));
    assert_string_equal(fault.key, "slope");
}

/* ---- tables ------------------------------------------------------------------------------------------------- */

static spectrum_table parse_table(const char *text)
{
    spectrum_table table;
    scene_error error = {0};
    if (!spectrum_table_parse(&table, text, strlen(text), "buoy.txt", &error))
        fail_msg("%s", error.text);
    return table;
}

/* Their heights are a trillionth of the sea's variance and less. */
static void short_waves_of_a_high_sea_are_no_noise(void **state)
{
    (void)state;
    static mgt_wave waves[MGT_MAX_WAVES];
    static const size_t counts[] = {1, 64, MGT_MAX_WAVES};
    for (size_t i = 0; i < 3; i++) {
        spectrum_settings settings = settings_of(SPECTRUM_PIERSON_MOSKOWITZ, 75);
        wave_spectrum s;
        spectrum_fault fault;
        settings.shortest = 1e-4;
        assert_true(wave_spectrum_make(&s, &settings, NULL, &fault));
        assert_true(spectrum_sample(&s, 1, counts[i], waves));
        double before = 0;
        for (size_t k = 0; k < counts[i]; k++) {
            const double number = hypot(waves[k].kx, waves[k].kz);
            assert_true(waves[k].amplitude > 0 && number >= before * (1 - 1e-6) && number < 2 * SPECTRUM_PI / 1e-4);
            before = number;
        }
        assert_near(waves_statistics(waves, counts[i], s.downwind).slope, statistics(&s).slope, 1e-4 * statistics(&s).slope);
    }
}

static void a_table_is_integrated_by_trapezia(void **state)
{
    (void)state;
    /* Uneven frequencies; 0.1 Hz: a triangle of 40° around west; 0.2 Hz: even all around; the gaps of 0.1 Hz are wide: nothing there. */
    spectrum_table table = parse_table("# a buoy\nfrequency direction density\n0.1 270 0.5 # peak\n0.1 250,0\n0.1 290\t0\r\n\n"
                                       "0.2 0 0.01\n0.2 90 0.01\n0.2 180 0.01\n0.2 -90 0.01\n0.5 10 0\n0.5 20 0\n");
    assert_int_equal(table.row_count, 3);
    const double hertz = 2 * SPECTRUM_PI;
    assert_near(table.rows[0].density * hertz, 0.5 * 20, 1e-12);
    assert_near(table.rows[1].density * hertz, 0.01 * 360, 1e-12);
    assert_near(spectrum_table_density(&table, 0.15 * hertz) * hertz, (10 + 3.6) / 2, 1e-12);
    assert_true(spectrum_table_density(&table, 0.05 * hertz) == 0 && spectrum_table_density(&table, 0.6 * hertz) == 0);
    /* From the west, that is to the east; per radian. */
    assert_near(spectrum_table_at(&table, 0.1 * hertz, SPECTRUM_PI / 2) * hertz, 0.5 * 180 / SPECTRUM_PI, 1e-12);
    assert_near(spectrum_table_at(&table, 0.1 * hertz, SPECTRUM_PI / 2 + SPECTRUM_PI / 18) * hertz, 0.25 * 180 / SPECTRUM_PI, 1e-9);
    assert_true(spectrum_table_at(&table, 0.1 * hertz, 0) == 0 && spectrum_table_at(&table, 0.1 * hertz, -SPECTRUM_PI / 2) == 0);
    assert_near(spectrum_table_mean_azimuth(&table), SPECTRUM_PI / 2, 1e-9);

    spectrum_settings settings = settings_of(SPECTRUM_BUOY, 8);
    wave_spectrum s;
    spectrum_fault fault;
    assert_true(wave_spectrum_make(&s, &settings, &table, &fault));
    const double variance = 0.1 * (10 + 3.6) / 2 + 0.3 * 3.6 / 2;
    assert_near(statistics(&s).height, 4 * sqrt(variance), 1e-5);
    mgt_wave waves[64];
    assert_true(spectrum_sample(&s, 1, 64, waves));
    assert_near(waves_statistics(waves, 64, s.downwind).height, 4 * sqrt(variance), 1e-5);
    assert_true(waves[0].kx > 0 && fabs(waves[0].kz) < waves[0].kx); /* the swell runs east */

    /* With a shorter wave the table gets a tail of ω⁻⁵, with cox-munk one that meets it. */
    settings.shortest = 0.1;
    assert_true(wave_spectrum_make(&s, &settings, &table, &fault));
    assert_near(dispersion_wave_number(s.high, 0), 2 * SPECTRUM_PI / 0.1, 1e-9);
    spectrum_table_free(&table);
}

static void a_tail_goes_on_where_a_table_ends(void **state)
{
    (void)state;
    spectrum_table table = parse_table("frequency direction density_rad\n0.1 180 0.1\n0.1 200 0.5\n0.1 220 0.1\n0.4 180 0.01\n0.4 200 0.05\n0.4 220 0.01\n");
    assert_near(table.rows[0].density * 2 * SPECTRUM_PI, 0.6 * SPECTRUM_PI / 9, 1e-12);
    spectrum_settings settings = settings_of(SPECTRUM_BUOY, 8);
    settings.shortest = 0.1;
    wave_spectrum s;
    spectrum_fault fault = {0};
    assert_true(wave_spectrum_make(&s, &settings, &table, &fault));
    const double end = 0.4 * 2 * SPECTRUM_PI;
    assert_near(wave_spectrum_density(&s, 2 * end), wave_spectrum_density(&s, end) / 32, 1e-12);
    const cox_munk clean = cox_munk_slopes(8);
    assert_true(spectrum_bend_tail(&s, clean, &fault));
    assert_near(statistics(&s).slope, clean.total, 1e-6);
    settings.shortest = 20;
    assert_false(wave_spectrum_make(&s, &settings, &table, &fault));
    assert_string_equal(fault.key, "shortest");
    spectrum_table_free(&table);
}

static void bad_tables_say_where(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"", "buoy.txt:1:1: the table holds no rows; allowed: lines of"},
        {"# nothing\n\n", "no rows"},
        {"frequency direction density\n", "no rows"},
        {"0.1 0 1\n0.1 10 1\n", "buoy.txt:1:1: the table holds only one frequency"},
        {"0.1 0 0\n0.1 10 0\n0.2 0 0\n0.2 10 0\n", "every density is 0"},
        {"0.1 0 1\n0.1 9 1\n 0.2 0 1\n", "buoy.txt:3:2: frequency 0.2 Hz has one direction"},
        {"0.1 0 1\n0.1 0 1\n0.2 0 1\n0.2 1 1\n", "buoy.txt:2:1: frequency 0.1 Hz has a direction twice"},
        {"0.1 0 1\n0.1 360 1\n0.2 0 1\n0.2 1 1\n", "has a direction twice"},
        {"0.1 0 0\n0.1 180 0\n0.2 0 0\n0.2 180 1\n", "buoy.txt:4:1: the table holds no waves: gaps of over 90 degrees"},
        {"0.1 0 0\n0.1 10 0\n0.2 0 0\n0.2 10 1e9\n", "buoy.txt:4:1: densities such as this one make a wave of"},
        {"0.1 0 1\n0.1 x 1\n", "buoy.txt:2:5: direction is x; allowed: a number, -360 to 360 degrees"},
        {"0.1 0 1\n0.1 10 -1\n", "buoy.txt:2:8: density is -1; allowed: a number, 0 to 1e9"},
        {"0.1 0 nan\n", "buoy.txt:1:7: density is nan"},
        {"-1 0 1\n", "buoy.txt:1:1: frequency is -1"},
        {"0.1 0\n", "buoy.txt:1:1: two of three columns"},
        {"0.1 0 1 2\n", "buoy.txt:1:9: more than three columns"},
        {"0.2 0 1\n0.2 1 1\n  0.1 0 1\n", "buoy.txt:3:3: frequency falls from 0.2 to 0.1 Hz"},
        {"freq dir dens\n0.1 0 1\n", "buoy.txt:1:1: these are not the names of the columns"},
        {"0.1 0 1\nfrequency direction density\n", "buoy.txt:2:1: frequency is frequency"},
        {"0.1 0 1\n\x01\n", "buoy.txt:2:1: not a text file"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        spectrum_table table;
        scene_error error = {0};
        assert_false(spectrum_table_parse(&table, bad[i][0], strlen(bad[i][0]), "buoy.txt", &error));
        assert_null(table.rows);
        assert_null(table.points);
        if (strstr(error.text, bad[i][1]) == NULL)
            fail_msg("\"%s\" gives \"%s\", not \"%s\"", bad[i][0], error.text, bad[i][1]);
    }
}

/* ---- scenes ------------------------------------------------------------------------------------------------- */

static scene_file *parse_scene(const char *text, scene_error *error) { return scene_file_parse(text, strlen(text), "sea.yaml", NULL, 0, error); }

static void a_spectrum_is_its_waves_written_out(void **state)
{
    (void)state;
    scene_error error = {0};
    scene_file *file = parse_scene("mangata: 1\nwater:\n  waves: [{amplitude: 0.01, a: 1, b: 0, c: -3}]\n"
                                   "  spectrum: {model: tma, wind: 9, depth: 8, directions: donelan-banner, slope: cox-munk, count: 40, seed: 5}\n",
                                   &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    assert_int_equal(scene_file_wave_count(file), 41);
    mgt_scene scene;
    assert_true(scene_file_frame(file, 0, &scene));
    assert_int_equal(scene.water.wave_count, 41);
    assert_true(scene.water.waves[0].amplitude == 0.01);

    /* The settings come back from text, and the same pictures without them. */
    for (int written_out = 0; written_out < 2; written_out++) {
        scene_values values;
        char *text = NULL, *expected = scene_file_canonical(file, NULL);
        size_t size;
        assert_true(scene_values_copy(&values, scene_file_values(file)));
        if (written_out)
            scene_values_write_out_sea(&values);
        FILE *stream = open_memstream(&text, &size);
        assert_true(scene_values_write(stream, &values));
        fclose(stream);
        assert_int_equal(strstr(text, "tma") == NULL, written_out);
        assert_int_equal(strstr(text, "spectrum") == NULL, written_out);
        scene_file *again = parse_scene(text, &error);
        if (again == NULL)
            fail_msg("%s\n%s", error.text, text);
        char *found = scene_file_canonical(again, NULL);
        assert_string_equal(found, expected);
        free(found);
        free(expected);
        free(text);
        scene_file_free(again);
        scene_values_free(&values);
    }
    scene_file_free(file);
}

static void bad_spectra_say_where(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"{model: jonswap, wind: -3}", "sea.yaml:2:42: water.spectrum.wind is -3; allowed: a number, 0.5 to 75 m/s"},
        {"{model: jonswap, wind: 900}", "wind is 900; allowed"},
        {"{model: jonswap, fetch: -5}", "fetch is -5; allowed: a number, 100 to 1e7 m"},
        {"{model: phillips}", "model is phillips; allowed: one of none, pierson-moskowitz, jonswap, tma, elfouhaily, buoy"},
        {"{model: tma}", "sea.yaml:2:19: water.spectrum.depth is 0: tma is a sea of limited depth"},
        {"{model: jonswap, wind: 20, depth: 3}", "sea.yaml:2:53: water.spectrum.depth is 3 m, shallow for this sea's waves"},
        {"{model: buoy}", "sea.yaml:2:19: water.spectrum.file is missing"},
        {"{model: jonswap, count: 2049}", "count is 2049; allowed: a whole number, 1 to 2048"},
        {"{model: jonswap, shortest: 5e-5}", "sea.yaml:2:46: water.spectrum.shortest is 5e-5; allowed: a number, 0 or 0.0001 to 1000 m"},
        {"{model: jonswap, shortest: 500}", "sea.yaml:2:46: water.spectrum.shortest leaves no room"},
        {"{model: jonswap, wind: 0.5, fetch: 100, shortest: 0.01, slope: cox-munk}", "sea.yaml:2:82: water.spectrum.slope cannot be cox-munk"},
        {"{model: buoy, file: no-such-table.txt}", "no-such-table.txt: No such file"},
        {"{model: buoy, file: /}", "/: is a directory"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[256];
        scene_error error = {0};
        snprintf(text, sizeof text, "mangata: 1\nwater: {spectrum: %s}\n", bad[i][0]);
        if (parse_scene(text, &error) != NULL)
            fail_msg("%s is no error", bad[i][0]);
        if (strstr(error.text, bad[i][1]) == NULL)
            fail_msg("%s gives \"%s\", not \"%s\"", bad[i][0], error.text, bad[i][1]);
    }
    scene_error error = {0};
    const char *override = "water.waves=[{amplitude: 0, a: 1, b: 1, c: 1}]", *scene = "mangata: 1\nwater: {spectrum: {model: jonswap, count: 2048}}\n";
    assert_null(scene_file_parse(scene, strlen(scene), "sea.yaml", &override, 1, &error));
    assert_non_null(strstr(error.text, "sea.yaml:2:43: water.spectrum.count is 2048, with water.waves 2049 in all; allowed: together at most 2048"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(portable_functions_are_those_of_the_c_library),
        cmocka_unit_test(dispersion_goes_there_and_back),
        cmocka_unit_test(the_factor_of_depth_is_a_ratio_of_derivatives),
        cmocka_unit_test(pierson_moskowitz_has_its_height_and_slope),
        cmocka_unit_test(jonswap_is_pierson_moskowitz_without_its_peak),
        cmocka_unit_test(depth_leads_from_deep_water),
        cmocka_unit_test(the_quadrature_is_right),
        cmocka_unit_test(spreadings_are_the_published_ones),
        cmocka_unit_test(waves_have_the_variances_of_their_spectrum),
        cmocka_unit_test(waves_run_with_the_wind),
        cmocka_unit_test(few_waves_run_with_the_wind),
        cmocka_unit_test(seeds_make_other_seas_of_the_same_kind),
        cmocka_unit_test(cox_and_munk_are_met),
        cmocka_unit_test(short_waves_of_a_high_sea_are_no_noise),
        cmocka_unit_test(a_table_is_integrated_by_trapezia),
        cmocka_unit_test(a_tail_goes_on_where_a_table_ends),
        cmocka_unit_test(bad_tables_say_where),
        cmocka_unit_test(a_spectrum_is_its_waves_written_out),
        cmocka_unit_test(bad_spectra_say_where),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
