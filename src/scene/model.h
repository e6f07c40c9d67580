/* SPDX-License-Identifier: MIT
 *
 * Models of a scene's objects: meshes, textures and places in the object's coordinates, from a file or from a built-in shape.
 */
#ifndef MANGATA_SCENE_MODEL_H
#define MANGATA_SCENE_MODEL_H

#include "scene/scene_fields.h"

/* Triangles of a mesh that is being made; freed by mesh_data_free(). */
typedef struct mesh_data {
    float *positions, *normals; /* 3 per vertex; `normals` may be NULL */
    float *texcoords;           /* 2 per vertex; may be NULL */
    uint32_t *indices;          /* 3 per triangle */
    size_t vertex_count, triangle_count;
} mesh_data;

/* A mesh of a model at a place. */
typedef struct model_part {
    const mgt_mesh *mesh;
    double transform[3][4]; /* from the mesh's to the object's coordinates */
    mgt_material material;  /* material by the file */
} model_part;

typedef struct scene_model {
    mgt_mesh **meshes; /* the model owns meshes, textures and the arrays */
    size_t mesh_count;
    mgt_texture **textures;
    size_t texture_count;
    model_part *parts;
    size_t part_count;
    uint64_t triangles; /* number of triangles of all parts */
    uint64_t hash;      /* hash of all data from files */
    double reach;       /* greatest distance of a vertex from the object's origin along an axis */
} scene_model;

/* Why there is no model: a text "FILE: what is wrong; allowed: …" without a place in the scene file. */
typedef struct model_fault {
    scene_error_kind kind;
    char text[400];
} model_fault;

bool model_fault_set(model_fault *fault, scene_error_kind kind, const char *format, ...) SCENE_FORMAT(3, 4);
bool model_fault_memory(model_fault *fault);

/* Allocates all arrays. False: out of memory. */
bool mesh_data_allocate(mesh_data *mesh, size_t vertex_count, size_t triangle_count);
void mesh_data_free(mesh_data *mesh);
/* Sets each vertex normal to the mean of the normals of its triangles, weighted by area. False: out of memory. */
bool mesh_data_smooth(mesh_data *mesh);

/* Builds the triangles of a built-in shape other than a floor. */
bool shape_build(mesh_data *mesh, const scene_object *object);

/* Builds the triangles of a floor from the picture at `path`. *hash becomes that of its heights. */
bool floor_build(mesh_data *mesh, const scene_object *object, const char *path, uint64_t *hash, model_fault *fault);

/* Makes a model of one mesh in the object's coordinates. */
bool model_of_mesh(scene_model *out, const mesh_data *mesh, const char *name, bool dry, model_fault *fault);

/* How a scene uses a file of meshes. */
typedef struct model_use {
    bool own_materials; /* materials and textures are those of the file; false: they are the scene format's defaults */
    bool dry;           /* the meshes are hulls that keep water out */
} model_use;

/* Loads a model. *pixels is the number of pixels of the scene's textures so far, see pixel_budget(); those of this model are added. */
bool model_load(scene_model *out, const char *path, model_use use, uint64_t *pixels, model_fault *fault);

/* Loads a texture from a PNG or JPEG file. *hash becomes that of its pixels. Their number is added to *pixels, see model_load(). NULL: *fault is filled. */
mgt_texture *texture_load(const char *path, uint64_t *pixels, uint64_t *hash, model_fault *fault);
/* Loads a texture from the bytes of a PNG or JPEG file. `name` is for messages. */
mgt_texture *texture_parse(const void *bytes, size_t length, const char *name, uint64_t *pixels, uint64_t *hash, model_fault *fault);

void model_free(scene_model *model);

/* A hash of bytes, continued from `hash`, which is 0 at the beginning. It distinguishes files but does not protect against forgery. */
uint64_t model_hash(uint64_t hash, const void *bytes, size_t length);

#endif
