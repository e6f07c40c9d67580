/* SPDX-License-Identifier: MIT
 * Functions of the layers that are compiled once per lane width. */
#ifndef MANGATA_CPU_RASTER_LANES_H
#define MANGATA_CPU_RASTER_LANES_H

#include <stddef.h>
#include <stdint.h>

#include "frame/kernel_data.h"

enum {
    PATCH_BATCH = 64,        /* triangles in a batch */
    RASTER_TILE = 64,        /* pixels along a tile's side */
    RASTER_STRIDE = 64 + 16, /* floats from row to row: vectors may reach beyond the end of a row */
    SUBPIXELS = 256,         /* subpixels along a pixel's side */
};

/* Triangles that may have to be split. Corners and middles are relative to the point of the mean surface below the camera. Images: see refract_patch.k. Indices
 * are [corner or edge][x, y, z]. Edge e joins corner e and the next one. */
typedef struct patch_batch {
    size_t count; /* lists are filled up to whole vectors */
    float corner[3][3][PATCH_BATCH];
    float image[3][3][PATCH_BATCH];
    float middle[3][3][PATCH_BATCH];       /* output: middles of edges that are split */
    float middle_image[3][3][PATCH_BATCH]; /* output: images of these middles */
    float split[3][PATCH_BATCH];           /* output: 1: the edge is split; else 0 */
    float hidden[PATCH_BATCH];             /* output: 1: no part of the triangle can be in the picture, however it bends; else 0 */
} patch_batch;

/* Triangles that are set up to be drawn. Their members are those of raster_triangle. */
typedef struct setup_batch {
    float x[3][PATCH_BATCH], y[3][PATCH_BATCH]; /* whole numbers */
    float inverse_depth[PATCH_BATCH], slope_x[PATCH_BATCH], slope_y[PATCH_BATCH], least[PATCH_BATCH], most[PATCH_BATCH];
    float state[PATCH_BATCH]; /* 0: no pixel's centre is covered; 1: ready; 2: not set up, because the triangle is too near or reaches too far */
} setup_batch;

/* Coordinates reach up to so many pixels from the middle pixel. That is enough for the largest image and its guard band, and keeps products of edges within a
 * tile in 32 bits. */
#define COORDINATE_LIMIT 20480

/* A triangle in the picture. It covers the pixels at which the edge functions of all three edges are 0 or more. Coordinates are in subpixels from the middle
 * pixel's centre. */
typedef struct raster_triangle {
    int32_t x[3], y[3];                    /* clockwise on the screen, y down */
    float inverse_depth, slope_x, slope_y; /* 1/depth at corner 0, and its change per pixel across and down */
    float least, most;                     /* bounds of 1/depth over the triangle */
    int32_t triangle;                      /* index in the world */
} raster_triangle;

/* A tile of a layer that is being drawn. */
typedef struct raster_tile {
    int32_t x, y;                                     /* place of its first pixel, in pixels from the picture's middle pixel */
    int32_t width, height;                            /* at most RASTER_TILE */
    float inverse_depth[RASTER_TILE * RASTER_STRIDE]; /* 1/depth; 0: the pixel shows nothing */
    int32_t triangle[RASTER_TILE * RASTER_STRIDE];    /* index in the world; −1: the pixel shows nothing */
} raster_tile;

typedef struct raster_kernels {
    /* Computes virtual images of points, which are relative to the point of the mean surface below the camera. `count` is a multiple of 16. */
    void (*virtual_points)(const RefractData *refract, size_t count, const float *const in[3], float *const out[3]);
    /* Computes the inverse of virtual_points(). */
    void (*true_points)(const RefractData *refract, size_t count, const float *const in[3], float *const out[3]);
    /* Computes images of `count` vertices of the world with 3 floats each. An image has 4 floats: x, y, z, and the vertex's distance beyond the mean surface,
       which is below 0 on the camera's side, where images are straight. `foot`: x and z of the camera in the world. */
    void (*images)(const RefractData *refract, const PictureData *picture, const float foot[2], size_t count, const float *positions, float *images);
    /* Computes the corners' images if `place` is set, then decides on splits. */
    void (*patches)(const RefractData *refract, const PictureData *picture, int place, patch_batch *batch);
    /* Sets up the triangles of a batch by their images alone. */
    void (*setups)(const PictureData *picture, patch_batch *batch, setup_batch *out);
    void (*tile_clear)(raster_tile *tile);
    /* Draws `count` listed triangles. */
    void (*tile_draw)(raster_tile *tile, const raster_triangle *triangles, const uint32_t *list, size_t count);
    /* Writes a row of the tile as depths, +inf where it shows nothing, and triangles. */
    void (*tile_row)(const raster_tile *tile, int32_t row, float *depth, int32_t *triangle);
} raster_kernels;

extern const raster_kernels raster_kernels_1;
extern const raster_kernels raster_kernels_4;
#if defined(__x86_64__)
extern const raster_kernels raster_kernels_8;
extern const raster_kernels raster_kernels_16;
#endif

#endif
