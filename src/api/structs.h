/* SPDX-License-Identifier: MIT
 * Public structs of callers that were built with another version of the library.
 *
 * A public struct begins with its size, which stands for the version of the header that its owner was compiled with: members are only ever
 * added at the end. The library works on copies of its own version. */
#ifndef MANGATA_API_STRUCTS_H
#define MANGATA_API_STRUCTS_H

#include "frame/backend.h"

enum { MOST_TARGETS = 16 }; /* of a call; textures and views likewise */

typedef struct struct_kind {
    const char *name; /* "mgt_scene" */
    const char *id;   /* log id of what is wrong with one */
    size_t most;      /* of them that a call takes at once */
    size_t least;     /* bytes of its first version */
    size_t size;      /* bytes of this version */
    const void *defaults;
} struct_kind;

extern const struct_kind context_desc_kind, context_info_kind, method_properties_kind, mesh_desc_kind, texture_desc_kind, scene_kind, target_kind,
    pixel_info_kind, gl_view_kind, gl_texture_kind, water_answers_kind, sea_kind;

/* Copies `count` structs of the caller, one after another at the distance that the first one's size says, into `own`. What an earlier version lacks
 * gets its default. A later version's struct is accepted while the members that this library does not know are 0, as struct_init leaves them. */
mgt_status struct_take(const reporter *r, const struct_kind *kind, void *own, const void *theirs, size_t count);

/* Fills a caller's struct, whose size is set, with as much of `own` as it has room for. */
mgt_status struct_give(const reporter *r, const struct_kind *kind, const void *own, void *theirs);

/* The library's copies of a scene and of targets for it, found valid. */
mgt_status scene_take(const reporter *r, mgt_scene *own, const mgt_scene *theirs);
mgt_status targets_take(const reporter *r, const mgt_scene *scene, mgt_target *own, const mgt_target *theirs, size_t count);

#endif
