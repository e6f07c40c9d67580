/* SPDX-License-Identifier: MIT
 * Which points of a world the light's centre sees: the highest object along each of its rays, which are bent by the flat mean surface. */
#ifndef MANGATA_FRAME_SHADOW_MAP_H
#define MANGATA_FRAME_SHADOW_MAP_H

#include "frame/world.h"

/*
 * A ray of the light meets the mean surface at (x, z) − lean · y, where lean is ∂(x, z)/∂y along the ray in air or, for y below 0, in water: this
 * place names the ray. A texel holds the greatest height of any object there.
 *
 * Where something is dry the map has a second half below the first one, of the same places: rays that go straight on below 0, as light falls into dry
 * hulls.
 */
typedef struct shadow_rays {
    double air[2], water[2]; /* lean */
} shadow_rays;

enum { SHADOW_SIDE = 2048, SHADOW_BLOCK = 8, SHADOW_LEVELS = 9 }; /* texels: most a side of a half, a side of the smallest blocks */

typedef struct shadow_map {
    uint64_t version; /* of the world it was drawn from */
    shadow_rays rays;
    uint32_t columns, rows; /* 0: nothing casts shadows */
    uint32_t halves;        /* 1, or 2: rows are those of one */
    float left, top;        /* place of its corner, metres in the world's coordinates */
    float texel;            /* metres */
    float *height;          /* columns × rows × halves; −inf: nothing */
    int levels;             /* of blocks of SHADOW_BLOCK << level texels a side; the last one is one block */
    int across[SHADOW_LEVELS], start[SHADOW_LEVELS];
    int blocks;   /* of all levels of a half */
    float *range; /* blocks × halves × 2: least and greatest height in the block at hand, the one to its right, the one below and the one between them */
} shadow_map;

/* *m is NULL at first; what it holds stays while the world's version and the rays are the same. MGT_ERROR_MEMORY leaves none. */
mgt_status shadow_map_update(shadow_map **m, const world *w, const shadow_rays *rays);
void shadow_map_free(shadow_map *m); /* NULL is allowed */

#endif
