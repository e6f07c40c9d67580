/* SPDX-License-Identifier: MIT
 * Floating-point operations of a `mangata` frame, counted by the instrumented kernels at one lane. */
#ifndef MANGATA_BENCH_OPERATION_FRAME_H
#define MANGATA_BENCH_OPERATION_FRAME_H

#include <stdbool.h>

#include "mangata/mangata.h"
#include "operation_count.h"

typedef struct stage_count {
    operation_count lattice, all;
    double water; /* pixels */
} stage_count;

/* A fused multiply-add counts as two. */
double flops(const operation_count *n);

/* Counts a frame tile by tile: the lattice of first hits on its own, then the tiles as they are rendered. */
bool count_frame(const mgt_scene *scene, stage_count *out);

#endif
