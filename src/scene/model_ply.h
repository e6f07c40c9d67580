/* SPDX-License-Identifier: MIT
 *
 * Meshes from PLY files.
 */
#ifndef MANGATA_SCENE_MODEL_PLY_H
#define MANGATA_SCENE_MODEL_PLY_H

#include "scene/model.h"

/* Reads the triangles of a PLY file from its bytes. Polygons are cut into fans. A file without normals gets smooth ones. `name` is for messages. */
bool ply_parse(mesh_data *out, const char *bytes, size_t length, const char *name, model_fault *fault);

/* Loads a model from the regular file at `path`. */
bool ply_load(scene_model *out, const char *path, bool dry, model_fault *fault);

#endif
