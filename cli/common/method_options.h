/* SPDX-License-Identifier: MIT */
/* The options of single methods and of refraction, checked together once all are known. */
#ifndef MANGATA_CLI_COMMON_METHOD_OPTIONS_H
#define MANGATA_CLI_COMMON_METHOD_OPTIONS_H

#include "cli/common/adaptive_options.h"
#include "cli/common/podee_options.h"
#include "cli/common/refraction_options.h"

typedef struct method_options {
    podee_options podee;
    adaptive_options adaptive;
    refraction_options refraction;
} method_options;

/* The word for the option of this name (without dashes); NULL: there is none. */
const char **method_option(method_options *options, const char *name, size_t length);

/* Puts them into `quality`, whose method is known. False with what is wrong and what is allowed. */
bool method_options_apply(const method_options *given, mgt_quality *quality, char *wrong, size_t size);

#endif
