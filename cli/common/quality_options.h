/* SPDX-License-Identifier: MIT */
/* Options of quality on the command line: the rows of params/options.h, and two that are not rows of it, --integral and --samples-range. */
#ifndef MANGATA_CLI_COMMON_QUALITY_OPTIONS_H
#define MANGATA_CLI_COMMON_QUALITY_OPTIONS_H

#include "params/options.h"

typedef struct quality_options {
    quality_choice choice;
    int integral;        /* --integral, an alternative to --kernels: 0: not given, 1: exact, 2: kernels */
    bool range_given;    /* --samples-range is given */
    uint64_t part[2];    /* I and N of --samples-range I/N; N 0: the option has the form FIRST,COUNT */
    bool number_in_name; /* --method is ssaaN, with which --spatial is not allowed */
} quality_options;

/* No options. */
quality_options quality_options_none(void);

/* Reads an option by its name without dashes. False: the value is wrong, and `wrong` says what is allowed, or *known is false and there is no such option. */
bool quality_option_set(quality_options *options, const char *name, size_t length, const char *value, bool *known, char *wrong, size_t size);

/* Replaces the alias of an option or of a value by its first name. Other names stay. */
void quality_option_first_names(const char **name, size_t *length, const char **value);

/* Changes `base`, the scene's quality, by the options. False: they do not fit, and `wrong` says why. */
bool quality_options_apply(const quality_options *options, const mgt_quality *base, mgt_quality *out, char *wrong, size_t size);

/* Reads a count of at least 1 in the range of the option `name`, for verbs that use it for their reference. False: `wrong` says what is allowed. */
bool quality_count_read(const char *name, const char *value, uint32_t *count, char *wrong, size_t size);

#endif
