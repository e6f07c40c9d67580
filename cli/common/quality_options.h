/* SPDX-License-Identifier: MIT */
/* Options of quality on the command line: the rows of params/options.h, and the two flags that are no plain values. */
#ifndef MANGATA_TOOLS_QUALITY_OPTIONS_H
#define MANGATA_TOOLS_QUALITY_OPTIONS_H

#include "params/options.h"

typedef struct quality_options {
    quality_choice choice;
    int integral;        /* --integral, an old way to choose kernels: 0 not given, 1 exact, 2 kernels */
    bool range_given;    /* --samples-range */
    uint64_t part[2];    /* of --samples-range I/N; N 0: it is FIRST,COUNT */
    bool number_in_name; /* --method ssaaN, whose N --spatial must not contradict */
} quality_options;

quality_options quality_options_none(void);

/* Reads one option by its name without dashes. False with what is wrong and what is allowed; *known: whether there is such an option. */
bool quality_option_set(quality_options *options, const char *name, size_t length, const char *value, bool *known, char *wrong, size_t size);

/* Replaces the alias of an option, and that of a value, by the name that is written. What has none stays. */
void quality_option_first_names(const char **name, size_t *length, const char **value);

/* `base`, the scene's quality, as the command line changes it. False with what is wrong and what is allowed. */
bool quality_options_apply(const quality_options *options, const mgt_quality *base, mgt_quality *out, char *wrong, size_t size);

/* Reads a count of at least 1 of the option `name`, for verbs that take it for their reference. False with what is wrong and what is allowed. */
bool quality_count_read(const char *name, const char *value, uint32_t *count, char *wrong, size_t size);

#endif
