/* SPDX-License-Identifier: MIT
 *
 * A sea's foam: its waves, moments, patterns and threshold.
 */
#include "params/foam.h"

#include <math.h>
#include <string.h>

#include "params/waves.h"

static const double pi = 3.14159265358979323846;

double foam_share_of_wind(double wind) { return fmin(3.84e-6 * pow(fmax(wind, 0), 3.41), MOST_FOAM); }

/* ---- waves ---- */

/* Short waves do not break. Waves count with the weight exp(−(k/k₀)²/2), where k₀ is break_number times mean_number(). Weights below least_part are dropped. */
static const double break_number = 8, least_part = 0.02;

/* √(mean-square slope / mean-square height): a mean wave number, radians per metre. */
static double mean_number(const mgt_water *water)
{
    double height = 0, slope = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const wave_numbers w = wave_numbers_of(&water->waves[i]);
        height += w.height * w.height;
        slope += w.height * w.height * (w.x * w.x + w.z * w.z);
    }
    return height > 0 ? sqrt(slope / height) : 0;
}

/* Mean of a cosine over ±half radians around a point, divided by its value at that point. */
static double mean_cosine(double half) { return fabs(half) < 1e-4 ? 1 - half * half / 6 : sin(half) / half; }

/* A wave of the scene that breaks. */
typedef struct breaking_wave {
    double k, part; /* wave number, radians per metre, and weight */
    size_t index;
} breaking_wave;

/* Sorts by rising k and is stable. qsort() is not used, because it may allocate. */
static void sort_by_length(breaking_wave *waves, breaking_wave *room, size_t count)
{
    if (count < 2)
        return;
    const size_t middle = count / 2;
    sort_by_length(waves, room, middle);
    sort_by_length(waves + middle, room, count - middle);
    memcpy(room, waves, middle * sizeof *room);
    for (size_t left = 0, right = middle, at = 0; left < middle; at++)
        waves[at] = right < count && waves[right].k < room[left].k ? waves[right++] : room[left++];
}

static void add_breaking(foam_sea *sea, const mgt_water *water, double breaking_number, const double span[FOAM_MOMENTS])
{
    breaking_wave breaking[MGT_MAX_WAVES], room[MGT_MAX_WAVES / 2];
    size_t count = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const wave_numbers w = wave_numbers_of(&water->waves[i]);
        const double k = hypot(w.x, w.z), relative = k / breaking_number, part = exp(-relative * relative / 2);
        if (k > 0 && part >= least_part && w.height != 0)
            breaking[count++] = (breaking_wave){k, part, i};
    }
    sort_by_length(breaking, room, count);
    for (size_t i = 0; i < count; i++) {
        const wave_numbers w = wave_numbers_of(&water->waves[breaking[i].index]);
        const double press = (double)water->choppiness * w.height * breaking[i].k * breaking[i].part;
        foam_wave *f = &sea->waves[sea->wave_count++];
        *f = (foam_wave){.x = w.x, .z = w.z, .frequency = w.frequency, .start = w.start, .height = w.height, .press = press};
        for (int j = 0; j < FOAM_MOMENTS; j++)
            f->held[j] = mean_cosine(w.frequency * span[j] / 2);
    }
}

static void measure_waves(foam_sea *sea)
{
    for (int i = 0; i < sea->wave_count; i++) {
        const foam_wave *w = &sea->waves[i];
        const double k = hypot(w->x, w->z), x = w->x / k, z = w->z / k, half = w->press * w->press / 2;
        const double parts[5] = {x * x * x * x, x * x * x * z, x * x * z * z, x * z * z * z, z * z * z * z};
        sea->variance += half;
        for (int c = 0; c < 5; c++)
            sea->shape[c] += half * parts[c];
    }
    for (int c = 0; c < 5 && sea->variance > 0; c++)
        sea->shape[c] /= sea->variance;
}

/* ---- moments ---- */

/* Age of the middle and length of each moment, in quarters of the persistence. */
static const double ages[FOAM_MOMENTS] = {0, 1, 2, 4}, spans[FOAM_MOMENTS] = {0.6, 1, 1.5, 2};
static const double weights[FOAM_MOMENTS] = {0.3, 0.28, 0.24, 0.18}, whitenesses[FOAM_MOMENTS] = {0.55, 0.26, 0.14, 0.08};

/* ---- patterns ---- */

enum { DIRECTIONS = FOAM_SINES / FOAM_OCTAVES };

/* Fills a pattern. Multiples of irrational numbers spread directions, phases, and lengths within an octave, so that the pattern does not repeat. `drawn`:
 * factor by which it is stretched along the wind. */
static void fill_pattern(foam_sine sines[FOAM_SINES], double longest, const double wind[2], double drawn, double seed)
{
    double sum = 0;
    for (int i = 0; i < FOAM_SINES; i++) {
        const int octave = i / DIRECTIONS;
        const double a = fmod(seed + i * 0.61803398874989485, 1), b = fmod(seed + i * 0.75487766624669276, 1), c = fmod(seed + i * 0.56984029099805327, 1);
        const double angle = pi * ((i % DIRECTIONS + a) / DIRECTIONS + 0.37 * octave), number = 2 * pi / longest * exp2(octave + b - 0.5);
        const double along = number * cos(angle) / drawn, across = number * sin(angle);
        sines[i] =
            (foam_sine){.x = along * wind[0] - across * wind[1], .z = along * wind[1] + across * wind[0], .start = 2 * pi * c, .size = exp2(-0.25 * octave)};
        sum += sines[i].size * sines[i].size / 2;
    }
    for (int i = 0; i < FOAM_SINES; i++)
        sines[i].size *= sqrt((1 - FOAM_FINE * FOAM_FINE) / sum);
}

/* The main axis of the covariance of breaking waves' slopes. */
static void main_axis(const foam_sea *sea, double axis[2])
{
    double xx = 0, xz = 0, zz = 0;
    for (int i = 0; i < sea->wave_count; i++) {
        const foam_wave *w = &sea->waves[i];
        const double k = hypot(w->x, w->z), share = w->press * w->press / (k * k);
        xx += share * w->x * w->x;
        xz += share * w->x * w->z;
        zz += share * w->z * w->z;
    }
    const double angle = 0.5 * atan2(2 * xz, xx - zz);
    axis[0] = cos(angle);
    axis[1] = sin(angle);
}

/* ---- the threshold ---- */

/* Probability of values below z in a gamma distribution of mean 0, variance 1 and this skewness, by Wilson and Hilferty's cube root. *lacking becomes −E[x; x <
 * z]. */
static double gamma_share(double z, double skewness, double *lacking)
{
    const double q = cbrt(fmax(1 + 0.5 * skewness * z, 0)), y = 3 * z / (q * q + q + 1) + skewness / 6;
    *lacking = q * exp(-y * y / 2) / sqrt(2 * pi);
    return 0.5 * erfc(-y / sqrt(2));
}

/* Covariance of J now and J at each moment. */
typedef struct moment_covariance {
    double of[FOAM_MOMENTS];
} moment_covariance;

static moment_covariance covariance_of(const foam_sea *sea)
{
    moment_covariance c = {{0}};
    for (int j = 0; j < sea->moments; j++)
        for (int i = 0; i < sea->wave_count; i++) {
            const foam_wave *w = &sea->waves[i];
            c.of[j] += w->press * w->press / 2 * w->held[j] * cos(w->frequency * sea->age[j]);
        }
    return c;
}

static double share_below(const foam_sea *sea, const moment_covariance *together, double least)
{
    const double deviation = sqrt(sea->variance), *t = sea->shape;
    const double xx = t[0] + t[2], xz = t[1] + t[3], zz = t[2] + t[4];
    const double skewness = 6 * deviation * (xx * zz - xz * xz);
    double share = 0;
    for (int j = 0; j < sea->moments; j++) {
        double lacking;
        const double below = gamma_share((least - 1) / deviation, skewness, &lacking);
        share += sea->weight[j] * fmax(below - together->of[j] / deviation * lacking, 0);
    }
    return share;
}

double foam_sea_share(const foam_sea *sea, double least)
{
    const moment_covariance together = covariance_of(sea);
    return share_below(sea, &together, least);
}

static double threshold(const foam_sea *sea)
{
    const moment_covariance together = covariance_of(sea);
    const double deviation = sqrt(sea->variance);
    double low = 1 - 6 * deviation, high = 1 + 6 * deviation;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (share_below(sea, &together, middle) < sea->share)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

bool foam_draws(const mgt_scene *scene)
{
    return scene->foam > 0 && scene->water.choppiness > 0 && mean_number(&scene->water) > 0 && scene->camera.position[1] >= 0;
}

bool foam_sea_of(const mgt_scene *scene, foam_sea *sea)
{
    const mgt_water *water = &scene->water;
    const double number = mean_number(water) * break_number;
    memset(sea, 0, offsetof(foam_sea, waves));
    if (!foam_draws(scene))
        return false;
    sea->share = fmin((double)scene->foam, MOST_FOAM);
    sea->moments = scene->foam_persistence > 0 ? FOAM_MOMENTS : 1;
    double span[FOAM_MOMENTS], wind[2];
    for (int j = 0; j < FOAM_MOMENTS; j++) {
        const double quarter = (double)scene->foam_persistence / 4;
        sea->age[j] = ages[j] * quarter;
        span[j] = spans[j] * quarter;
        sea->weight[j] = sea->moments > 1 ? weights[j] : j == 0 ? 1 : 0;
        sea->whiteness[j] = whitenesses[j];
    }
    sea->deviation = sqrt(waves_variances(water->waves, water->wave_count, 1, 0).height);
    add_breaking(sea, water, number, span);
    measure_waves(sea);
    if (!(sea->variance > 0))
        return false;
    sea->least = threshold(sea);
    main_axis(sea, wind);
    const double longest = 2 * pi / number;
    fill_pattern(sea->fresh, longest, wind, 1, 0.17);
    fill_pattern(sea->old, longest, wind, 3.5, 0.53);
    return true;
}
