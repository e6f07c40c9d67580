/* SPDX-License-Identifier: MIT
 *
 * Refraction path-traced: rays of a camera are traced through the wavy surface, with every wave, in double precision, and against every triangle. It is the
 * reference of refraction and shares no equation with the other methods, except for the light of what rays end at.
 */
#ifndef MANGATA_CPU_PATH_TRACED_H
#define MANGATA_CPU_PATH_TRACED_H

#include "cpu/path_dry.h"
#include "cpu/shade.h"
#include "trace/trace.h"

/*
 * At its first hit with the surface a ray is refracted, or mirrored if it is totally reflected. At each further hit, at a crest or from inside the water, it is
 * split into a refracted and a mirrored part, weighted by Fresnel's equations. Parts below PATH_LEAST_WEIGHT of the sample are dropped. A part that has met the
 * surface PATH_MOST_EVENTS times ends in the sky or the deep water of its direction. Rays in air pass the surface inside of dry hulls.
 */
#define PATH_LEAST_WEIGHT 0.001
#define PATH_MOST_EVENTS 8

typedef struct path_traced_job {
    const mgt_scene *scene; /* the scene at sea level; quality.refraction_samples and quality.seed are read */
    camera_rays camera; /* the camera at scene.time; under water if position[1] < 0. While it stands still, samples are spread over the shutter, and a single
                               one is at its middle. Samples of a moving camera are at scene.time */
    const world *world;
    const trace_scene *trace;                                                   /* ray tracer over `world` */
    const path_dry *dry;                                                        /* dry hulls of `world`; NULL: nothing is dry */
    void (*shade)(const shade_scene *user, const shade_hits *hits, float *rgb); /* shade_kernels.points(); path_traced_see() does not call it */
    const shade_scene *user;                                                    /* argument of `shade` */
    mgt_isa isa;                                                                /* the bits do not depend on it */
    uint32_t workers;
} path_traced_job;

/* Means over the samples of each pixel. */
typedef struct path_traced_pixels {
    float water[TILE_PIXELS]; /* fraction of the samples that meet the surface before any object */
    /* Mean radiance that comes through the surface, before the factor 1 − Fresnel's reflectance, over the samples that meet the surface. A sample that is
       totally reflected counts with its mirrored radiance. 0: no sample meets the surface. */
    float red[TILE_PIXELS], green[TILE_PIXELS], blue[TILE_PIXELS];
    /* Mean radiance that the surface mirrors, before the factor of Fresnel's reflectance, over the same samples. Set if `mirrored` is true. */
    float mirrored_red[TILE_PIXELS], mirrored_green[TILE_PIXELS], mirrored_blue[TILE_PIXELS];
    /* 1: no sample meets the surface before an object, although `front` says that objects do not hide the water of the whole pixel. So the pixel lies on a
       waterline, and both radiances are that of the object which its first sample meets. 0: other pixels. */
    float object[TILE_PIXELS];
} path_traced_pixels;

typedef struct path_traced path_traced;

/* What `job` points to must outlive the result. Returns MGT_OK, MGT_ERROR_MEMORY, or MGT_ERROR_UNAVAILABLE: the processor lacks the instruction set. */
mgt_status path_traced_create(path_traced **truth, const path_traced_job *job);
void path_traced_free(path_traced *truth); /* NULL is allowed */

/* Fills *out for the tile (tile_x, tile_y) of the lattice, also beyond the image. `mirrored`: the mirrored radiance is wanted, too. `front`: fraction of each
 * pixel that is hidden by objects in front of the water. One call per worker at a time. The bits depend on the tile alone. */
void path_traced_tile(const path_traced *truth, uint32_t tile_x, uint32_t tile_y, uint32_t worker, bool mirrored, const float *front, path_traced_pixels *out);

enum { SEEN_SKY = -1, SEEN_WATER = -2 };

/* The first objects that one ray through each pixel of a tile meets. At the surface a ray is refracted, and mirrored only if it is totally reflected. */
typedef struct path_traced_seen {
    int32_t object[TILE_PIXELS]; /* object of the scene; SEEN_WATER: none, and the ray of a camera in air has met the surface, or that of a camera under water
                                    ends in water; SEEN_SKY: none otherwise */
    float mirrored[TILE_PIXELS]; /* reflectance of the surface at the ray's first hit; 0: it does not meet the surface */
} path_traced_seen;

/* Traces one of the samples that path_traced_tile() takes. `sample` is below the square of refraction_samples. */
void path_traced_see(const path_traced *truth, uint32_t tile_x, uint32_t tile_y, uint32_t worker, uint32_t sample, path_traced_seen *out);

#endif
