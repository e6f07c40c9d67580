/* SPDX-License-Identifier: MIT
 * Random numbers that belong to a counter: whoever asks, in whatever order, gets the same. */
#ifndef MANGATA_BASE_HASH_H
#define MANGATA_BASE_HASH_H

#include <stdint.h>

/* The finaliser of SplitMix64 with its two rounds. */
static inline uint64_t hash_of(uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/* Uniform in [0, 1). */
static inline float hash_unit(uint64_t hash) { return (float)(hash >> 40) * 0x1p-24f; }

#endif
