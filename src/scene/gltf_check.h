/* SPDX-License-Identifier: MIT
 *
 * Validates glTF 2.0 files before other code reads them.
 */
#ifndef MANGATA_SCENE_GLTF_CHECK_H
#define MANGATA_SCENE_GLTF_CHECK_H

#include "scene/model.h"

/* Checks the bytes of a .gltf, or of a .glb if `binary` is true: JSON, version 2, indices, lengths and offsets within buffers, buffers within files, numbers of
 * triangles, and that nodes have at most one parent and form no circle. `path` is for messages and for files beside it. *weight becomes the size of the file
 * and its buffers, bytes. False: *fault is filled with "FILE:LINE:COLUMN: what is wrong; allowed: …". */
bool gltf_check(const char *path, const char *bytes, size_t length, bool binary, uint64_t *weight, model_fault *fault);

#endif
