/* SPDX-License-Identifier: MIT
 *
 * From a tree of YAML nodes to checked scene values.
 */
#ifndef MANGATA_SCENE_SCENE_READ_H
#define MANGATA_SCENE_SCENE_READ_H

#include "scene/scene_fields.h"
#include "scene/scene_tree.h"

/* Fills *values, which holds the defaults, from the tree: every key, type and range is checked against the table.
 * False on the first error, with *error filled; values are then partly filled and still to be freed. */
bool scene_read(const scene_tree *tree, scene_values *values, scene_error *error);

/* Checks what concerns several keys at once: size of the image, order of keyframes, legal cameras in every frame,
 * keys that exclude each other. */
bool scene_check(const scene_tree *tree, const scene_values *values, scene_error *error);

/* Looks for values that are legal but probably a mistake: waves steeper than water can be, and a camera that waves wash over. False with *warning filled by
 * the first of these; needs the waves of the spectrum. */
bool scene_warn(const scene_tree *tree, const scene_values *values, scene_error *warning);

/* Writes one override, "key=value", into the tree. */
bool scene_override_apply(scene_tree *tree, const char *override, scene_error *error);

#endif
