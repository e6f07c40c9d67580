/* SPDX-License-Identifier: MIT
 * Meshes and textures as backends read them. */
#ifndef MANGATA_FRAME_MESH_H
#define MANGATA_FRAME_MESH_H

#include <stdbool.h>

#include "mangata/mangata.h"

struct mgt_mesh {
    uint64_t id; /* of this process, never used again */
    uint32_t vertex_count, triangle_count;
    float *positions;      /* 3 a vertex */
    float *normals;        /* 3 a vertex, unit; NULL: those of the triangles */
    float *texcoords;      /* 2 a vertex; NULL: none */
    uint32_t *indices;     /* 3 a triangle */
    int32_t *neighbours;   /* 3 a triangle: those across the edges from each corner to the next, −1: none */
    float low[3], high[3]; /* bounds of the vertices in use */
    bool dry;              /* a hull: no water stands inside */
};

/* Fills `neighbours`; false: out of memory. */
bool mesh_find_neighbours(mgt_mesh *m);

enum {
    TEXTURE_LEVELS = 15,
    LINEAR_TEXELS = 1 << 20 /* up to as many are kept in linear light, too */
};

struct mgt_texture {
    uint64_t id;
    uint32_t width, height;
    uint32_t levels;                      /* down to 1 × 1: level l has max(1, size >> l) texels a side */
    uint32_t level_start[TEXTURE_LEVELS]; /* first texel of each in `texels` */
    uint32_t *texels;                     /* RGBA, 8 bits each, red lowest; sRGB, averaged in linear light */
    float *linear;                        /* the same in linear light, 4 a texel; NULL: too many */
};

#endif
