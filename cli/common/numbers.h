/* SPDX-License-Identifier: MIT */
/* Numbers of the command line. They are read strictly: the whole text must be a number that fits. A failure changes no output. */
#ifndef MANGATA_CLI_COMMON_NUMBERS_H
#define MANGATA_CLI_COMMON_NUMBERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Reads a number of decimal digits alone, at most `limit`. */
bool number_parse_u64(const char *text, uint64_t limit, uint64_t *number);

/* Reads exactly `count` such numbers, at most 4, with `separator` between them. */
bool number_parse_list(const char *text, char separator, uint64_t limit, size_t count, uint64_t *numbers);

/* Reads a finite decimal number. "inf", "nan" and hexadecimal numbers are not allowed. */
bool number_parse_double(const char *text, double *number);

/* A short text of at least 6 significant digits that reads back as the same number. */
typedef struct number_text {
    char text[32];
} number_text;
number_text number_print(double number);

/* A measured value, rounded at the first digit of its noise, but with at least 2 and at most 4 significant digits. `noise` NaN or 0: 4 digits. A value that is
 * not finite gives "-". */
number_text number_print_measured(double value, double noise);

/* Median, least and greatest of measured values. number_spread_of() sorts them. Without values all three are NaN. */
typedef struct number_spread {
    double median, least, most;
} number_spread;
number_spread number_spread_of(double *values, size_t count);

#endif
