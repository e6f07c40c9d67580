/* SPDX-License-Identifier: MIT */
/* The command line of one `mangata view`. The command checks it, the viewer carries it out. */
#ifndef MANGATA_CLI_VIEW_REQUEST_H
#define MANGATA_CLI_VIEW_REQUEST_H

#include "cli/common/context_options.h"
#include "cli/common/quality_options.h"

typedef struct view_request {
    console out;
    const char *scene_path;
    scene_changes changes;     /* its width and height are also those of the window */
    quality_options quality;   /* options of side A's method */
    context_options context;   /* its gl_device is not used: the window has a device */
    const char *script;        /* path of a script, "-": standard input; NULL: none */
    const char *shader_folder; /* folder of shader files that replace built-in ones; NULL: none */
} view_request;

/* Reads the words after "view". The strings are borrowed from `arguments`. Returns an exit code, or -1: the help has been printed, and there is nothing more to
 * do. The caller calls view_request_free() in every case. */
int view_request_read(view_request *request, int count, char **arguments);
void view_request_free(view_request *request);

#endif
