/* SPDX-License-Identifier: MIT
 *
 * The sky around its lights.
 */
#include "frame/atmosphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame/air.h"
#include "frame/fresnel.h"
#include "frame/spectrum.h"
#include "frame/stars.h"
#include "params/scene_rows.h"

#define PI 3.14159265358979323846

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
    const light_state *light = lights_get(state->lights, 0);
    double sin_light = light_toward(light)[1], cos_light = sqrt(fmax(0.0, 1.0 - sin_light * sin_light));
    double rgb_irradiance[3];
    light_beam_outside(light, rgb_irradiance);
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

/* The table's u = sin(φ/2), where φ is a direction's azimuth from the first light. */
static double azimuth_column(const sky_state *state, const double direction[3])
{
    double across = sqrt(fmax(direction[0] * direction[0] + direction[2] * direction[2], 1e-24));
    const double *azimuth = light_azimuth(lights_get(state->lights, 0));
    double chord_x = direction[0] / across - azimuth[0], chord_z = direction[2] / across - azimuth[1];
    return fmin(0.5 * sqrt(chord_x * chord_x + chord_z * chord_z), 1.0);
}

/* Bilinear interpolation between four texels; `low` is the lower left one, `right` and `up` in [0, 1] are the place between them. */
static void blend_texels(const float *low, double right, double up, double rgb[3])
{
    const float *high = low + SKY_COLUMNS * 3;
    for (int c = 0; c < 3; ++c) {
        double below = low[c] + ((double)low[c + 3] - low[c]) * right;
        double above = high[c] + ((double)high[c + 3] - high[c]) * right;
        rgb[c] = below + (above - below) * up;
    }
}

void sky_lookup(const sky_state *state, const double direction[3], double rgb[3])
{
    double u = azimuth_column(state, direction);
    double v = fmin(sqrt(fmax(direction[1], 0.0)), 1.0);
    double x = u * (SKY_COLUMNS - 1), y = v * (SKY_ROWS - 1);
    double column = fmin(floor(x), SKY_COLUMNS - 2.0), row = fmin(floor(y), SKY_ROWS - 2.0);
    blend_texels(&state->table[((int)row * SKY_COLUMNS + (int)column) * 3], x - column, y - row, rgb);
}

void sky_air_lookup(const sky_state *state, const double direction[3], double distance, double leaves[3], double light[3])
{
    double w = -expm1(-state->air_rate * distance);
    double y = w * (AIR_ROWS - 1), row = fmin(floor(y), AIR_ROWS - 2.0);
    double x = azimuth_column(state, direction) * (SKY_COLUMNS - 1), column = fmin(floor(x), SKY_COLUMNS - 2.0);
    blend_texels(&state->table[((SKY_ROWS + (int)row) * SKY_COLUMNS + (int)column) * 3], x - column, y - row, light);
    const float *near = &state->table[((SKY_ROWS + AIR_ROWS) * SKY_COLUMNS + (int)row) * 3];
    for (int c = 0; c < 3; ++c) {
        leaves[c] = near[c] + ((double)near[c + 3] - near[c]) * (y - row);
    }
}

/* ---- sums over the table -------------------------------------------------------------------------------- */

/* Weight of a column in the trapezium rule over φ; the weights of all columns sum to 2π. */
static double azimuth_weight(int column)
{
    double from = (double)(column > 0 ? column - 1 : 0) / (SKY_COLUMNS - 1);
    double to = (double)(column < SKY_COLUMNS - 1 ? column + 1 : column) / (SKY_COLUMNS - 1);
    return 2.0 * (asin(to) - asin(from));
}

/* Weight of a row in the trapezium rule over y = v²; the weights of all rows sum to 1. */
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

/* log2 of the key luminance of the sky up to 20° over the horizon, −infinity where the sky is black. It mixes the logarithm of the mean (weight 0.7) and the
 * mean of the logarithm (weight 0.3), both over solid angle. The former alone would let a small bright glow darken the whole picture. The latter alone would
 * let the glow burn out. */
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
                sums[pass] += weight * (pass ? log2(fmax(luminance, mean / 4096.0)) : luminance); /* a black texel counts as 12 stops below the mean */
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

/* Automatic exposure, log2. The key of a picture that shows the sky near the horizon and the water that mirrors it is half the sky's key. A key as bright as
 * day (2 kcd/m²) is displayed at 0.15. Fainter scenes are displayed darker, as the eye sees them: a key lower by a factor of 2 darkens the picture by
 * 2^0.12. A full moon's night, 17 stops below the day, comes out 2 stops darker. Under a black sky the picture is glitter: 2% of the light's radiance, which
 * is the radiance of a mirrored light at normal incidence, is displayed at 0.15. */
static double automatic_exposure(const sky_state *state, double key)
{
    const double compression = 0.12, day = 2.0;
    if (isfinite(key)) {
        return fmin(log2(0.15) - key + compression * fmin(key - log2(day), 0.0), 100.0);
    }
    double luminance = lights_luminance(state->lights);
    return luminance > 0.0 ? fmin(log2(0.15 / 0.02) - log2(luminance), 100.0) : 0.0;
}

/* ---- interface ------------------------------------------------------------------------------------------ */

/* Irradiance by the lights that enters the water through a flat surface. */
static void sum_entering(const light_set *lights, double n, double rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = 0; i < lights_count(lights); ++i) {
        double sine = light_toward(lights_get(lights, i))[1], share = sine > 0.0 ? 1.0 - fresnel_reflectance(sine, n) : 0.0, irradiance[3];
        light_irradiance(lights_get(lights, i), irradiance);
        for (int c = 0; c < 3; ++c) {
            rgb[c] += irradiance[c] * share;
        }
    }
}

void sky_upwelling_radiance(const sky_state *state, const mgt_water *water, double rgb[3])
{
    double n = water->index_of_refraction, mirrored = fresnel_diffuse(n), light_enters[3];
    sum_entering(state->lights, n, light_enters);
    for (int c = 0; c < 3; ++c) {
        double enters = light_enters[c] + state->irradiance_sky[c] * (1.0 - mirrored);
        rgb[c] = state->sky.model == MGT_SKY_BLACK ? 0.0 : water->body_albedo[c] * enters / (PI * n * n);
    }
}

/* Computes the whole state from the inputs. The state takes ownership of `air` and `ray`. */
static void fill_state(sky_state *s, const mgt_sky *sky, const mgt_light *light, scattering *air, scattering_ray *ray)
{
    light_set *lights = s->lights;
    memset(s, 0, sizeof *s);
    s->sky = *sky;
    s->lights = lights;
    s->air = air;
    s->ray = ray;
    s->air_height = -1.0;
    const spectrum_weights weights = air ? spectrum_weights_make() : (spectrum_weights){0};
    lights_set(s->lights, light, 1, air, &weights);
    if (air) {
        fill_atmosphere(s, air, &weights, ray);
        stars_fill(air, &weights, sky->night, s->table);
    } else if (sky->model == MGT_SKY_GRADIENT) {
        fill_gradient(s);
    }
    sum_irradiance(s);
    const double key = log_key(s) - 1.0;
    s->adaptation = exp2(key);
    s->exposure_ev = automatic_exposure(s, key);
}

sky_state *sky_state_create(void)
{
    sky_state *state = calloc(1, sizeof *state);
    if (!state || !(state->lights = lights_create())) {
        free(state);
        return NULL;
    }
    return state;
}

static void free_air(sky_state *state)
{
    scattering_ray_destroy(state->ray);
    scattering_destroy(state->air);
    state->ray = NULL;
    state->air = NULL;
}

void sky_state_destroy(sky_state *state)
{
    if (state) {
        free_air(state);
        lights_destroy(state->lights);
        free(state);
    }
}

mgt_status sky_state_build(sky_state *state, const mgt_sky *sky, const mgt_light *light)
{
    const mgt_sky wanted = *sky; /* a copy, because `sky` may be the state's own */
    scattering *air = NULL;
    scattering_ray *ray = NULL;
    if (wanted.model == MGT_SKY_ATMOSPHERE) { /* the other models allocate nothing, so that lights may move from frame to frame */
        air = scattering_create(wanted.turbidity, light_radius_sine(light));
        ray = scattering_ray_create();
        if (!air || !ray) {
            scattering_ray_destroy(ray);
            scattering_destroy(air);
            return MGT_ERROR_MEMORY;
        }
    }
    free_air(state);
    fill_state(state, &wanted, light, air, ray);
    return MGT_OK;
}

bool sky_state_has_air(const mgt_scene *scene) { return scene->aerial && scene->sky.model == MGT_SKY_ATMOSPHERE && scene->camera.position[1] >= 0; }

bool sky_state_see_air(sky_state *state, const mgt_scene *scene)
{
    const double height = scene->camera.position[1];
    if (!sky_state_has_air(scene) || !state->air || state->air_height == height)
        return false;
    const spectrum_weights weights = spectrum_weights_make();
    const light_state *light = lights_get(state->lights, 0);
    air_view view = {.height = height, .sin_light = light_toward(light)[1]};
    light_beam_outside(light, view.rgb_irradiance);
    air_fill(state->air, &weights, &view, texel(state, 0, 0), state->sky.night, state->ray, texel(state, 0, SKY_ROWS));
    state->air_rate = air_rate(state->air, height);
    state->air_height = height;
    return true;
}

bool sky_state_same_inputs(const sky_state *state, const mgt_sky *sky, const mgt_light *light)
{
    return lights_same(state->lights, light, 1) && fields_equal(sky_rows, &state->sky, sky);
}
