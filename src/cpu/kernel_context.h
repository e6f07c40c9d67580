/* SPDX-License-Identifier: MIT
 * The data that accessors of the kernels read on the CPU. */
#ifndef MANGATA_CPU_KERNEL_CONTEXT_H
#define MANGATA_CPU_KERNEL_CONTEXT_H

#include "cpu/lanes.h"
#include "frame/kernel_data.h"
#include "frame/podee_tables.h"

/* A kernel's data. Members that it does not read may be NULL. */
struct kernel_context {
    const FrameData *frame;
    const TileData *tile;
    const WaveData *waves;
    const SearchWave *search;
    const FoamData *foam; /* NULL: there is no foam */
    const FoamWave *foam_waves;
    const FoamSine *foam_sines;
    const float *skyline;              /* wave_set.skyline; read in tiles whose TileData.skyline is not 0 */
    const float *sky;                  /* sky_state.table: SKY_TABLE_ROWS × SKY_COLUMNS texels of 3 floats, and one float of padding */
    const ViewData *view;              /* only while tiles are sorted */
    const podee_tables *podee;         /* only where podee-* replaces its Gaussian by kernels */
    const struct lean_map *lean;       /* only for methods lean and leadr */
    const RefractData *refract;        /* only in scenes with objects */
    const PictureData *picture;        /* only in scenes with objects, while triangles are drawn */
    const struct shade_scene *shade;   /* only in scenes with objects, while points of objects are shaded */
    const struct narrow_scene *narrow; /* only in scenes with objects, in the narrow phase of refraction */
    struct tile_estimate *found;       /* output of walk_column(), HIT_ROWS structs; only while grazing tiles are searched */
    const float *light;                /* the planes of a tile_light at the pixels of this vector; NULL: there are no objects */
};

/* The context for the pixels of a tile. */
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
