/* SPDX-License-Identifier: MIT
 * Scenes with objects: what the pixels of a tile see of them, through the water's surface, mirrored by it and in front of it. */
#ifndef MANGATA_CPU_REFRACTION_H
#define MANGATA_CPU_REFRACTION_H

#include "frame/backend.h"
#include "cpu/narrow_lanes.h"
#include "cpu/shade.h"
#include "cpu/path_traced.h"

/* What objects are to the pixels of a tile. */
typedef struct tile_objects {
    tile_light light; /* through the surface and mirrored by it: for the methods that draw the water */
    /* In front of water and sky. */
    float share[TILE_PIXELS];     /* of the pixel */
    float color[3][TILE_PIXELS];  /* kcd/m², of that share */
    float along[TILE_PIXELS];     /* metres along the ray, where the share is most of the pixel; else +inf */
    float normal[3][TILE_PIXELS]; /* unit, towards the camera; there alone */
    /* Layers. */
    float refraction[3][TILE_PIXELS];
    float error[TILE_PIXELS];
    /* Room to work in. */
    tile_water water;
    tile_ends ends;
    float rgb[3 * TILE_PIXELS];
    uint16_t list[TILE_PIXELS];
    float seen[TILE_PIXELS];      /* places of a pixel that met water */
    float edge[TILE_PIXELS];      /* 1 where pictures do not certify what is seen through the last one, else 0 */
    bool at_front[TILE_PIXELS];   /* the pixel sees an edge of an object in front, or a waterline */
    tile_water beside;            /* the water in other places of pixels at outlines */
    ray_places places;            /* the places of `beside` */
    const tile_water *met;        /* `water` or `beside`: the one whose rays `ends` are of */
    float first[3 * TILE_PIXELS]; /* rgb of their first branch */
    trace_ray rays[TILE_PIXELS];
    trace_hit hits[TILE_PIXELS];
    path_traced_pixels truth;
} tile_objects;

typedef struct refraction refraction;

/*
 * Everything that a frame with objects needs before its tiles, in *r, which is NULL at first; what depends on the objects and the camera alone stays
 * between frames. The frame, its scene and the sky must outlive the tiles. On failure the report says why.
 */
mgt_status refraction_prepare(refraction **r, const reporter *report, const frame *f, const sky_state *sky, const lane_kernels *kernels, mgt_isa isa,
                              thread_pool *pool);
void refraction_free(refraction *r); /* NULL is allowed */

/* Tells the log, after a frame's tiles, what they took. */
void refraction_report(const refraction *r, const reporter *report);

/* Objects in the tile (tile_x, tile_y). `waves` and `estimate`: sorted for the tile, filtered, over frame_shutter(). One call a worker at a time. */
void refraction_tile(refraction *r, const tile_waves *waves, const tile_estimate *estimate, uint32_t tile_x, uint32_t tile_y, uint32_t worker,
                     tile_objects *out);

/* What the tile saw of objects when the shutter opened. */
typedef struct tile_opened {
    tile_light light;
    float share[TILE_PIXELS], color[3][TILE_PIXELS];
} tile_opened;

/* Where the camera is when the shutter opens; NULL unless it moves. The ground truth knows no other camera than the last one. */
refraction *refraction_opened(const refraction *r);

/* Mean of both ends of the shutter, but for the layers. */
void refraction_keep(const tile_objects *o, tile_opened *opened);
void refraction_blend(tile_objects *o, const tile_opened *opened);

/* Whether objects in front leave nothing else of the tile. */
bool refraction_covers(const tile_objects *o);

/* Planes of `count` places, each with the light of a pixel of the tile. */
void light_of_pixels(const tile_light *light, const uint16_t *pixels, size_t count, tile_light *out);

/* Puts what stands in front before a tile's pixels, and before its layers of depth and normals; either may be NULL. */
void refraction_compose(const tile_objects *o, tile_pixels *pixels, tile_surface *surface);

#endif
