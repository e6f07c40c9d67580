/* SPDX-License-Identifier: MIT
 * The light that comes from points of objects, and from where rays meet none: one function for every way to find them. */
#ifndef MANGATA_CPU_SHADE_H
#define MANGATA_CPU_SHADE_H

#include "frame/shade_scene.h"

/*
 * Where rays of a camera have ended. Every pointer leads to `count` numbers.
 */
typedef struct shade_hits {
    size_t count;
    const int32_t *triangle;   /* of the world; −1: the ray meets nothing, and ends in the sky or in deep water as its direction says */
    const float *position[3];  /* x, y, z in the world's coordinates; not read where there is no triangle */
    const float *direction[3]; /* unit, in which the ray goes when it ends */
    const float *before;       /* metres from the camera to the water's surface, or to the hit where it meets no surface */
    const float *after;        /* metres from the surface to the hit */
    const float *water;        /* metres of both that lie in water; where nothing is met, those before the ray left the water for good */
    const float *spread[3];    /* covariance side side, side rise, rise rise of what the ray covers, as in footprint.k */
    const float *gain;         /* radiance at the camera over that at the end: its index of refraction over the end's, squared; NULL: 1 */
} shade_hits;

/* Compiled once per lane width. */
typedef struct shade_kernels {
    /* Radiance that arrives at the near end of each ray, kcd/m²: 3 floats a hit. What the water on the way takes and adds is counted; Fresnel's share at
       its surface and the light's disk in the sky are not. The bits depend on the hit alone. Any number of threads at once. */
    void (*points)(const shade_scene *s, const shade_hits *hits, float *rgb);
    /* What objects leave of the light's disk over points of the mean surface, (x, 0, z) in the world's coordinates, and `way` metres of water between
       them and the eye, 0 above the surface: disk_through_water() of water_path.k. Three planes of `count` numbers. */
    void (*disk)(const shade_scene *s, size_t count, const float *x, const float *z, const float *way, float *const clear[3]);
} shade_kernels;

#endif
