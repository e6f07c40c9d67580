/* SPDX-License-Identifier: MIT
 * The narrow phase of refraction over the pixels of a tile: functions that are compiled once per lane width. */
#ifndef MANGATA_CPU_NARROW_LANES_H
#define MANGATA_CPU_NARROW_LANES_H

#include "cpu/gbuffer.h"
#include "cpu/lanes.h"

/* What points are looked for in. */
typedef struct narrow_scene {
    NarrowData data;
    RefractData refract;
    const gbuffer *layers[2];        /* beyond the surface, and as the surface mirrors it; all of one shape */
    const gbuffers *drawn[2];        /* the drawn scenes whose refracted layers these are */
    const uint8_t *breaks[2];        /* two-phase, hybrid: front_kernels.breaks of these layers */
    const float *planes;             /* of the world's triangles: unit normal, and its product with a point of the triangle */
    SearchWave waves[MGT_MAX_WAVES]; /* data.waves of them */
} narrow_scene;

/* The surface in the pixels of a tile; directions as in narrow_types.k, y away from the surface on the camera's side. */
typedef struct tile_water {
    float share[TILE_PIXELS];  /* of the pixel that is water; 0: the rest is not set */
    float column[TILE_PIXELS]; /* of the ray, in the image; pixel centres at whole numbers */
    float row[TILE_PIXELS];
    float view[3][TILE_PIXELS];   /* unit, of the ray */
    float along[TILE_PIXELS];     /* metres */
    float normal[3][TILE_PIXELS]; /* unit */
    float slopes[3][TILE_PIXELS]; /* covariance xx, xz, zz of the slopes that the pixel does not resolve; this and the next two: see WaterVariation */
    float bend[3][TILE_PIXELS];   /* second derivatives of the resolved waves */
    float path[3][TILE_PIXELS];   /* change over the shutter of the slope and of `along` */
} tile_water;

/* Where rays end, as shade_hits takes them. */
typedef struct tile_ends {
    int32_t triangle[TILE_PIXELS];
    float position[3][TILE_PIXELS];
    float direction[3][TILE_PIXELS];
    float before[TILE_PIXELS], after[TILE_PIXELS], water[TILE_PIXELS];
    float way[TILE_PIXELS];       /* metres of `after` to where the ray met the surface last; 0: it met it once */
    float wet[TILE_PIXELS];       /* metres of `way` in water */
    float from[3][TILE_PIXELS];   /* where it met the surface last; not set where it met it once */
    float part[TILE_PIXELS];      /* of the light that goes this way */
    float first[TILE_PIXELS];     /* 1 where the surface lets nothing through as it is met first */
    float spread[3][TILE_PIXELS]; /* the footprint, as in shade_hits */
    float terms[9][TILE_PIXELS];  /* Spread, for another `after`; two-phase, hybrid: where there is doubt */
    float gain[TILE_PIXELS];      /* as in shade_hits */
    float error[TILE_PIXELS];     /* pixels; +inf: unknown */
    float total[TILE_PIXELS];     /* 1 where the surface lets nothing through */
    float doubt[TILE_PIXELS];     /* two-phase, hybrid: 1 where the pictures do not certify the answer, else 0 */
    int32_t pixel[TILE_PIXELS];   /* index in the layer of the pixel that gave the answer; −1: none */
    int32_t last[TILE_PIXELS];    /* two-phase, hybrid: index of the pixel at which a point infinitely far along the ray is seen; −1: none */
} tile_ends;

/* Pixel 0 of the tile within the image, and the place in every pixel that rays go through, from its centre. */
typedef struct tile_offset {
    uint32_t column, row;
    float dx, dy;
} tile_offset;

/* Rays through places of a tile's pixels. */
typedef struct ray_places {
    size_t count;
    uint16_t pixel[TILE_PIXELS];            /* of the tile */
    float dx[TILE_PIXELS], dy[TILE_PIXELS]; /* from its centre */
} ray_places;

struct narrow_kernels {
    /* The filtered surface, over the time that the waves were sorted for. */
    void (*water)(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, const tile_offset *at, tile_water *out);
    /* The surface where these rays meet it, from that at the centres of their pixels: a ray each, in their order. Its `share` is 0 beyond them. */
    void (*beside)(const narrow_scene *n, const ray_places *places, const tile_water *water, tile_water *out);
    /* What lies behind it, on branch 0; on branch 1 of again.k only where out->part says that branch 0 is split. */
    void (*refracted)(const narrow_scene *n, const tile_water *water, int branch, tile_ends *out);
    /* What its mean slope mirrors of the camera's own side. */
    void (*mirrored)(const narrow_scene *n, const tile_water *water, tile_ends *out);
    /* Pixels of a layer at even steps along the image of a ray, −1 outside of it. `from`: as in narrow_types.k; after: as in place_along(). */
    void (*along)(const narrow_scene *n, int layer, const float from[3], const float direction[3], float after, int32_t pixels[SHARP_PLACES]);
};

#endif
