/* SPDX-License-Identifier: MIT
 *
 * Meshes from PLY files.
 */
#ifndef MANGATA_SCENE_MODEL_PLY_H
#define MANGATA_SCENE_MODEL_PLY_H

#include "scene/model.h"

/* The triangles of a PLY file's bytes, polygons cut into fans, with smooth normals where it has none of its own. `name` is for messages. */
bool ply_parse(mesh_data *out, const char *bytes, size_t length, const char *name, model_fault *fault);

/* A model of the regular file at `path`. */
bool ply_load(scene_model *out, const char *path, bool dry, model_fault *fault);

#endif
