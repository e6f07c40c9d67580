/* SPDX-License-Identifier: MIT
 * Which points lie inside dry hulls, by rays traced from each: what the ground truth of refraction goes by. */
#ifndef MANGATA_CPU_PATH_DRY_H
#define MANGATA_CPU_PATH_DRY_H

#include "frame/world.h"
#include "trace/trace.h"

/* The dry meshes of a world. */
typedef struct path_dry path_dry;

/* *dry is NULL at first, and stays NULL where nothing is dry. It refers to the world, and is to be updated with it. On failure the report says why. */
mgt_status path_dry_update(path_dry **dry, const world *w, uint32_t threads, const reporter *r);
void path_dry_free(path_dry *dry); /* NULL is allowed */

/* Whether the meshes lie straight below a point, in the world's coordinates, and around it at its height: by frame/dry.h's definition, in twice as many
 * directions, of which an eighth may meet nothing. */
bool path_dry_holds(const path_dry *dry, const double point[3]);

#endif
