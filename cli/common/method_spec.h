/* SPDX-License-Identifier: MIT */
/* A method with its options in one word, for lists of methods: NAME or NAME:OPTION=VALUE:OPTION=VALUE. The options are those of `mangata render`, such as
 * "podee-pixel:ndf-mean=drop" or "ssaa4:time-samples=8". NAME+REFRACTION chooses the method of refraction, such as "mangata+hybrid" or
 * "none+broad:tess-error=1". */
#ifndef MANGATA_CLI_COMMON_METHOD_SPEC_H
#define MANGATA_CLI_COMMON_METHOD_SPEC_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/common/quality_options.h"

enum { METHOD_SPEC_TEXT = 201 };

typedef struct method_spec {
    char name[METHOD_SPEC_TEXT];        /* as given, but with each option's and value's first name instead of an alias */
    char file[METHOD_SPEC_TEXT];        /* the same for use in a file's name: [a-z0-9.-]+ */
    char options[2 * METHOD_SPEC_TEXT]; /* the same as words of `mangata render`: "--method podee-pixel --ndf-mean drop" */
    quality_options given;              /* the options to apply to a scene's quality */
    mgt_quality quality;                /* `given`, and defaults for everything else */
} method_spec;

/* Reads `length` characters of `text`. False: `wrong` says in one line what is wrong and what is allowed. */
bool method_spec_parse(method_spec *spec, const char *text, size_t length, char *wrong, size_t wrong_size);

#endif
