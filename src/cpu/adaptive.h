/* SPDX-License-Identifier: MIT
 * Method adaptive: pixels of method `mangata` are split into four cells again and again where that is worth most. */
#ifndef MANGATA_CPU_ADAPTIVE_H
#define MANGATA_CPU_ADAPTIVE_H

#include "base/thread_pool.h"
#include "cpu/tile_job.h"
#include "frame/whole_frame.h"

/* One frame; the scene asks for no crop. */
typedef struct adaptive_frame {
    const frame *frame;
    const lane_kernels *kernels;
    const float *sky; /* the table of a sky_state */
    thread_pool *pool;
    tile_scratch **scratch;     /* one a worker */
    const tile_opened *objects; /* a tile each, in rows: what they see of objects; NULL: there are none */
    picture_sums sums;          /* of scheme podee */
    /* Asked now and then on the caller's thread with the share done; false: stop with MGT_CANCELLED. */
    bool (*keep_going)(void *argument, double fraction);
    void *keep_going_argument;
} adaptive_frame;

/* Memory that frames of one size share; nothing else outlives a frame. */
typedef struct refinement refinement;

/* Fills all planes but depth. MGT_ERROR_MEMORY where memory is short. *kept: NULL at first, made and remade as frames need it. */
mgt_status adaptive_render(const adaptive_frame *a, refinement **kept, const picture_planes *out);
void refinement_free(refinement *f);

#endif
