/* SPDX-License-Identifier: MIT
 * The broad phase: the world's triangles cut at the mean surface, moved to their virtual images and split where these bend. */
#ifndef MANGATA_CPU_BROAD_H
#define MANGATA_CPU_BROAD_H

#include "cpu/raster.h"
#include "frame/world.h"

enum { BROAD_CHUNK = 1024 }; /* triangles of the world in a chunk, which one worker takes */

/* What triangles of a picture have in common. */
typedef struct broad_view {
    const world *world;
    const raster_kernels *kernels;
    RefractData refract;
    PictureData picture;
    raster_grid grid;
    float foot[2];       /* x and z of the camera in the world */
    float crest;         /* gbuffer_job.crest; 0 for MAP_PATH */
    float trough;        /* gbuffer_job.trough */
    bool mirrored;       /* gbuffer_job.mirrored */
    const float *images; /* images of all vertices, see raster_kernels.images */
} broad_view;

/* A triangle of the world, or a part of one. */
typedef struct patch {
    float corner[3][3], image[3][3];
    int32_t triangle; /* triangle of the world */
    int32_t depth;    /* number of splits that have led to this part */
} patch;

typedef struct broad_counts {
    size_t drawn[LAYERS], splits;
} broad_counts;

typedef struct patch_stack {
    patch *patches;
    size_t count, room;
} patch_stack;

/* A worker's memory. It starts zeroed. */
typedef struct broad_scratch {
    patch_batch batch;
    patch taken[PATCH_BATCH]; /* the patches of `batch` */
    patch_batch straight;     /* triangles whose images are straight */
    patch straight_taken[PATCH_BATCH];
    int straight_layer[PATCH_BATCH];
    setup_batch setup;
    patch_stack waiting; /* patches whose images are known */
    patch_stack cut;     /* parts of triangles that the surface cuts; their images are not known yet */
    bool failed;         /* out of memory */
} broad_scratch;

/* Fills the bins of one chunk of the world. Their order depends on the chunk alone. */
void broad_chunk(const broad_view *view, size_t chunk, broad_scratch *scratch, raster_bins *bins, broad_counts *counts);
void broad_scratch_free(broad_scratch *scratch);

#endif
