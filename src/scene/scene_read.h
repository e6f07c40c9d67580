/* SPDX-License-Identifier: MIT
 *
 * Reads scene values from a tree of YAML nodes and checks them.
 */
#ifndef MANGATA_SCENE_SCENE_READ_H
#define MANGATA_SCENE_SCENE_READ_H

#include "scene/scene_fields.h"
#include "scene/scene_tree.h"

/* Fills *values, which has the defaults, from the tree. Every key, type and range is checked by the table. False: the first error is in *error, and `values`
 * are partly filled and must be freed. */
bool scene_read(const scene_tree *tree, scene_values *values, scene_error *error);

/* Checks conditions on several keys: size of the image, order of keyframes, legal cameras in every frame, and keys that exclude each other. */
bool scene_check(const scene_tree *tree, const scene_values *values, scene_error *error);

/* Searches for values that are legal but probably a mistake: waves that are steeper than water can be, and a camera that waves wash over. scene_sea_fill() must
 * come before. False: *warning is filled with the first one. */
bool scene_warn(const scene_tree *tree, const scene_values *values, scene_error *warning);

/* Writes one override, "key=value", into the tree. */
bool scene_override_apply(scene_tree *tree, const char *override, scene_error *error);

#endif
