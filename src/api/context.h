/* SPDX-License-Identifier: MIT
 * What a context holds. */
#ifndef MANGATA_API_CONTEXT_H
#define MANGATA_API_CONTEXT_H

#include "frame/backend.h"

struct mgt_context {
    const backend_functions *backend;
    void *state;
    reporter report;
    mgt_context_info info;
    void *cpu; /* made when first needed: the state of cpu_backend for what only the CPU does */
    char error[REPORTER_TEXT];
};

/* For what is created without a context: the text of mgt_last_error(NULL), emptied. */
reporter creation_reporter(void);

/* Moves a scene's cameras so that the mean surface is at y = 0, as backends expect it. Objects stay where they are, so who reads them
 * takes water.level off. */
void scene_to_sea_level(mgt_scene *own);

#endif
