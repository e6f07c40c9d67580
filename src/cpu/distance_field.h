/* SPDX-License-Identifier: MIT
 * Rays marched through voxels of distances, after D. Rodgman and M. Chen, Refraction in Discrete Ray Tracing, Volume Graphics 2001: a baseline. */
#ifndef MANGATA_CPU_DISTANCE_FIELD_H
#define MANGATA_CPU_DISTANCE_FIELD_H

#include "base/thread_pool.h"
#include "frame/world.h"
#include "trace/trace.h"

/* The side of a voxel, metres, and what all of them may take; where they would take more they are larger. */
#define DISTANCE_FIELD_VOXEL 0.05
#define DISTANCE_FIELD_BYTES ((size_t)512 << 20)

/* At a grid of points: metres to the nearest triangle, and which one that is. Near the triangles exact, elsewhere never too far. 8 bytes a voxel. */
typedef struct distance_field {
    uint64_t version; /* the world's */
    float voxel;
    float low[3];     /* the first point */
    uint32_t size[3]; /* points along x, y, z; 0 where the world is empty */
    float *distance;
    int32_t *triangle;
} distance_field;

/* *field: NULL at first; nothing is done where it is the world's already. The numbers do not depend on the pool. MGT_ERROR_MEMORY leaves it NULL. */
mgt_status distance_field_update(distance_field **field, const world *w, thread_pool *pool, const reporter *r);
void distance_field_free(distance_field *field); /* NULL is allowed */
size_t distance_field_bytes(const distance_field *field);

/* As trace_nearest(), but directions are unit, and hits are where the interpolated distance falls below half a voxel, of the triangle that the nearest
 * point of the grid knows; u and v are 0. */
void distance_field_nearest(const distance_field *field, size_t count, const trace_ray *rays, trace_hit *hits);

#endif
