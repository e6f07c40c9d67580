/* SPDX-License-Identifier: MIT
 * Exact sums of the point samples of a tile (base/exact_sum.h): a few samples in two doubles a value, then words. */
#ifndef MANGATA_CPU_SAMPLE_SUMS_H
#define MANGATA_CPU_SAMPLE_SUMS_H

#include "base/exact_sum.h"
#include "cpu/lanes.h"
#include "frame/targets.h"

/* Sums of a crop's samples. At most one is not NULL. */
typedef struct picture_sums {
    uint64_t *add;        /* samples are added to these; no target is written */
    const uint64_t *show; /* targets show their means; no sample is taken */
    region crop;
} picture_sums;

enum { SAMPLE_SUM_WORDS = 2 * EXACT_COUNT };

/* Terms are multiples of 2⁻⁸ in one double and what is left, a multiple of 2⁻⁵⁶, in another one. Both are exact for SAMPLE_TERMS_MOST terms of at most
 * SAMPLE_TERM_MOST. */
#define SAMPLE_TERM_MOST 0x1p42
enum { SAMPLE_TERMS_MOST = 8 };

/* Sums of one plane of a tile. */
typedef struct sample_terms {
    double high[TILE_PIXELS], low[TILE_PIXELS];
} sample_terms;

/* Planes by their number among the sums. */
typedef struct sample_sums {
    sample_terms planes[EXACT_COUNT];
    uint32_t terms;                                 /* in `planes` */
    uint64_t words[TILE_PIXELS * SAMPLE_SUM_WORDS]; /* pixel by pixel, see MGT_SUM_WORDS */
} sample_sums;

void sample_sums_clear(sample_sums *sums);

/* Adds one sample a pixel. Planes of black are zero, and are left out: colour unless `color`, foam unless `foam`. */
void sample_sums_add(sample_sums *sums, const lane_kernels *kernels, const tile_pixels *pixels, bool color, bool foam);

/* Moves all terms into the words. */
void sample_sums_settle(sample_sums *sums);

/* Reads or adds the words of that part of the tile (tile_x, tile_y) that lies in the crop, if the picture has sums. */
void sample_sums_exchange(sample_sums *sums, const picture_sums *picture, uint32_t tile_x, uint32_t tile_y);

/* The means over `count` samples, which is above 0. */
void sample_sums_mean(const sample_sums *sums, uint64_t count, tile_pixels *out);

#endif
