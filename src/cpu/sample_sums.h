/* SPDX-License-Identifier: MIT
 * Exact sums of the point samples of a tile, see base/exact_sum.h. A few samples are summed in two doubles per value, and these are then added to words. */
#ifndef MANGATA_CPU_SAMPLE_SUMS_H
#define MANGATA_CPU_SAMPLE_SUMS_H

#include "base/exact_sum.h"
#include "cpu/lanes.h"
#include "frame/targets.h"

/* Sums of a crop's samples. At most one is not NULL. */
typedef struct picture_sums {
    uint64_t *add;        /* samples are added to these sums, and no target is written */
    const uint64_t *show; /* targets show the means of these sums, and no sample is taken */
    region crop;
} picture_sums;

enum { SAMPLE_SUM_WORDS = 2 * EXACT_COUNT };

/* A term is a multiple of 2⁻⁸ in one double plus its rest, a multiple of 2⁻⁵⁶, in another one. The sums of both are exact for SAMPLE_TERMS_MOST terms of at
 * most SAMPLE_TERM_MOST. */
#define SAMPLE_TERM_MOST 0x1p42
enum { SAMPLE_TERMS_MOST = 8 };

/* Sums of one plane of a tile. */
typedef struct sample_terms {
    double high[TILE_PIXELS], low[TILE_PIXELS];
} sample_terms;

typedef struct sample_sums {
    sample_terms planes[EXACT_COUNT];               /* indices are EXACT_… */
    uint32_t terms;                                 /* number of samples in `planes` */
    uint64_t words[TILE_PIXELS * SAMPLE_SUM_WORDS]; /* pixel by pixel, see MGT_SUM_WORDS */
} sample_sums;

void sample_sums_clear(sample_sums *sums);

/* Adds one sample per pixel. Planes that are 0 are left out: colour if `color` is false, foam if `foam` is false. */
void sample_sums_add(sample_sums *sums, const lane_kernels *kernels, const tile_pixels *pixels, bool color, bool foam);

/* Moves all terms into the words. */
void sample_sums_settle(sample_sums *sums);

/* Copies the words from picture->show or adds them to picture->add, for the pixels of the tile (tile_x, tile_y) in the crop. Without either nothing happens. */
void sample_sums_exchange(sample_sums *sums, const picture_sums *picture, uint32_t tile_x, uint32_t tile_y);

/* Fills the means over `count` > 0 samples. */
void sample_sums_mean(const sample_sums *sums, uint64_t count, tile_pixels *out);

#endif
