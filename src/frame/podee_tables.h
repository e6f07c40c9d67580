/* SPDX-License-Identifier: MIT
 * The tables of Podee et al. 2021, §3.5 and §4: a circular Gaussian convolved with the light disk, and its integral along straight lines. */
#ifndef MANGATA_FRAME_PODEE_TABLES_H
#define MANGATA_FRAME_PODEE_TABLES_H

#include "kernels/common/constants.h"

#include <stdbool.h>
#include <stddef.h>

/* Lengths are in units of the disk's radius, so that one pair of tables serves every light. */
/* Slice s is for the standard deviation .02 · 400^(s/63), .02 to 8, and reaches 1 + 4 deviations from the disk's centre.
 *   share  F(r): the part of a Gaussian at distance r that lies in the disk; column c is r = reach · c/511.
 *   sweep  S(u, v) = ∫ F(√(u'² + v²)) du' from 0 to u (Eq. 18 less its value at u = 0, in which it is odd); column v, row u ≥ 0, as above.
 * A path from u0 to u1 at distance v from the centre has the mean (S(u1, v) − S(u0, v))/(u1 − u0) (Eq. 19 as corrected). */
typedef struct podee_tables {
    float *sweep; /* [slice][u][v], 64 MiB */
    float *share; /* [slice][r], 128 KiB */
} podee_tables;

double podee_slice_deviation(int slice);
double podee_slice_reach(int slice);

/* Calls body(argument, index) for every index below count, on any threads. */
typedef void podee_loop(void *user, size_t count, void (*body)(void *, size_t), void *argument);

/* Builds both, a slice at a time over the threads of `loop`. False where memory is short; *tables is then empty. */
bool podee_tables_build(podee_tables *tables, podee_loop *loop, void *user);
/* An empty (zeroed) one may be freed. */
void podee_tables_free(podee_tables *tables);

#endif
