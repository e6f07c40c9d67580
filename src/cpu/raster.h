/* SPDX-License-Identifier: MIT
 * Triangles of homogeneous images, clipped and snapped to subpixels, and sorted into the tiles that they may touch. */
#ifndef MANGATA_CPU_RASTER_H
#define MANGATA_CPU_RASTER_H

#include <stdbool.h>

#include "cpu/raster_lanes.h"

/* The pictures of both layers. */
typedef struct raster_grid {
    int32_t width, height;
    int32_t middle_x, middle_y; /* the pixel that images are relative to */
    int32_t columns, rows;      /* of tiles */
    double least_depth;         /* metres; what is nearer is cut off */
} raster_grid;

enum { FRONT_LAYER = 0, REFRACTED_LAYER = 1, LAYERS = 2 };

typedef struct bin_entry {
    uint32_t bin, triangle;
} bin_entry;

/* Triangles of one chunk of the world, in their order, and by bins: layer · tiles + tile. */
typedef struct raster_bins {
    raster_triangle *triangles;
    bin_entry *entries; /* as they came */
    uint32_t *list;     /* by bins: bin b has list[starts[b]] … list[starts[b + 1]] */
    uint32_t *starts;
    size_t triangle_count, entry_count;
    size_t triangle_room, entry_room, list_room, start_room;
    bool failed; /* memory was short */
} raster_bins;

/* Triangle i of a batch and its images, from which it is clipped if it reaches too far. Returns how many triangles are left of it. */
size_t raster_bins_add(raster_bins *bins, const raster_grid *grid, int layer, const setup_batch *from, size_t i, const float image[3][3], int32_t triangle);

/* Sorts the entries. */
void raster_bins_sort(raster_bins *bins, const raster_grid *grid);

void raster_bins_clear(raster_bins *bins);
void raster_bins_free(raster_bins *bins);

#endif
