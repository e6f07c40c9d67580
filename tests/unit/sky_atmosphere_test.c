/* SPDX-License-Identifier: MIT
 *
 * The sky around a light, against daylight and twilight as they have been measured, and against itself.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "frame/atmosphere.h"
#include "unit/sky_light.h"
#include "frame/scattering.h"
#include "frame/spectrum.h"

#define PI 3.14159265358979323846

static mgt_sky clear_sky(void) { return (mgt_sky){.model = MGT_SKY_ATMOSPHERE, .turbidity = 2.0f, .zenith = {1, 2, 4}, .horizon = {6, 7, 8}}; }

static mgt_light sun_at(double elevation)
{
    return (mgt_light){.body = MGT_SOURCE_SUN, .elevation_deg = elevation, .angular_radius_deg = 0.2665, .radiance = {1.98e6f, 1.88e6f, 1.80e6f}};
}

static sky_state *build(mgt_sky sky, mgt_light light)
{
    sky_state *state = sky_state_create();
    assert_non_null(state);
    assert_int_equal(sky_state_build(state, &sky, &light), MGT_OK);
    return state;
}

static void at(const sky_state *state, double azimuth_deg, double elevation_deg, double rgb[3])
{
    double a = azimuth_deg * PI / 180, e = elevation_deg * PI / 180;
    sky_lookup(state, (const double[3]){sin(a) * cos(e), sin(e), -cos(a) * cos(e)}, rgb);
}

static double luminance_at(const sky_state *state, double azimuth_deg, double elevation_deg)
{
    double rgb[3];
    at(state, azimuth_deg, elevation_deg, rgb);
    return spectrum_luminance(rgb);
}

static void assert_between(double value, double low, double high)
{
    if (!(value >= low && value <= high)) {
        fail_msg("%g is not in [%g, %g]", value, low, high);
    }
}

/* IES daylight practice and CIE 85 for the day; twilight after Seidelmann, Explanatory Supplement to the Astronomical Almanac. klx. */
static void illuminance_is_that_of_a_clear_day_and_dusk(void **unused)
{
    (void)unused;
    static const struct {
        double elevation, normal_low, normal_high, global_low, global_high;
    } known[] = {
        {60, 85, 112, 85, 112}, {30, 65, 95, 40, 60},     {18, 45, 78, 20, 36},    {7, 12, 38, 5, 12},
        {0, 0, 0.5, 0.35, 1.3}, {-6, 0, 0, 1.5e-3, 6e-3}, {-12, 0, 0, 2e-6, 2e-5},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i) {
        sky_state *s = build(clear_sky(), sun_at(known[i].elevation));
        assert_between(spectrum_luminance(light_of(s).light_radiance) * light_of(s).light_solid_angle, known[i].normal_low, known[i].normal_high);
        assert_between(spectrum_luminance(light_of(s).irradiance_light) + spectrum_luminance(s->irradiance_sky), known[i].global_low, known[i].global_high);
        sky_state_destroy(s);
    }
}

static void full_moon_gives_a_quarter_lux(void **unused)
{
    (void)unused;
    mgt_light moon = {.body = MGT_SOURCE_MOON, .elevation_deg = 60, .angular_radius_deg = 0.259, .radiance = {3.75f, 3.45f, 3.0f}};
    mgt_sky sky = clear_sky();
    sky.night[0] = sky.night[1] = sky.night[2] = 2e-7f;
    sky_state *s = build(sky, moon);
    assert_between(spectrum_luminance(light_of(s).irradiance_light) + spectrum_luminance(s->irradiance_sky), 0.15e-3, 0.32e-3);
    assert_between(luminance_at(s, 180, 50), 1e-6, 3e-5);
    sky_state_destroy(s);
    moon.elevation_deg = -40;
    s = build(sky, moon); /* only the night is left */
    assert_between(luminance_at(s, 20, 70), 1.99e-7, 2.2e-7);
    sky_state_destroy(s);
}

static void radiance_and_colour_follow_the_sun(void **unused)
{
    (void)unused;
    double zenith[3], glow[3], rgb[3];
    sky_state *s = build(clear_sky(), sun_at(60));
    at(s, 0, 90, zenith);
    assert_between(spectrum_luminance(zenith), 2.0, 6.0);
    assert_true(zenith[2] > 1.8 * zenith[0]);
    assert_true(luminance_at(s, 180, 3) > 1.3 * luminance_at(s, 180, 60));      /* brighter towards the horizon */
    assert_true(light_of(s).light_radiance[0] > light_of(s).light_radiance[2]); /* yellowish */
    assert_true(light_of(s).light_radiance[2] > 0.55 * light_of(s).light_radiance[0]);
    double day_blue = zenith[2] / zenith[0];
    sky_state_destroy(s);

    s = build(clear_sky(), sun_at(2));
    at(s, 0, 3, glow);
    at(s, 0, 90, zenith);
    assert_true(glow[0] > 1.3 * glow[1] && glow[1] > 1.3 * glow[2]); /* orange */
    assert_true(spectrum_luminance(glow) > 10 * spectrum_luminance(zenith));
    assert_true(zenith[2] > 1.5 * zenith[0]); /* still blue overhead: ozone */
    assert_true(light_of(s).light_radiance[0] > 2 * light_of(s).light_radiance[1]);
    at(s, 180, 3, rgb);
    assert_true(rgb[0] / rgb[2] < 0.6 * glow[0] / glow[2]); /* the far side is no sunset */
    sky_state_destroy(s);

    s = build(clear_sky(), sun_at(-6));
    at(s, 0, 90, zenith);
    assert_true(zenith[2] / zenith[0] > day_blue); /* the blue hour */
    assert_true(luminance_at(s, 0, 3) > 1.5 * luminance_at(s, 180, 3));
    sky_state_destroy(s);
}

static void everything_is_finite_and_not_negative(void **unused)
{
    (void)unused;
    static const double elevations[] = {-90, -18, -0.2, 0, 0.1, 90};
    for (size_t i = 0; i < sizeof elevations / sizeof elevations[0]; ++i) {
        mgt_light light = sun_at(elevations[i]);
        mgt_sky sky = clear_sky();
        sky.turbidity = i % 2 ? 10.0f : 1.0f;
        light.angular_radius_deg = i == 3 ? 20 : i == 4 ? 1e-3 : 0.2665;
        light.azimuth_deg = 1e6;
        if (i == 5) {
            memset(light.radiance, 0, sizeof light.radiance);
        }
        sky_state *s = build(sky, light);
        for (size_t k = 0; k < sizeof s->table / sizeof s->table[0]; ++k) {
            assert_true(s->table[k] >= 0.0f && s->table[k] < 1e9f);
        }
        for (int c = 0; c < 3; ++c) {
            assert_between(light_of(s).light_radiance[c], 0, light.radiance[c]);
            assert_between(light_of(s).irradiance_light[c] + s->irradiance_sky[c], 0, 1e7);
        }
        assert_true(isfinite(s->exposure_ev));
        sky_state_destroy(s);
    }
}

static void setting_light_fades_to_nothing(void **unused)
{
    (void)unused;
    double before = INFINITY, visible = 1.0;
    for (double elevation = 1.0; elevation > -0.36; elevation -= 0.2) {
        sky_state *s = build(clear_sky(), sun_at(elevation));
        double now = spectrum_luminance(light_of(s).light_radiance);
        assert_true(now <= before && light_of(s).light_visible <= visible);
        assert_true(elevation > -0.26 ? now > 0 : true);
        if (elevation < -0.2667) {
            assert_true(now == 0 && light_of(s).light_visible == 0);
            assert_true(luminance_at(s, 0, 5) > 0.01);
        }
        if (elevation > 0.2666) {
            assert_true(light_of(s).light_visible == 1.0);
        }
        before = now;
        visible = light_of(s).light_visible;
        sky_state_destroy(s);
    }
    sky_state *half = build(clear_sky(), sun_at(0));
    assert_between(light_of(half).light_visible, 0.48, 0.52);
    sky_state_destroy(half);
}

/* Between the nodes the table must give what the integral along that very ray gives. */
static void table_is_the_integral(void **unused)
{
    (void)unused;
    static const double elevations[] = {50, 7, 0.5, -5};
    spectrum_weights weights = spectrum_weights_make();
    for (size_t i = 0; i < sizeof elevations / sizeof elevations[0]; ++i) {
        mgt_light light = sun_at(elevations[i]);
        mgt_sky sky = clear_sky();
        sky_state *s = build(sky, light);
        scattering *air = scattering_create(sky.turbidity, sin(light.angular_radius_deg * PI / 180));
        scattering_ray *ray = scattering_ray_create();
        assert_true(air && ray);
        double total = 0, worst = 0, count = 0, colour[3], irradiance[3];
        for (int c = 0; c < 3; ++c) {
            irradiance[c] = light.radiance[c] * light_of(s).light_solid_angle;
        }
        for (int k = 0; k < 400; ++k) {
            double sine = pow((k + 0.5) / 400, 2), azimuth = fmod(k * 0.61803398875, 1.0) * 2 * PI, cosine = sqrt(1 - sine * sine), spectrum[SPECTRUM_BANDS];
            double d[3] = {sin(azimuth) * cosine, sine, -cos(azimuth) * cosine}, rgb[3];
            double cos_angle = d[0] * light_of(s).direction[0] + d[1] * light_of(s).direction[1] + d[2] * light_of(s).direction[2];
            scattering_ray_aim(air, sine, ray);
            scattering_radiance(air, ray, light_of(s).direction[1], cos_angle, spectrum);
            spectrum_to_rgb(&weights, spectrum, irradiance, colour);
            sky_lookup(s, d, rgb);
            double error = fabs(spectrum_luminance(rgb) / spectrum_luminance(colour) - 1);
            total += error;
            count += 1;
            worst = fmax(worst, error);
        }
        assert_between(total / count, 0, 0.002);
        assert_between(worst, 0, 0.08); /* in the bend of the glow over a low sun */
        scattering_ray_destroy(ray);
        scattering_destroy(air);
        sky_state_destroy(s);
    }
}

/* Optical thickness of the standard atmosphere at the node 540 nm: air 0.1048, 300 DU of ozone 0.023, aerosol by definition. */
static void transmittance_has_the_known_thickness(void **unused)
{
    (void)unused;
    scattering *clean = scattering_create(1.0, 0.00465), *hazy = scattering_create(3.0, 0.00465);
    double zenith[SPECTRUM_BANDS], low[SPECTRUM_BANDS], haze[SPECTRUM_BANDS];
    scattering_transmittance(clean, 1.0, zenith);
    scattering_transmittance(clean, sin(10 * PI / 180), low);
    scattering_transmittance(hazy, 1.0, haze);
    assert_between(-log(zenith[5]), 0.96 * 0.128, 1.04 * 0.128);
    assert_between(log(low[5]) / log(zenith[5]), 5.3, 5.9); /* air mass at 10°: 5.6 */
    assert_between(-log(haze[5] / zenith[5]), 0.97 * 2 * 0.0972 * 550 / 540, 1.03 * 2 * 0.0972 * 550 / 540);
    scattering_destroy(clean);
    scattering_destroy(hazy);
}

static void lookups_are_continuous_and_symmetric(void **unused)
{
    (void)unused;
    mgt_light light = sun_at(15);
    light.azimuth_deg = 73;
    sky_state *s = build(clear_sky(), light);
    for (double elevation = 0; elevation < 90; elevation += 7.3) {
        double before = luminance_at(s, 0, elevation), largest = 0;
        for (double azimuth = 0.05; azimuth < 361; azimuth += 0.05) {
            double now = luminance_at(s, azimuth, elevation);
            largest = fmax(largest, fabs(now / before - 1));
            before = now;
        }
        assert_between(largest, 0, 0.03);
        for (double side = 0; side <= 180; side += 11) {
            double one = luminance_at(s, 73 + side, elevation), other = luminance_at(s, 73 - side, elevation);
            assert_between(one / other, 1 - 1e-9, 1 + 1e-9);
        }
    }
    double zenith = luminance_at(s, 0, 90);
    for (double azimuth = 0; azimuth < 360; azimuth += 30) {
        assert_between(luminance_at(s, azimuth, 89.999) / zenith, 0.999, 1.001);
    }
    double below[3], horizon[3];
    at(s, 10, -20, below);
    at(s, 10, 0, horizon);
    assert_memory_equal(below, horizon, sizeof horizon);
    sky_state_destroy(s);
}

static void irradiance_is_the_hemisphere_integral(void **unused)
{
    (void)unused;
    sky_state *s = build(clear_sky(), sun_at(25));
    double sum = 0;
    for (int i = 0; i < 180; ++i) {
        for (int k = 0; k < 360; ++k) {
            double elevation = (i + 0.5) * 0.5, e = elevation * PI / 180;
            sum += luminance_at(s, k + 0.5, elevation) * sin(e) * cos(e) * (0.5 * PI / 180) * (PI / 180);
        }
    }
    assert_between(spectrum_luminance(s->irradiance_sky) / sum, 0.995, 1.005);
    sky_state_destroy(s);
}

static void azimuth_turns_the_sky(void **unused)
{
    (void)unused;
    mgt_light light = sun_at(20);
    sky_state *north = build(clear_sky(), light);
    light.azimuth_deg = 130;
    sky_state *turned = build(clear_sky(), light);
    assert_memory_equal(north->table, turned->table, sizeof north->table);
    assert_between(luminance_at(turned, 130 + 17, 8) / luminance_at(north, 17, 8), 1 - 1e-9, 1 + 1e-9);
    assert_between(light_of(turned).direction[0], 0.7198, 0.7199); /* sin 130° cos 20° */
    assert_between(light_of(turned).azimuth[1], 0.6427, 0.6428);   /* −cos 130° */
    sky_state_destroy(north);
    sky_state_destroy(turned);
}

static void gradient_and_black_skies(void **unused)
{
    (void)unused;
    mgt_sky sky = clear_sky();
    sky.model = MGT_SKY_GRADIENT;
    mgt_light light = sun_at(10);
    sky_state *s = build(sky, light);
    double rgb[3];
    for (int c = 0; c < 3; ++c) {
        at(s, 40, 0, rgb);
        assert_between(rgb[c], sky.horizon[c] - 1e-6, sky.horizon[c] + 1e-6);
        at(s, 40, 90, rgb);
        assert_between(rgb[c], sky.zenith[c] - 1e-6, sky.zenith[c] + 1e-6);
        assert_true(light_of(s).light_radiance[c] == light.radiance[c]);
    }
    double before = luminance_at(s, 0, 0);
    for (double e = 1; e <= 90; e += 1) {
        double now = luminance_at(s, e, e);
        assert_true(now < before);
        before = now;
    }
    sky_state_destroy(s);

    sky.model = MGT_SKY_BLACK;
    s = build(sky, light);
    const float black[sizeof s->table / sizeof s->table[0]] = {0};
    assert_memory_equal(s->table, black, sizeof s->table);
    assert_true(light_of(s).light_radiance[1] == light.radiance[1] && s->irradiance_sky[1] == 0);
    /* a mirror at normal incidence shows the light at 0.15 */
    assert_between(spectrum_luminance(light_of(s).light_radiance) * 0.02 * exp2(s->exposure_ev), 0.149, 0.151);
    sky_state_destroy(s);
    light.elevation_deg = -1;
    s = build(sky, light);
    assert_true(light_of(s).light_radiance[1] == 0 && light_of(s).irradiance_light[1] == 0);
    sky_state_destroy(s);
}

static void body_radiance_is_what_the_water_returns(void **unused)
{
    (void)unused;
    mgt_water water = {.index_of_refraction = 1.0, .body_albedo = {0.1f, 0.2f, 0.0f}};
    double all[3], water_body[3], none[3];
    sky_state *s = build(clear_sky(), sun_at(40));
    sky_upwelling_radiance(s, &water, all);
    for (int c = 0; c < 3; ++c) { /* no surface: Lambert's law */
        assert_between(all[c], 0.999999 * water.body_albedo[c] * (light_of(s).irradiance_light[c] + s->irradiance_sky[c]) / PI,
                       1.000001 * water.body_albedo[c] * (light_of(s).irradiance_light[c] + s->irradiance_sky[c]) / PI);
    }
    water.index_of_refraction = 1.333;
    sky_upwelling_radiance(s, &water, water_body);
    assert_between(water_body[1] / all[1] * 1.333 * 1.333, 0.94, 0.98); /* a little is mirrored: 3% of the sun, 6.6% of the sky */
    sky_state_destroy(s);
    mgt_sky black = clear_sky();
    black.model = MGT_SKY_BLACK;
    s = build(black, sun_at(40));
    sky_upwelling_radiance(s, &water, none);
    assert_true(none[0] == 0 && none[1] == 0 && none[2] == 0);
    sky_state_destroy(s);
}

static void exposure_follows_the_light_and_keeps_night_dark(void **unused)
{
    (void)unused;
    static const double elevations[] = {20, 7, 2, -2, -6, -10};
    double before = -INFINITY;
    for (size_t i = 0; i < sizeof elevations / sizeof elevations[0]; ++i) {
        sky_state *s = build(clear_sky(), sun_at(elevations[i]));
        assert_true(s->exposure_ev > before);
        before = s->exposure_ev;
        sky_state_destroy(s);
    }
    mgt_light moon = {.body = MGT_SOURCE_MOON, .elevation_deg = 35, .angular_radius_deg = 0.259, .radiance = {3.75f, 3.45f, 3.0f}};
    sky_state *day = build(clear_sky(), sun_at(35)), *night = build(clear_sky(), moon);
    double day_shown = luminance_at(day, 90, 10) * exp2(day->exposure_ev), night_shown = luminance_at(night, 90, 10) * exp2(night->exposure_ev);
    assert_between(day_shown, 0.12, 0.6);
    assert_between(log2(day_shown / night_shown), 1.3, 3.0);
    sky_state_destroy(day);
    sky_state_destroy(night);
}

static void same_inputs_are_recognised(void **unused)
{
    (void)unused;
    mgt_sky sky = clear_sky();
    mgt_light light = sun_at(12);
    sky_state *s = sky_state_create();
    assert_false(sky_state_same_inputs(s, &sky, &light));
    assert_int_equal(sky_state_build(s, &sky, &light), MGT_OK);
    assert_true(sky_state_same_inputs(s, &sky, &light));
    sky_state *again = build(sky, light);
    assert_memory_equal(s->table, again->table, sizeof s->table);
    mgt_light other = light;
    other.azimuth_deg += 1;
    assert_false(sky_state_same_inputs(s, &sky, &other));
    other = light;
    other.radiance[2] *= 2;
    assert_false(sky_state_same_inputs(s, &sky, &other));
    mgt_sky hazy = sky;
    hazy.turbidity = 3;
    assert_false(sky_state_same_inputs(s, &hazy, &light));
    hazy = sky;
    hazy.night[1] = 1;
    assert_false(sky_state_same_inputs(s, &hazy, &light));
    sky_state_destroy(again);
    sky_state_destroy(s);
}

static void own_exponential_is_exact(void **unused)
{
    (void)unused;
    for (double x = -600; x < 600; x += 0.37) {
        assert_between(spectrum_exp(x) / exp(x), 1 - 2e-15, 1 + 2e-15);
    }
    assert_true(spectrum_exp(-1e9) == 0 && spectrum_exp(0) == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(illuminance_is_that_of_a_clear_day_and_dusk),
        cmocka_unit_test(full_moon_gives_a_quarter_lux),
        cmocka_unit_test(radiance_and_colour_follow_the_sun),
        cmocka_unit_test(everything_is_finite_and_not_negative),
        cmocka_unit_test(setting_light_fades_to_nothing),
        cmocka_unit_test(table_is_the_integral),
        cmocka_unit_test(transmittance_has_the_known_thickness),
        cmocka_unit_test(lookups_are_continuous_and_symmetric),
        cmocka_unit_test(irradiance_is_the_hemisphere_integral),
        cmocka_unit_test(azimuth_turns_the_sky),
        cmocka_unit_test(gradient_and_black_skies),
        cmocka_unit_test(body_radiance_is_what_the_water_returns),
        cmocka_unit_test(exposure_follows_the_light_and_keeps_night_dark),
        cmocka_unit_test(same_inputs_are_recognised),
        cmocka_unit_test(own_exponential_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
