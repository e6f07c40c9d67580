/* SPDX-License-Identifier: MIT
 * Checks of scenes and targets. They are done once, before any backend is called. */
#ifndef MANGATA_API_VALIDATE_H
#define MANGATA_API_VALIDATE_H

#include "frame/backend.h"
#include "params/field.h"

mgt_status validate_desc(const reporter *r, const mgt_context_desc *desc);
/* Checks a struct by its rows. `path`: its name and a dot, such as "scene.". */
mgt_status validate_rows(const reporter *r, const char *path, const field_row *fields, const void *values);

mgt_status validate_waves(const reporter *r, const mgt_water *water);
mgt_status validate_scene(const reporter *r, const mgt_scene *scene);

/* Absolute value of a stride, bytes; 0: rows are tightly packed. */
size_t stride_length(ptrdiff_t stride);

mgt_status validate_targets(const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count);

#endif
