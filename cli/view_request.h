/* SPDX-License-Identifier: MIT */
/* What one `mangata view` was asked to do; the command checks it, the viewer does it. */
#ifndef MANGATA_CLI_VIEW_REQUEST_H
#define MANGATA_CLI_VIEW_REQUEST_H

#include "cli/common/context_options.h"
#include "cli/common/quality_options.h"

typedef struct view_request {
    console out;
    const char *scene_path;
    scene_changes changes;     /* width and height are the window's as well */
    quality_options quality;   /* of side A */
    context_options context;   /* but for the device: the window has one */
    const char *script;        /* NULL: none */
    const char *shader_folder; /* NULL: none */
} view_request;

/* Reads the words behind "view". An exit code, or -1 when the help was printed and there is nothing more to do. Free in every case. */
int view_request_read(view_request *request, int count, char **arguments);
void view_request_free(view_request *request);

#endif
