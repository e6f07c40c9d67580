/* SPDX-License-Identifier: MIT
 * The rows of the methods. */
#include "params/methods.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LAYERS_WATER                                                                                                                                      \
    (1u << MGT_LAYER_COLOR | 1u << MGT_LAYER_COVERAGE | 1u << MGT_LAYER_MASK | 1u << MGT_LAYER_DEPTH | 1u << MGT_LAYER_NORMAL | 1u << MGT_LAYER_SAMPLES | \
     1u << MGT_LAYER_FOAM)
#define LAYERS (LAYERS_WATER | 1u << MGT_LAYER_REFRACTION | 1u << MGT_LAYER_REFRACTION_ERROR)
#define LAYERS_ADAPTIVE (LAYERS | 1u << MGT_LAYER_IMPORTANCE | 1u << MGT_LAYER_DETAIL)
#define CPU (1u << MGT_BACKEND_CPU)
#define CPU_AND_GL (CPU | 1u << MGT_BACKEND_GL)

static const method_shader samples_shader = {.pass = "samples.comp"}, podee_shader = {.pass = "shade_podee.comp"},
                           podee_tables_shader = {.pass = "shade_kernels.comp"};

const method_row method_rows[] =
    {
        [MGT_METHOD_NONE] =
            {
                .properties = {0, "none", "one sample at the pixel's centre", MGT_WAVES_POINT, CPU_AND_GL, LAYERS},
                .way = METHOD_CENTRE,
                .shader = &samples_shader,
            },
        [MGT_METHOD_SSAA] =
            {
                .properties = {0, "ssaa", "N x N jittered samples", MGT_WAVES_POINT, CPU_AND_GL, LAYERS},
                .way = METHOD_SAMPLES,
                .numbered = true,
                .shader = &samples_shader,
            },
        [MGT_METHOD_PODEE_UNIFORM] =
            {
                .properties = {0, "podee-uniform", "Podee et al. 2021, one covariance for all unresolved waves", MGT_WAVES_SHUTTER, CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .transition = TRANSITION_PODEE,
                .tables = METHOD_PODEE_TABLES,
                .shader = &podee_shader,
                .with_tables = &podee_tables_shader,
            },
        [MGT_METHOD_PODEE_PIXEL] =
            {
                .properties = {0, "podee-pixel", "Podee et al. 2021, a covariance for each pixel", MGT_WAVES_SHUTTER, CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .transition = TRANSITION_PODEE,
                .keeps_phases = true,
                .tables = METHOD_PODEE_TABLES,
                .shader = &podee_shader,
                .with_tables = &podee_tables_shader,
            },
        [MGT_METHOD_MANGATA] =
            {
                .properties = {0, "mangata", "this library's own closed form", MGT_WAVES_SHUTTER, CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .from_middle = true,
                .hits = 2,
                .shader = &(const method_shader){"shade_slopes.comp", "glitter.k", NULL},
            },
        [MGT_METHOD_REFERENCE] =
            {
                .properties = {0, "reference", "brute force in double precision", MGT_WAVES_POINT, CPU, LAYERS_WATER},
                .way = METHOD_REFERENCE,
                .spatial = 8,
                .time = 8,
            },
        [MGT_METHOD_MSAA32] =
            {
                .properties = {0, "msaa32", "32 samples of visibility, one shading", MGT_WAVES_POINT, CPU_AND_GL, LAYERS},
                .way = METHOD_CENTRE,
                .samples = 32,
                .shader = &(const method_shader){"shade_point.comp", "msaa.k", "msaa_pixel"},
            },
        [MGT_METHOD_LEAN] =
            {
                .properties = {0, "lean", "Olano and Baker 2010: a tiled map of slope moments", MGT_WAVES_INSTANT, CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .tables = METHOD_LEAN_MAP,
                .shader = &(const method_shader){"shade_slopes.comp", "lean.k", "lean_result"},
            },
        [MGT_METHOD_LEADR] =
            {
                .properties = {0, "leadr", "Dupuy et al. 2013: lean with masking and shadowing", MGT_WAVES_INSTANT, CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .tables = METHOD_LEAN_MAP,
                .shader = &(const method_shader){"shade_slopes.comp", "leadr.k", "leadr_result"},
            },
        [MGT_METHOD_TOKUYOSHI] =
            {
                .properties = {0, "tokuyoshi", "Tokuyoshi and Kaplanyan 2019: geometric specular anti-aliasing", MGT_WAVES_POINT, CPU_AND_GL, LAYERS},
                .way = METHOD_CENTRE,
                .shader = &(const method_shader){"shade_point.comp", "tokuyoshi.k", "tokuyoshi_pixel"},
            },
        [MGT_METHOD_BRUNETON] =
            {
                .properties = {0, "bruneton", "Bruneton et al. 2010: Gaussian slopes and a point-like sun", MGT_WAVES_INSTANT, CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .transition = TRANSITION_BRUNETON,
                .shader = &(const method_shader){"shade_slopes.comp", "bruneton.k", "bruneton_result"},
            },
        [MGT_METHOD_FXAA] =
            {
                .properties = {0, "fxaa", "Lottes 2009: none, its edges blended afterwards", MGT_WAVES_POINT, CPU_AND_GL, LAYERS},
                .way = METHOD_PASS,
                .base = MGT_METHOD_NONE,
                .pass = METHOD_PASS_FXAA,
            },
        [MGT_METHOD_TAA] =
            {
                .properties = {0, "taa", "Karis 2014: none jittered over eight frames", MGT_WAVES_POINT, CPU_AND_GL, LAYERS},
                .way = METHOD_PASS,
                .base = MGT_METHOD_NONE,
                .pass = METHOD_PASS_TAA,
                .samples = 8,
            },
        [MGT_METHOD_TNDF] =
            {
                .properties = {0, "tndf", "after Tessari et al. 2020: one Gaussian of slopes over pixel and shutter", MGT_WAVES_SHUTTER, CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .shader = &(const method_shader){"shade_slopes.comp", "tndf.k", "tndf_result"},
            },
        [MGT_METHOD_ADAPTIVE] =
            {
                .properties = {0, "adaptive", "mangata, with more samples where it is likely to be wrong", MGT_WAVES_SHUTTER, CPU_AND_GL, LAYERS_ADAPTIVE},
                .way = METHOD_PASS,
                .base = MGT_METHOD_MANGATA,
                .pass = METHOD_PASS_ADAPTIVE,
                .from_middle = true,
                .hits = 1,
            },
        [MGT_METHOD_GGX_MOMENTS] =
            {
                .properties = {0, "ggx-moments", "GGX of the slopes' moments and a representative point of the light, as in engines", MGT_WAVES_INSTANT,
                               CPU_AND_GL, LAYERS},
                .way = METHOD_FILTERED,
                .shader = &(const method_shader){"shade_slopes.comp", "ggx_moments.k", "ggx_moments_result"},
            },
        {.properties = {.name = NULL}},
};

const size_t method_count = sizeof method_rows / sizeof *method_rows - 1;
_Static_assert(sizeof method_rows / sizeof *method_rows - 1 <= METHOD_SLOTS, "arrays by method have room for all");

const method_row *method_of(mgt_method method) { return &method_rows[method]; }

bool method_is_sampled(mgt_method method) { return method_rows[method].way == METHOD_SAMPLES || method_rows[method].way == METHOD_REFERENCE; }

uint64_t quality_samples(const mgt_quality *q) { return (uint64_t)q->spatial_samples * q->spatial_samples * q->time_samples; }

uint64_t quality_pixel_samples(const mgt_quality *q)
{
    const uint32_t fixed = method_rows[q->method].samples;
    if (q->method == MGT_METHOD_ADAPTIVE)
        return 0;
    return method_is_sampled(q->method) ? quality_samples(q) : fixed ? fixed : 1;
}

uint64_t quality_range(const mgt_quality *q)
{
    if (q->method == MGT_METHOD_ADAPTIVE)
        return q->adaptive == MGT_ADAPTIVE_PODEE ? q->sample_slots : 0;
    return method_is_sampled(q->method) ? quality_samples(q) : 0;
}

/* The number behind the name of a numbered row, which has `length` characters: 4 of "ssaa4"; 0: there is no legal number. */
static uint32_t number_behind(const char *name, size_t length)
{
    const char *digits = name + length;
    const size_t count = strspn(digits, "0123456789");
    if (count == 0 || digits[count])
        return 0;
    const unsigned long number = strtoul(digits, NULL, 10);
    return number <= METHOD_SIDE_MOST ? (uint32_t)number : 0;
}

bool method_from_name(const char *name, mgt_quality *quality)
{
    for (size_t i = 0; i < method_count; i++) {
        const method_row *row = &method_rows[i];
        const size_t length = strlen(row->properties.name);
        if (strncmp(name, row->properties.name, length) != 0)
            continue;
        const bool bare = name[length] == 0;
        const uint32_t number = !row->numbered ? bare : bare ? METHOD_SIDE_DEFAULT : number_behind(name, length);
        if (number == 0)
            continue;
        quality->method = (mgt_method)i;
        quality->spatial_samples = row->spatial ? row->spatial : number;
        quality->time_samples = row->time ? row->time : 1;
        return true;
    }
    return false;
}

bool method_name_has_number(const char *name)
{
    mgt_quality quality;
    return method_from_name(name, &quality) && method_rows[quality.method].numbered && strcmp(name, method_rows[quality.method].properties.name) != 0;
}

method_text method_name(const mgt_quality *quality)
{
    const method_row *row = &method_rows[quality->method];
    method_text out;
    if (row->numbered)
        snprintf(out.text, sizeof out.text, "%s%u", row->properties.name, quality->spatial_samples);
    else
        snprintf(out.text, sizeof out.text, "%s", row->properties.name);
    return out;
}

method_names_text method_names(void)
{
    method_names_text out;
    size_t used = 0;
    char numbers[40];
    snprintf(numbers, sizeof numbers, "N (N from 1 to %d)", METHOD_SIDE_MOST);
    for (size_t i = 0; i < method_count; i++)
        used += (size_t)snprintf(out.text + used, sizeof out.text - used, "%s%s%s", i ? ", " : "", method_rows[i].properties.name,
                                 method_rows[i].numbered ? numbers : "");
    return out;
}
