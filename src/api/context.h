/* SPDX-License-Identifier: MIT
 * What a context holds. */
#ifndef MANGATA_API_CONTEXT_H
#define MANGATA_API_CONTEXT_H

#include <stdatomic.h>

#include "frame/backend.h"

struct mgt_context {
    const backend_functions *backend;
    void *state;
    reporter report;
    mgt_context_info info;
    mgt_context_desc desc;
    void *cpu;            /* made when first needed: the state of cpu_backend for what only the CPU does */
    uint32_t told_of_cpu; /* bits by method: the log has said that the CPU renders it instead of OpenGL */
    char error[REPORTER_TEXT];
    atomic_bool busy; /* a call that uses the state runs */
};

/* Begins a call that uses the context's state, and clears its last error. False where `context` is NULL or such a call already runs, on another thread or around a
 * callback: the caller then returns MGT_ERROR_ARGUMENT and touches nothing. */
bool context_enter(mgt_context *context);

/* Ends that call; returns `status`. */
mgt_status context_leave(mgt_context *context, mgt_status status);

/* Brings a checked scene to sea level. MGT_ERROR_UNSUPPORTED where its method cannot draw it. */
mgt_status scene_ready(const reporter *r, mgt_scene *own);

/* Logs, once a method, that the CPU renders in place of OpenGL: a warning where OpenGL was asked for by name. `lacks`: a subject and a verb, such as
 * "the method runs". */
void announce_cpu(mgt_context *context, mgt_method method, const char *lacks);

/* The CPU backend's state: the context's own, or a second one beside another backend. */
mgt_status cpu_state(mgt_context *context, void **state);

#endif
