/* SPDX-License-Identifier: MIT
 *
 * Validates Wavefront OBJ files before other code reads them.
 */
#ifndef MANGATA_SCENE_OBJ_CHECK_H
#define MANGATA_SCENE_OBJ_CHECK_H

#include "scene/model.h"

/* Checks that vertices, normals and texture coordinates are finite numbers, that faces refer to existing ones, and that there are at most MGT_MAX_TRIANGLES
 * triangles. `bytes` need no NUL. False: *fault is filled with "FILE:LINE:COLUMN: what is wrong; allowed: …". */
bool obj_check(const char *path, const char *bytes, size_t length, model_fault *fault);

#endif
