/* SPDX-License-Identifier: MIT
 * Rays against triangles: the nearest one they meet, and whether they meet any. By Embree; src/trace/missing in builds without it.
 *
 * Embree only says which triangle a ray meets first, in arithmetic that is the same on every processor with AVX2 and AVX-512, whatever rays are
 * asked beside it and however its tree was built. Distance and place on the triangle are computed again here, in double precision. */
#ifndef MANGATA_TRACE_TRACE_H
#define MANGATA_TRACE_TRACE_H

#include "core/backend.h"

typedef struct trace_ray {
    float origin[3], direction[3]; /* in the triangles' coordinates; the direction has any length … */
    float least, most;             /* … and distances count in it: hits nearer than `least` or beyond `most` do not count */
} trace_ray;

typedef struct trace_hit {
    float along;      /* in lengths of the ray's direction; +inf: nothing */
    int32_t triangle; /* −1: nothing */
    float u, v;       /* the hit is (1 − u − v)·corner 0 + u·corner 1 + v·corner 2 */
} trace_hit;

/* Triangles to trace against; read while a trace_scene_update() runs and, for hits, as long as the scene is in use. */
typedef struct trace_triangles {
    size_t count;        /* 0 … MGT_MAX_TRIANGLES */
    const float *corners; /* of the first one: 9 numbers, x y z of each corner … */
    size_t stride;       /* … and floats from a triangle to the next one, ≥ 9 */
    uint64_t version;    /* another one whenever the triangles are others */
} trace_triangles;

typedef struct trace_scene trace_scene;

bool trace_available(void);

/* *scene: NULL at first. Nothing is done where it holds this version already. `threads` build the tree, 0: as many as there are. On failure *scene
 * is as it was. */
mgt_status trace_scene_update(trace_scene **scene, const trace_triangles *triangles, uint32_t threads, const reporter *r);
void trace_scene_free(trace_scene *scene); /* NULL is allowed */

/* Bytes that the tree and its copy of the triangles take. */
size_t trace_scene_bytes(const trace_scene *scene);

/* Any number of threads may ask one scene at once. A direction of length 0 and rays that are not finite meet nothing. */
void trace_nearest(const trace_scene *scene, size_t count, const trace_ray *rays, trace_hit *hits);

/* 1 where something lies between least and most, else 0. */
void trace_occluded(const trace_scene *scene, size_t count, const trace_ray *rays, uint8_t *occluded);

#endif
