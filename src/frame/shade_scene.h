/* SPDX-License-Identifier: MIT
 * What the shading of objects needs beside the hits: light in air and in water, materials, shadows. */
#ifndef MANGATA_FRAME_SHADE_SCENE_H
#define MANGATA_FRAME_SHADE_SCENE_H

#include "frame/frame.h"
#include "frame/shadow_map.h"
#include "frame/world.h"

/* An object's material; see the members of HitMaterial in material.k. */
typedef struct shade_material {
    float base[3], alpha, metallic, kind, color[3], inverse_size, joint;
    float texture_width, texture_height;
    const mgt_texture *texture; /* NULL: none */
} shade_material;

/* Floats of the records of HitTriangle, and of HitMaterial without `texture`; both end with padding. */
enum { HIT_TRIANGLE_FLOATS = 24, HIT_MATERIAL_FLOATS = 16 };

typedef struct shade_scene {
    ShadeData data;
    FrameData frame;
    const float *sky;
    const world *world;
    shade_material *materials; /* one an object */
    float *material_rows;      /* a record for each object, and one more for rays that meet nothing */
    size_t material_room;
    float *triangles; /* a record for each triangle, and one more for rays that meet nothing; NULL before shade_list_triangles() */
    size_t triangle_room;
    uint64_t triangle_version; /* version of the world that `triangles` is from */
    shadow_map *shadows;
    SearchWave waves[MGT_MAX_WAVES]; /* waves that make caustics */
    float linear[TEXTURE_CODES];     /* linear light of each sRGB code */
} shade_scene;

/* Fills *s, which is NULL at first. The shadow map is kept while the world's version and the light are the same. The world, the frame and the sky must
 * outlive the use of *s. */
mgt_status shade_update(shade_scene **s, const world *w, const frame *f, const sky_state *sky);

/* Fills s->triangles, 96 bytes each. Call shade_update() first. Returns false when out of memory. */
bool shade_list_triangles(shade_scene *s);

void shade_free(shade_scene *s); /* NULL is allowed */

#endif
