/* SPDX-License-Identifier: MIT
 * The functions that are compiled once per lane width, and the tile they work on. */
#ifndef MANGATA_CPU_LANES_H
#define MANGATA_CPU_LANES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "frame/tiles.h"
#include "mangata/mangata.h"
#include "frame/podee_tables.h"

/* The waves of a tile at one instant or over one shutter interval, for one camera. */
typedef struct tile_waves {
    TileData data;
    WaveData waves[MGT_MAX_WAVES];
    SearchWave search[MGT_MAX_WAVES];
    const foam_set *foam; /* of the wave_set that it was sorted from; NULL: none */
    const float *skyline; /* of the same set, as it has it */
} tile_waves;

/* Where the first hits are looked for, a value per pixel (see HitEstimate in pixel.k). A tile has HIT_ROWS of them, for the first and the next
 * TILE_HEIGHT rows of hits where pixels show several. */
typedef struct tile_estimate {
    float height[TILE_PIXELS];
    float from[TILE_PIXELS];
    float search[TILE_PIXELS];
    float slope_x[TILE_PIXELS], slope_z[TILE_PIXELS]; /* in grazing water alone */
    float shift_x[TILE_PIXELS], shift_z[TILE_PIXELS]; /* of choppy water */
} tile_estimate;

typedef struct tile_pixels {
    float red[TILE_PIXELS], green[TILE_PIXELS], blue[TILE_PIXELS];
    float coverage[TILE_PIXELS];
    float water[TILE_PIXELS];
    float foam[TILE_PIXELS];
} tile_pixels;

/* How a pixel or cell of method `mangata` goes on, see cells.k. */
typedef struct tile_detail {
    float height[TILE_PIXELS], variance[TILE_PIXELS], contrast[TILE_PIXELS], display_slope_squared[TILE_PIXELS], aspect[TILE_PIXELS], places[TILE_PIXELS];
} tile_detail;

/* What the pixels of a tile see of objects through the surface and mirrored by it, see pixel.k. Kernels read the planes by their numbers. */
typedef struct tile_light {
    float through[3][TILE_PIXELS];  /* what comes through */
    float mirrored[3][TILE_PIXELS]; /* what objects shine where they hide the sky */
    float share[TILE_PIXELS];       /* how much of the mirrored sky objects hide */
    float clear[3][TILE_PIXELS];    /* what objects and water leave of the light's disk */
    float deep[3][TILE_PIXELS];     /* under water: what shines where no surface is */
    float front[TILE_PIXELS];       /* how much of the pixel objects in front of the water cover */
} tile_light;

typedef struct lean_map lean_map; /* cpu/lean_map.h */

/* What a method shades the pixels of a tile from. */
typedef struct method_tile {
    const FrameData *frame;
    const float *sky;
    const tile_light *light;   /* of objects, for rays over the shutter a value a ray; NULL: there are none */
    const podee_tables *podee; /* where podee-* replaces its Gaussian by kernels */
    const lean_map *lean;      /* of methods lean and leadr */
    const tile_waves *close;
    const tile_estimate *close_estimate;
    const tile_waves *open; /* NULL unless the camera moves and the method counts the shutter; for rays over the shutter, unless this is 0 */
    const tile_estimate *open_estimate;
    tile_detail *detail; /* out, of method mangata; NULL: not wanted */
} method_tile;

/* Cells of one tile: pixels are split evenly into view.scale_x × view.scale_y of them. */
typedef struct tile_cells {
    size_t count;                                /* at most TILE_PIXELS */
    float column[TILE_PIXELS], row[TILE_PIXELS]; /* whole numbers, in cells from the tile's first one */
    int across, down;                            /* how often their pixels have been halved each way */
    float below[TILE_PIXELS];                    /* height of the hit of the pixel two rows under the cell's, metres; NAN: unknown */
    float kept[TILE_PIXELS];                     /* leaf_kept() of its leaf; kernels do not read it */
    const tile_light *light;                     /* a value a cell; NULL: no objects */
    tile_estimate estimate;                      /* heights; search: 1 to search from above, 0: only where the height leads nowhere */
    tile_detail detail;                          /* out */
    tile_pixels pixels;                          /* out */
} tile_cells;

typedef struct tile_surface {
    float along[TILE_PIXELS]; /* metres along the ray; +inf without water */
    float normal_x[TILE_PIXELS], normal_y[TILE_PIXELS], normal_z[TILE_PIXELS];
} tile_surface;

typedef struct sample_terms sample_terms;         /* cpu/sample_sums.h */
typedef struct shade_kernels shade_kernels;       /* cpu/shade.h */
typedef struct narrow_kernels narrow_kernels;     /* cpu/narrow_lanes.h */
typedef struct front_kernels front_kernels;       /* cpu/front_lanes.h */
typedef struct baseline_kernels baseline_kernels; /* cpu/baseline_lanes.h */
typedef struct raster_kernels raster_kernels;     /* cpu/raster_lanes.h */

typedef struct lane_kernels {
    uint32_t lanes;
    /* Sorts the waves for the tile (tile_x, tile_y) of the lattice; `view` is the set's own, or one that splits pixels into cells. */
    void (*sort)(const FrameData *frame, const wave_set *set, const ViewData *view, uint32_t tile_x, uint32_t tile_y, tile_waves *out);
    /* Searches the tile's nodes and fills the estimates of its pixels. */
    void (*estimate)(const FrameData *frame, const tile_waves *tile, tile_estimate *estimate);
    /* One sample a pixel at (x + dx, y + dy), dx and dy in pixels from its centre (NULL: 0); adds weight × result to `out`. `light`: of objects;
       NULL where there are none, here and below. */
    void (*sample)(const FrameData *frame, const float *sky, const tile_light *light, const tile_waves *tile, const tile_estimate *estimate, const float *dx,
                   const float *dy, float weight, tile_pixels *out);
    /* Adds one sample a pixel to the sums of a plane. What is not a number counts as 0. */
    void (*sum)(const float *values, sample_terms *terms);
    /* Methods that shade each pixel once: METHOD_CENTRE and METHOD_FILTERED. */
    void (*method)(mgt_method method, const method_tile *tile, tile_pixels *out);
    /* Cells by method `mangata`; the waves are sorted for their level. Lists are filled up to whole vectors. */
    void (*cells)(const FrameData *frame, const float *sky, const tile_waves *close, const tile_waves *open, tile_cells *cells);
    /* Depth and normal at one instant. */
    void (*surface)(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, tile_surface *out);
    /* The mean shading normal of filtered methods instead, from a tile with resolved and mixed waves at one instant. */
    void (*filtered_normal)(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, tile_surface *out);
    /* Displayed colour: `count` pixels of 3 floats to 4 bytes. */
    void (*display)(const FrameData *frame, const float *rgb, uint8_t *rgba, size_t count);
    const baseline_kernels *baselines;
    const shade_kernels *shade;
    const narrow_kernels *narrow;
    const front_kernels *front;
    const raster_kernels *raster;
} lane_kernels;

/* Those that lane_kernels lead to. */
extern const shade_kernels shade_kernels_1, shade_kernels_4, shade_kernels_8, shade_kernels_16;
extern const narrow_kernels narrow_kernels_1, narrow_kernels_4, narrow_kernels_8, narrow_kernels_16;
extern const front_kernels front_kernels_1, front_kernels_4, front_kernels_8, front_kernels_16;

extern const lane_kernels lane_kernels_1;
extern const lane_kernels lane_kernels_4;
#if defined(__x86_64__)
extern const lane_kernels lane_kernels_8;
extern const lane_kernels lane_kernels_16;
#endif

#endif
