/* SPDX-License-Identifier: MIT
 *
 * Wavefront OBJ files, looked through before anything else reads them.
 */
#ifndef MANGATA_SCENE_OBJ_CHECK_H
#define MANGATA_SCENE_OBJ_CHECK_H

#include "scene/model.h"

/* Checks that vertices, normals and texture coordinates are finite numbers, that faces name some that there are, and that there are at most
 * MGT_MAX_TRIANGLES triangles. `bytes` need no NUL. False with *fault filled: "FILE:LINE:COLUMN: what is wrong; allowed: …". */
bool obj_check(const char *path, const char *bytes, size_t length, model_fault *fault);

#endif
