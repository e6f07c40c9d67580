/* SPDX-License-Identifier: MIT
 * Random numbers that belong to a counter: whoever asks, in whatever order, gets the same. */
#ifndef MANGATA_BASE_HASH_H
#define MANGATA_BASE_HASH_H

#include <stdint.h>

#include "base/hash_numbers.h"

#define HASH_WORD(name) ((uint64_t)name##_HIGH << 32 | name##_LOW)

/* The finaliser of SplitMix64 with its two rounds. */
static inline uint64_t hash_of(uint64_t x)
{
    x += HASH_WORD(HASH_STEP);
    x = (x ^ (x >> 30)) * HASH_WORD(HASH_FIRST);
    x = (x ^ (x >> 27)) * HASH_WORD(HASH_SECOND);
    return x ^ (x >> 31);
}

/* Uniform in [0, 1). */
static inline float hash_unit(uint64_t hash) { return (float)(hash >> 40) * 0x1p-24f; }

#endif
