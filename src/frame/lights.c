/* SPDX-License-Identifier: MIT
 *
 * The lights of a frame.
 */
#include "frame/lights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/triples.h"
#include "frame/scattering.h"
#include "frame/spectrum.h"
#include "params/scene_rows.h"

static const double pi = 3.14159265358979323846;

/* ---- from a scene ---- */

/* Radiance in kcd/m², irradiance in klx (kcd·sr/m²), linear sRGB. */
struct light_state {
    mgt_light light; /* what it was made from */

    double direction[3]; /* unit, to the light's centre */
    double azimuth[2];   /* x, z of the unit horizontal direction to the light; (0, −1) when it stands in the zenith */
    double tan_radius;   /* tangent of the light's angular radius */
    double limb;         /* u of the limb darkening I(μ)/I(1) = 1 − u·(1 − μ), μ² = 1 − (angle/radius)²: sun 0.6, moon 0 */

    /* Mean radiance of the whole disk as seen from the water. The part below the horizon counts as black, so this fades to 0 while the light sets. The mean
     * radiance of the part above the horizon is light_radiance / light_visible. */
    double light_radiance[3];
    double light_visible;       /* fraction of the disk's light that comes from above the horizon, [0, 1] */
    double light_solid_angle;   /* of the whole disk, sr */
    double irradiance_light[3]; /* on a horizontal plane at the water */
};

struct light_set {
    int count;
    light_state of[MAX_LIGHTS];
};

light_set *lights_create(void) { return calloc(1, sizeof(light_set)); }

void lights_destroy(light_set *set) { free(set); }

static double limb_of(mgt_source body) { return body == MGT_SOURCE_SUN ? 0.6 : 0; }

double light_radius_sine(const mgt_light *light) { return sin(light->angular_radius_deg * (pi / 180)); }

static light_state placed(const mgt_light *light)
{
    const double elevation = light->elevation_deg * (pi / 180), azimuth = fmod(light->azimuth_deg, 360) * (pi / 180);
    const double radius = light->angular_radius_deg * (pi / 180);
    return (light_state){
        .light = *light,
        .direction = {sin(azimuth) * cos(elevation), sin(elevation), -cos(azimuth) * cos(elevation)},
        .azimuth = {sin(azimuth), -cos(azimuth)},
        .tan_radius = tan(radius),
        .limb = limb_of(light->body),
        .light_solid_angle = 2 * pi * (1 - cos(radius)),
    };
}

bool lights_same(const light_set *set, const mgt_light *lights, int count)
{
    bool same = set->count == count && count > 0;
    for (int i = 0; same && i < count; i++)
        same = fields_equal(light_rows, &set->of[i].light, &lights[i]);
    return same;
}

/* ---- through the air ---- */

static double limb_factor(double limb, double relative_distance)
{
    const double mu = sqrt(fmax(0, 1 - relative_distance * relative_distance));
    return (1 - limb * (1 - mu)) / (1 - limb / 3);
}

/* Sets the light that passes through the air: the transmittance is averaged over horizontal strips of the disk. Strips below the horizon are black. */
static void through_air(light_state *state, const struct scattering *air, const struct spectrum_weights *weights)
{
    enum { STRIPS = 64, DEPTHS = 16 };
    const mgt_light *light = &state->light;
    const double outside[3] = {light->radiance[0], light->radiance[1], light->radiance[2]};
    const double elevation = light->elevation_deg * (pi / 180), radius = light->angular_radius_deg * (pi / 180);
    double total = 0, visible = 0, spectrum[SPECTRUM_BANDS] = {0}, irradiance[SPECTRUM_BANDS] = {0};
    for (int i = 0; i < STRIPS; i++) {
        const double h = (i + 0.5) / STRIPS * 2 - 1, half_chord = sqrt(1 - h * h);
        double share = 0;
        for (int k = 0; k < DEPTHS; k++) {
            const double x = (k + 0.5) / DEPTHS * half_chord;
            share += limb_factor(state->limb, sqrt(h * h + x * x)) * half_chord / DEPTHS;
        }
        const double sine = sin(elevation + h * radius);
        const double above = fmin(fmax((sine + radius / STRIPS) / (2 * radius / STRIPS), 0), 1);
        total += share;
        visible += share * above;
        if (above > 0) {
            double through[SPECTRUM_BANDS];
            scattering_transmittance(air, sine, through);
            for (int b = 0; b < SPECTRUM_BANDS; b++) {
                spectrum[b] += share * above * through[b];
                irradiance[b] += share * above * through[b] * fmax(sine, 0);
            }
        }
    }
    state->light_visible = fmin(visible / total, 1);
    for (int b = 0; b < SPECTRUM_BANDS; b++) {
        spectrum[b] /= total;
        irradiance[b] *= state->light_solid_angle / total;
    }
    spectrum_to_rgb(weights, spectrum, outside, state->light_radiance);
    spectrum_to_rgb(weights, irradiance, outside, state->irradiance_light);
}

/* Sets the light without an atmosphere: nothing is lost while the light's centre is above the horizon, and all below. */
static void without_air(light_state *state)
{
    const bool up = state->light.elevation_deg >= 0;
    state->light_visible = up ? 1 : 0;
    for (int c = 0; c < 3; c++) {
        state->light_radiance[c] = up ? (double)state->light.radiance[c] : 0;
        state->irradiance_light[c] = state->light_radiance[c] * state->light_solid_angle * fmax(state->direction[1], 0);
    }
}

void lights_set(light_set *set, const mgt_light *lights, int count, const struct scattering *air, const struct spectrum_weights *weights)
{
    set->count = count < MAX_LIGHTS ? count : MAX_LIGHTS;
    for (int i = 0; i < set->count; i++) {
        set->of[i] = placed(&lights[i]);
        if (air)
            through_air(&set->of[i], air, weights);
        else
            without_air(&set->of[i]);
    }
}

/* ---- what the rest of a frame asks ---- */

int lights_count(const light_set *set) { return set->count; }

const light_state *lights_get(const light_set *set, int index) { return &set->of[index]; }

const double *light_toward(const light_state *state) { return state->direction; }

const double *light_azimuth(const light_state *state) { return state->azimuth; }

double light_tan_radius(const light_state *state) { return state->tan_radius; }

double light_solid_angle(const light_state *state) { return state->light_solid_angle; }

double light_visible_part(const light_state *state) { return state->light_visible; }

double light_limb_factor(const light_state *state, double relative_distance) { return limb_factor(state->limb, relative_distance); }

void light_mean_radiance(const light_state *state, double rgb[3]) { memcpy(rgb, state->light_radiance, sizeof state->light_radiance); }

void light_beam_outside(const light_state *state, double rgb[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c] = (double)state->light.radiance[c] * state->light_solid_angle;
}

void light_beam(const light_state *state, double rgb[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c] = state->light_radiance[c] * state->light_solid_angle;
}

void light_irradiance(const light_state *state, double rgb[3]) { memcpy(rgb, state->irradiance_light, sizeof state->irradiance_light); }

double lights_luminance(const light_set *set)
{
    double brightest = 0;
    for (int i = 0; i < set->count; i++) {
        const float *radiance = set->of[i].light.radiance;
        brightest = fmax(brightest, spectrum_luminance((const double[3]){radiance[0], radiance[1], radiance[2]}));
    }
    return brightest;
}

/* ---- for kernels ---- */

static LightData light_data(const light_state *state, bool under)
{
    const double up[3] = {0, 1, 0}, north[3] = {0, 0, -1};
    const double to[3] = {state->direction[0], under ? -state->direction[1] : state->direction[1], state->direction[2]};
    double e[3], f[3];
    cross3(fabs(to[1]) < 0.999 ? up : north, to, e);
    normalize3(e);
    cross3(to, e, f);
    return (LightData){
        .light_x = (float)to[0],
        .light_y = (float)to[1],
        .light_z = (float)to[2],
        .disk_radius = (float)state->tan_radius,
        .light_azimuth_x = (float)state->azimuth[0],
        .light_azimuth_z = (float)state->azimuth[1],
        .limb = (float)state->limb,
        .light_visible = state->light.elevation_deg >= 0 ? 1 : 0,
        .light_hidden = (float)(1 - state->light_visible),
        .light_radiance_r = (float)state->light_radiance[0],
        .light_radiance_g = (float)state->light_radiance[1],
        .light_radiance_b = (float)state->light_radiance[2],
        .axis_e_x = (float)e[0],
        .axis_e_y = (float)e[1],
        .axis_e_z = (float)e[2],
        .axis_f_x = (float)f[0],
        .axis_f_y = (float)f[1],
        .axis_f_z = (float)f[2],
    };
}

void lights_place(const light_set *set, bool under, FrameData *frame)
{
    frame->light_count = set->count;
    for (int i = 0; i < set->count; i++)
        frame->lights[i] = light_data(&set->of[i], under);
}

bool lights_dark(const FrameData *frame)
{
    for (int i = 0; i < frame->light_count; i++)
        if (frame->lights[i].light_radiance_r > 0 || frame->lights[i].light_radiance_g > 0 || frame->lights[i].light_radiance_b > 0)
            return false;
    return true;
}

double lights_disk_radius(const FrameData *frame) { return (double)frame->lights[0].disk_radius; }
