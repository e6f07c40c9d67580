/* SPDX-License-Identifier: MIT
 * mgt_inspect_pixel(): what method mangata computes for one pixel. */
#ifndef MANGATA_CPU_INSPECT_H
#define MANGATA_CPU_INSPECT_H

#include "cpu/tile_job.h"

/* Fills all members of `info` but struct_size for the pixel (x, y) of the image. The frame's method must be mangata. */
void inspect_pixel(const frame *f, const frame_waves *waves, const float *sky, uint32_t x, uint32_t y, tile_scratch *scratch, mgt_pixel_info *info);

#endif
