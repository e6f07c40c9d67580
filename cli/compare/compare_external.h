/* SPDX-License-Identifier: MIT */
/* Methods of others: pictures that are there already, beside those that are rendered. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_EXTERNAL_H
#define MANGATA_CLI_COMPARE_COMPARE_EXTERNAL_H

#include "cli/compare/compare_job.h"

/* In a path: the scene's name in the report. */
#define EXTERNAL_SCENE "{scene}"

/* Adds "NAME=PATH" to the methods. An exit code, after a line on stderr where it is not 0. */
int compare_external_add(compare_request *request, const char *text);

/* Whether method `method` is such. */
static inline bool compare_is_external(const compare_request *request, size_t method) { return request->external[method] != NULL; }

/* Its file of a frame. False, with the error printed, when the path is too long. */
bool compare_external_path(const compare_job *job, const compare_scene *scene, size_t method, size_t frame, char path[COMPARE_PATH]);

/* Reads every frame of every scene, so that an hour of rendering does not end at a bad one: files must be there, of the scene's size, and hold colour or
 * coverage or both, the same in all frames; which is noted in the results. An exit code. */
int compare_external_check(compare_job *job);

#endif
