/* SPDX-License-Identifier: MIT
 * The objects that each pixel shows and their fractions of the pixel, for mattes. */
#ifndef MANGATA_CPU_OBJECT_IDS_H
#define MANGATA_CPU_OBJECT_IDS_H

#include "base/report.h"

enum { OBJECT_RANKS = 6, OBJECT_SIDE_MAX = 16 };

/* The labels that a pixel shows, by falling share; equal shares are sorted by label. Labels beyond OBJECT_RANKS are dropped. */
typedef struct object_shares {
    uint32_t label[OBJECT_RANKS];
    float share[OBJECT_RANKS]; /* fraction of the pixel; 0: there are no more labels */
} object_shares;

typedef struct object_ids_job {
    const mgt_scene *scene;                        /* a scene that mgt_scene_check() has found valid */
    const uint32_t *labels;                        /* labels of the scene's objects; objects of one label count as one */
    uint32_t sky, water;                           /* labels of sky and water */
    uint32_t side;                                 /* a pixel has side × side rays, 1 … OBJECT_SIDE_MAX */
    uint32_t threads;                              /* 0: one per usable processor */
    mgt_isa isa;                                   /* the bits do not depend on it */
    bool (*progress)(void *user, double fraction); /* called repeatedly; false: stop. NULL: no calls */
    void *user;
} object_ids_job;

/*
 * Fills `pixels`, the pixels of the scene's crop. The scene's seed jitters rays in strata of the pixel and of the open shutter. If the camera moves, all rays
 * are at the shutter's end. The fraction of a ray's light that the surface mirrors counts as water; the rest counts as what the ray meets behind the surface,
 * an object or the water. The bits depend neither on threads nor on the crop. Returns MGT_OK, MGT_ERROR_UNAVAILABLE in builds that cannot trace, MGT_CANCELLED,
 * or an error of memory or threads; after a failure the pixels are undefined.
 */
mgt_status object_ids_draw(const object_ids_job *job, const reporter *report, object_shares *pixels);

#endif
