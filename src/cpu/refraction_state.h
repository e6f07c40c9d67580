/* SPDX-License-Identifier: MIT
 * What a frame with objects keeps for its tiles, and between frames. */
#ifndef MANGATA_CPU_REFRACTION_STATE_H
#define MANGATA_CPU_REFRACTION_STATE_H

#include <stdatomic.h>

#include "cpu/distance_field.h"
#include "cpu/refraction.h"
#include "reference/refraction_truth.h"
#include "trace/trace.h"

struct refraction {
    world *world;
    gbuffers direct, mirrored; /* the camera's layers, and those of its mirror image */
    float *planes;             /* 4 a triangle */
    size_t plane_room;         /* triangles */
    uint64_t plane_version;    /* of the world that they are of */
    shade_scene *shade;
    trace_scene *trace;        /* NULL until a method traces */
    distance_field *field;     /* NULL until a method marches through it */
    refraction_truth *truth;   /* of this frame, for that method */
    narrow_scene narrow;
    const lane_kernels *kernels;
    const frame *frame;
    camera_rays camera;        /* as it is, not mirrored */
    bool mirrors;              /* something stands on the camera's side, or water does */
    atomic_size_t pixels, traced; /* of water, of this frame; and rays traced through them */
};

/* Radiance of the tile's first `count` ends, in o->rgb. */
void refraction_shade(const refraction *r, tile_objects *o, size_t count);

/* What stands in front of water and sky in the tile whose first pixel this is; the water must be known. */
void refraction_near(const refraction *r, uint32_t column, uint32_t row, tile_objects *o);

#endif
