/* SPDX-License-Identifier: MIT
 * Passes over scenes with objects on the GPU: objects in front of the water, objects behind its surface, and objects that the surface mirrors. */
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

/* Images of the objects that pixels see. The shaders objects_*.comp write and describe them. */
typedef struct gl_seen {
    gl_image body, mirrored; /* RGBA32F */
    gl_image front, surface; /* RGBA32F */
    gl_image error;          /* R32F */
    gl_image clear, deep;    /* RGBA32F; `deep` only for a camera under water */
} gl_seen;

typedef struct gl_refraction {
    gl_seen seen, opened; /* when the shutter closes and, for a moving camera alone, when it opens; gl_refraction_blend() puts the mean of both in `seen` */
    shade_scene *shade;
    gl_table materials; /* RGBA32F */
    gl_table texels;    /* R32UI: the texels of all textures */
    uint64_t *textures; /* identities of the textures that `texels` holds, in the same order */
    size_t texture_count, texture_room;
    gl_image shadows;        /* R32F */
    shadow_rays shadow_rays; /* rays of the light for which the map in `shadows` was made */
    uint64_t shadow_version; /* version of the world in that map; 0: none */
    gl_buffer water, lists;  /* values and lists of a band's pixels: see objects_pixel.glsl */
    gl_objects_block block;
    SearchWave again[MAX_WAVES]; /* the waves that NarrowData.waves counts */
} gl_refraction;

/* Prepares the objects of a frame before its bands: draws their layers and updates lights, materials and shadows. */
mgt_status gl_refraction_prepare(struct gl_renderer *g, const frame *f, const region *area, const reporter *r);

/* Reserves one texel of each image and table that a frame may lack: see gl_frame_begin(). */
mgt_status gl_refraction_reserve_least(struct gl_renderer *g, const reporter *r);

/* Largest number of pixels of a band. */
enum { REFRACTION_PIXELS = 1 << 20 };

/* Finds what the pixels of a band see of objects. The band's tiles must be those of the filtered waves over frame_shutter(). */
mgt_status gl_refraction_see(struct gl_renderer *g, const PassData *pass, const reporter *r);

/* gl_refraction_keep() keeps the images as those of the shutter's opening. gl_refraction_blend() then makes those of a band the mean of both ends. */
void gl_refraction_keep(struct gl_renderer *g);
mgt_status gl_refraction_blend(struct gl_renderer *g, const PassData *pass, const reporter *r);

/* gl_refraction_bind_light() binds the images that methods read, gl_refraction_bind_front() those that objects_compose.comp reads. */
void gl_refraction_bind_light(const struct gl_renderer *g);
void gl_refraction_bind_front(const struct gl_renderer *g);

void gl_refraction_free(const gl_api *gl, gl_refraction *o);

#endif
