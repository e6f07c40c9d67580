/* SPDX-License-Identifier: MIT
 * Counter-based random numbers: a number depends on its key alone, not on the order of the calls. */
#ifndef MANGATA_BASE_HASH_H
#define MANGATA_BASE_HASH_H

#include <stdint.h>

#define WORD64 uint64_t
#define HASH static inline
#define HASH_FLOAT(u) ((float)(u))

#define word_of(high, low) ((uint64_t)(uint32_t)(high) << 32 | (uint32_t)(low))
#define word_sum(a, b) ((a) + (b))
#define word_product(a, b) ((a) * (b))
#define word_xor(a, b) ((a) ^ (b))
#define word_shift(a, places) ((a) >> (places))
#define word_high(a) ((uint32_t)((a) >> 32))
#define word_low(a) ((uint32_t)(a))

#define uint uint32_t
#include "base/hash_rounds.h"
#undef uint

/* The next output of SplitMix64. */
static inline uint64_t hash_next(uint64_t *state)
{
    const uint64_t output = hash_of(*state);
    *state += word_of(HASH_STEP_HIGH, HASH_STEP_LOW);
    return output;
}

/* Uniform in [0, 1), from 53 bits. */
static inline double hash_fraction(uint64_t hash) { return (double)(hash >> 11) * 0x1p-53; }

#endif
