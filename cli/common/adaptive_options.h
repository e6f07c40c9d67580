/* SPDX-License-Identifier: MIT */
/* The options of method adaptive alone: its scheme, and how much it samples. */
#ifndef MANGATA_CLI_COMMON_ADAPTIVE_OPTIONS_H
#define MANGATA_CLI_COMMON_ADAPTIVE_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "mangata/mangata.h"

/* Words of the command line as they stand; NULL where an option is not given. */
typedef struct adaptive_options {
    const char *scheme, *samples, *target, *budget, *center, *width, *threshold, *slots;
} adaptive_options;

/* The member for the option of this name (without dashes); NULL: there is none. */
const char **adaptive_option(adaptive_options *options, const char *name, size_t length);

/* Puts them into `quality`, whose method is known. False with what is wrong and what is allowed. */
bool adaptive_options_apply(const adaptive_options *given, mgt_quality *quality, char *wrong, size_t size);

/* What of these changes pixels, empty for other methods. */
typedef struct adaptive_text {
    char text[200];
} adaptive_text;
adaptive_text adaptive_options_text(const mgt_quality *quality);

#endif
