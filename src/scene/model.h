/* SPDX-License-Identifier: MIT
 *
 * What one object of a scene is made of: meshes, textures and where they stand in its own coordinates, from a file or from a built-in shape.
 */
#ifndef MANGATA_SCENE_MODEL_H
#define MANGATA_SCENE_MODEL_H

#include "scene/scene_fields.h"

/* Triangles as they grow; to be freed with mesh_data_free(). */
typedef struct mesh_data {
    float *positions, *normals; /* 3 a vertex; normals may be NULL */
    float *texcoords;           /* 2 a vertex; may be NULL */
    uint32_t *indices;          /* 3 a triangle */
    size_t vertex_count, triangle_count;
} mesh_data;

/* A mesh of a model at its place. */
typedef struct model_part {
    const mgt_mesh *mesh;
    double transform[3][4]; /* to the object's coordinates */
    mgt_material material;  /* the file's own */
} model_part;

typedef struct scene_model {
    mgt_mesh **meshes; /* owned, as is each, and as are the textures */
    size_t mesh_count;
    mgt_texture **textures;
    size_t texture_count;
    model_part *parts;
    size_t part_count;
    uint64_t triangles; /* of all parts */
    uint64_t hash;      /* of all that came from files */
    double reach;       /* no vertex lies further from the object's origin along an axis */
} scene_model;

/* Why there is none: a text "FILE: what is wrong; allowed: …" without a place in the scene. */
typedef struct model_fault {
    scene_error_kind kind;
    char text[400];
} model_fault;

bool model_fault_set(model_fault *fault, scene_error_kind kind, const char *format, ...) SCENE_FORMAT(3, 4);
bool model_fault_memory(model_fault *fault);

/* Allocates all arrays for so many; false when memory runs out. */
bool mesh_data_allocate(mesh_data *mesh, size_t vertex_count, size_t triangle_count);
void mesh_data_free(mesh_data *mesh);
/* Normals as the means of those of the triangles around, by area. */
bool mesh_data_smooth(mesh_data *mesh);

/* The triangles of a built-in shape other than a floor. */
bool shape_build(mesh_data *mesh, const scene_object *object);

/* A floor's, from the picture at `path`; *hash is that of its heights. */
bool floor_build(mesh_data *mesh, const scene_object *object, const char *path, uint64_t *hash, model_fault *fault);

/* A model of one mesh in the object's own coordinates. */
bool model_of_mesh(scene_model *out, const mesh_data *mesh, const char *name, bool dry, model_fault *fault);

/* How a scene uses a file of meshes. */
typedef struct model_use {
    bool own_materials; /* with the materials and textures it names; else they are left at the format's defaults */
    bool dry;           /* its meshes are hulls */
} model_use;

/* *pixels counts those of the scene's textures so far; see pixel_budget(). */
bool model_load(scene_model *out, const char *path, model_use use, uint64_t *pixels, model_fault *fault);

/* A texture from a PNG or JPEG file; *hash is that of its pixels, *pixels counts them with the scene's others. NULL with *fault filled. */
mgt_texture *texture_load(const char *path, uint64_t *pixels, uint64_t *hash, model_fault *fault);
/* The same from the bytes of one; `name` is for messages. */
mgt_texture *texture_parse(const void *bytes, size_t length, const char *name, uint64_t *pixels, uint64_t *hash, model_fault *fault);

void model_free(scene_model *model);

/* A hash of bytes, continued from `hash` (0 to begin). Not against forgery: it tells one file from the next. */
uint64_t model_hash(uint64_t hash, const void *bytes, size_t length);

#endif
