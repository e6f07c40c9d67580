/* SPDX-License-Identifier: MIT */
/* A method with its options in one word, as lists of methods need it: NAME, or NAME:OPTION=VALUE:OPTION=VALUE. The options are those of
 * `mangata render`, such as "podee-pixel:ndf-mean=drop" or "ssaa4:time-samples=8". NAME+REFRACTION sees through the water by another method than the
 * default, such as "mangata+hybrid" or "none+broad:tess-error=1". */
#ifndef MANGATA_CLI_COMMON_METHOD_SPEC_H
#define MANGATA_CLI_COMMON_METHOD_SPEC_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/common/quality_options.h"

enum { METHOD_SPEC_TEXT = 96 };

typedef struct method_spec {
    char name[METHOD_SPEC_TEXT];        /* as it was given, but by the older name of what has two */
    char file[METHOD_SPEC_TEXT];        /* the same as a part of a file's name: [a-z0-9.-]+ */
    char options[2 * METHOD_SPEC_TEXT]; /* the same as words of `mangata render`: "--method podee-pixel --ndf-mean drop" */
    quality_options given;
    mgt_quality quality; /* with defaults for what is not given; a scene may say otherwise */
} method_spec;

/* Reads `length` characters of `text`. On failure returns false with one line in `wrong`: what is wrong, what is allowed. */
bool method_spec_parse(method_spec *spec, const char *text, size_t length, char *wrong, size_t wrong_size);

#endif
