/* SPDX-License-Identifier: MIT
 * Public structs of callers that were built with another version of the library.
 *
 * A public struct begins with its size. Members are only ever added at the end, so the size tells the version of the header that the caller was compiled with.
 * The library works on copies of its own version. */
#ifndef MANGATA_API_STRUCTS_H
#define MANGATA_API_STRUCTS_H

#include "frame/backend.h"

enum { MOST_TARGETS = 16 }; /* largest number of targets, textures or views of a call */

typedef struct struct_kind {
    const char *name; /* type, such as "mgt_scene" */
    const char *id;   /* log id of its errors */
    size_t most;      /* largest number that a call takes at once */
    size_t least;     /* size of its first version, bytes */
    size_t size;      /* size of this version, bytes */
    const void *defaults;
} struct_kind;

extern const struct_kind context_desc_kind, context_info_kind, method_properties_kind, mesh_desc_kind, texture_desc_kind, scene_kind, target_kind,
    pixel_info_kind, gl_view_kind, gl_texture_kind, water_answers_kind, sea_kind;

/* Copies an array of `count` structs of the caller to `own`. Its elements are as far apart as the first one's size says. Members that an earlier version lacks
 * get their defaults. A later version's struct is accepted if all members that this library does not know are 0. */
mgt_status struct_take(const reporter *r, const struct_kind *kind, void *own, const void *theirs, size_t count);

/* Copies as much of `own` to a caller's struct as its size, which the caller has set, has room for. */
mgt_status struct_give(const reporter *r, const struct_kind *kind, const void *own, void *theirs);

/* As struct_give(), for a struct whose size stands beside it; the struct gets this size. Where the size is wrong nothing is written. */
mgt_status struct_give_sized(const reporter *r, const struct_kind *kind, const void *own, void *theirs, size_t size);

/* Copies a scene of the caller and checks the copy. */
mgt_status scene_take(const reporter *r, mgt_scene *own, const mgt_scene *theirs);
/* Copies targets of the caller and checks the copies. `scene` is valid. */
mgt_status targets_take(const reporter *r, const mgt_scene *scene, mgt_target *own, const mgt_target *theirs, size_t count);

#endif
