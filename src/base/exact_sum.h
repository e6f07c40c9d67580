/* SPDX-License-Identifier: MIT
 * Sums whose bits depend neither on the order of the terms nor on how the sum is divided into parts. Each term is truncated to a multiple of 2⁻⁵⁶, and
 * multiples are added as integers of 128 bits. */
#ifndef MANGATA_BASE_EXACT_SUM_H
#define MANGATA_BASE_EXACT_SUM_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* A sum in two's complement. The type is unsigned, so that sums of a damaged file may overflow. */
__extension__ typedef unsigned __int128 exact_sum;
__extension__ typedef __int128 exact_signed;

enum { EXACT_SUM_BITS = 56 };

/* A term may be at most this divided by the number of terms, so that no sum overflows. */
#define EXACT_SUM_MOST 0x1p70

static inline exact_sum exact_term_any(double x, double most)
{
    const double size = x < 0 ? -x : x, term = size > most ? most : size;
    uint64_t bits;
    memcpy(&bits, &term, sizeof bits);
    const int shift = (int)(bits >> 52) - 1075 + EXACT_SUM_BITS;
    const uint64_t digits = (bits & 0xfffffffffffffu) | 0x10000000000000u;
    if (!(size >= 0) || shift <= -53)
        return 0;
    const exact_sum sum = shift >= 0 ? (exact_sum)digits << shift : digits >> -shift;
    return x < 0 ? -sum : sum;
}

/* The term of `x`, which is clamped to ±most and truncated. `most` is 128 or more. NaN counts as 0. */
static inline exact_sum exact_term(double x, double most)
{
    /* Nearly all terms are in this range, in which a conversion is faster and gives the same bits. */
    if (x >= 0 && x < 128)
        return (uint64_t)(int64_t)(x * 0x1p56);
    return exact_term_any(x, most);
}

/* The sum of `count` ones. */
static inline exact_sum exact_count(uint64_t count) { return (exact_sum)count << EXACT_SUM_BITS; }

/* The sum divided by `count` > 0. */
static inline double exact_mean(exact_sum sum, double count) { return (double)(exact_signed)sum * 0x1p-56 / count; }

/* The sums of a pixel. Each has two words, the low one first, so the six sums fill MGT_SUM_WORDS. */
enum { EXACT_RED = 0, EXACT_GREEN, EXACT_BLUE, EXACT_COVERAGE, EXACT_WATER, EXACT_FOAM, EXACT_COUNT };

static inline exact_sum exact_load(const uint64_t *words) { return (exact_sum)words[1] << 64 | words[0]; }

/* Whether `samples` samples can have these sums of a pixel: no sum is below 0, and apart from rounding coverage, water and foam are at most `samples`. */
static inline bool exact_sums_fit(const uint64_t *words, uint64_t samples)
{
    const exact_sum most = exact_count(samples) + (exact_count(samples) >> 10);
    for (int i = 0; i < EXACT_COUNT; i++)
        if ((exact_signed)exact_load(words + 2 * i) < 0 || (i >= EXACT_COVERAGE && exact_load(words + 2 * i) > most))
            return false;
    return true;
}

static inline void exact_add(uint64_t *words, exact_sum term)
{
    const exact_sum sum = exact_load(words) + term;
    words[0] = (uint64_t)sum;
    words[1] = (uint64_t)(sum >> 64);
}

#endif
