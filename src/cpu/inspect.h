/* SPDX-License-Identifier: MIT
 * What method `mangata` knows of one pixel. */
#ifndef MANGATA_CPU_INSPECT_H
#define MANGATA_CPU_INSPECT_H

#include "cpu/tile_job.h"

/* Fills all of `info` but its size, for the pixel (x, y) of the image. The frame must be one of method `mangata`. */
void inspect_pixel(const frame *f, const frame_waves *waves, const float *sky, uint32_t x, uint32_t y, tile_scratch *scratch, mgt_pixel_info *info);

#endif
