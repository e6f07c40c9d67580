/* SPDX-License-Identifier: MIT
 * Which sides of triangles face the dry inside of hulls, and up to which height. */
#ifndef MANGATA_FRAME_DRY_H
#define MANGATA_FRAME_DRY_H

#include "frame/world.h"

/*
 * The dry meshes of a world are taken together. A point is inside of them if a triangle of theirs lies straight below it and if they stand around it at its
 * height: of DRY_DIRECTIONS horizontal rays from the point at most DRY_MISSES meet none of their triangles.
 *
 * Each side of a triangle has one level, the height of the hull's rim. Points just before the side and below this level are inside. The level is −inf where
 * the side does not face the inside of a hull. A line of sight that begins below the level and ends on the side, with no triangle between, lies within the
 * hull, because it cannot have come over the rim.
 */
enum { DRY_DIRECTIONS = 16, DRY_MISSES = 2 };

/* Fills w->dry and world_object.in_dry. If no object is dry, w->dry stays NULL. Returns false when out of memory. */
bool dry_levels(world *w, thread_pool *pool);

#endif
