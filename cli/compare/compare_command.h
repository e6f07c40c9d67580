/* SPDX-License-Identifier: MIT */
/* The commands that give a report and its pictures, quoted for a shell. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_COMMAND_H
#define MANGATA_CLI_COMPARE_COMPARE_COMMAND_H

#include "cli/compare/compare_job.h"

/* Return texts that the caller frees. NULL: out of memory. */
char *compare_command(const compare_job *job);                                                     /* the command of the whole comparison */
char *compare_picture_command(const compare_job *job, const compare_scene *scene, size_t picture); /* the command that renders the frames of a picture */

#endif
