/* SPDX-License-Identifier: MIT
 *
 * What stands in, on and under the water: meshes, textures, materials and their places. */
#ifndef MANGATA_OBJECTS_H
#define MANGATA_OBJECTS_H

#include "mangata/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Triangles and pictures that scenes refer to. They belong to no context and never change: any number of threads, contexts and scenes may use one at
 * once. A context keeps what it uploads or builds for them while frames go on using them. A mesh or texture must outlive every mgt_render() that uses
 * it; contexts do not read it after that. */
typedef struct mgt_mesh mgt_mesh;
typedef struct mgt_texture mgt_texture;

typedef struct mgt_mesh_desc {
    size_t struct_size;
    const float *positions;  /* 3 a vertex, metres, within ±1e6 */
    const float *normals;    /* 3 a vertex, of any length; NULL: those of the triangles */
    const float *texcoords;  /* 2 a vertex, (0, 0) the top left of a texture, (1, 1) its bottom right; it repeats; within ±1e6. NULL: all (0, 0) */
    uint32_t vertex_count;   /* at least 1 */
    uint32_t triangle_count; /* 1 … MGT_MAX_TRIANGLES */
    const uint32_t *indices; /* 3 a triangle, below vertex_count; counter-clockwise seen from outside. Both sides are drawn */
    uint32_t dry;            /* 1: a hull, open or closed at the top; no water is drawn inside. 0: water passes through the mesh. A point is inside if
                              * a triangle of a dry mesh lies straight below it and dry meshes surround it at its own height. The wall may be missing in
                              * up to an eighth of all directions. Water above the rim is drawn */
    uint32_t reserved;       /* 0 */
} mgt_mesh_desc;

typedef struct mgt_texture_desc {
    size_t struct_size;
    uint32_t width, height; /* pixels, 1 … 16384 */
    const uint8_t *pixels;  /* RGBA, 8 bits each, sRGB; the top row first; alpha is not read */
    ptrdiff_t row_stride;   /* bytes from a row to the next one; 0: tightly packed */
} mgt_texture_desc;

/* No triangles; no pixels. */
MGT_API void mgt_mesh_desc_init(mgt_mesh_desc *desc, size_t size);
MGT_API void mgt_texture_desc_init(mgt_texture_desc *desc, size_t size);

/* Copies what the description points to. On failure *mesh is NULL, the status says why and mgt_last_error(NULL) gives the detail. Triangles without
 * area are dropped; it is an error if none is left, or if a number is out of its range or not finite. The caller owns the result and destroys it. */
MGT_API mgt_status mgt_mesh_create(mgt_mesh **mesh, const mgt_mesh_desc *desc);
MGT_API mgt_status mgt_texture_create(mgt_texture **texture, const mgt_texture_desc *desc);
MGT_API void mgt_mesh_destroy(mgt_mesh *mesh); /* NULL is allowed, as below */
MGT_API void mgt_texture_destroy(mgt_texture *texture);

typedef enum mgt_pattern {
    MGT_PATTERN_NONE = 0,
    MGT_PATTERN_TILES = 1,   /* a grid of tiles with joints between them */
    MGT_PATTERN_CHECKER = 2, /* fields of two colours in turn */
    MGT_PATTERN_STRIPES = 3  /* bands of two colours across the first texture coordinate */
} mgt_pattern;

MGT_API const char *mgt_pattern_name(mgt_pattern pattern);
MGT_API bool mgt_pattern_from_name(const char *name, mgt_pattern *pattern);

/* What a surface is made of: diffuse (Lambert) and glossy (GGX). Colours are linear sRGB in [0, 1]. */
typedef struct mgt_material {
    float base_color[3];
    float roughness;            /* GGX α = roughness², [0.02, 1] */
    float metallic;             /* [0, 1]; 0: reflects 4% at normal incidence and is diffuse below */
    const mgt_texture *texture; /* times base_color; NULL: none */
    mgt_pattern pattern;        /* replaces base_color by pattern_color here and there */
    float pattern_color[3];     /* of the joints, of every other field, of every other stripe */
    float pattern_size;         /* side of a tile, field or stripe in texture coordinates (metres for meshes that are laid out so), [1e-4, 1e6] */
    float pattern_joint;        /* width of a joint in tiles, [0, 0.999] */
} mgt_material;

/* A mesh somewhere in the scene. */
typedef struct mgt_object {
    const mgt_mesh *mesh;
    double transform[3][4]; /* from the mesh to the world: position = transform · (x, y, z, 1); each number within ±1e6. It may mirror but not flatten: the
                               determinant of the first three columns is beyond ±1e-24 */
    mgt_material material;
} mgt_object;

#ifdef __cplusplus
}
#endif
#endif
