/* SPDX-License-Identifier: MIT
 *
 * The objects of a scene with their models.
 */
#ifndef MANGATA_SCENE_SCENE_MODELS_H
#define MANGATA_SCENE_SCENE_MODELS_H

#include "scene/scene_fields.h"
#include "scene/scene_tree.h"

typedef struct scene_models scene_models; /* immutable; its owners are counted */

/* Loads and builds the models of values->objects into values->models. Errors have the places of the objects' keys. Each file is read once, or not at all if
 * `former`, the models of an earlier reading, has it from the same file with the same time. `former` may be NULL. */
bool scene_models_read(const scene_tree *tree, scene_values *values, const scene_models *former, scene_error *error);

/* Adds an owner. Returns `models`. NULL is allowed. */
scene_models *scene_models_share(scene_models *models);
/* Removes an owner. NULL is allowed. */
void scene_models_release(scene_models *models);

/* The objects of the scene; NULL: there are none. They live as long as `models`. */
const mgt_object *scene_models_objects(const scene_models *models, size_t *count);

/* Name of object `object`, see scene_file_object_name(). NULL: there is no such object. */
const char *scene_models_label(const scene_models *models, size_t object);

/* Writes a line "objects[0].content HASH" for the files of each object, for the canonical text. */
void scene_models_write(FILE *stream, const scene_models *models);

#endif
