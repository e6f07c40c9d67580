/* SPDX-License-Identifier: MIT
 * Refraction distance-field, a baseline: rays are marched through voxels of distances, after D. Rodgman and M. Chen, Refraction in Discrete Ray Tracing, Volume
 * Graphics 2001. */
#ifndef MANGATA_CPU_DISTANCE_FIELD_H
#define MANGATA_CPU_DISTANCE_FIELD_H

#include "base/thread_pool.h"
#include "frame/world.h"
#include "trace/trace.h"

/* Side of a voxel, metres, and largest size of all voxels, bytes. Voxels are larger where they would exceed that size. */
#define DISTANCE_FIELD_VOXEL 0.05
#define DISTANCE_FIELD_BYTES ((size_t)512 << 20)

/* Distance in metres to the nearest triangle, and that triangle, at the points of a grid. Distances are exact near triangles and nowhere too large. A point
 * takes 8 bytes. */
typedef struct distance_field {
    uint64_t version; /* world.version */
    float voxel;      /* metres between points */
    float low[3];     /* position of the first point */
    uint32_t size[3]; /* number of points along x, y and z; 0: the world is empty */
    float *distance;
    int32_t *triangle;
} distance_field;

/* Rebuilds *field unless it is that of this version of the world. *field is NULL at first, and after MGT_ERROR_MEMORY. The values do not depend on the pool. */
mgt_status distance_field_update(distance_field **field, const world *w, thread_pool *pool, const reporter *r);
void distance_field_free(distance_field *field); /* NULL is allowed */
size_t distance_field_bytes(const distance_field *field);

/* Finds hits as trace_nearest() does, with these differences: directions must be unit vectors; a ray hits where the interpolated distance falls below half a
 * voxel; the triangle is that of the nearest point of the grid; u and v are 0. */
void distance_field_nearest(const distance_field *field, size_t count, const trace_ray *rays, trace_hit *hits);

#endif
