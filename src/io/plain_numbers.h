/* SPDX-License-Identifier: MIT */
/* Numbers of files have a decimal point, whatever locale the host has chosen. Private to src/io. */
#ifndef MANGATA_IO_PLAIN_NUMBERS_H
#define MANGATA_IO_PLAIN_NUMBERS_H

#include <locale.h>

typedef struct plain_numbers {
    locale_t plain, host;
} plain_numbers;

/* From here to plain_numbers_end() the calling thread reads and writes numbers as in the locale "C". */
static inline plain_numbers plain_numbers_begin(void)
{
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return (plain_numbers){.plain = plain, .host = uselocale(plain)};
}

static inline void plain_numbers_end(plain_numbers numbers)
{
    uselocale(numbers.host);
    if (numbers.plain != (locale_t)0)
        freelocale(numbers.plain);
}

#endif
