/* SPDX-License-Identifier: MIT
 * Meshes and textures as backends read them. */
#ifndef MANGATA_FRAME_MESH_H
#define MANGATA_FRAME_MESH_H

#include <stdbool.h>

#include "mangata/mangata.h"

struct mgt_mesh {
    uint64_t id; /* unlike that of every other mesh of this process */
    uint32_t vertex_count, triangle_count;
    float *positions;      /* 3 a vertex */
    float *normals;        /* 3 a vertex, unit; NULL: the triangles are flat */
    float *texcoords;      /* 2 a vertex; NULL: none */
    uint32_t *indices;     /* 3 a triangle */
    int32_t *neighbours;   /* 3 a triangle: the triangles across its edges, of which edge i goes from corner i to the next; −1: none */
    float low[3], high[3]; /* bounds of the vertices in use */
    bool dry;              /* a hull: no water stands inside */
};

/* Fills `neighbours`. Returns false when out of memory. */
bool mesh_find_neighbours(mgt_mesh *m);

enum {
    TEXTURE_LEVELS = 15,
    LINEAR_TEXELS = 1 << 20 /* textures of at most so many texels are kept in linear light, too */
};

struct mgt_texture {
    uint64_t id;
    uint32_t width, height;
    uint32_t levels;                      /* levels of the mip pyramid down to 1 × 1; level l has max(1, size >> l) texels a side */
    uint32_t level_start[TEXTURE_LEVELS]; /* index in `texels` of each level's first texel */
    uint32_t *texels;                     /* sRGB with alpha, 8 bits a channel, red lowest; the levels are averaged in linear light */
    float *linear;                        /* the texels in linear light, 4 floats a texel; NULL: more than LINEAR_TEXELS */
};

#endif
