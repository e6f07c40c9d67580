/* SPDX-License-Identifier: MIT
 * Names of all public enums but mgt_method, whose rows are in methods.h. Lists are in the order of their enums and NULL-terminated. */
#ifndef MANGATA_PARAMS_NAMES_H
#define MANGATA_PARAMS_NAMES_H

#include "mangata/mangata.h"
#include "params/field.h"

extern const char *const adaptive_names[];
extern const char *const backend_names[];
extern const char *const body_names[];
extern const char *const format_names[];
extern const char *const gl_color_names[];
extern const char *const isa_names[];
extern const char *const kernels_names[];
extern const char *const layer_names[];
extern const char *const log_level_names[];
extern const char *const method_waves_names[];
extern const char *const pattern_names[];
extern const char *const refraction_names[];
extern const char *const sky_model_names[];
extern const char *const spectrum_names[];
extern const char *const spreading_names[];
extern const char *const status_names[];
extern const char *const tone_map_names[];

/* Newer names, which are read, too. */
extern const name_alias refraction_aliases[];

/* The values of kernels_names, which have gaps. */
extern const int kernels_values[];

enum { LAYER_COUNT = MGT_LAYER_FOAM + 1 };

/* A list of names for messages: "color, coverage, mask". */
typedef struct names_text {
    char text[160];
} names_text;
names_text names_list(const char *const *names);

#endif
