/* SPDX-License-Identifier: MIT
 * Which points lie inside dry hulls, decided by rays traced from each point. For refraction path-traced. */
#ifndef MANGATA_CPU_PATH_DRY_H
#define MANGATA_CPU_PATH_DRY_H

#include "frame/world.h"
#include "trace/trace.h"

/* The dry meshes of a world. */
typedef struct path_dry path_dry;

/* Rebuilds *dry for the world. *dry is NULL at first, and stays NULL if nothing is dry. It refers to the world, so call this after each change of it. A failure
 * is reported. */
mgt_status path_dry_update(path_dry **dry, const world *w, uint32_t threads, const reporter *r);
void path_dry_free(path_dry *dry); /* NULL is allowed */

/* Whether a point in the world's coordinates lies inside of the dry meshes by the definition in frame/dry.h, with twice as many directions around the point. An
 * eighth of them may meet nothing. */
bool path_dry_holds(const path_dry *dry, const double point[3]);

#endif
