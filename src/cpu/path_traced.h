/* SPDX-License-Identifier: MIT
 *
 * What the rays of a camera meet through the wavy surface as it is: every wave, double precision, rays traced against every triangle. The ground
 * truth of refraction, by equations of its own; only the light of what is met comes from the function that all methods use.
 */
#ifndef MANGATA_CPU_PATH_TRACED_H
#define MANGATA_CPU_PATH_TRACED_H

#include "cpu/path_dry.h"
#include "cpu/shade.h"
#include "trace/trace.h"

/*
 * A ray meets the surface first, is bent, and goes on. Where it meets the surface again, at a crest or from inside the water, it goes on both as
 * what is let through and as what is mirrored, each weighed by Fresnel's equations; parts below PATH_LEAST_WEIGHT of the pixel are let go, and a
 * part that met the surface PATH_MOST_EVENTS times ends there, in what lies in its direction far away. Radiance is not divided by the square of
 * the index of refraction. In air a surface inside dry hulls is none: rays pass it.
 */
#define PATH_LEAST_WEIGHT 0.001
#define PATH_MOST_EVENTS 8

typedef struct path_traced_job {
    const mgt_scene *scene; /* its mean surface is y = 0; refraction_samples and seed count */
    camera_rays camera;     /* at scene.time. position[1] < 0: under water. Unless it moves samples are spread over the shutter, one is of its middle */
    const world *world;
    const trace_scene *trace; /* of that world */
    const path_dry *dry;      /* likewise; NULL: nothing is dry */
    /* Radiance of what rays end at: points() of the shading kernels. `user` is its scene. */
    void (*shade)(const shade_scene *user, const shade_hits *hits, float *rgb); /* not needed by path_traced_see() */
    const shade_scene *user;
    mgt_isa isa; /* any gives the same bits */
    uint32_t workers;
} path_traced_job;

/* Means over the samples of a pixel. */
typedef struct path_traced_pixels {
    float water[TILE_PIXELS]; /* share of them that meet the surface, before any object */
    /* Radiance that comes through the surface, before Fresnel's share of it is taken; of total internal reflection, what is mirrored. A mean over
       the samples that meet the surface; 0 where none does */
    float red[TILE_PIXELS], green[TILE_PIXELS], blue[TILE_PIXELS];
    /* Radiance that the surface mirrors; where the job is for it, else left alone. */
    float mirrored_red[TILE_PIXELS], mirrored_green[TILE_PIXELS], mirrored_blue[TILE_PIXELS];
} path_traced_pixels;

typedef struct path_traced path_traced;

/* What `job` points to must outlive the result. MGT_ERROR_MEMORY; MGT_ERROR_UNAVAILABLE where the processor lacks the instruction set. */
mgt_status path_traced_create(path_traced **truth, const path_traced_job *job);
void path_traced_free(path_traced *truth); /* NULL is allowed */

/* Pixels of the tile (tile_x, tile_y) of the lattice, also those beyond the image. One call a worker at a time. `mirrored`: its planes are wanted,
 * too. The bits depend on the tile alone. */
void path_traced_tile(const path_traced *truth, uint32_t tile_x, uint32_t tile_y, uint32_t worker, bool mirrored, path_traced_pixels *out);

enum { SEEN_SKY = -1, SEEN_WATER = -2 };

/* What one ray through each pixel of a tile shows: the first object on its way through the surface, which mirrors it only where nothing goes through. */
typedef struct path_traced_seen {
    int32_t object[TILE_PIXELS]; /* of the scene, SEEN_WATER: none under the surface or in the water, SEEN_SKY: none in the air */
    float mirrored[TILE_PIXELS]; /* share of the light that the surface mirrors where the ray met it first; else 0 */
} path_traced_seen;

/* The same samples as path_traced_tile() takes: `sample` below the square of refraction_samples. */
void path_traced_see(const path_traced *truth, uint32_t tile_x, uint32_t tile_y, uint32_t worker, uint32_t sample, path_traced_seen *out);

#endif
