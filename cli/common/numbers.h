/* SPDX-License-Identifier: MIT */
/* Strict numbers from the command line: the whole text or nothing, never wrapped around. */
#ifndef MANGATA_CLI_COMMON_NUMBERS_H
#define MANGATA_CLI_COMMON_NUMBERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Decimal digits only, at most `limit`. */
bool number_parse_u64(const char *text, uint64_t limit, uint64_t *number);

/* Exactly `count` such numbers (at most 4), separated by `separator`. */
bool number_parse_list(const char *text, char separator, uint64_t limit, size_t count, uint64_t *numbers);

/* A finite decimal number. */
bool number_parse_double(const char *text, double *number);

/* The shortest text that reads back as the same number. */
typedef struct number_text {
    char text[32];
} number_text;
number_text number_print(double number);

/* A measured value to the digits that its noise leaves: to the place of the first digit of `noise`, but never fewer than 2 significant digits nor
 * more than 4. `noise` NaN or 0: 4. "-" for a value that is not finite. */
number_text number_print_measured(double value, double noise);

/* Of measured values, which are sorted by it; NaN where there are none. */
typedef struct number_spread {
    double median, least, most;
} number_spread;
number_spread number_spread_of(double *values, size_t count);

#endif
