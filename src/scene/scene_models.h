/* SPDX-License-Identifier: MIT
 *
 * The objects of a scene with what they are made of.
 */
#ifndef MANGATA_SCENE_SCENE_MODELS_H
#define MANGATA_SCENE_SCENE_MODELS_H

#include "scene/scene_fields.h"
#include "scene/scene_tree.h"

typedef struct scene_models scene_models; /* immutable, counted by its owners */

/* Loads and builds what values->objects name into values->models; errors at the places of their keys. Each file is read once, and not at all where `former` has it
 * from the same file and of the same time. `former`: of an earlier reading, or NULL. */
bool scene_models_read(const scene_tree *tree, scene_values *values, const scene_models *former, scene_error *error);

/* Another owner, and one fewer. NULL is allowed. */
scene_models *scene_models_share(scene_models *models);
void scene_models_release(scene_models *models);

/* The objects of the scene; NULL where there are none. They live as long as `models`. */
const mgt_object *scene_models_objects(const scene_models *models, size_t *count);

/* What object `object` of them is called: the name of the file's object, "NAME/2" at its second place; without a name after its shape or mesh. NULL: there is none. */
const char *scene_models_label(const scene_models *models, size_t object);

/* What stands in the files, a line "objects[0].content HASH" each, for the canonical text. */
void scene_models_write(FILE *stream, const scene_models *models);

#endif
