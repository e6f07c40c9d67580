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
    const foam_set *foam; /* foam of the wave_set that the waves come from; NULL: none */
    const float *skyline; /* wave_set.skyline of that set */
} tile_waves;

/* Estimates of first hits, one per pixel and in the order of pixels, see HitEstimate in pixel.k. A pixel may show several hits, one above the other, so a tile
 * has HIT_ROWS of these structs. Each holds TILE_HEIGHT rows of hits. */
typedef struct tile_estimate {
    float height[TILE_PIXELS];
    float from[TILE_PIXELS];
    float search[TILE_PIXELS];
    float slope_x[TILE_PIXELS], slope_z[TILE_PIXELS]; /* set and read in grazing tiles alone */
    float shift_x[TILE_PIXELS], shift_z[TILE_PIXELS]; /* shift of choppy water, metres */
} tile_estimate;

typedef struct tile_pixels {
    float red[TILE_PIXELS], green[TILE_PIXELS], blue[TILE_PIXELS];
    float coverage[TILE_PIXELS];
    float water[TILE_PIXELS];
    float foam[TILE_PIXELS];
} tile_pixels;

/* What method adaptive needs of pixels or cells to decide on their splits: members of CellResult in cells.k. */
typedef struct tile_detail {
    float height[TILE_PIXELS], variance[TILE_PIXELS], contrast[TILE_PIXELS], display_slope_squared[TILE_PIXELS], aspect[TILE_PIXELS], places[TILE_PIXELS];
} tile_detail;

/* Light of objects in the pixels of a tile. Each member has the value of an accessor of pixel.k. light_plane() of lane_access.h reads the planes by number, so
 * their order matters. */
typedef struct tile_light {
    float through[3][TILE_PIXELS];  /* UPWELLING: radiance that comes up to the surface, kcd/m² */
    float mirrored[3][TILE_PIXELS]; /* OBJECTS_COLOR: radiance of mirrored objects times their share, kcd/m² */
    float share[TILE_PIXELS];       /* OBJECTS_COVERAGE: fraction of the mirrored directions that objects hide */
    float clear[3][TILE_PIXELS];    /* CLEAR_TO_LIGHT: fraction of the light's disk that objects and water let through */
    float deep[3][TILE_PIXELS];     /* DEEP_WATER: radiance where no surface is, for a camera under water, kcd/m² */
    float front[TILE_PIXELS];       /* FRONT_COVERAGE: fraction of the pixel that objects in front of the water cover */
} tile_light;

typedef struct lean_map lean_map; /* cpu/lean_map.h */

/* Inputs of a method that shades the pixels of a tile. */
typedef struct method_tile {
    const FrameData *frame;
    const float *sky;
    const tile_light *light;   /* light of objects, one value per pixel, or per ray for rays over the shutter; NULL: there are none */
    const podee_tables *podee; /* read where podee-* replaces its Gaussian by kernels */
    const lean_map *lean;      /* read by methods lean and leadr */
    const tile_waves *close;
    const tile_estimate *close_estimate;
    const tile_waves *open; /* the tile when the shutter opens; NULL: `close` stands for it. Methods that see both ends of the shutter have it if the
                               camera moves, rays over the shutter also if the shutter is open for a time */
    const tile_estimate *open_estimate;
    tile_detail *detail; /* output of method mangata; NULL: not wanted */
} method_tile;

/* Cells of one tile. ViewData.scale_x × ViewData.scale_y equal cells make a pixel. */
typedef struct tile_cells {
    size_t count;                                /* at most TILE_PIXELS */
    float column[TILE_PIXELS], row[TILE_PIXELS]; /* whole numbers of cells from the tile's first one */
    int across, down;                            /* number of times that pixels have been halved across and down */
    float below[TILE_PIXELS];                    /* height of the hit of the pixel two rows below the cell's pixel, metres; NAN: unknown */
    float kept[TILE_PIXELS];                     /* leaf_kept() of the cell's leaf; kernels do not read it */
    const tile_light *light;                     /* light of objects, one value per cell; NULL: there are none */
    tile_estimate estimate;                      /* the caller sets `height`, lane_kernels.cells() the other members */
    tile_detail detail;                          /* output */
    tile_pixels pixels;                          /* output */
} tile_cells;

typedef struct tile_surface {
    float along[TILE_PIXELS]; /* metres along the ray; +inf: no water */
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
    /* Fills the estimates of the tile's hits: TileData.hit_rows structs. */
    void (*estimate)(const FrameData *frame, const tile_waves *tile, tile_estimate *estimate);
    /* Takes one sample per pixel and adds weight × result to `out`. dx and dy are in pixels from the pixel's centre; NULL: 0. `light`: light of objects; NULL:
       there are none. */
    void (*sample)(const FrameData *frame, const float *sky, const tile_light *light, const tile_waves *tile, const tile_estimate *estimate, const float *dx,
                   const float *dy, float weight, tile_pixels *out);
    /* Adds one sample per pixel to the sums of a plane. NaN counts as 0. */
    void (*sum)(const float *values, sample_terms *terms);
    /* Shades the pixels by a method that shades each pixel once: METHOD_CENTRE or METHOD_FILTERED. */
    void (*method)(mgt_method method, const method_tile *tile, tile_pixels *out);
    /* Shades cells by method mangata. The waves are sorted for the cells' level. Lists are filled up to whole vectors. */
    void (*cells)(const FrameData *frame, const float *sky, const tile_waves *waves, tile_cells *cells);
    /* Computes depth and normal at one instant. */
    void (*surface)(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, tile_surface *out);
    /* Replaces the normals by the mean shading normals of filtered methods. The tile has resolved and mixed waves at one instant. */
    void (*filtered_normal)(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, tile_surface *out);
    /* Displayed colour of `count` pixels: from 3 floats each to 4 bytes each. */
    void (*display)(const FrameData *frame, const float *rgb, uint8_t *rgba, size_t count);
    const baseline_kernels *baselines;
    const shade_kernels *shade;
    const narrow_kernels *narrow;
    const front_kernels *front;
    const raster_kernels *raster;
} lane_kernels;

/* The kernels that lane_kernels point to, by lane width. */
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
