/* SPDX-License-Identifier: MIT
 * Names of public enums, and enums from names. */
#include "params/names.h"

#include <stdio.h>
#include <string.h>

#include "params/methods.h"

const char *const adaptive_names[] = {"cells", "podee", NULL};
const char *const backend_names[] = {"cpu", "gl", "auto", "null", NULL};
const char *const body_names[] = {"sun", "moon", NULL};
const char *const format_names[] = {"r32f", "rgb32f", "rgba32f", "rgba8_srgb", NULL};
const char *const gl_color_names[] = {"radiance", "exposed", "display", NULL};
const char *const isa_names[] = {"auto", "scalar", "sse2", "avx2", "avx512", "neon", NULL};
const char *const kernels_names[] = {"exact", "1", "3", "5", "9", "feline", "riemann", NULL};
const int kernels_values[] = {MGT_MIXTURE_EXACT, MGT_MIXTURE_1, MGT_MIXTURE_3, MGT_MIXTURE_5, MGT_MIXTURE_9, MGT_MIXTURE_FELINE, MGT_MIXTURE_RIEMANN};
const char *const layer_names[] = {"color",      "coverage",         "mask", "depth", "normal", "samples", "importance", "detail",
                                   "refraction", "refraction_error", "foam", NULL};
const char *const log_level_names[] = {"debug", "info", "warning", "error", NULL};
const char *const method_waves_names[] = {"point", "instant", "shutter", NULL};
const char *const pattern_names[] = {"none", "tiles", "checker", "stripes", NULL};
const char *const refraction_names[] = {"two-phase", "hybrid", "liu", "broad", "narrow", "screen-space", "distance-field", "off", "truth", NULL};
const name_alias refraction_aliases[] = {{"path-traced", "truth"}, {NULL, NULL}};
const char *const sky_model_names[] = {"atmosphere", "gradient", "black", NULL};
const char *const spectrum_names[] = {"auto", "pierson-moskowitz", "jonswap", "tma", "elfouhaily", NULL};
const char *const spreading_names[] = {"mitsuyasu", "hasselmann", "donelan-banner", "fixed", NULL};
const char *const status_names[] = {"ok", "argument", "scene", "memory", "unavailable", "unsupported", "thread", "cancelled", "lost", NULL};
const char *const tone_map_names[] = {"none", "reinhard", "aces", "agx", NULL};

names_text names_list(const char *const *names)
{
    names_text out = {""};
    for (size_t i = 0, used = 0; names[i]; i++)
        used += (size_t)snprintf(out.text + used, sizeof out.text - used, "%s%s", i ? ", " : "", names[i]);
    return out;
}

static const char *name_of(const char *const *names, int value)
{
    for (int i = 0; value >= 0 && names[i]; i++)
        if (i == value)
            return names[i];
    return NULL;
}

/* Writes the place of `name` to an enum of any type; all have the size of an int. */
static bool find(const char *const *names, const char *name, void *value)
{
    for (int i = 0; name && value && names[i]; i++)
        if (strcmp(names[i], name) == 0)
            return memcpy(value, &i, sizeof i), true;
    return false;
}

const char *mgt_adaptive_name(mgt_adaptive adaptive) { return name_of(adaptive_names, (int)adaptive); }
const char *mgt_backend_name(mgt_backend backend) { return name_of(backend_names, (int)backend); }
const char *mgt_source_name(mgt_source body) { return name_of(body_names, (int)body); }
const char *mgt_format_name(mgt_format format) { return name_of(format_names, (int)format); }
const char *mgt_gl_color_name(mgt_gl_color color) { return name_of(gl_color_names, (int)color); }
const char *mgt_isa_name(mgt_isa isa) { return name_of(isa_names, (int)isa); }
const char *mgt_layer_name(mgt_layer layer) { return name_of(layer_names, (int)layer); }
const char *mgt_log_level_name(mgt_log_level level) { return name_of(log_level_names, (int)level); }
const char *mgt_method_waves_name(mgt_method_waves waves) { return name_of(method_waves_names, (int)waves); }
const char *mgt_pattern_name(mgt_pattern pattern) { return name_of(pattern_names, (int)pattern); }
const char *mgt_refraction_name(mgt_refraction refraction) { return name_of(refraction_names, (int)refraction); }
const char *mgt_sky_model_name(mgt_sky_model model) { return name_of(sky_model_names, (int)model); }
const char *mgt_spectrum_name(mgt_spectrum spectrum) { return name_of(spectrum_names, (int)spectrum); }
const char *mgt_spreading_name(mgt_spreading spreading) { return name_of(spreading_names, (int)spreading); }
const char *mgt_status_name(mgt_status status) { return name_of(status_names, (int)status); }
const char *mgt_tone_map_name(mgt_tone_map tone_map) { return name_of(tone_map_names, (int)tone_map); }

bool mgt_adaptive_from_name(const char *name, mgt_adaptive *adaptive) { return find(adaptive_names, name, adaptive); }
bool mgt_backend_from_name(const char *name, mgt_backend *backend) { return find(backend_names, name, backend); }
bool mgt_source_from_name(const char *name, mgt_source *body) { return find(body_names, name, body); }
bool mgt_format_from_name(const char *name, mgt_format *format) { return find(format_names, name, format); }
bool mgt_gl_color_from_name(const char *name, mgt_gl_color *color) { return find(gl_color_names, name, color); }
bool mgt_isa_from_name(const char *name, mgt_isa *isa) { return find(isa_names, name, isa); }
bool mgt_layer_from_name(const char *name, mgt_layer *layer) { return find(layer_names, name, layer); }
bool mgt_log_level_from_name(const char *name, mgt_log_level *level) { return find(log_level_names, name, level); }
bool mgt_method_waves_from_name(const char *name, mgt_method_waves *waves) { return find(method_waves_names, name, waves); }
bool mgt_pattern_from_name(const char *name, mgt_pattern *pattern) { return find(pattern_names, name, pattern); }
bool mgt_refraction_from_name(const char *name, mgt_refraction *refraction)
{
    return name && find(refraction_names, name_first(refraction_aliases, name), refraction);
}
bool mgt_sky_model_from_name(const char *name, mgt_sky_model *model) { return find(sky_model_names, name, model); }
bool mgt_status_from_name(const char *name, mgt_status *status) { return find(status_names, name, status); }
bool mgt_tone_map_from_name(const char *name, mgt_tone_map *tone_map) { return find(tone_map_names, name, tone_map); }

const char *mgt_mixture_name(mgt_mixture kernels)
{
    for (int i = 0; kernels_names[i]; i++)
        if (kernels_values[i] == (int)kernels)
            return kernels_names[i];
    return NULL;
}

bool mgt_spectrum_from_name(const char *name, mgt_spectrum *spectrum) { return find(spectrum_names, name, spectrum); }
bool mgt_spreading_from_name(const char *name, mgt_spreading *spreading) { return find(spreading_names, name, spreading); }
bool mgt_mixture_from_name(const char *name, mgt_mixture *kernels)
{
    int place;
    if (!kernels || !find(kernels_names, name, &place))
        return false;
    *kernels = (mgt_mixture)kernels_values[place];
    return true;
}

const char *mgt_method_name(mgt_method method) { return (size_t)method < method_count ? method_of(method)->properties.name : NULL; }

bool mgt_method_from_name(const char *name, mgt_method *method)
{
    for (size_t i = 0; name && method && i < method_count; i++)
        if (strcmp(method_rows[i].properties.name, name) == 0)
            return *method = (mgt_method)i, true;
    return false;
}

uint32_t mgt_layer_channels(mgt_layer layer)
{
    if ((int)layer < 0 || (int)layer >= LAYER_COUNT)
        return 0;
    return layer == MGT_LAYER_COLOR || layer == MGT_LAYER_NORMAL || layer == MGT_LAYER_REFRACTION ? 3 : 1;
}
