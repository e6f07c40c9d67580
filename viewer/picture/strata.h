/* SPDX-License-Identifier: MIT
 * In which order the samples of a pixel are taken where they are shown as they come. */
#ifndef MANGATA_VIEWER_PICTURE_STRATA_H
#define MANGATA_VIEWER_PICTURE_STRATA_H

#include <stdint.h>

/* The stratum of sample `index` of `total`: each once, and pixel and shutter are filled evenly from the first on. */
uint64_t stratum_at(uint64_t index, uint64_t total);

#endif
