/* SPDX-License-Identifier: MIT */
/* Memory that this process uses, as Linux counts it. */
#ifndef MANGATA_CLI_COMMON_MEMORY_USE_H
#define MANGATA_CLI_COMMON_MEMORY_USE_H

/* Begins a measurement: returns free memory to the system. Returns the bytes that are in use; NaN: the system does not report them. */
double memory_use_begin(void);

/* The largest number of bytes in use since then; NaN: the system does not report it. */
double memory_use_peak(void);

#endif
