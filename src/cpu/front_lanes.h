/* SPDX-License-Identifier: MIT
 * Edges of layers, and points of the front layer between them: functions that are compiled once per lane width. */
#ifndef MANGATA_CPU_FRONT_LANES_H
#define MANGATA_CPU_FRONT_LANES_H

#include "cpu/narrow_lanes.h"

/* The front layer and what its pixels are decided by. */
typedef struct front_scene {
    const gbuffer *layer;
    const uint8_t *edges;               /* rows of front_kernels.edges() */
    const float *planes;                /* planes of the world's triangles, as in narrow_scene */
    const float *dry;                   /* dry levels of their sides, see frame/dry.h; NULL: nothing is dry */
    float corner[3], right[3], down[3]; /* the camera's rays, see camera_rays */
    float foot[3];                      /* position of the camera in the world's coordinates */
    float pixel_angle;
    bool under;             /* the camera is under water */
    uint32_t columns, rows; /* size of the image */
} front_scene;

/* A pixel's place in front of the water: no object; inside an object; at an object's edge or at a waterline. */
enum { FRONT_NOTHING, FRONT_INSIDE, FRONT_EDGE };

/* Objects in front of the water in the pixels of a tile. Pixels outside of the image are FRONT_NOTHING. */
typedef struct tile_front {
    uint8_t kind[TILE_PIXELS];
    float *along;                 /* TILE_PIXELS values: distance along the ray of FRONT_INSIDE pixels, metres; else +inf */
    float (*normal)[TILE_PIXELS]; /* 3 planes: unit normal towards the camera; set where `along` is finite */
} tile_front;

struct front_kernels {
    /* Fills a row of marks of a refracted layer. 1: the surface that the pixel shows breaks off or bends beside it; else 0. `focal`: pixels per radian. */
    void (*breaks)(const gbuffer *g, const float *planes, float focal, uint32_t row, uint8_t *out);
    /* Fills a row of marks of the front layer, not the first or the last row. 1: a neighbour of the pixel does not continue its surface; else 0. */
    void (*edges)(const gbuffer *g, const float *planes, const uint32_t *objects, uint32_t row, uint8_t *out);
    /* Finds what the centres of the tile's pixels see in front of the water. Fills `ends` for pixels that are FRONT_INSIDE. */
    void (*points)(const front_scene *n, const tile_offset *at, const tile_water *water, tile_front *out, tile_ends *ends);
};

#endif
