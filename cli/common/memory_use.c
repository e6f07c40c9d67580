/* SPDX-License-Identifier: MIT */
/* Memory that this process uses: the resident set and its peak in /proc. */
#include "cli/common/memory_use.h"

#include <math.h>
#include <stdio.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

static double status_bytes(const char *format)
{
    FILE *file = fopen("/proc/self/status", "r");
    char line[256];
    double kibibytes = NAN;
    while (file && fgets(line, sizeof line, file) && sscanf(line, format, &kibibytes) != 1)
        continue;
    if (file)
        fclose(file);
    return 1024 * kibibytes;
}

double memory_use_begin(void)
{
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
    FILE *file = fopen("/proc/self/clear_refs", "w");
    const int written = file ? fputs("5", file) : EOF; /* sets the peak back to the present value */
    if (!file || fclose(file) != 0 || written == EOF)
        return NAN;
    return status_bytes("VmRSS: %lf");
}

double memory_use_peak(void) { return status_bytes("VmHWM: %lf"); }
