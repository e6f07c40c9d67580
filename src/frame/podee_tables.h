/* SPDX-License-Identifier: MIT
 * The tables of Podee et al. 2021, §3.5 and §4: a circular Gaussian convolved with the light disk, and its integral along straight lines. */
#ifndef MANGATA_FRAME_PODEE_TABLES_H
#define MANGATA_FRAME_PODEE_TABLES_H

#include "kernels/common/constants.h"

#include <stdbool.h>
#include <stddef.h>

/* Lengths are in units of the disk's radius, so that one pair of tables serves every light.
 *
 * Slice s is for the standard deviation .02 · 400^(s/63), from .02 to 8. It reaches 1 + 4 deviations from the disk's centre.
 *   share  F(r): the part of a Gaussian at distance r from the disk's centre that lies in the disk. Column c is for r = reach · c/511.
 *   sweep  S(u, v) = ∫ F(√(u'² + v²)) du' from 0 to u, which is Eq. 18 less its value at u = 0. Column c is for v = reach · c/511, row r for
 *          u = reach · r/511. S is odd in u, so the table holds u ≥ 0 alone.
 * The mean of F over a path from u0 to u1 at distance v from the centre is (S(u1, v) − S(u0, v))/(u1 − u0), which is Eq. 19 as corrected. */
typedef struct podee_tables {
    float *sweep; /* [slice][u][v], 64 MiB */
    float *share; /* [slice][r], 128 KiB */
} podee_tables;

/* Standard deviation of a slice. */
double podee_slice_deviation(int slice);

/* Greatest distance from the disk's centre in a slice. */
double podee_slice_reach(int slice);

/* Calls body(argument, index) for every index below count, on any threads. */
typedef void podee_loop(void *user, size_t count, void (*body)(void *, size_t), void *argument);

/* Builds both tables; each call of loop's body builds a slice. Returns false when out of memory; *tables is then empty. */
bool podee_tables_build(podee_tables *tables, podee_loop *loop, void *user);

/* Frees the tables. Empty (zeroed) tables are allowed. */
void podee_tables_free(podee_tables *tables);

#endif
