/* SPDX-License-Identifier: MIT
 * What shading needs beside the points: light in air and in water, materials, shadows. */
#ifndef MANGATA_FRAME_SHADE_SCENE_H
#define MANGATA_FRAME_SHADE_SCENE_H

#include "frame/frame.h"
#include "frame/shadow_map.h"
#include "frame/world.h"

/* An object's material as kernels take it, see HitMaterial in material.k. */
typedef struct shade_material {
    float base[3], alpha, metallic, kind, color[3], inverse_size, joint;
    float texture_width, texture_height;
    const mgt_texture *texture; /* NULL: none */
} shade_material;

typedef struct shade_scene {
    ShadeData data;
    FrameData frame;
    const float *sky;
    const world *world;
    shade_material *materials; /* an object each */
    size_t material_room;
    shadow_map *shadows;
    SearchWave waves[MGT_MAX_WAVES]; /* where light is bundled */
    float linear[TEXTURE_CODES];     /* of an sRGB code */
} shade_scene;

/*
 * Fills *s, which is NULL at first. Shadows stay while the world's version and the light are the same. The world, the frame and the sky must outlive its use.
 */
mgt_status shade_update(shade_scene **s, const world *w, const frame *f, const sky_state *sky);
void shade_free(shade_scene *s); /* NULL is allowed */

#endif
