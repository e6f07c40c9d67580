/* SPDX-License-Identifier: MIT
 * Sums whose bits depend on the terms alone, not on their order nor on how they are cut into parts: each term is cut to a multiple of
 * 2⁻⁵⁶, and multiples are added as integers of 128 bits. */
#ifndef MANGATA_BASE_EXACT_SUM_H
#define MANGATA_BASE_EXACT_SUM_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* In two's complement. Unsigned, so that sums of a damaged file run over without harm. */
__extension__ typedef unsigned __int128 exact_sum;
__extension__ typedef __int128 exact_signed;

enum { EXACT_SUM_BITS = 56 };

/* No term is above this over the number of terms, so that sums fit. */
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

/* `x`, at most `most` away from 0, cut to a multiple; `most` is 128 or more. What is not a number counts as 0. */
static inline exact_sum exact_term(double x, double most)
{
    /* Nearly all terms, and the fast way to the same bits. */
    if (x >= 0 && x < 128)
        return (uint64_t)(int64_t)(x * 0x1p56);
    return exact_term_any(x, most);
}

/* `count` as a sum of ones. */
static inline exact_sum exact_count(uint64_t count) { return (exact_sum)count << EXACT_SUM_BITS; }

/* The sum over `count`, which is above 0. */
static inline double exact_mean(exact_sum sum, double count) { return (double)(exact_signed)sum * 0x1p-56 / count; }

/* What a method sums up for a pixel, each sum as two words, the low one first: six sums fill MGT_SUM_WORDS of the public interface. */
enum { EXACT_RED = 0, EXACT_GREEN, EXACT_BLUE, EXACT_COVERAGE, EXACT_WATER, EXACT_FOAM, EXACT_COUNT };

static inline exact_sum exact_load(const uint64_t *words) { return (exact_sum)words[1] << 64 | words[0]; }

/* Whether `samples` samples can have these sums of a pixel: none is below 0, and coverage, water and foam are at most one a sample (but for rounding). */
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
