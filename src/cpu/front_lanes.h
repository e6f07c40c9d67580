/* SPDX-License-Identifier: MIT
 * Edges of layers, and what the front one shows between them: functions that are compiled once per lane width. */
#ifndef MANGATA_CPU_FRONT_LANES_H
#define MANGATA_CPU_FRONT_LANES_H

#include "cpu/narrow_lanes.h"

/* What objects in front of the water are looked up in. */
typedef struct front_scene {
    const gbuffer *layer;
    const uint8_t *edges;               /* as front_kernels.edges sets them */
    const float *planes;                /* of the world's triangles, as in narrow_scene */
    const float *dry;                   /* levels of their sides, see frame/dry.h; NULL: none is dry */
    float corner[3], right[3], down[3]; /* rays of the camera */
    float foot[3];                      /* the camera, in the world's coordinates */
    float pixel_angle;
    bool under;
    uint32_t columns, rows; /* of the image */
} front_scene;

enum { FRONT_NOTHING, FRONT_INSIDE, FRONT_EDGE };

/* In pixels within the image; others are FRONT_NOTHING. */
typedef struct tile_front {
    uint8_t kind[TILE_PIXELS];
    float *along;                 /* TILE_PIXELS: metres along the ray where the pixel is FRONT_INSIDE; else +inf */
    float (*normal)[TILE_PIXELS]; /* 3 planes: unit, towards the camera; there alone */
} tile_front;

struct front_kernels {
    /* Of a row of a refracted layer: 1 where what it shows breaks off or bends next to a pixel, else 0. focal: pixels in a radian. */
    void (*breaks)(const gbuffer *g, const float *planes, float focal, uint32_t row, uint8_t *out);
    /* Of a row of the front layer, neither the first nor the last one: 1 where a neighbour of a pixel shows something else, else 0. */
    void (*edges)(const gbuffer *g, const float *planes, const uint32_t *objects, uint32_t row, uint8_t *out);
    /* What the centres of a tile's pixels see in front of the water; `ends` of those inside. */
    void (*points)(const front_scene *n, const tile_offset *at, const tile_water *water, tile_front *out, tile_ends *ends);
};

#endif
