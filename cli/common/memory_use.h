/* SPDX-License-Identifier: MIT */
/* Memory that this process has in use, as Linux counts it. */
#ifndef MANGATA_CLI_COMMON_MEMORY_USE_H
#define MANGATA_CLI_COMMON_MEMORY_USE_H

/* Begins to measure: gives back to the system what is free. Returns the bytes in use; NaN where the system does not report them. */
double memory_use_begin(void);

/* The most bytes that have been in use since then; NaN where the system does not report them. */
double memory_use_peak(void);

#endif
