/* SPDX-License-Identifier: MIT
 * Which points of a world the light's centre sees: the highest object along each of its rays, which are bent by the flat mean surface. */
#ifndef MANGATA_FRAME_SHADOW_MAP_H
#define MANGATA_FRAME_SHADOW_MAP_H

#include "frame/world.h"

/*
 * The ray of the light through a point (x, y, z) meets the mean surface at (x, z) − lean · y, where lean is ∂(x, z)/∂y along the ray: that in air for y ≥ 0,
 * that in water for y < 0. The texel at this place of the surface holds the greatest height at which the ray meets an object.
 *
 * If an object is dry, the map has a second half below the first one. It covers the same places, for rays that go straight on below y = 0. So light falls
 * into dry hulls.
 */
typedef struct shadow_rays {
    double air[2], water[2]; /* lean of the rays in air and in water */
} shadow_rays;

enum { SHADOW_SIDE = 2048, SHADOW_BLOCK = 8, SHADOW_LEVELS = 9 }; /* most texels a side of a half; texels a side of the smallest blocks; most levels */

typedef struct shadow_map {
    uint64_t version; /* of the world it was drawn from */
    shadow_rays rays;
    uint32_t columns, rows; /* 0: nothing casts shadows */
    uint32_t halves;        /* 1 or 2; `rows` counts those of one half */
    float left, top;        /* place of the map's corner, metres in the world's coordinates */
    float texel;            /* size of a texel, metres */
    float *height;          /* columns × rows × halves, metres; −inf: the ray meets no object */
    int levels;             /* number of levels of blocks; a block has SHADOW_BLOCK << level texels a side, and the last level is one block */
    int across[SHADOW_LEVELS], start[SHADOW_LEVELS];
    int blocks;   /* number of blocks in all levels of a half */
    float *range; /* blocks × halves × 2: least and greatest height in a square of four blocks, of which this block is the upper left one */
} shadow_map;

/* Draws the map into *m, which is NULL at first. A map is kept while the world's version and the rays are the same. After MGT_ERROR_MEMORY *m is NULL. */
mgt_status shadow_map_update(shadow_map **m, const world *w, const shadow_rays *rays);
void shadow_map_free(shadow_map *m); /* NULL is allowed */

#endif
