/* SPDX-License-Identifier: MIT */
/* The options of podee-* alone: how the Gaussian is integrated and how waves turn from resolved to unresolved. */
#ifndef MANGATA_CLI_COMMON_PODEE_OPTIONS_H
#define MANGATA_CLI_COMMON_PODEE_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "mangata/mangata.h"

/* Words of the command line as they stand; NULL where an option is not given. */
typedef struct podee_options {
    const char *kernels, *integral, *elongation, *segments, *transition, *width;
} podee_options;

/* The member for the option of this name (without dashes); NULL: there is none. */
const char **podee_option(podee_options *options, const char *name, size_t length);

/* Puts them into `quality`, whose method is known. False with what is wrong and what is allowed. */
bool podee_options_apply(const podee_options *given, mgt_quality *quality, char *wrong, size_t size);

/* What of these changes pixels: "kernels 9 elongation 9 segments 1 …", empty where all is as it is by default. */
typedef struct podee_text {
    char text[160];
} podee_text;
podee_text podee_options_text(const mgt_quality *quality);

#endif
