/* SPDX-License-Identifier: MIT
 * What the accessors of the kernels read on the CPU. */
#ifndef MANGATA_CPU_KERNEL_CONTEXT_H
#define MANGATA_CPU_KERNEL_CONTEXT_H

#include "cpu/lanes.h"
#include "frame/kernel_data.h"
#include "frame/podee_tables.h"

/* What a kernel can reach through its accessors. */
struct kernel_context {
    const FrameData *frame;
    const TileData *tile;
    const WaveData *waves;
    const SearchWave *search;
    const FoamData *foam; /* NULL: there is none */
    const FoamWave *foam_waves;
    const FoamSine *foam_sines;
    const float *skyline;              /* pairs, as wave_set has them; only where a tile says so */
    const float *sky;                  /* SKY_TABLE_ROWS × SKY_COLUMNS × 3, and one beyond */
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

/* For the pixels of a tile. */
static inline struct kernel_context context_for(const FrameData *data, const tile_waves *tile)
{
    struct kernel_context cx = {.frame = data, .tile = &tile->data, .waves = tile->waves, .search = tile->search, .skyline = tile->skyline};
    if (tile->foam) {
        cx.foam = &tile->foam->data;
        cx.foam_waves = tile->foam->waves;
        cx.foam_sines = tile->foam->sines;
    }
    return cx;
}

#endif
