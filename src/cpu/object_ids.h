/* SPDX-License-Identifier: MIT
 * Which objects each pixel shows, and how much of each: what mattes are cut out by. */
#ifndef MANGATA_CPU_OBJECT_IDS_H
#define MANGATA_CPU_OBJECT_IDS_H

#include "base/report.h"

enum { OBJECT_RANKS = 6, OBJECT_SIDE_MAX = 16 };

/* What a pixel shows, the largest share first. Those beyond OBJECT_RANKS are lost; equal shares stand in the order of their labels. */
typedef struct object_shares {
    uint32_t label[OBJECT_RANKS];
    float share[OBJECT_RANKS]; /* their sum is at most 1; 0: nothing more */
} object_shares;

typedef struct object_ids_job {
    const mgt_scene *scene;                        /* checked */
    const uint32_t *labels;                        /* of the scene's objects; objects of one label count as one */
    uint32_t sky, water;                           /* labels of what is no object */
    uint32_t side;                                 /* N of N × N rays a pixel, 1 … OBJECT_SIDE_MAX */
    uint32_t threads;                              /* 0: as many as there are */
    mgt_isa isa;                                   /* any gives the same bits */
    bool (*progress)(void *user, double fraction); /* called now and then; false stops. NULL: never */
    void *user;
} object_ids_job;

/*
 * Fills `pixels`, those of the scene's crop, by rays that the scene's seed jitters in strata of the pixel and of the open shutter (of its end where the
 * camera moves). A ray that meets the surface counts as water with the fraction of its light that is mirrored there, and with the rest as what it meets
 * behind: an object, or the water. The bits depend neither on threads nor on the crop. After MGT_ERROR_UNAVAILABLE, in builds that cannot trace, or
 * MGT_CANCELLED the pixels hold nothing of use.
 */
mgt_status object_ids_draw(const object_ids_job *job, const reporter *report, object_shares *pixels);

#endif
