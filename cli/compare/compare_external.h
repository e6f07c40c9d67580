/* SPDX-License-Identifier: MIT */
/* External methods: pictures of other programs, which are compared beside those that are rendered. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_EXTERNAL_H
#define MANGATA_CLI_COMPARE_COMPARE_EXTERNAL_H

#include "cli/compare/compare_job.h"

/* Stands in a path for the scene's name in the report. */
#define EXTERNAL_SCENE "{scene}"

/* Adds "NAME=PATH" to the methods; the request borrows `text`. Returns an exit code; errors are printed. */
int compare_external_add(compare_request *request, const char *text);

/* Whether a method is external. */
static inline bool compare_is_external(const compare_request *request, size_t method) { return request->external[method] != NULL; }

/* Writes the path of an external method's frame to `path`. False: it is too long, which is printed. */
bool compare_external_path(const compare_job *job, const compare_scene *scene, size_t method, size_t frame, char path[COMPARE_PATH]);

/* Checks every external picture before anything is rendered. It must exist, have the scene's size, and hold colour or coverage or both. All frames must hold
 * the same layers, which the results record. Returns an exit code; errors are printed. */
int compare_external_check(compare_job *job);

#endif
