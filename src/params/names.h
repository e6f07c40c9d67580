/* SPDX-License-Identifier: MIT
 * The names of all public enums but mgt_method, whose rows are in methods.h. Each list is in the order of its enum and ended by NULL. */
#ifndef MANGATA_PARAMS_NAMES_H
#define MANGATA_PARAMS_NAMES_H

#include "mangata/mangata.h"
#include "params/field.h"

extern const char *const adaptive_names[],
    *const backend_names[], *const body_names[], *const format_names[], *const gl_color_names[],
                                                                            *const isa_names[], *const kernels_names[],
                                                                                                    *const layer_names[],
                                                                                                        *const log_level_names[],
                                                                                                            *const method_waves_names[],
                                                                                                                *const pattern_names[],
                                                                                                                    *const refraction_names[],
                                                                                                                        *const sky_model_names[],
                                                                                                                            *const spectrum_names[],
                                                                                                                                *const spreading_names[],
                                                                                                                                    *const status_names[],
                                                                                                                                        *const tone_map_names[];

/* Newer names that are read as well. */
extern const name_alias refraction_aliases[];

/* The values of kernels_names, which have gaps. */
extern const int kernels_values[];

enum { LAYER_COUNT = MGT_LAYER_FOAM + 1 };

/* "color, coverage, mask": what a message allows. */
typedef struct names_text {
    char text[160];
} names_text;
names_text names_list(const char *const *names);

#endif
