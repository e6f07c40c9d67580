/* SPDX-License-Identifier: MIT
 *
 * The sky around one light.
 */
#include "frame/atmosphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame/scattering.h"
#include "frame/spectrum.h"

#define PI 3.14159265358979323846

/* ---- the light ------------------------------------------------------------------------------------------ */

double sky_limb_factor(double limb, double relative_distance)
{
    double mu = sqrt(fmax(0.0, 1.0 - relative_distance * relative_distance));
    return (1.0 - limb * (1.0 - mu)) / (1.0 - limb / 3.0);
}

static void place_light(sky_state *state)
{
    const mgt_light *light = &state->light;
    double elevation = light->elevation_deg * (PI / 180.0);
    double azimuth = fmod(light->azimuth_deg, 360.0) * (PI / 180.0);
    double radius = light->angular_radius_deg * (PI / 180.0);
    state->direction[0] = sin(azimuth) * cos(elevation);
    state->direction[1] = sin(elevation);
    state->direction[2] = -cos(azimuth) * cos(elevation);
    state->azimuth[0] = sin(azimuth);
    state->azimuth[1] = -cos(azimuth);
    state->tan_radius = tan(radius);
    state->light_solid_angle = 2.0 * PI * (1.0 - cos(radius));
    state->limb = light->body == MGT_SOURCE_SUN ? 0.6 : 0.0;
}

/* Mean over the disk of what each of its horizontal strips sends through the air; strips below the horizon send nothing. */
static void see_light(sky_state *state, const scattering *air, const spectrum_weights *weights)
{
    enum { STRIPS = 64, DEPTHS = 16 };
    const double rgb_light[3] = {state->light.radiance[0], state->light.radiance[1], state->light.radiance[2]};
    double elevation = state->light.elevation_deg * (PI / 180.0), radius = state->light.angular_radius_deg * (PI / 180.0);
    double total = 0.0, visible = 0.0, spectrum[SPECTRUM_BANDS] = {0}, irradiance[SPECTRUM_BANDS] = {0};
    for (int i = 0; i < STRIPS; ++i) {
        double h = (i + 0.5) / STRIPS * 2.0 - 1.0, half_chord = sqrt(1.0 - h * h), share = 0.0;
        for (int k = 0; k < DEPTHS; ++k) {
            double x = (k + 0.5) / DEPTHS * half_chord;
            share += sky_limb_factor(state->limb, sqrt(h * h + x * x)) * half_chord / DEPTHS;
        }
        double sine = sin(elevation + h * radius);
        double above = fmin(fmax((sine + radius / STRIPS) / (2.0 * radius / STRIPS), 0.0), 1.0);
        total += share;
        visible += share * above;
        if (above > 0.0) {
            double through[SPECTRUM_BANDS];
            scattering_transmittance(air, sine, through);
            for (int b = 0; b < SPECTRUM_BANDS; ++b) {
                spectrum[b] += share * above * through[b];
                irradiance[b] += share * above * through[b] * fmax(sine, 0.0);
            }
        }
    }
    state->light_visible = fmin(visible / total, 1.0);
    for (int b = 0; b < SPECTRUM_BANDS; ++b) {
        spectrum[b] /= total;
        irradiance[b] *= state->light_solid_angle / total;
    }
    spectrum_to_rgb(weights, spectrum, rgb_light, state->light_radiance);
    spectrum_to_rgb(weights, irradiance, rgb_light, state->irradiance_light);
}

/* Without air: unchanged until the light's centre meets the horizon. */
static void see_light_without_air(sky_state *state)
{
    bool up = state->light.elevation_deg >= 0.0;
    state->light_visible = up ? 1.0 : 0.0;
    for (int c = 0; c < 3; ++c) {
        state->light_radiance[c] = up ? state->light.radiance[c] : 0.0;
        state->irradiance_light[c] = state->light_radiance[c] * state->light_solid_angle * fmax(state->direction[1], 0.0);
    }
}

/* ---- the table ------------------------------------------------------------------------------------------ */

static float *texel(sky_state *state, int column, int row) { return &state->table[(row * SKY_COLUMNS + column) * 3]; }

static void fill_gradient(sky_state *state)
{
    const mgt_sky *sky = &state->sky;
    for (int row = 0; row < SKY_ROWS; ++row) {
        double v = (double)row / (SKY_ROWS - 1);
        double y = v * v, blend = y * (2.0 - y); /* steep at the horizon, level at the zenith */
        for (int column = 0; column < SKY_COLUMNS; ++column) {
            for (int c = 0; c < 3; ++c) {
                texel(state, column, row)[c] = (float)(sky->horizon[c] + ((double)sky->zenith[c] - sky->horizon[c]) * blend);
            }
        }
    }
}

static void fill_atmosphere(sky_state *state, const scattering *air, const spectrum_weights *weights, scattering_ray *ray)
{
    double sin_light = state->direction[1], cos_light = sqrt(fmax(0.0, 1.0 - sin_light * sin_light));
    double rgb_irradiance[3];
    for (int c = 0; c < 3; ++c) {
        rgb_irradiance[c] = state->light.radiance[c] * state->light_solid_angle;
    }
    for (int row = 0; row < SKY_ROWS; ++row) {
        double v = (double)row / (SKY_ROWS - 1), sine = v * v, cosine = sqrt(fmax(0.0, 1.0 - sine * sine));
        scattering_ray_aim(air, sine, ray);
        for (int column = 0; column < SKY_COLUMNS; ++column) {
            double u = (double)column / (SKY_COLUMNS - 1);
            double cos_angle = sine * sin_light + cosine * cos_light * (1.0 - 2.0 * u * u);
            double radiance[SPECTRUM_BANDS], rgb[3];
            scattering_radiance(air, ray, sin_light, cos_angle, radiance);
            spectrum_to_rgb(weights, radiance, rgb_irradiance, rgb);
            for (int c = 0; c < 3; ++c) {
                texel(state, column, row)[c] = (float)(rgb[c] + state->sky.night[c]);
            }
        }
    }
}

void sky_lookup(const sky_state *state, const double direction[3], double rgb[3])
{
    double across = sqrt(fmax(direction[0] * direction[0] + direction[2] * direction[2], 1e-24));
    double chord_x = direction[0] / across - state->azimuth[0], chord_z = direction[2] / across - state->azimuth[1];
    double u = fmin(0.5 * sqrt(chord_x * chord_x + chord_z * chord_z), 1.0);
    double v = fmin(sqrt(fmax(direction[1], 0.0)), 1.0);
    double x = u * (SKY_COLUMNS - 1), y = v * (SKY_ROWS - 1);
    double column = fmin(floor(x), SKY_COLUMNS - 2.0), row = fmin(floor(y), SKY_ROWS - 2.0);
    const float *low = &state->table[((int)row * SKY_COLUMNS + (int)column) * 3], *high = low + SKY_COLUMNS * 3;
    for (int c = 0; c < 3; ++c) {
        double below = low[c] + ((double)low[c + 3] - low[c]) * (x - column);
        double above = high[c] + ((double)high[c + 3] - high[c]) * (x - column);
        rgb[c] = below + (above - below) * (y - row);
    }
}

/* ---- sums over the table -------------------------------------------------------------------------------- */

/* Trapezium weights of a column over φ (both half circles together 2π) and of a row over y = v². */
static double azimuth_weight(int column)
{
    double from = (double)(column > 0 ? column - 1 : 0) / (SKY_COLUMNS - 1);
    double to = (double)(column < SKY_COLUMNS - 1 ? column + 1 : column) / (SKY_COLUMNS - 1);
    return 2.0 * (asin(to) - asin(from));
}

static double height_weight(int row)
{
    double from = (double)(row > 0 ? row - 1 : 0) / (SKY_ROWS - 1);
    double to = (double)(row < SKY_ROWS - 1 ? row + 1 : row) / (SKY_ROWS - 1);
    return 0.5 * (to * to - from * from);
}

static void sum_irradiance(sky_state *state)
{
    for (int c = 0; c < 3; ++c) {
        state->irradiance_sky[c] = 0.0;
    }
    for (int row = 0; row < SKY_ROWS; ++row) {
        double v = (double)row / (SKY_ROWS - 1), weight = v * v * height_weight(row);
        for (int column = 0; column < SKY_COLUMNS; ++column) {
            for (int c = 0; c < 3; ++c) {
                state->irradiance_sky[c] += texel(state, column, row)[c] * weight * azimuth_weight(column);
            }
        }
    }
}

/* Key luminance (log2) of the sky up to 20° over the horizon, by solid angle: seven parts of the logarithm of the mean and three of
 * the mean of the logarithm. The former alone would let a small bright glow darken the whole picture, the latter burn the glow out.
 * −infinity where the sky is black. */
static double log_key(sky_state *state)
{
    double sums[2] = {0.0, 0.0}, weights = 0.0, mean = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
        weights = 0.0;
        for (int row = 0; row < SKY_ROWS; ++row) {
            double v = (double)row / (SKY_ROWS - 1);
            if (v * v > 0.34202014332566873) {
                break;
            }
            for (int column = 0; column < SKY_COLUMNS; ++column) {
                const float *t = texel(state, column, row);
                const double rgb[3] = {t[0], t[1], t[2]};
                double weight = height_weight(row) * azimuth_weight(column), luminance = spectrum_luminance(rgb);
                sums[pass] += weight * (pass ? log2(fmax(luminance, mean / 4096.0)) : luminance); /* black spots count 12 stops */
                weights += weight;
            }
        }
        mean = sums[0] / weights;
        if (!(mean > 0.0)) {
            return -INFINITY;
        }
    }
    return 0.7 * log2(mean) + 0.3 * sums[1] / weights;
}

/* Automatic exposure. The sky near the horizon and the water, which mirrors a part of it, share the picture: their common key,
 * half the sky's, is put at 0.15 when it is as bright as day (2 kcd/m²). Fainter scenes are kept darker, as the eye sees them: each
 * factor of 2 in the key moves the picture by 2^0.12. A full moon's night, 17 stops below the day, comes out 2 stops darker.
 * Without a sky, glitter is the picture: 2% of the light's radiance (a full mirror's at normal incidence) goes to 0.15. */
static double automatic_exposure(sky_state *state)
{
    const double compression = 0.12, day = 2.0;
    const double light[3] = {state->light.radiance[0], state->light.radiance[1], state->light.radiance[2]};
    double key = log_key(state) - 1.0;
    if (isfinite(key)) {
        return fmin(log2(0.15) - key + compression * fmin(key - log2(day), 0.0), 100.0);
    }
    double luminance = spectrum_luminance(light);
    return luminance > 0.0 ? fmin(log2(0.15 / 0.02) - log2(luminance), 100.0) : 0.0;
}

/* ---- interface ------------------------------------------------------------------------------------------ */

/* Share of unpolarised light that a flat surface mirrors, seen from above. */
static double fresnel(double cosine, double n)
{
    double inside = sqrt(fmax(0.0, 1.0 - (1.0 - cosine * cosine) / (n * n)));
    double s = (cosine - n * inside) / (cosine + n * inside), p = (n * cosine - inside) / (n * cosine + inside);
    return cosine + inside > 0.0 ? 0.5 * (s * s + p * p) : 1.0;
}

void sky_upwelling_radiance(const sky_state *state, const mgt_water *water, double rgb[3])
{
    enum { STEPS = 64 };
    double n = water->index_of_refraction, mirrored = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        double cosine = (i + 0.5) / STEPS;
        mirrored += fresnel(cosine, n) * 2.0 * cosine / STEPS;
    }
    double light_enters = state->direction[1] > 0.0 ? 1.0 - fresnel(state->direction[1], n) : 0.0;
    for (int c = 0; c < 3; ++c) {
        double enters = state->irradiance_light[c] * light_enters + state->irradiance_sky[c] * (1.0 - mirrored);
        rgb[c] = state->sky.model == MGT_SKY_BLACK ? 0.0 : water->body_albedo[c] * enters / (PI * n * n);
    }
}

/* Everything that follows from the inputs; with air, `ray` is room to work in. */
static void fill_state(sky_state *s, const mgt_sky *sky, const mgt_light *light, const scattering *air, scattering_ray *ray)
{
    memset(s, 0, sizeof *s);
    s->sky = *sky;
    s->light = *light;
    place_light(s);
    if (air) {
        spectrum_weights weights = spectrum_weights_make();
        see_light(s, air, &weights);
        fill_atmosphere(s, air, &weights, ray);
    } else {
        see_light_without_air(s);
        if (sky->model == MGT_SKY_GRADIENT) {
            fill_gradient(s);
        }
    }
    sum_irradiance(s);
    s->exposure_ev = automatic_exposure(s);
}

mgt_status sky_state_build(sky_state *state, const mgt_sky *sky, const mgt_light *light)
{
    const mgt_sky wanted_sky = *sky; /* may be the state's own */
    const mgt_light wanted_light = *light;
    if (wanted_sky.model != MGT_SKY_ATMOSPHERE) { /* a light that moves from frame to frame allocates nothing */
        fill_state(state, &wanted_sky, &wanted_light, NULL, NULL);
        return MGT_OK;
    }
    scattering *air = scattering_create(wanted_sky.turbidity, sin(wanted_light.angular_radius_deg * (PI / 180.0)));
    scattering_ray *ray = scattering_ray_create();
    const bool enough = air && ray;
    if (enough) {
        fill_state(state, &wanted_sky, &wanted_light, air, ray);
    }
    scattering_ray_destroy(ray);
    scattering_destroy(air);
    return enough ? MGT_OK : MGT_ERROR_MEMORY;
}

static bool same_colour(const float a[3], const float b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

bool sky_state_same_inputs(const sky_state *state, const mgt_sky *sky, const mgt_light *light)
{
    const mgt_sky *s = &state->sky;
    const mgt_light *l = &state->light;
    bool placed = state->tan_radius > 0.0 &&
                  state->direction[0] * state->direction[0] + state->direction[1] * state->direction[1] + state->direction[2] * state->direction[2] > 0.5;
    bool same_light = l->body == light->body && l->elevation_deg == light->elevation_deg && l->azimuth_deg == light->azimuth_deg &&
                      l->angular_radius_deg == light->angular_radius_deg && same_colour(l->radiance, light->radiance);
    bool same_sky = s->model == sky->model && s->turbidity == sky->turbidity && same_colour(s->zenith, sky->zenith) && same_colour(s->horizon, sky->horizon) &&
                    same_colour(s->night, sky->night);
    return placed && same_light && same_sky;
}
