/* SPDX-License-Identifier: MIT
 * Rays against triangles: the nearest one they meet, and whether they meet any. By Embree; src/trace/missing in builds without it.
 *
 * Embree only says which triangle a ray meets first, in arithmetic that is the same on every processor with AVX2, AVX-512 or both, whatever threads
 * built its tree. Distance and place on the triangle are computed again here, in double precision. */
#ifndef MANGATA_TRACE_TRACE_H
#define MANGATA_TRACE_TRACE_H

#include "base/report.h"

typedef struct trace_ray {
    float origin[3], direction[3]; /* in the triangles' coordinates; the direction has any length, which is the unit of distances */
    float least, most;             /* hits nearer than `least` or beyond `most` do not count */
} trace_ray;

typedef struct trace_hit {
    float along;      /* in lengths of the ray's direction; +inf: nothing */
    int32_t triangle; /* −1: nothing */
    float u, v;       /* the hit is (1 − u − v)·corner 0 + u·corner 1 + v·corner 2 */
} trace_hit;

/* Triangles to trace against. The scene refers to the arrays, so they must stay as long as it is asked. */
typedef struct trace_triangles {
    size_t count; /* 0 … MGT_MAX_TRIANGLES */
    size_t vertex_count;
    const float *positions;  /* 3 a vertex, and one number more that can be read */
    const uint32_t *indices; /* 3 a triangle */
    uint64_t version;        /* another one whenever the triangles are others */
} trace_triangles;

typedef struct trace_scene trace_scene;

bool trace_available(void);

/* *scene: NULL at first. Nothing is done where it holds this version already. `threads` build the tree, 0: as many as there are. On failure *scene
 * is as it was. */
mgt_status trace_scene_update(trace_scene **scene, const trace_triangles *triangles, uint32_t threads, const reporter *r);
void trace_scene_free(trace_scene *scene); /* NULL is allowed */

/* Bytes that the tree takes. */
size_t trace_scene_bytes(const trace_scene *scene);

/* Any number of threads may ask one scene at once. Rays that start near each other and go the same way are fastest in one call. The same call gives
 * the same bits; another one may name the other triangle where a ray meets an edge of two to the last bits, so that pictures whose bytes must not
 * depend on tiles or crops ask for the rays of a lattice of their own. Between two triangles with an edge in common no ray slips through; exactly
 * through a vertex some few do. A direction of length 0 and rays that are not finite meet nothing. */
void trace_nearest(const trace_scene *scene, size_t count, const trace_ray *rays, trace_hit *hits);

/* 1 where something lies between least and most, else 0. */
void trace_occluded(const trace_scene *scene, size_t count, const trace_ray *rays, uint8_t *occluded);

#endif
