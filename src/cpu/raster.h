/* SPDX-License-Identifier: MIT
 * Clips triangles of homogeneous images, snaps them to subpixels, and sorts them into the tiles that they may touch. */
#ifndef MANGATA_CPU_RASTER_H
#define MANGATA_CPU_RASTER_H

#include <stdbool.h>

#include "cpu/raster_lanes.h"

/* The picture of a layer; both layers have the same. */
typedef struct raster_grid {
    int32_t width, height;
    int32_t middle_x, middle_y; /* the pixel that images are relative to */
    int32_t columns, rows;      /* number of tiles across and down */
    double least_depth;         /* triangles are clipped at this depth, metres */
} raster_grid;

enum { FRONT_LAYER = 0, REFRACTED_LAYER = 1, LAYERS = 2 };

typedef struct bin_entry {
    uint32_t bin, triangle;
} bin_entry;

/* Triangles of one chunk of the world in the chunk's order, and sorted into bins. A tile's bin is layer · tiles + tile. */
typedef struct raster_bins {
    raster_triangle *triangles;
    bin_entry *entries; /* entries in the order of triangles */
    uint32_t *list;     /* triangles sorted by bin; bin b has list[starts[b]] … list[starts[b + 1] − 1] */
    uint32_t *starts;
    size_t triangle_count, entry_count;
    size_t triangle_room, entry_room, list_room, start_room; /* allocated elements */
    bool failed;                                             /* out of memory */
} raster_bins;

/* Adds triangle i of a batch. `image`: images of its corners, by which it is clipped if it reaches beyond COORDINATE_LIMIT. `triangle`: its index in the world.
 * Returns the number of triangles that were added. */
size_t raster_bins_add(raster_bins *bins, const raster_grid *grid, int layer, const setup_batch *from, size_t i, const float image[3][3], int32_t triangle);

/* Fills `list` and `starts` from the entries. */
void raster_bins_sort(raster_bins *bins, const raster_grid *grid);

void raster_bins_clear(raster_bins *bins);
void raster_bins_free(raster_bins *bins);

#endif
