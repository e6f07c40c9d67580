/* SPDX-License-Identifier: MIT
 * Seeded random numbers: splitmix64. */
#ifndef MANGATA_TESTS_RANDOM_NUMBERS_H
#define MANGATA_TESTS_RANDOM_NUMBERS_H

#include <stdint.h>

typedef struct random_state {
    uint64_t state;
} random_state;

/* From 0 to below 1. */
static inline double random_unit(random_state *r)
{
    uint64_t x = r->state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

static inline double random_range(random_state *r, double low, double high) { return low + (high - low) * random_unit(r); }

#endif
