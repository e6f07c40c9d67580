/* SPDX-License-Identifier: MIT
 * The functions of G-buffers that are compiled once per lane width. */
#ifndef MANGATA_CPU_RASTER_LANES_H
#define MANGATA_CPU_RASTER_LANES_H

#include <stddef.h>
#include <stdint.h>

#include "frame/kernel_data.h"

enum {
    PATCH_BATCH = 64,
    RASTER_TILE = 64,        /* pixels along a side */
    RASTER_STRIDE = 64 + 16, /* vectors may reach over the end of a row */
    SUBPIXELS = 256,
};

/* Triangles that may have to be split: points relative to the camera's foot, images as in refract_patch.k; [corner or edge][x, y, z]. Edge e joins
 * corner e and the next one. */
typedef struct patch_batch {
    size_t count; /* lists are filled up to whole vectors */
    float corner[3][3][PATCH_BATCH];
    float image[3][3][PATCH_BATCH];
    float middle[3][3][PATCH_BATCH];       /* out, where an edge is split */
    float middle_image[3][3][PATCH_BATCH]; /* out, where an edge is split */
    float split[3][PATCH_BATCH];           /* out: 1 or 0 */
    float hidden[PATCH_BATCH];             /* out: 1 where nothing of the triangle can be in the picture, however it bends; else 0 */
} patch_batch;

/* Triangles as they are drawn, by their images alone; see raster_triangle. */
typedef struct setup_batch {
    float x[3][PATCH_BATCH], y[3][PATCH_BATCH]; /* whole numbers */
    float inverse_depth[PATCH_BATCH], slope_x[PATCH_BATCH], slope_y[PATCH_BATCH], least[PATCH_BATCH], most[PATCH_BATCH];
    float state[PATCH_BATCH]; /* 0: no pixel's centre is covered, 1: ready, 2: reaches beyond the limits, not set up */
} setup_batch;

/* Pixels from the middle that coordinates reach: enough for the largest image and its guard band; products of edges then fit into 32 bits in a tile. */
#define COORDINATE_LIMIT 20480

/* A triangle in the picture, drawn where all three edges' numbers are 0 or more. Coordinates count subpixels from the middle pixel's centre. */
typedef struct raster_triangle {
    int32_t x[3], y[3];                    /* clockwise on the screen, y down */
    float inverse_depth, slope_x, slope_y; /* 1/depth at corner 0, and its change per pixel */
    float least, most;                     /* bounds of 1/depth over the triangle */
    int32_t triangle;                      /* of the world */
} raster_triangle;

/* Pixels of a tile in the making: 1/depth, 0 where there is nothing, and triangles. */
typedef struct raster_tile {
    int32_t x, y;          /* of its first pixel, from the picture's middle pixel */
    int32_t width, height; /* at most RASTER_TILE */
    float inverse_depth[RASTER_TILE * RASTER_STRIDE];
    int32_t triangle[RASTER_TILE * RASTER_STRIDE];
} raster_tile;

typedef struct raster_kernels {
    /* Points relative to the camera's foot; `count` a multiple of 16. */
    void (*virtual_points)(const RefractData *refract, size_t count, const float *const in[3], float *const out[3]);
    void (*true_points)(const RefractData *refract, size_t count, const float *const in[3], float *const out[3]);
    /* Images of `count` vertices, 3 floats each in the world and 4 in `images`: x, y, z and how far on the far side they are; those on the camera's
       side are seen straight. `foot` is the camera's foot in the world. */
    void (*images)(const RefractData *refract, const PictureData *picture, const float foot[2], size_t count, const float *positions, float *images);
    /* The images of the corners, if `place` is set; then what to split. */
    void (*patches)(const RefractData *refract, const PictureData *picture, int place, patch_batch *batch);
    void (*setups)(const PictureData *picture, patch_batch *batch, setup_batch *out);
    void (*tile_clear)(raster_tile *tile);
    void (*tile_draw)(raster_tile *tile, const raster_triangle *triangles, const uint32_t *list, size_t count);
    /* A row of the tile as depths and triangles. */
    void (*tile_row)(const raster_tile *tile, int32_t row, float *depth, int32_t *triangle);
} raster_kernels;

extern const raster_kernels raster_kernels_1;
extern const raster_kernels raster_kernels_4;
#if defined(__x86_64__)
extern const raster_kernels raster_kernels_8;
extern const raster_kernels raster_kernels_16;
#endif

#endif
