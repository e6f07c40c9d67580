/* SPDX-License-Identifier: MIT
 * Functions of the baseline methods that are compiled once per lane width. */
#ifndef MANGATA_CPU_BASELINE_LANES_H
#define MANGATA_CPU_BASELINE_LANES_H

#include "cpu/lean_map.h"

/* Rays through the pixels of a tile that are traced when the shutter opens and when it closes, see temporal_ray.k. */
typedef struct temporal_rays {
    size_t count;                                /* at most TILE_PIXELS */
    uint16_t pixel[TILE_PIXELS];                 /* pixel of the tile whose estimates the ray's search begins with */
    float column[TILE_PIXELS], row[TILE_PIXELS]; /* place of the ray, in pixels from the tile's first pixel centre */
    tile_pixels pixels;                          /* output, one value per ray; lists are filled up to whole vectors */
} temporal_rays;

struct baseline_kernels {
    /* Shades the pixels of a tile. */
    void (*pixels)(mgt_method method, const method_tile *tile, tile_pixels *out);
    /* Shades rays over the shutter. */
    void (*temporal)(const method_tile *tile, temporal_rays *rays);
    /* Finds the highest frequency of waves in each pixel of a tile, cycles per pixel; 0: the pixel has no water. */
    void (*frequencies)(const method_tile *tile, const wave_set *waves, float *most);
    /* Fills LEAN_ROWS rows of the map's level 0. `phases` has one element per wave. */
    void (*lean_rows)(const lean_waves *waves, const lean_phase *phases, float *slope_x, float *slope_z);
    /* Luma, [0, 1], of `count` pixels of 3 floats as they are displayed. */
    void (*luma)(const FrameData *frame, const float *rgb, float *luma, size_t count);
};

extern const baseline_kernels baseline_kernels_1;
extern const baseline_kernels baseline_kernels_4;
#if defined(__x86_64__)
extern const baseline_kernels baseline_kernels_8;
extern const baseline_kernels baseline_kernels_16;
#endif

#endif
