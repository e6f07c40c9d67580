/* SPDX-License-Identifier: MIT
 *
 * Validation of glTF 2.0 files before anything else reads them.
 */
#ifndef MANGATA_SCENE_GLTF_CHECK_H
#define MANGATA_SCENE_GLTF_CHECK_H

#include "scene/model.h"

/* Checks a .gltf (`binary` false) or a .glb from its bytes: JSON, version 2, indices in range, every length and offset against its buffer and that against its
 * file, numbers of triangles, each node one parent and no circle. `path` is for messages and for the files beside it. *weight is how many bytes the file and
 * its buffers have in all. False with *fault filled: "FILE:LINE:COLUMN: what is wrong; allowed: …". */
bool gltf_check(const char *path, const char *bytes, size_t length, bool binary, uint64_t *weight, model_fault *fault);

#endif
