/* SPDX-License-Identifier: MIT */
/* The exact commands behind a report, quoted for a shell. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_COMMAND_H
#define MANGATA_CLI_COMPARE_COMPARE_COMMAND_H

#include "cli/compare/compare_job.h"

/* The caller frees the text; NULL when memory runs out. */
char *compare_command(const compare_job *job);                                                     /* the whole comparison */
char *compare_picture_command(const compare_job *job, const compare_scene *scene, size_t picture); /* the frames of one method */

#endif
