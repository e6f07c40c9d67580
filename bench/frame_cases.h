/* SPDX-License-Identifier: MIT
 * The kernels of src/cpu/lanes.c rebuilt so that a frame's calls of the disk-path integral are kept, and stages can be timed. */
#ifndef MANGATA_BENCH_FRAME_CASES_H
#define MANGATA_BENCH_FRAME_CASES_H

#include "cpu/lanes.h"

enum { DISK_PATH_INPUTS = 8 }; /* p0, p1, covariance xx, xy, yy, radius */

/* Vectors of arguments, DISK_PATH_INPUTS × lanes floats each. */
typedef struct disk_path_cases {
    float *values; /* those in which any lane was in reach, up to `capacity` */
    size_t count, capacity;
    size_t calls;       /* all */
    size_t in_reach;    /* calls in which any lane was in reach */
    size_t evaluations; /* of the integrand, whole vectors */
} disk_path_cases;

/* How far a pixel is taken. */
typedef enum frame_stage {
    STAGE_SURFACE,  /* the hit, sums over waves, the mirror map */
    STAGE_COVERAGE, /* and the disk-path integral with its weight */
} frame_stage;

typedef struct frame_cases_kernels {
    const lane_kernels *kernels;
    /* Later calls of the kernels fill `cases`; NULL: no more. One thread at a time. */
    void (*keep)(disk_path_cases *cases);
    /* The integral over kept cases; returns something that depends on all of its values. */
    float (*replay)(const disk_path_cases *cases, size_t first, size_t count);
    /* Method mangata over the tile's pixels as far as `stage`; `out` gets what the stage found. */
    void (*run_stage)(frame_stage stage, const FrameData *frame, const float *sky, const tile_waves *tile, const tile_estimate *estimate, tile_pixels *out);
} frame_cases_kernels;

extern const frame_cases_kernels frame_cases_1;
#if defined(__x86_64__)
extern const frame_cases_kernels frame_cases_8;
extern const frame_cases_kernels frame_cases_16;
#endif

#endif
