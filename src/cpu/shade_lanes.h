/* SPDX-License-Identifier: MIT
 * The functions of shading that are compiled once per lane width, and what they read. */
#ifndef MANGATA_CPU_SHADE_LANES_H
#define MANGATA_CPU_SHADE_LANES_H

#include "cpu/shade.h"
#include "frame/shadow_map.h"

enum { SHADE_TEXTURE_CODES = 256 };

/* An object's material as kernels take it, see HitMaterial in material.k. */
typedef struct shade_material {
    float base[3], alpha, metallic, kind, color[3], inverse_size, joint;
    float texture_width, texture_height;
    const mgt_texture *texture; /* NULL: none */
} shade_material;

struct shade_scene {
    ShadeData data;
    FrameData frame;
    const float *sky;
    const world *world;
    shade_material *materials; /* an object each */
    size_t material_room;
    shadow_map *shadows;
    MarchWave waves[MGT_MAX_WAVES];    /* where light is bundled */
    float linear[SHADE_TEXTURE_CODES]; /* of an sRGB code */
    const shade_kernels *kernels;
};

struct shade_kernels {
    void (*points)(const shade_scene *s, const shade_hits *hits, float *rgb);
    void (*sun)(const shade_scene *s, size_t count, const float *x, const float *z, float *share);
};

#endif
