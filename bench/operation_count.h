/* SPDX-License-Identifier: MIT
 * Operations on pixels' values, counted by the instrumented build of the kernels. */
#ifndef MANGATA_BENCH_OPERATION_COUNT_H
#define MANGATA_BENCH_OPERATION_COUNT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct operation_count {
    uint64_t add, multiply, fused, divide, square_root;
    uint64_t other;      /* comparisons, selections, minima, signs, roundings, bits */
    uint64_t integrands; /* evaluations in the disk-path integral */
} operation_count;

/* Of the one thread that counts. */
extern operation_count operations_done;

#ifdef __cplusplus
}
#endif

#endif
