/* SPDX-License-Identifier: MIT
 * Scenes with objects on the GPU: what pixels see of them through the water's surface, mirrored by it and in front of it. */
#ifndef MANGATA_GL_GL_REFRACTION_H
#define MANGATA_GL_GL_REFRACTION_H

#include "frame/frame.h"
#include "frame/shade_scene.h"
#include "frame/shadow_map.h"
#include "gl/gl_memory.h"
#include "gl/gl_objects.h"
#include "gl/gl_pass_data.h"
#include "frame/targets.h"

struct gl_renderer;

/* The uniform block of objects_data.glsl. */
typedef struct gl_objects_block {
    RefractData refract;
    NarrowData narrow;
    ShadeData shade;
    ObjectsData objects;
} gl_objects_block;

/* What pixels see of objects: see the shaders of their names. */
typedef struct gl_seen {
    gl_image body, mirrored; /* RGBA32F */
    gl_image front, surface; /* RGBA32F */
    gl_image error;          /* R32F */
    gl_image clear, deep;    /* RGBA32F; the last while a camera is under water */
} gl_seen;

typedef struct gl_refraction {
    gl_seen seen, opened; /* now, and while a camera moves, when the shutter opened */
    shade_scene *shade;
    gl_table materials; /* RGBA32F */
    gl_table texels;    /* R32UI, of all textures */
    uint64_t *textures; /* identities of those that `texels` holds, in their order */
    size_t texture_count, texture_room;
    gl_image shadows;        /* R32F */
    shadow_rays shadow_rays; /* of the map that `shadows` holds */
    uint64_t shadow_version; /* of the world in that map; 0: none */
    gl_buffer water, lists;  /* of a band's pixels: see objects_pixel.glsl */
    gl_objects_block block;
    SearchWave again[MAX_WAVES]; /* those of block.narrow.waves */
} gl_refraction;

/* Everything that the objects of a frame need before its bands: draws them, and brings lights, materials and shadows up to date. */
mgt_status gl_refraction_prepare(struct gl_renderer *g, const frame *f, const region *area, const reporter *r);

/* A texel of each image and table that a frame may do without: see gl_frame_begin(). */
mgt_status gl_refraction_reserve_least(struct gl_renderer *g, const reporter *r);

/* Pixels of a band that the buffers can take at a time. */
enum { REFRACTION_PIXELS = 1 << 20 };

/* What the pixels of a band see of objects. The band's tiles are those of the filtered waves over frame_shutter(). */
mgt_status gl_refraction_see(struct gl_renderer *g, const PassData *pass, const reporter *r);

/* Keeps what has been seen as that of the shutter's opening, and makes it part of a band's. */
void gl_refraction_keep(struct gl_renderer *g);
mgt_status gl_refraction_blend(struct gl_renderer *g, const PassData *pass, const reporter *r);

/* Binds what methods read of it, and what objects_compose.comp does. */
void gl_refraction_bind_light(const struct gl_renderer *g);
void gl_refraction_bind_front(const struct gl_renderer *g);

void gl_refraction_free(const gl_api *gl, gl_refraction *o);

#endif
