/* SPDX-License-Identifier: MIT */
/* The report of `mangata waves` about a sea. */
#include "cli/waves_report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sea/spectrum_math.h"
#include "params/waves.h"

static double wavelength(const mgt_wave *wave) { return 2 * SPECTRUM_PI / wave_course_of(wave, 0).number; }

static bool is_bent(const waves_report *r) { return r->settings->settings.slope == SLOPE_COX_MUNK; }

bool waves_report_make(waves_report *report, const scene_spectrum *settings, const scene_sea *sea, const mgt_wave *waves, size_t count)
{
    const wave_spectrum *s = &sea->spectrum;
    const bool parametric = s->kind == SPECTRUM_PIERSON_MOSKOWITZ || s->kind == SPECTRUM_JONSWAP;
    waves_report r = {.settings = settings,
                      .spectrum = *s,
                      .peak_period = 2 * SPECTRUM_PI / wave_spectrum_peak(s),
                      .longest = wavelength(&waves[0]),
                      .shortest = wavelength(&waves[count - 1]),
                      .count = count,
                      .waves = waves_statistics(waves, count, s->downwind),
                      .height = parametric ? closed_form_height(s->alpha, s->peak, s->gamma) : NAN,
                      .slope = NAN,
                      .clean = sea->slopes};
    r.spectrum.table = NULL;
    if (s->kind == SPECTRUM_BUOY && !is_bent(&r))
        r.clean = (cox_munk){NAN, NAN, NAN}; /* the wind is not known */
    if (is_bent(&r))
        r.slope = sea->slopes.total;
    else if (parametric && s->gamma == 1 && !(s->depth > 0))
        r.slope = closed_form_slope(s->alpha, s->peak, s->high);
    *report = r;
    return spectrum_statistics(s, &report->sea);
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

static json_t *number(double value) { return isfinite(value) ? json_real(value) : json_null(); }

static json_t *figures(double closed_form, double clean, double spectrum, double waves)
{
    return json_pack("{s:o, s:o, s:o, s:o}", "closed_form", number(closed_form), "cox_munk", number(clean), "spectrum", number(spectrum), "waves",
                     number(waves));
}

static const char *choice_name(const char *key, int choice)
{
    const field_row *field = scene_root_field()->fields;
    const char *const path[] = {"water", "spectrum", key};
    for (size_t i = 0; i < 3; field = ++i < 3 ? field->fields : field)
        while (strcmp(field->key, path[i]) != 0)
            field++;
    return field->choices[choice];
}

json_t *waves_report_json(const waves_report *r, const char *path)
{
    const spectrum_settings *s = &r->settings->settings;
    const double wind = r->spectrum.wind_10, azimuth = r->spectrum.downwind * 180 / SPECTRUM_PI;
    const bool fetch = spectrum_takes_fetch(s->kind);
    json_t *json = json_pack("{s:s, s:s, s:I, s:I}", "spectrum", choice_name("model", (int)s->kind), "slope", choice_name("slope", (int)s->slope), "waves",
                             (json_int_t)r->count, "seed", (json_int_t)r->settings->seed);
    if (!json)
        return NULL;
    json_object_set_new(json, "wind_10m", number(wind));
    json_object_set_new(json, "wind_19_5m", number(wind_at_height(wind, 10, 19.5)));
    json_object_set_new(json, "fetch", fetch ? number(s->fetch) : json_null());
    json_object_set_new(json, "depth", s->depth > 0 ? number(s->depth) : json_null());
    json_object_set_new(json, "from_deg", number(fmod(azimuth + 180, 360)));
    json_object_set_new(json, "peak_period", number(r->peak_period));
    json_object_set_new(json, "longest", number(r->longest));
    json_object_set_new(json, "shortest", number(r->shortest));
    json_object_set_new(json, "alpha", s->kind == SPECTRUM_BUOY ? json_null() : number(r->spectrum.alpha));
    json_object_set_new(json, "tail_power", is_bent(r) ? number(r->spectrum.bend_power) : json_null());
    json_object_set_new(json, "significant_wave_height", figures(r->height, NAN, r->sea.height, r->waves.height));
    json_object_set_new(json, "mean_square_slope", figures(r->slope, r->clean.total, r->sea.slope, r->waves.slope));
    json_object_set_new(json, "mean_square_slope_upwind", figures(NAN, r->clean.upwind, r->sea.upwind, r->waves.upwind));
    json_object_set_new(json, "mean_square_slope_crosswind", figures(NAN, r->clean.crosswind, r->sea.crosswind, r->waves.crosswind));
    json_object_set_new(json, "scene", path ? console_json_text(path) : json_null());
    return json;
}

/* ---- text --------------------------------------------------------------------------------------------------- */

static void print_row(const console *out, const char *name, const double values[4])
{
    char cells[4][16];
    for (int i = 0; i < 4; i++)
        snprintf(cells[i], sizeof cells[i], isfinite(values[i]) ? "%.4g" : "-", values[i]);
    console_note(out, "%-26s%12s%12s%12s%12s", name, cells[0], cells[1], cells[2], cells[3]);
}

void waves_report_print(const waves_report *r, const console *out)
{
    const sea_statistics *sea = &r->sea, *waves = &r->waves;
    console_note(out, "%s", waves_report_title(r).text);
    console_note(out, "%zu waves of %.3g to %.3g m, peak period %.3g s", r->count, r->shortest, r->longest, r->peak_period);
    console_note(out, "%-26s%12s%12s%12s%12s", "", "closed form", "Cox-Munk", "spectrum", "waves");
    print_row(out, "significant wave height, m", (const double[4]){r->height, NAN, sea->height, waves->height});
    print_row(out, "mean-square slope", (const double[4]){r->slope, r->clean.total, sea->slope, waves->slope});
    print_row(out, "  upwind", (const double[4]){NAN, r->clean.upwind, sea->upwind, waves->upwind});
    print_row(out, "  crosswind", (const double[4]){NAN, r->clean.crosswind, sea->crosswind, waves->crosswind});
}

waves_title waves_report_title(const waves_report *r)
{
    static const char *const names[] = {"", "Pierson-Moskowitz", "JONSWAP", "TMA", "unified", "buoy's"};
    const spectrum_settings *s = &r->settings->settings;
    const double height = s->wind_height > 0 ? s->wind_height : s->kind == SPECTRUM_PIERSON_MOSKOWITZ ? 19.5 : 10;
    waves_title title;
    char wind[64] = "", fetch[48] = "", depth[48] = "";
    if (s->kind != SPECTRUM_BUOY || is_bent(r))
        snprintf(wind, sizeof wind, ", wind %g m/s at %g m", s->wind, height);
    if (spectrum_takes_fetch(s->kind))
        snprintf(fetch, sizeof fetch, ", fetch %g km", s->fetch / 1000);
    if (s->depth > 0)
        snprintf(depth, sizeof depth, ", depth %g m", s->depth);
    snprintf(title.text, sizeof title.text, "a %s sea%s%s%s: significant wave height %.3g m, mean-square slope %.3g%s", names[s->kind], wind, fetch, depth,
             r->waves.height, r->waves.slope, is_bent(r) ? " (Cox and Munk)" : "");
    return title;
}
