/* SPDX-License-Identifier: MIT
 * A frame taken apart: its tiles rendered one by one, by any build of the kernels, on the caller's thread. */
#ifndef MANGATA_BENCH_TILE_FRAME_H
#define MANGATA_BENCH_TILE_FRAME_H

#include "cpu/tile_job.h"

typedef struct tile_frame {
    sky_state *sky;
    frame_waves *waves;
    frame frame;
    uint32_t columns, rows;
} tile_frame;

/* The scene must outlive the frame. NULL when memory is short. */
tile_frame *tile_frame_create(const mgt_scene *scene);
void tile_frame_free(tile_frame *frame);

/* Colour of every tile by these kernels. */
void tile_frame_render(const tile_frame *frame, const lane_kernels *kernels, tile_scratch *scratch);

#endif
