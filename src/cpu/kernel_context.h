/* SPDX-License-Identifier: MIT
 * What the accessors of the kernels read on the CPU. */
#ifndef MANGATA_CPU_KERNEL_CONTEXT_H
#define MANGATA_CPU_KERNEL_CONTEXT_H

#include "frame/kernel_data.h"
#include "frame/podee_tables.h"

/* What a kernel can reach through its accessors. */
struct kernel_context {
    const FrameData *frame;
    const TileData *tile;
    const WaveData *waves;
    const SearchWave *search;
    const float *sky;                  /* SKY_ROWS × SKY_COLUMNS × 3 */
    const ViewData *view;              /* only while tiles are sorted */
    const podee_tables *podee;         /* only where podee-* replaces its Gaussian by kernels */
    const struct lean_map *lean;       /* methods lean and leadr alone */
    const RefractData *refract;        /* scenes with objects alone, as what follows */
    const PictureData *picture;        /* only where triangles are drawn */
    const struct shade_scene *shade;   /* only where objects are shaded */
    const struct narrow_scene *narrow; /* only where objects are looked for */
    struct tile_estimate *found;       /* HIT_ROWS of them; only while columns of grazing water are searched */
    const float *light;                /* of this vector's pixels, planes of a tile_light; NULL: no objects */
};

#endif
