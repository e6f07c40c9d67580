/* SPDX-License-Identifier: MIT
 * Which sides of triangles face the inside of dry hulls. */
#ifndef MANGATA_FRAME_DRY_H
#define MANGATA_FRAME_DRY_H

#include "frame/world.h"

/*
 * A point is inside the dry meshes of a world, taken together, if they lie straight below it and stand around it at its height: of DRY_DIRECTIONS
 * horizontal rays at most DRY_MISSES meet none of their triangles.
 *
 * A side of a triangle has one level: points before it are tried upwards from near its lowest corner, and what the side sees up to its level is inside.
 * The level is that of the rim: −inf where the side faces no inside. A straight way that begins at a lower point and ends on the side, with no triangle
 * between, lies within the hull: it cannot have come over the rim.
 */
enum { DRY_DIRECTIONS = 16, DRY_MISSES = 2 };

/* Fills w->dry and world_object.in_dry; w->dry stays NULL where no object is dry. false: out of memory. */
bool dry_levels(world *w, thread_pool *pool);

#endif
