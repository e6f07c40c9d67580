/* SPDX-License-Identifier: MIT */
/* The options of what is seen through the surface: the method, and how well. */
#ifndef MANGATA_CLI_COMMON_REFRACTION_OPTIONS_H
#define MANGATA_CLI_COMMON_REFRACTION_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "mangata/mangata.h"

/* Words of the command line as they stand; NULL where an option is not given. */
typedef struct refraction_options {
    const char *method, *tess_error, *samples, *caustics;
} refraction_options;

/* The member for the option of this name (without dashes); NULL: there is none. */
const char **refraction_option(refraction_options *options, const char *name, size_t length);

/* Puts them into `quality`. False with what is wrong and what is allowed. */
bool refraction_options_apply(const refraction_options *given, mgt_quality *quality, char *wrong, size_t size);

/* False for a word that names none. */
bool refraction_from_name(const char *name, size_t length, mgt_refraction *refraction);
const char *refraction_name(mgt_refraction refraction);
extern const char refraction_words[];

/* What of these changes pixels, empty where all is as it is by default. */
typedef struct refraction_text {
    char text[96];
} refraction_text;
refraction_text refraction_options_text(const mgt_quality *quality);

#endif
