/* SPDX-License-Identifier: MIT
 * The state of refraction: data for the tiles of a frame with objects, of which some is kept between frames. */
#ifndef MANGATA_CPU_REFRACTION_STATE_H
#define MANGATA_CPU_REFRACTION_STATE_H

#include <stdatomic.h>

#include "cpu/distance_field.h"
#include "cpu/front_lanes.h"
#include "cpu/refraction.h"
#include "cpu/path_traced.h"
#include "trace/trace.h"

/* One byte per pixel of a layer. */
typedef struct layer_marks {
    uint8_t *bytes;
    size_t size;
    uint64_t drawn; /* gbuffers.drawn of the drawing that was marked */
} layer_marks;

/* Data that surfaces.k reads of a triangle. Its size is that of a cache line. */
typedef struct surface_triangle {
    float corners[3][3];   /* metres, in the world's coordinates */
    int32_t neighbours[3]; /* those of world.neighbours */
    float normal[3];       /* unit normal of its plane */
    float padding;
} surface_triangle;

struct refraction {
    world *world;
    gbuffers direct, mirrored; /* layers of the camera and of its mirror image */
    float *planes;             /* 4 floats per triangle */
    surface_triangle *surface; /* one per triangle */
    size_t plane_room;         /* number of triangles that `planes` and `surface` have memory for */
    uint64_t plane_version;    /* world.version of `planes` and `surface` */
    shade_scene *shade;
    trace_scene *trace;    /* NULL until a method traces rays */
    distance_field *field; /* NULL until a frame has method distance-field */
    path_traced *truth;    /* method path-traced: renderer of this frame; else NULL */
    path_dry *dry;         /* dry hulls of method path-traced; NULL: nothing is dry */
    layer_marks edges;     /* front_kernels.edges() of the front layer */
    layer_marks breaks[2]; /* front_kernels.breaks() of narrow.layers, for methods that read it */
    narrow_scene narrow;
    front_scene front;
    const lane_kernels *kernels;
    const frame *frame;
    camera_rays camera;           /* the camera itself, which frame.close mirrors under water */
    bool mirrors;                 /* refraction_mirrors(): the surface may mirror something besides the sky */
    atomic_size_t pixels, traced; /* pixels of water in this frame, and rays traced through them */
    refraction *opened;           /* the state for the camera when the shutter opens; it owns its layers, marks and `moved`; NULL until a camera moves */
    frame moved;                  /* in `opened` alone: the frame with that camera */
};

/* Updates the marks to the layers' last drawing. False: out of memory. */
bool refraction_mark(refraction *r, thread_pool *pool);
void refraction_marks_free(refraction *r);

/* Fills o->rgb with the radiance of the first `count` of o->ends. */
void refraction_shade(const refraction *r, tile_objects *o, size_t count);

/* Fills o->rgb with the radiance of the ends of the first `count` pixels in o->list, which is sorted. The ends are moved to the front of o->ends. */
void refraction_shade_listed(const refraction *r, tile_objects *o, size_t count);

/* Copies o->rgb to the planes' elements of the pixels in o->list. */
void refraction_spread(const tile_objects *o, size_t count, float (*planes)[TILE_PIXELS]);

/* Fills what stands in front of water and sky in the tile whose first pixel is (column, row). o->water must be filled. */
void refraction_front(const refraction *r, uint32_t column, uint32_t row, tile_objects *o);

/* Whether an object in front hides the water at a place of the tile's pixel i, (x, y) pixels from its centre. o->water must be filled, at that place or at the
 * centre. */
bool refraction_is_hidden(const refraction *r, const tile_offset *at, const tile_objects *o, size_t i, float x, float y);

enum { REFRACTION_NEIGHBOURS = 9 };

/* Lists the triangles, each once, that an element of a layer and its eight neighbours show. Neighbours outside of the layer are left out. Returns the number of
 * triangles. */
size_t refraction_neighbours(const gbuffer *g, size_t element, int32_t triangles[REFRACTION_NEIGHBOURS]);

/* Moves the end of a pixel's ray to `last` metres behind its last hit with the surface: sets `after`, `water` and the footprint. */
void refraction_end_at(const refraction *r, tile_objects *o, size_t i, float last);

/* Intersects the rays of doubtful ends, among the first `count` pixels of o->list, with the surfaces that the answer's pixel and its neighbours show. The
 * nearest hit replaces the end, because a surface that breaks off or bends there makes the answer's pixel unreliable. */
void refraction_sharpen(const refraction *r, tile_objects *o, size_t count);

#endif
