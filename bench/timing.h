/* SPDX-License-Identifier: MIT
 * Time measured and summed up, for the programs of this folder. */
#ifndef MANGATA_BENCH_TIMING_H
#define MANGATA_BENCH_TIMING_H

#include <stdbool.h>
#include <stddef.h>

double seconds_now(void);

/* Of runs of the same work. */
typedef struct timing {
    double median, least, most;
} timing;

/* Sorts the samples; count > 0. */
timing timing_of(double *samples, size_t count);

/* "ok" or "MISSED", for a table's column of limits. */
const char *verdict(bool ok);

#endif
