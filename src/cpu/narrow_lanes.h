/* SPDX-License-Identifier: MIT
 * The narrow phase of refraction over the pixels of a tile: functions that are compiled once per lane width. */
#ifndef MANGATA_CPU_NARROW_LANES_H
#define MANGATA_CPU_NARROW_LANES_H

#include "cpu/gbuffer.h"
#include "cpu/lanes.h"

/* The layers and the waves in which the narrow phase searches. */
typedef struct narrow_scene {
    NarrowData data;
    RefractData refract;
    const gbuffer *layers[2];        /* LAYER_REFRACTED and LAYER_REFLECTED, both of one shape */
    const gbuffers *drawn[2];        /* the pictures whose refracted layers these are */
    const uint8_t *breaks[2];        /* two-phase, hybrid: front_kernels.breaks() of these layers */
    const float *planes;             /* planes of the world's triangles: unit normal, and its product with a point of the triangle */
    SearchWave waves[MGT_MAX_WAVES]; /* the first data.waves are set */
} narrow_scene;

/* The surface in the pixels of a tile. Coordinates are those of narrow_types.k, so y points to the camera's side. */
typedef struct tile_water {
    float share[TILE_PIXELS];     /* fraction of the pixel that is water; 0: the other members are not set */
    float column[TILE_PIXELS];    /* place of the ray in the image; pixel centres are at whole numbers */
    float row[TILE_PIXELS];       /* as `column` */
    float view[3][TILE_PIXELS];   /* unit direction of the ray */
    float along[TILE_PIXELS];     /* length of the ray to the surface, metres */
    float normal[3][TILE_PIXELS]; /* unit normal of the surface */
    float slopes[3][TILE_PIXELS]; /* WaterVariation.variance_*: covariance xx, xz, zz of the slopes that the pixel does not resolve */
    float bend[3][TILE_PIXELS];   /* WaterVariation.bend_*: second derivatives xx, xz, zz of the resolved waves, 1/metre */
    float path[3][TILE_PIXELS];   /* WaterVariation.path and path_along: change over the shutter of both slopes and of `along` */
} tile_water;

/* The ends of rays, see shade_hits. */
typedef struct tile_ends {
    int32_t triangle[TILE_PIXELS];
    float position[3][TILE_PIXELS];
    float direction[3][TILE_PIXELS];
    float before[TILE_PIXELS], after[TILE_PIXELS], water[TILE_PIXELS];
    float way[TILE_PIXELS];       /* metres from the ray's first hit with the surface to its last one; 0: there is one hit */
    float wet[TILE_PIXELS];       /* metres of `way` in water */
    float from[3][TILE_PIXELS];   /* the last hit with the surface, in the world's coordinates; not set where `way` is 0 */
    float part[TILE_PIXELS];      /* fraction of the light on this branch, SeenBehind.part */
    float unsure[TILE_PIXELS];    /* SeenBehind.unsure */
    float toward[3][TILE_PIXELS]; /* direction of the ray behind its first hit with the surface, in the world's coordinates; not set where `unsure` is 0 */
    float first[TILE_PIXELS];     /* 1: the ray is totally reflected at its first hit with the surface; else 0 */
    float spread[3][TILE_PIXELS]; /* shade_hits.spread */
    float terms[9][TILE_PIXELS];  /* the nine coefficients of Spread, which give the footprint for another `after`; set by distance-field, and by two-phase
                                     and hybrid in vectors with a doubtful pixel */
    float gain[TILE_PIXELS];      /* shade_hits.gain */
    float error[TILE_PIXELS];     /* point_error(), pixels; +inf: unknown */
    float total[TILE_PIXELS];     /* 1: the ray ends on the camera's side of the surface; else 0 */
    float doubt[TILE_PIXELS];     /* two-phase, hybrid: 1: the layers do not certify the answer; else 0 */
    int32_t pixel[TILE_PIXELS];   /* element of the layer that gave the answer; −1: none */
    int32_t last[TILE_PIXELS];    /* two-phase, hybrid: element of the layer at which the ray ends at infinity; −1: none */
} tile_ends;

typedef struct tile_offset {
    uint32_t column, row; /* the tile's first pixel in the image */
    float dx, dy;         /* place in every pixel that rays go through, in pixels from its centre */
} tile_offset;

/* Rays through places of a tile's pixels. */
typedef struct ray_places {
    size_t count;
    uint16_t pixel[TILE_PIXELS];            /* index of each ray's pixel in the tile */
    float dx[TILE_PIXELS], dy[TILE_PIXELS]; /* the ray's place, in pixels from that pixel's centre */
} ray_places;

struct narrow_kernels {
    /* Fills the filtered surface, over the time that the waves were sorted for. */
    void (*water)(const FrameData *frame, const tile_waves *tile, const tile_estimate *estimate, const tile_offset *at, tile_water *out);
    /* Fills the surface at the hits of other rays, one element per ray, from the surface at the pixels' centres. `share` of further elements is 0. */
    void (*beside)(const narrow_scene *n, const ray_places *places, const tile_water *water, tile_water *out);
    /* Finds the ends of rays behind the surface, on branch 0 or 1 of again.k. Branch 1 is filled only where out->part, which branch 0 has set, is that of a
       split ray. */
    void (*refracted)(const narrow_scene *n, const tile_water *water, int branch, tile_ends *out);
    /* Finds the ends of rays that the surface's mean slope mirrors. */
    void (*mirrored)(const narrow_scene *n, const tile_water *water, tile_ends *out);
    /* Finds the elements of a layer at even steps along the image of a ray; −1: outside of the layer. `from` is in coordinates of narrow_types.k; `after`: see
       place_along(). */
    void (*along)(const narrow_scene *n, int layer, const float from[3], const float direction[3], float after, int32_t pixels[SHARP_PLACES]);
};

#endif
