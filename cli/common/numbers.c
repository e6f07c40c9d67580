/* SPDX-License-Identifier: MIT */
/* Strict reading and exact printing of numbers. */
#include "cli/common/numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads digits from *text and moves *text behind them. */
static bool read_digits(const char **text, uint64_t limit, uint64_t *number)
{
    const char *p = *text;
    uint64_t value = 0;
    if (*p < '0' || *p > '9')
        return false;
    for (; *p >= '0' && *p <= '9'; p++) {
        const uint64_t digit = (uint64_t)(*p - '0');
        if (value > (UINT64_MAX - digit) / 10)
            return false;
        value = value * 10 + digit;
    }
    if (value > limit)
        return false;
    *number = value;
    *text = p;
    return true;
}

bool number_parse_u64(const char *text, uint64_t limit, uint64_t *number)
{
    uint64_t value;
    if (!read_digits(&text, limit, &value) || *text)
        return false;
    *number = value;
    return true;
}

bool number_parse_list(const char *text, char separator, uint64_t limit, size_t count, uint64_t *numbers)
{
    uint64_t values[4];
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && *text++ != separator)
            return false;
        if (!read_digits(&text, limit, &values[i]))
            return false;
    }
    if (*text)
        return false;
    memcpy(numbers, values, count * sizeof *numbers);
    return true;
}

bool number_parse_double(const char *text, double *number)
{
    if (!*text || text[strspn(text, "+-.0123456789eE")])
        return false;
    char *end;
    const double value = strtod(text, &end);
    if (*end || !isfinite(value))
        return false;
    *number = value;
    return true;
}

number_text number_print(double number)
{
    number_text out;
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(out.text, sizeof out.text, "%.*g", digits, number);
        if (strtod(out.text, NULL) == number)
            break;
    }
    return out;
}

/* Decimal place of the first digit: 0 for 1 to 9.99, −1 for 0.1 to 0.999. */
static int first_place(double magnitude) { return (int)floor(log10(magnitude)); }

number_text number_print_measured(double value, double noise)
{
    const double magnitude = fabs(value);
    number_text out;
    int digits = 4;
    if (!isfinite(value)) {
        snprintf(out.text, sizeof out.text, "-");
        return out;
    }
    if (magnitude >= 1e12) {
        snprintf(out.text, sizeof out.text, "%.3e", value);
        return out;
    }
    const int place = magnitude > 0 ? first_place(magnitude) : isfinite(noise) && noise > 0 ? first_place(noise) : 0;
    if (isfinite(noise) && noise > 0)
        digits = place - first_place(noise) + 1;
    digits = digits < 2 ? 2 : digits > 4 ? 4 : digits;
    const int behind = digits - 1 - place;
    snprintf(out.text, sizeof out.text, "%.*f", behind < 0 ? 0 : behind > 12 ? 12 : behind, value);
    return out;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

number_spread number_spread_of(double *values, size_t count)
{
    if (count == 0)
        return (number_spread){NAN, NAN, NAN};
    qsort(values, count, sizeof *values, ascending);
    return (number_spread){0.5 * (values[(count - 1) / 2] + values[count / 2]), values[0], values[count - 1]};
}
