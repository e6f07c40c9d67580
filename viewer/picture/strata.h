/* SPDX-License-Identifier: MIT
 * The order of a pixel's samples for pictures that are shown while they are refined. */
#ifndef MANGATA_VIEWER_PICTURE_STRATA_H
#define MANGATA_VIEWER_PICTURE_STRATA_H

#include <stdint.h>

/* The stratum of sample `index` of `total`. Each stratum occurs once. The first samples, however many, fill pixel and shutter evenly. */
uint64_t stratum_at(uint64_t index, uint64_t total);

#endif
