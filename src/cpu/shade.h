/* SPDX-License-Identifier: MIT
 * The light at the ends of rays: of points of objects, the sky, or deep water. All refraction methods share it. */
#ifndef MANGATA_CPU_SHADE_H
#define MANGATA_CPU_SHADE_H

#include "frame/shade_scene.h"

/* The ends of rays of a camera. Every pointer leads to `count` numbers. */
typedef struct shade_hits {
    size_t count;
    const int32_t *triangle;   /* triangle of the world; −1: the ray meets none and ends in the sky or in deep water, by its direction */
    const float *position[3];  /* x, y, z in the world's coordinates; not read if `triangle` is −1 */
    const float *direction[3]; /* unit direction of the ray at its end */
    const float *before;       /* metres from the camera to the water's surface, or to the end if the ray meets no surface */
    const float *after;        /* metres from the surface to the end */
    const float *water; /* metres of both that lie in water; if `triangle` is −1, the metres before the ray leaves the water for good; IN_DRY_HULL: the end
                                  lies in a dry hull */
    const float *spread[3]; /* covariance side side, side rise, rise rise of the ray's footprint, see footprint.k */
    const float *gain;      /* radiance at the camera over that at the end: (index of refraction at the camera / that at the end)²; NULL: 1 */
} shade_hits;

/* Functions that are compiled once per lane width. */
typedef struct shade_kernels {
    /* Computes the radiance that arrives at the near end of each ray, kcd/m², 3 floats per hit. It includes what the water on the way absorbs and scatters, but
       neither Fresnel's factor at its surface nor the light's disk in the sky. The bits depend on the hit alone. Any number of threads at once. */
    void (*points)(const shade_scene *s, const shade_hits *hits, float *rgb);
    /* Computes the fraction of the light's disk that objects above points of the mean surface and `way` metres of water between these points and the eye let
       through: disk_through_water() of water_path.k. Points are (x, 0, z) in the world's coordinates. `way` is 0 for an eye above the water. Fills three planes
       of `count` numbers. */
    void (*disk)(const shade_scene *s, size_t count, const float *x, const float *z, const float *way, float *const clear[3]);
} shade_kernels;

#endif
