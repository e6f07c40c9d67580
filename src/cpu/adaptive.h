/* SPDX-License-Identifier: MIT
 * Method adaptive: splits pixels of method mangata into four cells again and again where that saves the most error. */
#ifndef MANGATA_CPU_ADAPTIVE_H
#define MANGATA_CPU_ADAPTIVE_H

#include "base/thread_pool.h"
#include "cpu/tile_job.h"
#include "frame/whole_frame.h"

/* One frame; the scene asks for no crop. */
typedef struct adaptive_frame {
    const frame *frame;
    const lane_kernels *kernels;
    const float *sky; /* sky_state.table */
    thread_pool *pool;
    tile_scratch **scratch;     /* one per worker */
    const tile_opened *objects; /* objects in each tile, row by row; NULL: there are none */
    picture_sums sums;          /* read by scheme podee */
    /* Called repeatedly on the caller's thread with the fraction that is done. False: the frame ends with MGT_CANCELLED. */
    bool (*keep_going)(void *argument, double fraction);
    void *keep_going_argument;
} adaptive_frame;

/* Memory that is kept between frames of one size. */
typedef struct refinement refinement;

/* Fills all planes but depth. *kept is NULL at first and is reallocated when a frame's size needs it. Returns MGT_OK, MGT_CANCELLED or MGT_ERROR_MEMORY. */
mgt_status adaptive_render(const adaptive_frame *a, refinement **kept, const picture_planes *out);
void refinement_free(refinement *f);

#endif
