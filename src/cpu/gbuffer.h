/* SPDX-License-Identifier: MIT
 * Layers of the objects that a camera sees: front for its own side of the mean surface, refracted for the other side.
 *
 * The refracted layer shows every triangle where refraction by the flat mean surface shows it. Points are moved to their virtual images
 * (kernels/refraction/refract_point.k), which lie on straight rays of the camera. Triangles are cut at the mean surface, split where the map bends them, and
 * drawn into a picture with a guard band around it.
 */
#ifndef MANGATA_CPU_GBUFFER_H
#define MANGATA_CPU_GBUFFER_H

#include "cpu/raster_lanes.h"
#include "frame/gbuffer_job.h"
#include "base/thread_pool.h"
#include "frame/world.h"

/* Counts of the last picture that was drawn. */
typedef struct gbuffer_counts {
    size_t front_triangles, far_triangles; /* triangles drawn into each layer, counted after cuts and splits */
    size_t splits;                         /* triangles that splits have added */
} gbuffer_counts;

enum { GBUFFER_BLOCK = 8 }; /* pixels along a block's side */

typedef struct gbuffers {
    gbuffer front, refracted;
    RefractData refract; /* data of the kernels' true_point() and virtual_point() */
    gbuffer_counts counts;
    uint64_t drawn;              /* number of times that the layers were drawn */
    float *nearest;              /* refracted layer: least depth in each block of GBUFFER_BLOCK² pixels, row by row */
    uint32_t columns, rows;      /* number of blocks across and down */
    uint32_t empties;            /* number of blocks that show nothing */
    float within[4];             /* refracted layer: first and last column, first and last row of the blocks that show something */
    struct gbuffer_store *store; /* memory, and the inputs of the last drawing */
} gbuffers;

/*
 * Draws both layers of a world, unless world.version and the job are those of the last call. Start with a zeroed struct. The bits depend neither on threads nor
 * on lanes nor on what was drawn before. MGT_ERROR_MEMORY leaves empty layers.
 */
mgt_status gbuffers_draw(gbuffers *g, const world *w, const gbuffer_job *job, const raster_kernels *kernels, thread_pool *pool);
void gbuffers_free(gbuffers *g);

#endif
