/* SPDX-License-Identifier: MIT
 *
 * Published wave spectra.
 */
#include "sea/spectrum_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sea/spectrum_math.h"

static const double G = SPECTRUM_GRAVITY;
static const double LOWEST = 0.3; /* lowest frequency over that of the peak; the density's exponential is below e^-150 there */

/* ---- dispersion --------------------------------------------------------------------------------------------- */

double dispersion_frequency(double wave_number, double depth) { return sqrt(G * wave_number * (depth > 0 ? portable_tanh(wave_number * depth) : 1)); }

double dispersion_wave_number(double frequency, double depth)
{
    const double deep = frequency * frequency / G;
    if (!(depth > 0) || deep * depth > 20)
        return deep;
    /* Newton's method on k tanh(k d) = ω²/g from Eckart's estimate, whose error is at most 5 %. */
    double k = deep / sqrt(portable_tanh(deep * depth));
    for (int i = 0; i < 20; i++) {
        const double t = portable_tanh(k * depth), next = k - (k * t - deep) / (t + k * depth * (1 - t * t));
        if (!(fabs(next - k) > 1e-15 * k))
            break;
        k = next;
    }
    return k;
}

/* Ratio of k⁻³ ∂k/∂ω in this depth to its value in deep water, by Bouws et al.: tanh²(kd) / (1 + 2kd / sinh 2kd). */
double depth_factor(double frequency, double depth)
{
    if (!(depth > 0))
        return 1;
    const double x = 2 * dispersion_wave_number(frequency, depth) * depth;
    if (x > 40)
        return 1;
    const double t = portable_tanh(x / 2), inverse_sinh = (1 - t * t) / (2 * t), e = portable_exp(-x);
    return t * t / (1 + x * (x < 1 ? inverse_sinh : 2 * e / (1 - e * e))); /* each form avoids cancellation */
}

/* ---- closed forms ------------------------------------------------------------------------------------------- */

double wind_at_height(double wind, double height, double wanted_height)
{
    const double drag = 1.3e-3, karman = 0.4, slope = sqrt(drag) / karman;
    return wind * (1 + slope * portable_log(wanted_height / 10)) / (1 + slope * portable_log(height / 10));
}

double closed_form_height(double alpha, double peak, double gamma)
{
    const double variance = alpha * G * G / (5 * peak * peak * peak * peak);
    return gamma <= 7 ? 4 * sqrt(variance / (1 - 0.287 * portable_log(gamma))) : NAN;
}

/* E₁(x) for x > 0, by its series up to x = 1 and by the continued fraction beyond. */
static double exponential_integral(double x)
{
    if (x > 1) {
        double fraction = x + 40;
        for (int i = 40; i > 0; i--)
            fraction = x + i / (1 + i / fraction);
        return portable_exp(-x) / fraction;
    }
    double sum = -0.57721566490153286061 - portable_log(x), term = 1;
    for (int i = 1; i < 25; i++) {
        term *= -x / i;
        sum -= term / i;
    }
    return sum;
}

double closed_form_slope(double alpha, double peak, double high)
{
    const double ratio = peak / high;
    return alpha / 4 * exponential_integral(1.25 * ratio * ratio * ratio * ratio);
}

cox_munk cox_munk_slopes(double wind) { return (cox_munk){.total = 0.003 + 5.12e-3 * wind, .upwind = 3.16e-3 * wind, .crosswind = 0.003 + 1.92e-3 * wind}; }

/* ---- from settings ------------------------------------------------------------------------------------------ */

static bool refuse(spectrum_fault *fault, const char *key, const char *format, double value, double limit)
{
    fault->key = key;
    snprintf(fault->text, sizeof fault->text, format, value, limit);
    return false;
}

static double jonswap_peak(double wind_10, double fetch) { return 22 * portable_pow(G * G / (wind_10 * fetch), 1.0 / 3); }

/* Pierson and Moskowitz write α g² ω⁻⁵ exp(-β (g / (U ω))⁴) with β = 0.74, so the peak is at (4 β / 5)^¼ g / U. */
static double pierson_moskowitz_peak(double wind_19_5) { return sqrt(sqrt(0.8 * 0.74)) * G / wind_19_5; }

static void make_pierson_moskowitz(wave_spectrum *s, double wind_19_5)
{
    s->alpha = 8.1e-3;
    s->gamma = 1;
    s->peak = pierson_moskowitz_peak(wind_19_5);
}

static void make_jonswap(wave_spectrum *s, double wind_10, double fetch, double gamma)
{
    s->alpha = 0.076 * portable_pow(wind_10 * wind_10 / (fetch * G), 0.22);
    s->gamma = gamma;
    s->peak = jonswap_peak(wind_10, fetch);
}

static bool make_elfouhaily(wave_spectrum *s, double wind_10, double fetch, spectrum_fault *fault)
{
    const double age = unified_age(wind_10, fetch);
    if (age > UNIFIED_YOUNGEST)
        return refuse(fault, "fetch", "is %g m, too short for the spectrum in this wind; allowed: at least %.0f m", fetch,
                      ceil(unified_fetch(wind_10, UNIFIED_YOUNGEST)));
    s->unified = unified_sea_make(wind_10, age);
    s->alpha = s->unified.long_alpha;
    s->gamma = s->unified.gamma;
    s->peak = age * G / wind_10;
    return true;
}

static bool make_buoy(wave_spectrum *s, const spectrum_table *table, double shortest, spectrum_fault *fault)
{
    const spectrum_row *rows = table->rows, *highest = rows, *last = &rows[table->row_count - 1];
    for (size_t i = 1; i < table->row_count; i++)
        highest = rows[i].density > highest->density ? &rows[i] : highest;
    s->table = table;
    s->peak = highest->frequency;
    s->gamma = 1;
    s->downwind = spectrum_table_mean_azimuth(table);
    s->low = rows[0].frequency;
    s->high = last->frequency;
    if (!(shortest > 0))
        return true;
    const double end = dispersion_frequency(2 * SPECTRUM_PI / shortest, s->depth);
    if (end <= s->high)
        return refuse(fault, "shortest", "is %g m, which the table reaches itself; allowed: shorter than %g m, or 0: none beyond the table", shortest,
                      2 * SPECTRUM_PI / dispersion_wave_number(s->high, s->depth));
    s->tail_from = s->high;
    s->high = end;
    return true;
}

static double wind_height_of(const spectrum_settings *settings)
{
    return settings->wind_height > 0 ? settings->wind_height : settings->kind == SPECTRUM_PIERSON_MOSKOWITZ ? 19.5 : 10;
}

double spectrum_wind_10(const spectrum_settings *settings) { return wind_at_height(settings->wind, wind_height_of(settings), 10); }

bool wave_spectrum_make(wave_spectrum *out, const spectrum_settings *settings, const spectrum_table *table, spectrum_fault *fault)
{
    const bool buoy = settings->kind == SPECTRUM_BUOY;
    const double half_turns = (settings->direction_deg + 180) / 360;
    double shortest = settings->shortest;
    if (!(shortest > 0) && (!buoy || settings->slope == SLOPE_COX_MUNK))
        shortest = SPECTRUM_SHORTEST;
    wave_spectrum s = {
        .kind = settings->kind,
        .depth = settings->depth,
        .wind_10 = spectrum_wind_10(settings),
        .tail_from = INFINITY,
        .bend_from = INFINITY,
        .directions = settings->directions,
        .spread = settings->spread,
        .downwind = 2 * SPECTRUM_PI * (half_turns - floor(half_turns)),
    };
    if (settings->kind == SPECTRUM_TMA && !(settings->depth > 0))
        return refuse(fault, "depth", "is %g: tma is a sea of limited depth; allowed: above 0 (or the model jonswap)", settings->depth, 0);
    if (buoy) {
        const bool good = make_buoy(&s, table, shortest, fault);
        *out = s;
        return good;
    }
    if (settings->kind == SPECTRUM_ELFOUHAILY) {
        if (!make_elfouhaily(&s, s.wind_10, settings->fetch, fault))
            return false;
    } else if (settings->kind == SPECTRUM_PIERSON_MOSKOWITZ)
        make_pierson_moskowitz(&s, wind_at_height(settings->wind, wind_height_of(settings), 19.5));
    else
        make_jonswap(&s, s.wind_10, settings->fetch, settings->gamma);
    const double shallow = 0.7616 * G / (s.peak * s.peak); /* k d = 1 at the peak, and 0.7616 = tanh 1 */
    if (!spectrum_takes_depth(settings->kind) && s.depth > 0 && s.depth < shallow)
        return refuse(
            fault, "depth",
            "is %g m, shallow for this sea's waves, and the model one of deep water; allowed: the models tma and elfouhaily, 0 (deep), or above %.3g m",
            s.depth, shallow);
    s.low = LOWEST * s.peak;
    s.high = dispersion_frequency(2 * SPECTRUM_PI / shortest, s.depth);
    *out = s;
    if (s.high < 2 * s.peak)
        return refuse(fault, settings->shortest > 0 ? "shortest" : "wind",
                      "leaves no room between the shortest wave, %g m, and the peak's, %g m; allowed: at least four times as long", shortest,
                      2 * SPECTRUM_PI / dispersion_wave_number(s.peak, s.depth));
    return true;
}

double wave_spectrum_peak(const wave_spectrum *spectrum)
{
    /* The factor of depth falls towards low frequencies, so it moves the highest density to a higher frequency. That of Elfouhaily et al. is not at their
       k_p. */
    double best = spectrum->peak;
    if (spectrum_takes_depth(spectrum->kind))
        for (double f = 0.5 * spectrum->peak, most = 0; f < 3 * spectrum->peak; f += 0.001 * spectrum->peak) {
            const double density = wave_spectrum_density(spectrum, f);
            if (density > most) {
                most = density;
                best = f;
            }
        }
    return best;
}

/* ---- densities ---------------------------------------------------------------------------------------------- */

/* Density in deep water. */
static double parametric_density(const wave_spectrum *s, double frequency)
{
    if (s->kind == SPECTRUM_ELFOUHAILY)
        return unified_density(&s->unified, dispersion_wave_number(frequency, 0)) * (2 * frequency / G); /* dk/dω */
    const double ratio = s->peak / frequency, square = frequency * frequency;
    double density = s->alpha * G * G / (square * square * frequency) * portable_exp(-1.25 * ratio * ratio * ratio * ratio);
    if (s->gamma > 1) {
        const double width = frequency <= s->peak ? 0.07 : 0.09, x = (frequency / s->peak - 1) / width;
        density *= portable_pow(s->gamma, portable_exp(-x * x / 2));
    }
    return density;
}

double wave_spectrum_density(const wave_spectrum *s, double frequency)
{
    if (!(frequency >= s->low && frequency <= s->high))
        return 0;
    double density;
    if (s->kind != SPECTRUM_BUOY)
        density = parametric_density(s, frequency) * (spectrum_takes_depth(s->kind) ? depth_factor(frequency, s->depth) : 1);
    else if (frequency > s->tail_from)
        density = spectrum_table_density(s->table, s->tail_from) * portable_pow(frequency / s->tail_from, -5);
    else
        density = spectrum_table_density(s->table, frequency);
    return frequency > s->bend_from ? density * portable_pow(frequency / s->bend_from, s->bend_power) : density;
}

/* ---- directions --------------------------------------------------------------------------------------------- */

/* cos^2s of half the angle: its power 2 s. */
static double half_cosine(double angle, double s) { return portable_pow(fabs(portable_cos(angle / 2)), 2 * s); }

static double mitsuyasu_spread(double ratio, double wind_over_speed)
{
    return 11.5 * portable_pow(wind_over_speed, -2.5) * portable_pow(ratio, ratio <= 1 ? 5 : -2.5);
}

static double hasselmann_spread(double ratio, double wind_over_speed)
{
    return ratio < 1.05 ? 6.97 * portable_pow(ratio, 4.06) : 9.77 * portable_pow(ratio, -2.33 - 1.45 * (wind_over_speed - 1.17));
}

static double donelan_banner(double angle, double ratio)
{
    double beta;
    if (ratio < 0.56)
        beta = 1.24;
    else if (ratio < 0.95)
        beta = 2.61 * portable_pow(ratio, 1.3);
    else if (ratio < 1.6)
        beta = 2.28 * portable_pow(ratio, -1.3);
    else
        beta = portable_pow(10, -0.4 + 0.8393 * portable_exp(-0.567 * portable_log(ratio * ratio)));
    const double e = portable_exp(-2 * beta * fabs(angle)); /* sech² x = 4 e^-2x / (1 + e^-2x)² */
    return 4 * e / ((1 + e) * (1 + e));
}

double wave_spectrum_spreading(const wave_spectrum *s, double frequency, double azimuth)
{
    const double turns = (azimuth - s->downwind) / (2 * SPECTRUM_PI), angle = 2 * SPECTRUM_PI * (turns - floor(turns + 0.5));
    if (frequency > s->bend_from)
        return half_cosine(angle, s->bend_spread);
    if (s->kind == SPECTRUM_BUOY)
        return spectrum_table_at(s->table, frequency, azimuth);
    if (s->kind == SPECTRUM_ELFOUHAILY) /* the paper's is symmetric; only its half along the wind is used, because no wave runs against the wind */
        return fabs(angle) < SPECTRUM_PI / 2 ? 1 + unified_asymmetry(&s->unified, dispersion_wave_number(frequency, 0)) * portable_cos(2 * angle) : 0;
    const double ratio = frequency / s->peak, wind_over_speed = s->wind_10 * s->peak / G;
    switch (s->directions) {
    case DIRECTIONS_MITSUYASU:
        return half_cosine(angle, mitsuyasu_spread(ratio, wind_over_speed));
    case DIRECTIONS_HASSELMANN:
        return half_cosine(angle, hasselmann_spread(ratio, wind_over_speed));
    case DIRECTIONS_DONELAN_BANNER:
        return donelan_banner(angle, ratio);
    case DIRECTIONS_FIXED:
        return half_cosine(angle, s->spread);
    }
    return 0;
}
