/* SPDX-License-Identifier: MIT
 * A frame's foam in single precision, relative to a camera. */
#include "frame/foam.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846, turn = 6.28318530717958647692;

void frame_foam_light(const mgt_scene *scene, const sky_state *sky, double by_sky[3], double by_light[MAX_LIGHTS][3])
{
    for (int c = 0; c < 3; c++)
        by_sky[c] = scene->sky.model == MGT_SKY_BLACK ? 0 : sky->irradiance_sky[c] / pi;
    for (int i = 0; i < lights_count(sky->lights); i++) {
        light_beam(lights_get(sky->lights, i), by_light[i]);
        for (int c = 0; c < 3; c++)
            by_light[i][c] /= pi;
    }
}

void frame_foam_of(const mgt_scene *scene, const sky_state *sky, frame_foam *foam)
{
    foam->some = foam_sea_of(scene, &foam->sea);
    if (!foam->some)
        return;
    double beams[MAX_LIGHTS][3] = {{0}};
    frame_foam_light(scene, sky, foam->sky, beams);
    memcpy(foam->beam, beams[0], sizeof foam->beam);
    memset(foam->toward, 0, sizeof foam->toward);
    if (lights_count(sky->lights) > 0)
        memcpy(foam->toward, light_toward(lights_get(sky->lights, 0)), sizeof foam->toward);
}

_Static_assert((int)MAX_LIGHTS == 1, "foam has one beam");
_Static_assert(FOAM_MOMENTS == 4, "four of each member");

static float reduced(double radians)
{
    const double turns = radians / turn;
    return (float)(turns - rint(turns));
}

static double mean_cosine(double half) { return fabs(half) < 1e-4 ? 1 - half * half / 6 : sin(half) / half; }

/* What a wave gives to the variance and the covariances of each moment, as FoamWave has them. */
typedef struct foam_parts {
    double held[FOAM_MOMENTS], variance[FOAM_MOMENTS], shared[FOAM_MOMENTS], high[FOAM_MOMENTS];
    double lean[FOAM_MOMENTS]; /* over the wave vector, radians per metre */
} foam_parts;

/* Of the mean over an interval of twice `half` seconds. */
static foam_parts parts_of(const foam_sea *sea, const foam_wave *w, double half)
{
    const double blur = mean_cosine(w->frequency * half), variance = w->press * w->press / 2;
    foam_parts parts;
    for (int j = 0; j < FOAM_MOMENTS; j++) {
        const double turned = w->frequency * sea->age[j];
        parts.held[j] = w->held[j] * blur;
        parts.variance[j] = variance * parts.held[j] * parts.held[j];
        parts.shared[j] = variance * w->held[j] * cos(turned) * blur * blur;
        parts.high[j] = -w->height * w->press / sea->deviation * w->held[j] / 2 * cos(turned);
        parts.lean[j] = w->height * w->press * w->held[j] / 2 * sin(turned);
    }
    return parts;
}

static FoamWave wave_of(const foam_sea *sea, const foam_wave *w, const foam_parts *parts, double x, double z, double middle)
{
    const double k = hypot(w->x, w->z), *held = parts->held;
    return (FoamWave){.along_x = (float)(w->x / turn),
                      .along_z = (float)(w->z / turn),
                      .start = reduced(w->x * x + w->z * z + w->frequency * middle + w->start),
                      .held_0 = (float)held[0],
                      .press_xx = (float)(-w->press * w->x * w->x / (k * k)),
                      .press_xz = (float)(-w->press * w->x * w->z / (k * k)),
                      .press_zz = (float)(-w->press * w->z * w->z / (k * k)),
                      .along_squared = (float)(k * k / (turn * turn)),
                      .back_c1 = (float)(held[1] * cos(w->frequency * sea->age[1])),
                      .back_s1 = (float)(-held[1] * sin(w->frequency * sea->age[1])),
                      .back_c2 = (float)(held[2] * cos(w->frequency * sea->age[2])),
                      .back_s2 = (float)(-held[2] * sin(w->frequency * sea->age[2])),
                      .back_c3 = (float)(held[3] * cos(w->frequency * sea->age[3])),
                      .back_s3 = (float)(-held[3] * sin(w->frequency * sea->age[3])),
                      .variance_0 = (float)parts->variance[0],
                      .variance_1 = (float)parts->variance[1],
                      .variance_2 = (float)parts->variance[2],
                      .variance_3 = (float)parts->variance[3],
                      .shared_0 = (float)parts->shared[0],
                      .shared_1 = (float)parts->shared[1],
                      .shared_2 = (float)parts->shared[2],
                      .shared_3 = (float)parts->shared[3],
                      .lean_1 = (float)(turn * parts->lean[1]),
                      .lean_2 = (float)(turn * parts->lean[2]),
                      .lean_3 = (float)(turn * parts->lean[3]),
                      .high_0 = (float)parts->high[0],
                      .high_1 = (float)parts->high[1],
                      .high_2 = (float)parts->high[2],
                      .high_3 = (float)parts->high[3]};
}

/* What the waves before one leave of the variance and the covariances of each moment if they are all resolved. See the members rest_… of FoamWave. */
typedef struct foam_rest {
    double variance[FOAM_MOMENTS], shared[FOAM_MOMENTS], high[FOAM_MOMENTS], lean[FOAM_MOMENTS][2];
} foam_rest;

/* Adds the covariances of a wave `times` 1 or −1. */
static void add_covariances(foam_rest *rest, const foam_wave *w, const foam_parts *parts, double times)
{
    for (int j = 0; j < FOAM_MOMENTS; j++) {
        rest->shared[j] += times * parts->shared[j];
        rest->high[j] += times * parts->high[j];
        rest->lean[j][0] += times * w->x * parts->lean[j];
        rest->lean[j][1] += times * w->z * parts->lean[j];
    }
}

/* All of it: no wave is resolved yet. What is not resolved is not a mean over an interval either. */
static foam_rest rest_of_all(const foam_sea *sea)
{
    foam_rest rest = {.variance = {sea->variance, sea->variance, sea->variance, sea->variance}};
    for (int i = 0; i < sea->wave_count; i++) {
        const foam_parts parts = parts_of(sea, &sea->waves[i], 0);
        add_covariances(&rest, &sea->waves[i], &parts, 1);
    }
    return rest;
}

static void store_rest(const foam_rest *rest, FoamWave *w)
{
    w->rest_variance_0 = (float)rest->variance[0];
    w->rest_variance_1 = (float)rest->variance[1];
    w->rest_variance_2 = (float)rest->variance[2];
    w->rest_variance_3 = (float)rest->variance[3];
    w->rest_shared_0 = (float)rest->shared[0];
    w->rest_shared_1 = (float)rest->shared[1];
    w->rest_shared_2 = (float)rest->shared[2];
    w->rest_shared_3 = (float)rest->shared[3];
    w->rest_high_0 = (float)rest->high[0];
    w->rest_high_1 = (float)rest->high[1];
    w->rest_high_2 = (float)rest->high[2];
    w->rest_high_3 = (float)rest->high[3];
    w->rest_lean_x_1 = (float)rest->lean[1][0];
    w->rest_lean_x_2 = (float)rest->lean[2][0];
    w->rest_lean_x_3 = (float)rest->lean[3][0];
    w->rest_lean_z_1 = (float)rest->lean[1][1];
    w->rest_lean_z_2 = (float)rest->lean[2][1];
    w->rest_lean_z_3 = (float)rest->lean[3][1];
}

/* foam_sine is a cosine and FoamSine is a sine, so a quarter of a turn is added to the phase. */
static FoamSine sine_of(const foam_sine *s, double x, double z)
{
    return (FoamSine){(float)(s->x / turn), (float)(s->z / turn), reduced(s->x * x + s->z * z + s->start + pi / 2), (float)s->size};
}

void foam_place(const frame_foam *foam, double x, double z, double middle, double half, bool filter, foam_set *out)
{
    const foam_sea *sea = &foam->sea;
    FoamData *d = &out->data;
    foam_rest rest = rest_of_all(sea);
    for (int i = 0; i < sea->wave_count; i++) {
        const foam_parts parts = parts_of(sea, &sea->waves[i], half);
        out->waves[i] = wave_of(sea, &sea->waves[i], &parts, x, z, middle);
        store_rest(&rest, &out->waves[i]);
        add_covariances(&rest, &sea->waves[i], &parts, -1);
        for (int j = 0; j < FOAM_MOMENTS; j++)
            rest.variance[j] -= parts.variance[j];
    }
    out->waves[sea->wave_count] = (FoamWave){.along_x = 0};
    store_rest(&rest, &out->waves[sea->wave_count]);
    for (int i = 0; i < FOAM_SINES; i++) {
        out->sines[i] = sine_of(&sea->fresh[i], x, z);
        out->sines[FOAM_SINES + i] = sine_of(&sea->old[i], x, z);
    }
    *d = (FoamData){.foam_waves = sea->wave_count,
                    .foam_moments = sea->moments,
                    .least = (float)sea->least,
                    .sees = filter ? 1 : 0,
                    .shape_xxxx = (float)sea->shape[0],
                    .shape_xxxz = (float)sea->shape[1],
                    .shape_xxzz = (float)sea->shape[2],
                    .shape_xzzz = (float)sea->shape[3],
                    .shape_zzzz = (float)sea->shape[4],
                    .weight_0 = (float)sea->weight[0],
                    .weight_1 = (float)sea->weight[1],
                    .weight_2 = (float)sea->weight[2],
                    .weight_3 = (float)sea->weight[3],
                    .white_0 = (float)(sea->weight[0] * sea->whiteness[0]),
                    .white_1 = (float)(sea->weight[1] * sea->whiteness[1]),
                    .white_2 = (float)(sea->weight[2] * sea->whiteness[2]),
                    .white_3 = (float)(sea->weight[3] * sea->whiteness[3]),
                    .toward_x = (float)foam->toward[0],
                    .toward_y = (float)foam->toward[1],
                    .toward_z = (float)foam->toward[2],
                    .beam_r = (float)foam->beam[0],
                    .beam_g = (float)foam->beam[1],
                    .beam_b = (float)foam->beam[2],
                    .sky_r = (float)foam->sky[0],
                    .sky_g = (float)foam->sky[1],
                    .sky_b = (float)foam->sky[2]};
}
