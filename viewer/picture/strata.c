/* SPDX-License-Identifier: MIT
 * The order of a picture's samples. */
#include "viewer/picture/strata.h"

static uint64_t common_divisor(uint64_t a, uint64_t b)
{
    while (b) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* The step is about the golden section of `total`, so that the first samples of any number are spread evenly. It has no divisor in common with `total`, so that
 * every stratum comes once. */
uint64_t stratum_at(uint64_t index, uint64_t total)
{
    uint64_t step = (uint64_t)((double)total * 0.6180339887498949) | 1;
    while (common_divisor(step, total) != 1)
        step += 2;
    return (uint64_t)((unsigned __int128)index * step % total);
}
