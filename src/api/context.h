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

#endif
