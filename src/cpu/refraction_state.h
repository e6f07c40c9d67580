/* SPDX-License-Identifier: MIT
 * What a frame with objects keeps for its tiles, and between frames. */
#ifndef MANGATA_CPU_REFRACTION_STATE_H
#define MANGATA_CPU_REFRACTION_STATE_H

#include <stdatomic.h>

#include "cpu/distance_field.h"
#include "cpu/front_lanes.h"
#include "cpu/refraction.h"
#include "cpu/path_traced.h"
#include "trace/trace.h"

/* A byte a pixel of a layer. */
typedef struct layer_marks {
    uint8_t *bytes;
    size_t size;
    uint64_t drawn; /* gbuffers.drawn of what was marked */
} layer_marks;

/* What the way over a surface asks of a triangle, in a line of the cache. */
typedef struct surface_triangle {
    float corners[3][3];   /* metres, in the world's coordinates */
    int32_t neighbours[3]; /* as those of the world */
    float normal[3];       /* of its plane */
    float padding;
} surface_triangle;

struct refraction {
    world *world;
    gbuffers direct, mirrored; /* the camera's layers, and those of its mirror image */
    float *planes;             /* 4 a triangle */
    surface_triangle *surface; /* 1 a triangle */
    size_t plane_room;         /* triangles */
    uint64_t plane_version;    /* of the world that they are of */
    shade_scene *shade;
    trace_scene *trace;           /* NULL until a method traces */
    distance_field *field;        /* NULL until a method marches through it */
    path_traced *truth;           /* of this frame, for that method */
    path_dry *dry;                /* likewise; NULL: nothing is dry */
    layer_marks edges, breaks[2]; /* of the front layer; of narrow.layers, where the method asks */
    narrow_scene narrow;
    front_scene front;
    const lane_kernels *kernels;
    const frame *frame;
    camera_rays camera;           /* as it is, not mirrored */
    bool mirrors;                 /* something stands on the camera's side, or water does */
    atomic_size_t pixels, traced; /* of water, of this frame; and rays traced through them */
    /* The same where the camera is when the shutter opens, NULL until one moves: layers and `moved` are its own, the rest is lent. */
    refraction *opened;
    frame moved;
};

/* Marks what the layers' last drawing changed; false: out of memory. */
bool refraction_mark(refraction *r, thread_pool *pool);
void refraction_marks_free(refraction *r);

/* Radiance of the tile's first `count` ends, in o->rgb. */
void refraction_shade(const refraction *r, tile_objects *o, size_t count);

/* The same of the ends of the pixels in o->list, which rises, in its order; the ends move together. */
void refraction_shade_listed(const refraction *r, tile_objects *o, size_t count);

/* From o->rgb to the pixels in o->list. */
void refraction_spread(const tile_objects *o, size_t count, float (*planes)[TILE_PIXELS]);

/* What stands in front of water and sky in the tile whose first pixel this is; the water must be known. */
void refraction_front(const refraction *r, uint32_t column, uint32_t row, tile_objects *o);

/* Whether an object in front hides the water in a place of the tile's pixel i, (x, y) pixels from its centre. o->water is known there, or at the centre. */
bool refraction_is_hidden(const refraction *r, const tile_offset *at, const tile_objects *o, size_t i, float x, float y);

enum { REFRACTION_NEIGHBOURS = 9 };

/* The triangles, each once, that an element of a layer and those around it show; those on the layer's edge count as far as they have neighbours.
 * Returns how many. */
size_t refraction_neighbours(const gbuffer *g, size_t element, int32_t triangles[REFRACTION_NEIGHBOURS]);

/* Ends a pixel's ray `last` metres behind where it met the surface last: `after`, `water` and the footprint. */
void refraction_end_at(const refraction *r, tile_objects *o, size_t i, float last);

/* Where what a layer shows breaks off or bends, the pixel of the answer is not enough: the rays of doubtful ends among the listed ones meet the
 * surfaces that it and its neighbours show, and the nearest one counts. */
void refraction_sharpen(const refraction *r, tile_objects *o, size_t count);

#endif
