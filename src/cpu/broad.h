/* SPDX-License-Identifier: MIT
 * The broad phase: the world's triangles cut at the mean surface, moved to their virtual images and split where these bend. */
#ifndef MANGATA_CPU_BROAD_H
#define MANGATA_CPU_BROAD_H

#include "cpu/raster.h"
#include "frame/world.h"

enum { BROAD_CHUNK = 1024 }; /* triangles of the world that are worked on at a time */

/* What all triangles of a picture share. */
typedef struct broad_view {
    const world *world;
    const raster_kernels *kernels;
    RefractData refract;
    PictureData picture;
    raster_grid grid;
    float foot[2];       /* the camera's foot in the world */
    float crest;         /* metres that the refracted layer goes on for on the camera's side */
    float trough;        /* metres that the front layer goes on for beyond the surface */
    bool mirrored;       /* see gbuffer_job */
    const float *images; /* of all vertices, as raster_kernels.images fills them */
} broad_view;

/* A triangle on its way. */
typedef struct patch {
    float corner[3][3], image[3][3];
    int32_t triangle;
    int32_t depth; /* how often it has been split */
} patch;

typedef struct broad_counts {
    size_t drawn[LAYERS], splits;
} broad_counts;

typedef struct patch_stack {
    patch *patches;
    size_t count, room;
} patch_stack;

/* A worker's memory; zeroed at first. */
typedef struct broad_scratch {
    patch_batch batch;
    patch taken[PATCH_BATCH]; /* what the batch holds */
    patch_batch straight;     /* triangles that nothing bends */
    patch straight_taken[PATCH_BATCH];
    int straight_layer[PATCH_BATCH];
    setup_batch setup;
    patch_stack waiting; /* with images */
    patch_stack cut;     /* parts of triangles that meet the surface, without images */
    bool failed;         /* memory was short */
} broad_scratch;

/* Bins of the triangles of one chunk, in an order of their own that depends on nothing else. */
void broad_chunk(const broad_view *view, size_t chunk, broad_scratch *scratch, raster_bins *bins, broad_counts *counts);
void broad_scratch_free(broad_scratch *scratch);

#endif
