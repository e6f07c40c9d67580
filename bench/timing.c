/* SPDX-License-Identifier: MIT
 * Time measured and summed up, for the programs of this folder. */
#define _POSIX_C_SOURCE 200809L
#include "timing.h"

#include <stdlib.h>
#include <time.h>

double seconds_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

timing timing_of(double *samples, size_t count)
{
    qsort(samples, count, sizeof *samples, ascending);
    return (timing){0.5 * (samples[(count - 1) / 2] + samples[count / 2]), samples[0], samples[count - 1]};
}

const char *verdict(bool ok) { return ok ? "ok" : "MISSED"; }
