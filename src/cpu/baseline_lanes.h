/* SPDX-License-Identifier: MIT
 * The baseline methods' functions that are compiled once per lane width. */
#ifndef MANGATA_CPU_BASELINE_LANES_H
#define MANGATA_CPU_BASELINE_LANES_H

#include "cpu/lean_map.h"

/* Rays through the pixels of a tile that are traced when the shutter opens and when it closes, see temporal_ray.k. */
typedef struct temporal_rays {
    size_t count;                                /* at most TILE_PIXELS */
    uint16_t pixel[TILE_PIXELS];                 /* of the tile: whose estimates serve */
    float column[TILE_PIXELS], row[TILE_PIXELS]; /* from the tile's first pixel centre */
    tile_pixels pixels;                          /* out, a value a ray; lists are filled up to whole vectors */
} temporal_rays;

struct baseline_kernels {
    void (*pixels)(mgt_method method, const method_tile *tile, tile_pixels *out);
    void (*temporal)(const method_tile *tile, temporal_rays *rays);
    /* The largest frequency among the waves in each pixel of a tile, cycles per pixel; 0 where there is no water. */
    void (*frequencies)(const method_tile *tile, const wave_set *waves, float *most);
    /* LEAN_ROWS rows of the map's level 0; a phase per wave. */
    void (*lean_rows)(const lean_waves *waves, const lean_phase *phases, float *slope_x, float *slope_z);
    /* Luma, [0, 1], of `count` displayed pixels of 3 floats. */
    void (*luma)(const FrameData *frame, const float *rgb, float *luma, size_t count);
};

extern const baseline_kernels baseline_kernels_1;
extern const baseline_kernels baseline_kernels_4;
#if defined(__x86_64__)
extern const baseline_kernels baseline_kernels_8;
extern const baseline_kernels baseline_kernels_16;
#endif

#endif
