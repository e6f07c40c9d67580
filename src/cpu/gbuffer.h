/* SPDX-License-Identifier: MIT
 * What a camera sees of the objects, apart on its own side of the mean surface and on the other one.
 *
 * On the other side, the refracted layer, every triangle is drawn where refraction by the flat mean surface shows it: its points are moved to their
 * virtual images (kernels/refraction/refract_point.k), which lie on straight rays of the camera. Triangles are cut at the mean surface, split where the
 * map bends them, and drawn into a picture with a guard band around it.
 */
#ifndef MANGATA_CPU_GBUFFER_H
#define MANGATA_CPU_GBUFFER_H

#include "cpu/raster_lanes.h"
#include "frame/gbuffer_job.h"
#include "base/thread_pool.h"
#include "frame/world.h"

/* Counts of the last picture that was drawn. */
typedef struct gbuffer_counts {
    size_t front_triangles, far_triangles; /* drawn: cut, split and within the guard band */
    size_t splits;                         /* triangles added because the map bends */
} gbuffer_counts;

enum { GBUFFER_BLOCK = 8 };

typedef struct gbuffers {
    gbuffer front, refracted;
    RefractData refract; /* what the kernels' true_point() and virtual_point() need */
    gbuffer_counts counts;
    uint64_t drawn;              /* how often */
    float *nearest;              /* refracted layer: the least depth in each block of GBUFFER_BLOCK² pixels, row by row */
    uint32_t columns, rows;      /* of blocks */
    uint32_t empties;            /* blocks that show nothing */
    float within[4];             /* refracted layer: first and last column, first and last row of the pixels that may show something */
    struct gbuffer_store *store; /* its own: memory and what the layers were drawn from */
} gbuffers;

/*
 * Draws both layers of a world. What is in *g stays where world.version and the job are the same as the last time; start with a zeroed struct.
 * The bits depend neither on threads nor on lanes nor on what was drawn before. MGT_ERROR_MEMORY leaves empty layers.
 */
mgt_status gbuffers_draw(gbuffers *g, const world *w, const gbuffer_job *job, const raster_kernels *kernels, thread_pool *pool);
void gbuffers_free(gbuffers *g);

#endif
