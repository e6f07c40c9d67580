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

/* Numbers of a record: HitTriangle, and HitMaterial but for `texture`; the rest is padding. */
enum { HIT_TRIANGLE_FLOATS = 24, HIT_MATERIAL_FLOATS = 16 };

typedef struct shade_scene {
    ShadeData data;
    FrameData frame;
    const float *sky;
    const world *world;
    shade_material *materials; /* one an object */
    float *material_rows;      /* the same as records, and one more for rays that meet nothing */
    size_t material_room;
    float *triangles; /* a record each, and one more; NULL before shade_list_triangles() */
    size_t triangle_room;
    uint64_t triangle_version; /* of the world that they are of */
    shadow_map *shadows;
    SearchWave waves[MGT_MAX_WAVES]; /* where light is bundled */
    float linear[TEXTURE_CODES];     /* of an sRGB code */
} shade_scene;

/*
 * Fills *s, which is NULL at first. Shadows stay while the world's version and the light are the same. The world, the frame and the sky must outlive its use.
 */
mgt_status shade_update(shade_scene **s, const world *w, const frame *f, const sky_state *sky);

/* Fills s->triangles, 96 bytes each, after shade_update(). False: out of memory. */
bool shade_list_triangles(shade_scene *s);

void shade_free(shade_scene *s); /* NULL is allowed */

#endif
