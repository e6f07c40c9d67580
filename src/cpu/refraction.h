/* SPDX-License-Identifier: MIT
 * Objects in the pixels of a tile: seen through the water's surface, mirrored by it, and in front of it. */
#ifndef MANGATA_CPU_REFRACTION_H
#define MANGATA_CPU_REFRACTION_H

#include "frame/backend.h"
#include "cpu/narrow_lanes.h"
#include "cpu/shade.h"
#include "cpu/path_traced.h"

/* Objects in the pixels of a tile. */
typedef struct tile_objects {
    tile_light light;                 /* for the methods that draw the water */
    float share[TILE_PIXELS];         /* fraction of the pixel that objects in front of water and sky cover */
    float color[3][TILE_PIXELS];      /* their mean radiance, kcd/m² */
    float along[TILE_PIXELS];         /* their distance along the ray, metres; +inf: `share` is below FRONT_SHOWS */
    float normal[3][TILE_PIXELS];     /* their unit normal towards the camera; set where `along` is finite */
    float refraction[3][TILE_PIXELS]; /* MGT_LAYER_REFRACTION */
    float error[TILE_PIXELS];         /* MGT_LAYER_REFRACTION_ERROR */
    float deep_known[TILE_PIXELS];    /* camera under water: 1 where light.deep is known, else 0 */
    /* Scratch memory from here on. */
    tile_water water;
    tile_ends ends;
    float rgb[3 * TILE_PIXELS];
    uint16_t list[TILE_PIXELS];
    float seen[TILE_PIXELS];      /* number of rays of the pixel that have met water */
    float edge[TILE_PIXELS];      /* 1: the layers do not certify what the pixel's last ray shows; else 0 */
    bool at_front[TILE_PIXELS];   /* the pixel is FRONT_EDGE */
    tile_water beside;            /* the water at the further rays of pixels at outlines */
    ray_places places;            /* the rays of `beside` */
    const tile_water *met;        /* `water` or `beside`: the one whose rays end at `ends` */
    float first[3 * TILE_PIXELS]; /* `rgb` of the first branch */
    trace_ray rays[TILE_PIXELS];
    trace_hit hits[TILE_PIXELS];
    path_traced_pixels truth;
} tile_objects;

typedef struct refraction refraction;

/*
 * Prepares what a frame with objects needs before its tiles. *r is NULL at first. What depends on the objects and the camera alone is kept between frames.
 * The frame, its scene and the sky must outlive the tiles. A failure is reported.
 */
mgt_status refraction_prepare(refraction **r, const reporter *report, const frame *f, const sky_state *sky, const lane_kernels *kernels, mgt_isa isa,
                              thread_pool *pool);
void refraction_free(refraction *r); /* NULL is allowed */

/* Logs numbers of triangles and of pixels after a frame's tiles. */
void refraction_report(const refraction *r, const reporter *report);

/* Fills *out for the tile (tile_x, tile_y). `waves` and `estimate` are those of the tile: filtered, for frame.through, over the shutter or, if the camera
 * moves, at one of its ends. One call per worker at a time. */
void refraction_tile(refraction *r, const tile_waves *waves, const tile_estimate *estimate, uint32_t tile_x, uint32_t tile_y, uint32_t worker,
                     tile_objects *out);

/* Objects in the pixels of a tile when the shutter opens. */
typedef struct tile_opened {
    tile_light light;
    float share[TILE_PIXELS], color[3][TILE_PIXELS], deep_known[TILE_PIXELS];
} tile_opened;

/* The state for the camera when the shutter opens; NULL: it does not move, or the method is path-traced, which takes the camera of the closing shutter
 * alone. */
refraction *refraction_opened(const refraction *r);

/* Copies what refraction_blend() needs of the opening shutter. */
void refraction_keep(const tile_objects *o, tile_opened *opened);
/* Replaces `light`, `share` and `color` by means over both ends of the shutter. `under`: the camera is under water. */
void refraction_blend(tile_objects *o, const tile_opened *opened, bool under);

/* Whether objects in front of the water cover the whole tile. */
bool refraction_covers(const tile_objects *o);

/* Copies the light of `count` listed pixels. Elements behind the last one repeat it. */
void light_of_pixels(const tile_light *light, const uint16_t *pixels, size_t count, tile_light *out);

/* Composes objects in front over a tile's pixels, and over its depths and normals; either may be NULL. */
void refraction_compose(const tile_objects *o, tile_pixels *pixels, tile_surface *surface);

#endif
